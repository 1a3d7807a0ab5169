#include "fit/checks.h"

#include <algorithm>
#include <limits>
#include <string>

#include "base/error.h"
#include "fit/parameters.h"

namespace ifsm::core {
namespace {

constexpr int most_parameters = 1024;  // beyond, one linear solve takes longer than a cancel may

}  // namespace

void require_curves(const std::vector<FitCurve>& curves) {
  if (curves.empty()) throw Error(Status::range, "curve_count", "There is no curve to fit; give at least one.").with(0);
  for (std::size_t c = 0; c < curves.size(); ++c) {
    if (curves[c].samples.dimension() == curves[0].samples.dimension()) continue;
    throw Error(Status::shape, "curves",
                "Curve " + std::to_string(c) + " has dimension " + std::to_string(curves[c].samples.dimension()) +
                    " and the first one " + std::to_string(curves[0].samples.dimension()) +
                    "; curves that share a filter must have one dimension.")
        .at(static_cast<Index>(c))
        .with(static_cast<double>(curves[c].samples.dimension()));
  }
}

void require_start(const FilterPtr& start) {
  if (!start->shape().joined())
    throw Error(Status::range, "start",
                "The fit needs a joined filter to start from; this one is square. Give \"casteljau\" with the joined "
                "topology.");
  if (free_count(start->shape()) > most_parameters)
    throw Error(Status::limit, "start",
                "A filter of this shape has " + std::to_string(free_count(start->shape())) +
                    " free entries; the fit takes at most " + std::to_string(most_parameters) +
                    ": use fewer control points or maps.")
        .with(free_count(start->shape()));
}

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
        .with(static_cast<double>(budgets[b]));
  }
}

void require_least_budgets(const std::vector<Index>& budgets, const Shape& shape) {
  for (std::size_t b = 0; b < budgets.size(); ++b) {
    if (budgets[b] >= shape.control_points()) continue;
    throw Error(Status::range, "budgets",
                "budgets[" + std::to_string(b) + "] is " + std::to_string(budgets[b]) +
                    "; a sketch holds the control points at least, which are " +
                    std::to_string(shape.control_points()) + ".")
        .at(static_cast<Index>(b))
        .with(static_cast<double>(budgets[b]));
  }
}

}  // namespace ifsm::core
