#include "fit/region.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "curve/transform.h"

namespace ifsm::core {
namespace {

double largest_coordinate(std::span<const double> line) {
  double largest = 0;
  for (const double value : line) largest = std::max(largest, std::abs(value));
  return largest;
}

// Of all levels, from the centre; infinite when a coordinate is not finite.
double largest_polygon(const Shape& shape, const RowMatrix& inverse, const Points& line, int levels) {
  double largest = 0;
  for (Index axis = 0; axis < line.dimension(); ++axis) {
    std::vector<double> fine(line.plane(axis).begin(), line.plane(axis).end());
    for (int level = levels - 1; level >= 0; --level) {
      std::vector<double> coarse(static_cast<std::size_t>(shape.line_length(level)));
      coarsen_level(shape, inverse, fine, coarse);
      largest = std::max(largest, largest_coordinate(coarse));
      fine.swap(coarse);
    }
  }
  return std::isfinite(largest) ? largest : std::numeric_limits<double>::infinity();
}

}  // namespace

Neighbourhood Neighbourhood::of(const Model& start, const Points& line, double reach) {
  return {&line, start.levels(), std::max(reach * start.parts().diagonal, start.parts().largest_polygon)};
}

bool stay_near(const Shape& shape, const RowMatrix& matrix, std::span<const Neighbourhood> curves) {
  const RowMatrix inverse = inverse_of(shape, matrix);
  return std::ranges::all_of(curves, [&](const Neighbourhood& curve) {
    return largest_polygon(shape, inverse, *curve.line, curve.levels) <= curve.largest;
  });
}

}  // namespace ifsm::core
