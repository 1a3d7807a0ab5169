// One set of axes with what is drawn in it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "canvas.h"
#include "scale.h"

namespace plot {

struct Range {
  double low = 0, high = 0;
};

struct Axis {
  std::string label = {};
  Scale::Kind kind = Scale::Kind::Linear;
  std::optional<Range> range = {};  // the data's own, with a little air, when not given
  std::vector<Tick> ticks = {};     // round values when empty
};

// Where data coordinates lie on the page.
struct View {
  Box box;
  Scale x, y;
  Point operator()(Point data) const {
    return {box.left + box.width * x.share(data.x), box.bottom() - box.height * y.share(data.y)};
  }
};

struct Cell {
  Range x, y;
  Colour colour;
};

class Panel {
 public:
  std::string title;
  Axis x, y;
  bool equal_aspect = false;   // one unit is as long upwards as it is sideways
  std::string words;           // in the middle: why there is nothing to see
  std::string unit_of_length;  // when set: no axes, a bar of a round length in this unit instead (maps)

  void area(const std::vector<Point>& ring, Colour fill, const std::string& label = "");
  void line(const std::vector<Point>& points, const Stroke& stroke, const std::string& label = "");
  void dots(const std::vector<Point>& points, double radius, Colour fill, const std::string& label = "");
  // From left to right and from top to bottom.
  void cells(const std::vector<Cell>& cells);
  // Words beside a point; `away` says in which direction, in pixels.
  void name(Point at, const std::string& words, Point away);
  // The scale of viridis, drawn at the right.
  void colour_bar(const Scale& scale, const std::string& label);

  void draw(Canvas& canvas, const Box& outer) const;

 private:
  struct Element {
    std::function<void(Canvas&, const View&)> draw;
    std::string label;                        // in the legend; none when empty
    std::function<void(Canvas&, Point)> key;  // what stands beside it there
  };
  void include(const std::vector<Point>& points);
  Scale scale_of(const Axis& axis, const Range& data) const;
  Box draw_title(Canvas& canvas, Box rest) const;
  Box draw_legend(Canvas& canvas, Box rest) const;
  Box draw_colour_bar(Canvas& canvas, Box rest) const;
  void draw_map(Canvas& canvas, Box rest) const;
  void draw_axes(Canvas& canvas, Box rest) const;
  void draw_words(Canvas& canvas, const Box& box) const;
  void draw_elements(Canvas& canvas, const View& view) const;
  View fitted(View view) const;

  std::vector<Element> elements_;
  Range x_data_{1, -1}, y_data_{1, -1};  // empty as long as low > high
  std::optional<std::pair<Scale, std::string>> bar_;
};

}  // namespace plot
