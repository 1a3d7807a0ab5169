// Curves of any dimension as lines on a page.
#pragma once

#include <string>
#include <vector>

#include "plot/panel.h"

namespace figures {

using Points = std::vector<double>;  // point-major

// The first two coordinates; of a curve of one, that one over the parameter, 0 … 1 in equal steps. A closed line comes
// back to its first point.
std::vector<plot::Point> line_of(const Points& points, int dimension, bool closed);

// How far along the curve each point is; closed: one more entry, the whole length. Increasing, also where points
// repeat: a curve of no length is as long as it has steps.
std::vector<double> lengths(const Points& points, int dimension, bool closed);

// What to call that.
std::string position_label(int dimension);

// Linear interpolation in increasing xs, of at least two.
double interpolated(const std::vector<double>& xs, const std::vector<double>& ys, double x);

// Axes for lines of that dimension: equal units where both are lengths, and which coordinates are seen.
plot::Panel plane_panel(int dimension);

// The land inside a ring; nothing of other curves.
void add_inside(plot::Panel& panel, const std::vector<plot::Point>& line, int dimension, bool closed);

}  // namespace figures
