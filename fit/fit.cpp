#include "fit/fit.h"

#include <cmath>

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

void require_tolerance(double tolerance) {
  if (std::isfinite(tolerance) && tolerance > 0) return;
  throw Error(std::isfinite(tolerance) ? Status::range : Status::not_finite, "tolerance",
              "tolerance is " + text_of(tolerance) +
                  "; give the relative fall, above 0, of the objective at which the fit stops.")
      .with(tolerance);
}

FilterPtr require_start(FilterPtr start) {
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
  return start;
}

}  // namespace ifsm::core
