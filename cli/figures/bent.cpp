#include "figures/bent.h"

#include <algorithm>

#include "figures/lines.h"

namespace figures {
namespace {

namespace colours = plot::palette;

const plot::Stroke faint{plot::mix(colours::muted, colours::ink, 0.15), 1.2, {}};
const plot::Stroke bold{colours::ink, 1.6, {}};
const plot::Stroke before_polygon{plot::mix(colours::muted, colours::blue, 0.4), 1.6, {4, 6}};
const plot::Stroke after_polygon{colours::blue, 2.2, {12, 7}};

constexpr plot::Range nothing{1e300, -1e300};

void include(plot::Range& range, double value) { range = {std::min(range.low, value), std::max(range.high, value)}; }

plot::Range with_air(plot::Range range, double air) {
  const double extent = range.high > range.low ? range.high - range.low : 1;
  return {range.low - air * extent, range.high + air * extent};
}

// What the curves need, and the control points as far as they are not far away: those of a ring may be.
plot::Range range_of(plot::Range curves, plot::Range polygons) {
  const plot::Range most = with_air(curves, 0.2);
  include(curves, std::max(most.low, polygons.low));
  include(curves, std::min(most.high, polygons.high));
  return with_air(curves, 0.04);
}

}  // namespace

Frame frame_of(const std::vector<Moment>& moments, int dimension, bool closed) {
  Frame curves{nothing, nothing}, polygons{nothing, nothing};
  for (const auto& moment : moments) {
    for (const auto& point : line_of(moment.curve, dimension, closed))
      include(curves.x, point.x), include(curves.y, point.y);
    for (const auto& point : line_of(moment.polygon, dimension, false))
      include(polygons.x, point.x), include(polygons.y, point.y);
  }
  return {range_of(curves.x, polygons.x), range_of(curves.y, polygons.y)};
}

plot::Panel bent_panel(const Moment& before, const Moment& after, int dimension, bool closed, const Frame& frame) {
  plot::Panel panel = plane_panel(dimension);
  panel.x.range = frame.x;
  panel.y.range = frame.y;
  const auto curve = line_of(after.curve, dimension, closed);
  add_inside(panel, curve, dimension, closed);
  panel.line(line_of(before.polygon, dimension, false), before_polygon);
  panel.line(line_of(before.curve, dimension, closed), faint, "before");
  panel.line(curve, bold, "after");
  const auto polygon = line_of(after.polygon, dimension, false);
  if (polygon.size() > 1) panel.line(polygon, after_polygon, "control polygon");
  panel.dots(polygon, 6, colours::blue);
  if (!after.moved.empty()) panel.dots(line_of(after.moved, dimension, false), 8, colours::orange, "moved");
  if (!after.held.empty()) panel.dots(line_of(after.held, dimension, false), 8, colours::ink, "held");
  return panel;
}

}  // namespace figures
