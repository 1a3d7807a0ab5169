#include "fit/tolerance.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

#include "curve/named.h"
#include "fit/budgets.h"
#include "fit/within.h"

namespace ifsm::core {
namespace {

struct Within {
  std::vector<ModelPtr> models;
  std::vector<Sketch> sketches;

  Index details() const {
    return std::accumulate(sketches.begin(), sketches.end(), Index{0},
                           [](Index sum, const Sketch& sketch) { return sum + sketch.model->details_kept(); });
  }
};

Within sketches_within(const std::vector<FitCurve>& curves, const FilterPtr& filter, const Tolerance& tolerance,
                       Watch watch) {
  Within found;
  const auto count = static_cast<double>(curves.size());
  for (const FitCurve& curve : curves) {
    const auto done = static_cast<double>(found.models.size());
    Watch part = watch.part(done / count, (done + 1) / count);
    const ModelPtr& model = found.models.emplace_back(analyze(filter, curve.samples, curve.closed));
    ModelPtr sketch = keep_within(*model, tolerance.bound, Resolve::choice, tolerance.distance, part);
    const double rms = distance(*sketch, *model, Distance::rms), largest = distance(*sketch, *model, Distance::largest);
    found.sketches.push_back({std::move(sketch), rms, largest});
  }
  return found;
}

// What the curves need, each, as far as every one of them has as many.
std::vector<Index> budgets_of(const Within& found, const std::vector<FitCurve>& curves, const Shape& shape) {
  constexpr std::size_t most = 64;
  const Index fewest = fewest_vectors(curves, shape);
  std::set<Index> budgets;
  for (const Sketch& sketch : found.sketches)
    budgets.insert(std::min(shape.control_points() + sketch.model->details_kept(), fewest));
  std::vector<Index> spread;
  const std::vector<Index> all(budgets.begin(), budgets.end());
  for (std::size_t i = 0; i < std::min(most, all.size()); ++i)
    spread.push_back(all[i * all.size() / std::min(most, all.size())]);
  return spread;
}

std::vector<std::vector<FitBudget>> rows_of(const Within& start, const Within& fitted) {
  std::vector<std::vector<FitBudget>> rows;
  for (std::size_t c = 0; c < fitted.sketches.size(); ++c) {
    const Model& sketch = *fitted.sketches[c].model;
    const Index details = sketch.details_kept();
    rows.push_back({{sketch.shape().control_points() + details, details, start.sketches[c], fitted.sketches[c]}});
  }
  return rows;
}

}  // namespace

FitResult fit_to_tolerance(const std::vector<FitCurve>& curves, const FitOptions& options, const Tolerance& tolerance,
                           Watch& watch) {
  require_curves(curves);
  for (const FitCurve& curve : curves) require_bound(tolerance.bound, diagonal(curve.samples), "within");
  const FilterPtr start =
      options.start ? require_start(options.start) : default_filter(options.control_points, options.maps);
  const Within at_start = sketches_within(curves, start, tolerance, watch.part(0, 0.35));
  FitOptions at_budgets = options;
  at_budgets.budgets = budgets_of(at_start, curves, start->shape());
  Watch fitting = watch.part(0.35, 0.65);
  FitResult result = fit_sparse(curves, at_budgets, fitting);
  Within fitted = sketches_within(curves, result.filter, tolerance, watch.part(0.65, 1));
  if (fitted.details() >= at_start.details()) {
    fitted = at_start;
    result.filter = start;
    result.reason = FitReason::start_best;
    result.final_condition = result.start_condition = start->condition();
    result.final_cost = result.start_cost;
  }
  result.models = fitted.models;
  result.budgets = rows_of(at_start, fitted);
  watch.finish();
  return result;
}

}  // namespace ifsm::core
