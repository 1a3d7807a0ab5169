#include "fit/budgets.h"

#include <algorithm>
#include <limits>
#include <string>

#include "base/error.h"

namespace ifsm::core {
Index vectors_of(const FitCurve& curve, const Shape& shape) {
  const int levels = shape.levels_for(curve.samples.count(), curve.closed);
  return shape.control_points() + shape.first_node(levels) * shape.details_per_node();
}

Index fewest_vectors(const std::vector<FitCurve>& curves, const Shape& shape) {
  Index fewest = std::numeric_limits<Index>::max();
  for (const FitCurve& curve : curves) fewest = std::min(fewest, vectors_of(curve, shape));
  return fewest;
}

void require_budgets(const std::vector<Index>& budgets, const Shape& shape, const std::vector<FitCurve>& curves) {
  require_least_budgets(budgets, shape);
  const auto smallest =
      std::ranges::min_element(curves, {}, [&](const FitCurve& curve) { return vectors_of(curve, shape); });
  const Index most = vectors_of(*smallest, shape);
  for (std::size_t b = 0; b < budgets.size(); ++b) {
    if (budgets[b] <= most) continue;
    throw Error(Status::range, "budgets",
                "budgets[" + std::to_string(b) + "] is " + std::to_string(budgets[b]) + "; the model of curve " +
                    std::to_string(smallest - curves.begin()) + ", with " + std::to_string(smallest->samples.count()) +
                    " samples, holds " + std::to_string(most) + " vectors: give at most that, or leave the curve out.")
        .at(static_cast<Index>(b))
        .with(static_cast<double>(budgets[b]))
        .needs(most);
  }
}

void require_least_budgets(const std::vector<Index>& budgets, const Shape& shape) {
  for (std::size_t b = 0; b < budgets.size(); ++b) {
    if (budgets[b] >= shape.control_points()) continue;
    throw Error(Status::range, "budgets",
                "budgets[" + std::to_string(b) + "] is " + std::to_string(budgets[b]) +
                    "; a sketch holds the control points at least, which are " +
                    std::to_string(shape.control_points()) + ": give that or more.")
        .at(static_cast<Index>(b))
        .with(static_cast<double>(budgets[b]))
        .needs(shape.control_points());
  }
}

}  // namespace ifsm::core
