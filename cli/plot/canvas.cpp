#include "canvas.h"

#include <cairo-svg.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace plot {

namespace {

constexpr double visible = 0.5;  // pixels: points of lines that are nearer to each other are not drawn
// Pixels: an SVG's coordinates are multiples, which keeps their decimals few. Cairo itself rounds to 1/256.
constexpr double grain = 1.0 / 16;

// Not the first byte of a character of UTF-8.
bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

// Points of a stroke: cairo's time for pixels grows with the crossings of a stroke with itself, so long lines are drawn
// in pieces. An SVG is drawn by others; its pieces are longer, as each costs bytes.
constexpr std::size_t most_in_pixels = 32, most_in_svg = 512;

cairo_status_t append(void* target, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(target)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

cairo_surface_t* surface_of(const Paper& paper, Format format, std::string& stream) {
  if (format == Format::Png) return cairo_image_surface_create(CAIRO_FORMAT_RGB24, paper.width, paper.height);
  auto* surface = cairo_svg_surface_create_for_stream(append, &stream, paper.width, paper.height);
  cairo_svg_surface_set_document_unit(surface, CAIRO_SVG_UNIT_PX);
  return surface;
}

void check(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS) throw std::runtime_error(cairo_status_to_string(status));
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '<' || c == '&' || c == '>')
      result += c == '<' ? "&lt;" : c == '>' ? "&gt;" : "&amp;";
    else
      result += c >= 0 && c < ' ' ? ' ' : c;
  }
  return result;
}

}  // namespace

Canvas::Canvas(const Paper& paper, Format format)
    : paper_(paper),
      format_(format),
      surface_(surface_of(paper, format, stream_)),
      context_(cairo_create(surface_.get())) {
  colour(palette::paper);
  cairo_paint(context_.get());
  cairo_scale(context_.get(), paper.scale, paper.scale);
  cairo_set_line_join(context_.get(), CAIRO_LINE_JOIN_ROUND);
}

void Canvas::colour(Colour c) { cairo_set_source_rgb(context_.get(), c.red, c.green, c.blue); }

