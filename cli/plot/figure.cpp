#include "figure.h"

#include <numeric>

namespace plot {
namespace {

const Font headline{32, true, palette::ink};
const Font small_print{20, false, {0.35, 0.35, 0.37}};
constexpr double margin = 30;
constexpr double gutter = 34;  // between panels

// The words in lines, not more than leave room for the panels.
std::vector<std::string> lines_of(Canvas& canvas, const std::string& words, const Font& font, double width) {
  constexpr std::size_t most = 3;
  auto lines = canvas.wrapped(words, font, width);
  if (lines.size() <= most) return lines;
  lines.resize(most);
  lines.back() = canvas.shortened(lines.back() + "…", font, width);
  return lines;
}

// Draws words in the box's upper left and gives back what is left of it.
Box take_lines(Canvas& canvas, Box rest, const std::string& words, const Font& font) {
  const double height = canvas.line_height(font) * 1.1;
  for (const auto& line : lines_of(canvas, words, font, rest.width)) {
    canvas.text(line, {rest.left, rest.top + height / 2}, font);
    rest = {rest.left, rest.top + height, rest.width, rest.height - height};
  }
  return rest;
}

double height_of(Canvas& canvas, const std::string& words, const Font& font, double width) {
  return static_cast<double>(lines_of(canvas, words, font, width).size()) * canvas.line_height(font) * 1.1;
}

}  // namespace

std::string Figure::bytes(Format format) const {
  Canvas canvas({width, height, scale}, format);
  draw(canvas);
  return canvas.bytes(title);
}

Pixels Figure::pixels() const {
  Canvas canvas({width, height, scale}, Format::Png);
  draw(canvas);
  return canvas.pixels();
}

void Figure::draw(Canvas& canvas) const {
  Box page{margin, margin, width / scale - 2 * margin, height / scale - 2 * margin};
  page = take_lines(canvas, page, title, headline);
  const double foot = height_of(canvas, note, small_print, page.width);
  take_lines(canvas, {page.left, page.bottom() - foot, page.width, foot}, note, small_print);

  const Box area{page.left, page.top + gutter / 2, page.width,
                 page.height - gutter / 2 - (foot > 0 ? foot + gutter / 2 : 0)};
  const auto across = static_cast<std::size_t>(columns);
  const std::size_t rows = (panels.size() + across - 1) / across;
  const auto widths = shares.empty() ? std::vector<double>(across, 1.0) : shares;
  const double unit = (area.width - gutter * (columns - 1)) / std::accumulate(widths.begin(), widths.end(), 0.0);
  const double tall = (area.height - gutter * static_cast<double>(rows - 1)) / static_cast<double>(rows);
  double left = area.left;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const std::size_t column = i % across;
    if (column == 0) left = area.left;
    const std::size_t row = i / across;
    const double top = area.top + static_cast<double>(row) * (tall + gutter);
    panels[i].draw(canvas, {left, top, unit * widths[column], tall});
    left += unit * widths[column] + gutter;
  }
}

}  // namespace plot
