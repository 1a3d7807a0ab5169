#include "panel.h"

#include <algorithm>
#include <cmath>

namespace plot {
namespace {

const Font title_font{24, true, palette::ink};
const Font label_font{22, false, palette::ink};
const Font tick_font{20, false, palette::ink};
const Stroke grid{palette::faint, 1, {}};
const Stroke rim{palette::ink, 1.5, {}};

constexpr double gap = 10;  // between neighbouring texts and lines
constexpr double tick_length = 7;
constexpr double tick_distance = 110;  // about, along an axis
constexpr double key_width = 44;       // of a line in a legend
constexpr double colour_bar_width = 26;
constexpr int colour_bar_steps = 200;
constexpr double overlap = 1.5;  // of neighbouring areas that share an edge

void widen(Range& range, double value) {
  if (range.low > range.high) range = {value, value};
  range = {std::min(range.low, value), std::max(range.high, value)};
}

std::vector<Point> placed(const std::vector<Point>& points, const View& view) {
  std::vector<Point> page;
  page.reserve(points.size());
  for (const auto& point : points) page.push_back(view(point));
  return page;
}

double widest(Canvas& canvas, const std::vector<Tick>& ticks) {
  double width = 0;
  for (const auto& tick : ticks) width = std::max(width, canvas.text_width(tick.label, tick_font));
  return width;
}

std::vector<Tick> ticks_of(const Axis& axis, const Scale& scale, double length) {
  if (axis.ticks.empty()) return scale.ticks(static_cast<int>(length / tick_distance));
  std::vector<Tick> seen;
  for (const auto& tick : axis.ticks)
    if (scale.share(tick.value) >= 0 && scale.share(tick.value) <= 1) seen.push_back(tick);
  return seen;
}

void draw_x_ticks(Canvas& canvas, const View& view, const std::vector<Tick>& ticks) {
  const double baseline = view.box.bottom() + tick_length + gap / 2 + canvas.line_height(tick_font) / 2;
  double free_from = -1e9;  // a label that would touch the one before is left out
  for (const auto& tick : ticks) {
    const double x = view.box.left + view.box.width * view.x.share(tick.value);
    canvas.polyline({{x, view.box.bottom()}, {x, view.box.bottom() + tick_length}}, rim);
    const double half = canvas.text_width(tick.label, tick_font) / 2;
    if (x - half < free_from) continue;
    canvas.text(tick.label, {x, baseline}, tick_font, Align::Middle);
    free_from = x + half + gap;
  }
}

void draw_y_ticks(Canvas& canvas, const View& view, const std::vector<Tick>& ticks) {
  double last = -1e9;
  for (const auto& tick : ticks) {
    const double y = view.box.bottom() - view.box.height * view.y.share(tick.value);
    canvas.polyline({{view.box.left - tick_length, y}, {view.box.left, y}}, rim);
    if (std::abs(y - last) < canvas.line_height(tick_font)) continue;
    canvas.text(tick.label, {view.box.left - tick_length - gap / 2, y}, tick_font, Align::End);
    last = y;
  }
}

void draw_grid(Canvas& canvas, const View& view, const std::vector<Tick>& x_ticks, const std::vector<Tick>& y_ticks) {
  for (const auto& tick : x_ticks) {
    const double x = view.box.left + view.box.width * view.x.share(tick.value);
    canvas.polyline({{x, view.box.top}, {x, view.box.bottom()}}, grid);
  }
  for (const auto& tick : y_ticks) {
    const double y = view.box.bottom() - view.box.height * view.y.share(tick.value);
    canvas.polyline({{view.box.left, y}, {view.box.right(), y}}, grid);
  }
}

}  // namespace

// ---- what is drawn

void Panel::include(const std::vector<Point>& points) {
  for (const auto& point : points) {
    widen(x_data_, point.x);
    widen(y_data_, point.y);
  }
}

void Panel::area(const std::vector<Point>& ring, Colour fill, const std::string& label) {
  include(ring);
  elements_.push_back({[=](Canvas& canvas, const View& view) { canvas.polygon(placed(ring, view), fill); }, label,
                       [=](Canvas& canvas, Point at) {
                         canvas.box({at.x, at.y - 8, key_width, 16}, fill);
                         canvas.frame({at.x, at.y - 8, key_width, 16}, {palette::muted, 1, {}});
                       }});
}

void Panel::line(const std::vector<Point>& points, const Stroke& stroke, const std::string& label) {
  include(points);
  elements_.push_back({[=](Canvas& canvas, const View& view) { canvas.polyline(placed(points, view), stroke); }, label,
                       [=](Canvas& canvas, Point at) {
                         canvas.polyline({at, {at.x + key_width, at.y}}, stroke);
                       }});
}

void Panel::dots(const std::vector<Point>& points, double radius, Colour fill, const std::string& label) {
  include(points);
  elements_.push_back({[=](Canvas& canvas, const View& view) {
                         for (const auto& point : points) canvas.dot(view(point), radius, fill, palette::paper);
                       },
                       label,
                       [=](Canvas& canvas, Point at) {
                         canvas.dot({at.x + key_width / 2, at.y}, radius, fill, palette::paper);
                       }});
}

void Panel::cells(const std::vector<Cell>& cells) {
  for (const auto& cell : cells) include({{cell.x.low, cell.y.low}, {cell.x.high, cell.y.high}});
  elements_.push_back({[=](Canvas& canvas, const View& view) {
                         for (const auto& cell : cells) {
                           const Point from = view({cell.x.low, cell.y.high}), to = view({cell.x.high, cell.y.low});
                           // Each reaches below those to its right and under it, which come later: no seam shows
                           // between them.
                           canvas.box({from.x, from.y, to.x - from.x + overlap, to.y - from.y + overlap}, cell.colour);
                         }
                       },
                       "",
                       {}});
}

void Panel::name(Point at, const std::string& words, Point away) {
  include({at});
  elements_.push_back({[=](Canvas& canvas, const View& view) {
                         const Point anchor = view(at);
                         // A name that would leave the box stands on the other side of its point.
                         const double half = canvas.text_width(words, label_font) / 2;
                         const double low = canvas.line_height(label_font) / 2;
                         const auto side = [](double from, double step, double low_end, double high_end) {
                           return from + step < low_end || from + step > high_end ? from - step : from + step;
                         };
                         canvas.text_over(words,
                                          {side(anchor.x, away.x, view.box.left + half, view.box.right() - half),
                                           side(anchor.y, away.y, view.box.top + low, view.box.bottom() - low)},
                                          label_font, Align::Middle);
                       },
                       "",
                       {}});
}

void Panel::colour_bar(const Scale& scale, const std::string& label) { bar_ = {scale, label}; }

// ---- where it is drawn

Scale Panel::scale_of(const Axis& axis, const Range& data) const {
  if (axis.range) return {axis.kind, axis.range->low, axis.range->high};
  if (data.low > data.high) return {axis.kind, 1, 10};  // nothing is drawn
  if (axis.kind == Scale::Kind::Logarithmic) {
    const double air = data.high > data.low ? std::pow(data.high / data.low, 0.05) : 2;
    return {axis.kind, data.low / air, data.high * air};
  }
  // Of a single value the axis shows a piece that its own digits can tell apart.
  const double least = std::max(std::abs(data.low), std::abs(data.high)) * 1e-9;
  const double extent = data.high - data.low > least ? data.high - data.low : least > 0 ? 1e9 * least : 1;
  return {axis.kind, data.low - 0.04 * extent, data.high + 0.04 * extent};
}

// With equal aspect the shorter direction shows more of the plane; nothing is distorted.
View Panel::fitted(View view) const {
  if (!equal_aspect) return view;
  const double x_extent = view.x.high() - view.x.low(), y_extent = view.y.high() - view.y.low();
  const double unit = std::min(view.box.width / x_extent, view.box.height / y_extent);
  const auto about = [](const Scale& scale, double extent) {
    const double middle = (scale.low() + scale.high()) / 2;
    return Scale(Scale::Kind::Linear, middle - extent / 2, middle + extent / 2);
  };
  view.x = about(view.x, view.box.width / unit);
  view.y = about(view.y, view.box.height / unit);
  return view;
}

void Panel::draw(Canvas& canvas, const Box& outer) const {
  const Box rest = draw_legend(canvas, draw_title(canvas, outer));
  if (unit_of_length.empty())
    draw_axes(canvas, rest);
  else
    draw_map(canvas, rest);
}

Box Panel::draw_title(Canvas& canvas, Box rest) const {
  const double height = canvas.line_height(title_font);
  for (const auto& line : canvas.wrapped(title, title_font, rest.width)) {
    canvas.text(line, {rest.left + rest.width / 2, rest.top + height / 2}, title_font, Align::Middle);
    rest = {rest.left, rest.top + height, rest.width, rest.height - height};
  }
  return title.empty() ? rest : Box{rest.left, rest.top + gap, rest.width, rest.height - gap};
}

Box Panel::draw_legend(Canvas& canvas, Box rest) const {
  const double height = canvas.line_height(label_font) + gap / 2;
  double left = rest.left + gap, top = rest.top;
  bool any = false;
  for (const auto& element : elements_) {
    if (element.label.empty()) continue;
    const double width = key_width + gap + canvas.text_width(element.label, label_font);
    if (any && left + width > rest.right()) left = rest.left + gap, top += height;
    element.key(canvas, {left, top + height / 2});
    canvas.text(element.label, {left + key_width + gap, top + height / 2}, label_font);
    left += width + 3 * gap;
    any = true;
  }
  if (!any) return rest;
  const double used = top + height + gap - rest.top;
  return {rest.left, rest.top + used, rest.width, rest.height - used};
}

void Panel::draw_elements(Canvas& canvas, const View& view) const {
  const Canvas::Clip clip(canvas, view.box);
  for (const auto& element : elements_) element.draw(canvas, view);
}

void Panel::draw_words(Canvas& canvas, const Box& box) const {
  const double height = canvas.line_height(label_font);
  const auto lines = canvas.wrapped(words, label_font, box.width - 2 * gap);
  double y = box.top + (box.height - height * static_cast<double>(lines.size())) / 2 + height / 2;
  for (const auto& line : lines) {
    canvas.text_over(line, {box.left + box.width / 2, y}, label_font, Align::Middle);
    y += height;
  }
}

// A map: no axes, but a bar that tells the scale.
void Panel::draw_map(Canvas& canvas, Box rest) const {
  const double strip = canvas.line_height(tick_font) + gap;
  const Box box{rest.left, rest.top, rest.width, rest.height - strip};
  const View view = fitted({box, scale_of(x, x_data_), scale_of(y, y_data_)});
  draw_elements(canvas, view);
  const double unit = box.width / (view.x.high() - view.x.low());
  const double length = round_down((view.x.high() - view.x.low()) / 3);
  const Point from{rest.left + gap, rest.bottom() - strip / 2}, to{from.x + length * unit, from.y};
  canvas.polyline({{from.x, from.y - 6}, from, to, {to.x, to.y - 6}}, rim);
  canvas.text(plain(length, 3) + " " + unit_of_length, {to.x + gap, to.y}, tick_font);
}

Box Panel::draw_colour_bar(Canvas& canvas, Box rest) const {
  const auto& [scale, label] = *bar_;
  const auto ticks = scale.ticks(6);
  const double words = widest(canvas, ticks) + canvas.line_height(label_font) + tick_length + 3 * gap;
  const Box bar{rest.right() - words - colour_bar_width, rest.top, colour_bar_width, rest.height};
  const double step = bar.height / colour_bar_steps;
  for (int row = 0; row < colour_bar_steps; ++row)  // from the top, each over the one before
    canvas.box({bar.left, bar.top + row * step, bar.width, row + 1 < colour_bar_steps ? step + overlap : step},
               viridis(1 - (row + 0.5) / colour_bar_steps));
  canvas.frame(bar, rim);
  for (const auto& tick : ticks) {
    const double y = bar.bottom() - bar.height * scale.share(tick.value);
    canvas.polyline({{bar.right(), y}, {bar.right() + tick_length, y}}, rim);
    canvas.text(tick.label, {bar.right() + tick_length + gap / 2, y}, tick_font);
  }
  canvas.upward_text(label, {rest.right() - canvas.line_height(label_font) / 2, bar.top + bar.height / 2}, label_font);
  return {rest.left, rest.top, bar.left - 2 * gap - rest.left, rest.height};
}

void Panel::draw_axes(Canvas& canvas, Box rest) const {
  const double tick_height = canvas.line_height(tick_font), label_height = canvas.line_height(label_font);
  const double below = tick_length + gap / 2 + tick_height + (x.label.empty() ? 0 : label_height + gap / 2);
  Box box{rest.left, rest.top + tick_height / 2, rest.width, rest.height - below - tick_height / 2};
  if (bar_) box = draw_colour_bar(canvas, box);

  // The width of the labels depends on the ticks, and those on the width: two rounds settle it.
  View view{box, scale_of(x, x_data_), scale_of(y, y_data_)};
  std::vector<Tick> x_ticks, y_ticks;
  for (int round = 0; round < 2; ++round) {
    view = fitted({view.box, scale_of(x, x_data_), scale_of(y, y_data_)});
    x_ticks = ticks_of(x, view.x, view.box.width);
    y_ticks = ticks_of(y, view.y, view.box.height);
    const double beside = widest(canvas, y_ticks) + tick_length + gap + (y.label.empty() ? 0 : label_height + gap / 2);
    const double beyond = bar_ ? 0 : widest(canvas, x_ticks) / 2;
    view.box = {box.left + beside, box.top, box.width - beside - beyond, box.height};
  }
  view = fitted(view);
  if (!words.empty()) x_ticks.clear(), y_ticks.clear();

  draw_grid(canvas, view, x_ticks, y_ticks);
  draw_elements(canvas, view);
  draw_words(canvas, view.box);
  canvas.frame(view.box, rim);
  draw_x_ticks(canvas, view, x_ticks);
  draw_y_ticks(canvas, view, y_ticks);
  canvas.text(x.label, {view.box.left + view.box.width / 2, rest.bottom() - label_height / 2}, label_font,
              Align::Middle);
  canvas.upward_text(y.label, {rest.left + label_height / 2, view.box.top + view.box.height / 2}, label_font);
}

}  // namespace plot
