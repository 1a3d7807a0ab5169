#include "fit/tolerance.h"

#include <gtest/gtest.h>

#include "curves.h"
#include "fit/within.h"

using namespace ifsm::core;

namespace {

FitOptions quick() {
  FitOptions options;
  options.iterations = 10, options.sparse_rounds = 1, options.polish_rounds = 2;
  return options;
}

FitResult fitted(const std::vector<FitCurve>& curves, const FitOptions& options, const Tolerance& tolerance) {
  Watch watch;
  return fit_to_tolerance(curves, options, tolerance, watch);
}

TEST(FitToTolerance, BringsEveryCurveWithinTheBoundByNoMoreDetailsThanTheStart) {
  const std::vector<FitCurve> curves = {{walk(257, 2, 1), false}, {loop(200, 2, 2), true}};
  for (const Distance by : {Distance::rms, Distance::largest, Distance::hausdorff}) {
    const FitResult fit = fitted(curves, quick(), {1.5, by});
    Index details = 0, at_start = 0;
    for (std::size_t c = 0; c < curves.size(); ++c) {
      ASSERT_EQ(fit.budgets[c].size(), 1U);
      const FitBudget& row = fit.budgets[c][0];
      EXPECT_EQ(row.fitted.model->details_kept(), row.details);
      EXPECT_EQ(row.budget, row.details + fit.filter->shape().control_points());
      EXPECT_LE(distance(*row.fitted.model, *fit.models[c], by), 1.5);
      EXPECT_LE(distance(*row.start.model, *fit.models[c], by), 1.5 * (1 + 1e-9));
      details += row.details;
      at_start += row.start.model->details_kept();
    }
    EXPECT_LE(details, at_start);
  }
}

TEST(FitToTolerance, FindsThatTheKochCurveNeedsNone) {
  FitOptions options = quick();
  options.start = named_filter("koch", Topology::joined, 0, 0);
  const FitResult fit = fitted({{koch_samples(4), false}}, options, {1e-6, Distance::hausdorff});
  EXPECT_EQ(fit.budgets[0][0].details, 0);
  EXPECT_EQ(fit.reason, FitReason::start_best);
}

TEST(FitToTolerance, ToldAllDetailsWhenTheBoundIsTheLeastOne) {
  const Points samples = walk(33, 2, 3);
  const double least = 1e-12 * diagonal(samples);
  const FitResult fit = fitted({{samples, false}}, quick(), {least, Distance::rms});
  EXPECT_LE(fit.budgets[0][0].fitted.rms, least);
}

TEST(FitToTolerance, StopsWhenAsked) {
  Watch watch(nullptr, [](double fraction, const char*) { return fraction > 0.5; });
  EXPECT_THROW(fit_to_tolerance({{walk(129, 2, 4), false}}, quick(), {1, Distance::rms}, watch), Cancelled);
}

}  // namespace