void Canvas::select(const Font& font) {
  cairo_select_font_face(context_.get(), "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         font.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context_.get(), font.size);
}

double Canvas::text_width(const std::string& words, const Font& font) {
  select(font);
  cairo_text_extents_t extents;
  cairo_text_extents(context_.get(), words.c_str(), &extents);
  return extents.x_advance;
}

double Canvas::line_height(const Font& font) {
  select(font);
  cairo_font_extents_t extents;
  cairo_font_extents(context_.get(), &extents);
  return extents.ascent + extents.descent;
}

// Where the pen is set down.
Point Canvas::start_of(const std::string& words, Point at, const Font& font, Align along) {
  const double width = text_width(words, font);
  const double shift = along == Align::Start ? 0 : along == Align::Middle ? width / 2 : width;
  cairo_font_extents_t extents;
  cairo_font_extents(context_.get(), &extents);
  return {at.x - shift, at.y + (extents.ascent - extents.descent) / 2};
}

void Canvas::text(const std::string& words, Point at, const Font& font, Align along) {
  const Point pen = start_of(words, at, font, along);
  colour(font.colour);
  cairo_move_to(context_.get(), pen.x, pen.y);
  cairo_show_text(context_.get(), words.c_str());
}

void Canvas::text_over(const std::string& words, Point at, const Font& font, Align along) {
  const Point pen = start_of(words, at, font, along);
  cairo_move_to(context_.get(), pen.x, pen.y);
  cairo_text_path(context_.get(), words.c_str());
  colour(palette::paper);
  cairo_set_line_width(context_.get(), 7);
  cairo_stroke(context_.get());
  text(words, at, font, along);
}

void Canvas::upward_text(const std::string& words, Point middle, const Font& font) {
  cairo_save(context_.get());
  cairo_translate(context_.get(), middle.x, middle.y);
  cairo_rotate(context_.get(), -std::numbers::pi / 2);
  text(words, {}, font, Align::Middle);
  cairo_restore(context_.get());
}

std::vector<std::string> Canvas::broken(const std::string& word, const Font& font, double width) {
  std::vector<std::string> parts{""};
  for (const char c : word) {
    if (!continues_character(c) && !parts.back().empty() && text_width(parts.back() + c, font) > width)
      parts.emplace_back();
    parts.back() += c;
  }
  return parts;
}

std::vector<std::string> Canvas::wrapped(const std::string& words, const Font& font, double width) {
  std::vector<std::string> lines;
  std::istringstream stream(words);
  for (std::string word; stream >> word;) {
    const bool fits = !lines.empty() && text_width(lines.back() + " " + word, font) <= width;
    if (fits)
      lines.back() += " " + word;
    else if (text_width(word, font) <= width)
      lines.push_back(word);
    else
      for (auto& part : broken(word, font, width)) lines.push_back(std::move(part));
  }
  return lines;
}

std::string Canvas::shortened(std::string words, const Font& font, double width) {
  const std::string dots = "…";
  while (!words.empty() && text_width(words, font) > width) {
    if (words.ends_with(dots)) words.resize(words.size() - dots.size());
    while (!words.empty() && continues_character(words.back())) words.pop_back();
    if (!words.empty()) words.pop_back();
    words += dots;
  }
  return words;
}

std::vector<Point> Canvas::seen(const std::vector<Point>& points) const {
  auto line = thinned(points, visible / paper_.scale);
  if (format_ == Format::Png) return line;
  const double unit = grain / paper_.scale;
  for (auto& [x, y] : line) x = std::round(x / unit) * unit, y = std::round(y / unit) * unit;
  return line;
}

void Canvas::trace(std::span<const Point> points) {
  cairo_new_path(context_.get());
  for (const auto& point : points) cairo_line_to(context_.get(), point.x, point.y);
}

void Canvas::polyline(const std::vector<Point>& points, const Stroke& stroke) {
  const auto line = seen(points);
  colour(stroke.colour);
  cairo_set_line_width(context_.get(), stroke.width);
  cairo_set_dash(context_.get(), stroke.dashes.data(), static_cast<int>(stroke.dashes.size()), 0);
  // The pieces share a step, so that it joins them.
  const std::size_t most = format_ == Format::Png ? most_in_pixels : most_in_svg;
  const std::size_t piece = stroke.dashes.empty() ? most : line.size();
  for (std::size_t first = 0; first < line.size(); first += piece) {
    trace(std::span(line).subspan(first, std::min(piece + 2, line.size() - first)));
    cairo_stroke(context_.get());
  }
  cairo_set_dash(context_.get(), nullptr, 0, 0);
  const auto& at = points.empty() ? Point{} : points.front();
  const auto is_there = [&](const Point& point) { return point.x == at.x && point.y == at.y; };
  if (!points.empty() &&
      std::all_of(points.begin(), points.end(), is_there))  // has no length, and is seen all the same
    dot(at, 1.5 * stroke.width, stroke.colour, stroke.colour);
}

void Canvas::polygon(const std::vector<Point>& points, Colour fill) {
  trace(seen(points));
  cairo_close_path(context_.get());
  colour(fill);
  cairo_fill(context_.get());
}

void Canvas::dot(Point centre, double radius, Colour fill, Colour rim) {
  cairo_new_path(context_.get());
  cairo_arc(context_.get(), centre.x, centre.y, radius, 0, 2 * std::numbers::pi);
  colour(fill);
  cairo_fill_preserve(context_.get());
  colour(rim);
  cairo_set_line_width(context_.get(), 1.5);
  cairo_stroke(context_.get());
}

void Canvas::box(const Box& box, Colour fill) {
  cairo_rectangle(context_.get(), box.left, box.top, box.width, box.height);
  colour(fill);
  cairo_fill(context_.get());
}

void Canvas::frame(const Box& box, const Stroke& stroke) {
  polyline({{box.left, box.top},
            {box.right(), box.top},
            {box.right(), box.bottom()},
            {box.left, box.bottom()},
            {box.left, box.top}},
           stroke);
}

Canvas::Clip::Clip(Canvas& canvas, const Box& inside) : context_(canvas.context_.get()) {
  cairo_save(context_);
  cairo_rectangle(context_, inside.left, inside.top, inside.width, inside.height);
  cairo_clip(context_);
}

Canvas::Clip::~Clip() { cairo_restore(context_); }

std::string Canvas::bytes(const std::string& title) {
  check(cairo_status(context_.get()));
  return format_ == Format::Png ? png() : svg(title);
}

Pixels Canvas::pixels() {
  check(cairo_status(context_.get()));
  auto* const surface = surface_.get();
  cairo_surface_flush(surface);
  Pixels all{cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface), {}};
  const unsigned char* row = cairo_image_surface_get_data(surface);
  const auto width = static_cast<std::size_t>(all.width);
  all.values.resize(width * static_cast<std::size_t>(all.height));
  for (std::size_t y = 0; y < static_cast<std::size_t>(all.height); ++y, row += cairo_image_surface_get_stride(surface))
    std::memcpy(&all.values[y * width], row, width * sizeof all.values[0]);
  for (auto& value : all.values) value |= 0xff000000;  // cairo leaves that byte open
  return all;
}

std::string Canvas::png() {
  std::string bytes;
  check(cairo_surface_write_to_png_stream(surface_.get(), append, &bytes));
  return bytes;
}

std::string Canvas::svg(const std::string& title) {
  cairo_surface_finish(surface_.get());
  check(cairo_surface_status(surface_.get()));
  const auto root = stream_.find("<svg");
  const auto inside = root == std::string::npos ? root : stream_.find('>', root);
  if (inside == std::string::npos) throw std::runtime_error("cairo wrote no SVG.");
  stream_.insert(inside + 1, "\n<title>" + escaped(title) + "</title>");
  return stream_;
}

}  // namespace plot
