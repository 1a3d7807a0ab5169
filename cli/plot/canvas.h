// A page to draw on: cairo with the few verbs that plots need. Lengths are pixels times the page's scale, y grows
// downwards. The same calls make a PNG and an SVG; letters of an SVG are outlines, so that it looks the same
// everywhere.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <cairo.h>

#include "colour.h"
#include "thin.h"
#include "webp.h"

namespace plot {

enum class Format { Png, Svg };

struct Paper {
  int width = 0;  // pixels
  int height = 0;
  double scale = 1;  // pixels in a unit of length
};

struct Box {
  double left = 0, top = 0, width = 0, height = 0;
  double right() const { return left + width; }
  double bottom() const { return top + height; }
};

struct Stroke {
  Colour colour = palette::ink;
  double width = 2;
  std::vector<double> dashes = {};
};

struct Font {
  double size = 22;
  bool bold = false;
  Colour colour = palette::ink;
};

enum class Align { Start, Middle, End };

class Canvas {
 public:
  Canvas(const Paper& paper, Format format);
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  // `at` is the middle of the line's height; `along` says which part of the text stands there.
  void text(const std::string& words, Point at, const Font& font, Align along = Align::Start);
  // The same, with paper around the letters, so that it can be read over lines.
  void text_over(const std::string& words, Point at, const Font& font, Align along);
  void upward_text(const std::string& words, Point middle, const Font& font);
  double text_width(const std::string& words, const Font& font);
  double line_height(const Font& font);
  // Breaks at blanks so that no line is wider, and words that are wider where they must be.
  std::vector<std::string> wrapped(const std::string& words, const Font& font, double width);

  // Words that are too wide lose letters at their end to a "…".
  std::string shortened(std::string words, const Font& font, double width);

  void polyline(const std::vector<Point>& points, const Stroke& stroke);
  void polygon(const std::vector<Point>& points, Colour fill);
  void dot(Point centre, double radius, Colour fill, Colour rim);
  void box(const Box& box, Colour fill);
  void frame(const Box& box, const Stroke& stroke);

  // Everything drawn while `inside` lives is cut at the box.
  class Clip {
   public:
    Clip(Canvas& canvas, const Box& inside);
    ~Clip();
    Clip(const Clip&) = delete;
    Clip& operator=(const Clip&) = delete;

   private:
    cairo_t* context_;
  };

  // The finished page as a file; `title` is what an SVG tells to those who do not see it. Throws std::runtime_error.
  std::string bytes(const std::string& title);
  // The same as pixels, of a canvas for PNG.
  Pixels pixels();

 private:
  std::vector<std::string> broken(const std::string& word, const Font& font, double width);
  void select(const Font& font);
  Point start_of(const std::string& words, Point at, const Font& font, Align along);
  std::vector<Point> seen(const std::vector<Point>& points) const;
  void trace(std::span<const Point> points);
  void colour(Colour colour);

  std::string png();
  std::string svg(const std::string& title);

  struct Release {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
    void operator()(cairo_t* context) const { cairo_destroy(context); }
  };
  Paper paper_;
  Format format_;
  std::string stream_;  // of the SVG
  std::unique_ptr<cairo_surface_t, Release> surface_;
  std::unique_ptr<cairo_t, Release> context_;
};

}  // namespace plot
