// A page to draw on: cairo with the few verbs that plots need. Lengths are pixels, y grows downwards.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <cairo.h>

#include "colour.h"

namespace plot {

struct Point {
  double x = 0, y = 0;
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
  Canvas(int width, int height);

  // `at` is the middle of the line's height; `along` says which part of the text stands there.
  void text(const std::string& words, Point at, const Font& font, Align along = Align::Start);
  // The same, with paper around the letters, so that it can be read over lines.
  void text_over(const std::string& words, Point at, const Font& font, Align along);
  void upward_text(const std::string& words, Point middle, const Font& font);
  double text_width(const std::string& words, const Font& font);
  double line_height(const Font& font);
  // Breaks at blanks so that no line is wider; a single word may be.
  std::vector<std::string> wrapped(const std::string& words, const Font& font, double width);

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

  std::string png() const;  // the page as bytes; throws std::runtime_error

 private:
  void select(const Font& font);
  Point start_of(const std::string& words, Point at, const Font& font, Align along);
  void trace(const std::vector<Point>& points);
  void colour(Colour colour);

  struct Release {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
    void operator()(cairo_t* context) const { cairo_destroy(context); }
  };
  std::unique_ptr<cairo_surface_t, Release> surface_;
  std::unique_ptr<cairo_t, Release> context_;
};

}  // namespace plot
