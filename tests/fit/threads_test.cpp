// Run under the thread sanitizer as well: blocks of one curve's tree share the threads.
#include <gtest/gtest.h>

#include "base/parallel.h"
#include "curve/keep.h"
#include "curves.h"
#include "fit/curve_stage.h"
#include "fit/parameters.h"
#include "fit/projection.h"
#include "fit/sparsity.h"
#include "fit/truncation.h"

namespace ifsm::core {
namespace {

struct Setting {
  FilterPtr filter = named_filter("coast", Topology::joined, 5, 2);
  ModelPtr model = analyze(filter, walk(20'000, 2, 5), false);
  Points finest = line(*model, model->levels());
  TreeSolver solver{filter->shape(), model->levels(), false, sample_weights(*model)};
  Watch watch;
};

struct Gathered {
  double value;
  Eigen::MatrixXd product;
};

Gathered gathered(Objective& objective, const Setting& setting, Part part, int threads) {
  const Threads most(threads);
  Normal normal(free_count(setting.filter->shape(), part));
  objective.gather(setting.filter->matrix(), normal);
  return {objective.value(setting.filter->matrix()), normal.product()};
}

void expect_the_same_bits(Objective& objective, const Setting& setting, Part part) {
  const Gathered one = gathered(objective, setting, part, 1);
  EXPECT_GT(one.value, 0);
  for (const int threads : {2, 7}) {
    const Gathered many = gathered(objective, setting, part, threads);
    EXPECT_EQ(many.value, one.value) << threads << " threads";
    EXPECT_EQ(many.product, one.product) << threads << " threads";
  }
}

TEST(FitThreads, SumOneCurvesSparsityToTheSameBits) {
  const Setting setting;
  Sparsity objective(setting.filter->shape(), {{&setting.finest, setting.model->levels(), {0.4, 1.7}}}, setting.watch);
  expect_the_same_bits(objective, setting, Part::all);
}

TEST(FitThreads, SumOneSketchsErrorToTheSameBits) {
  Setting setting;
  Projection objective(
      setting.filter->shape(),
      {{&setting.solver, &setting.finest, setting.model->levels(), most_significant(*setting.model, 100), 0.7}},
      setting.watch);
  expect_the_same_bits(objective, setting, Part::all);
}

TEST(FitThreads, SumTheErrorOfTheFirstLevelsToTheSameBits) {
  const Setting setting;
  Truncation objective(setting.filter->shape(),
                       {{&setting.finest, setting.model->levels(), 3, sample_weights(*setting.model)}}, setting.watch);
  expect_the_same_bits(objective, setting, Part::details);
}

TEST(FitThreads, FitOneCurvesControlPointsToTheSameBits) {
  const std::vector<FitCurve> curves = {{walk(40'000, 2, 6), false}};
  for (const bool robust : {false, true}) {
    CurveOptions options;
    options.starts = 1;
    options.iterations = 12;
    if (robust) options.loss = {LossKind::huber, 5};
    const auto fitted = [&](int threads) {
      const Threads most(threads);
      Watch watch;
      return fit_curve(curves, options, watch);
    };
    const FitResult one = fitted(1);
    EXPECT_LT(one.final_cost, one.start_cost);
    for (const int threads : {2, 7}) {
      const FitResult many = fitted(threads);
      EXPECT_EQ(many.filter->matrix(), one.filter->matrix()) << threads << " threads";
      EXPECT_EQ(many.final_cost, one.final_cost) << threads << " threads";
    }
  }
}

}  // namespace
}  // namespace ifsm::core
