// The fractal dimension of a curve, as counting at many scales tells it.
#pragma once

#include <vector>

#include "linalg/trend.h"
#include "measure/polyline.h"

namespace ifsm::core {

enum class Counting : std::int32_t { boxes = 0, divider = 1 };

// The scales: geometrically from the largest to the smallest, in the samples' units.
struct ScaleRange {
  int scales = 12;
  double smallest = 0;  // 0: twice the mean segment, but at most a quarter of the largest
  double largest = 0;   // 0: a quarter of the bounding box's diagonal
};

struct Dimension {
  std::vector<double> scales;  // growing smaller
  std::vector<double> counts;
  double dimension;  // minus the slope of log count over log scale
  double standard_error;
  double r_squared;
};

// Boxes: how many cubes of a grid with that side the curve touches; the grid's corner is the bounding box's lowest, and
// cubes own their lower faces. Exactly that, for coordinates rounded to 2^-30 of the bounding box's longest side; sides
// are rounded so, too. Two and three dimensions.
// Divider: how many steps of that length a pair of compasses takes along the curve, each to the first point so far
// away; the rest counts as the share of a step that its chord is.
//
// Errors: a curve that is a point, or boxes in one or four dimensions (shape); scales outside 3 … 256; a range that is
// empty, above the diagonal, or below 2^-20 of it (range); one so fine that more than 2^26 boxes, or 2^31 steps, might
// be visited (limit).
Dimension measure_dimension(const Polyline& polyline, Counting counting, const ScaleRange& range);

}  // namespace ifsm::core
