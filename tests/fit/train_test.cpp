#include "fit/train.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"
#include "curves.h"

namespace ifsm::core {
namespace {

std::vector<FitCurve> family(int count, Index samples = 257) {
  std::vector<FitCurve> curves;
  for (int c = 0; c < count; ++c) {
    const bool closed = c % 3 == 0;
    const auto seed = static_cast<unsigned>(100 + c);
    curves.push_back({closed ? loop(samples, 2, seed) : walk(samples, 2, seed), closed});
  }
  return curves;
}

TrainOptions quick() {
  TrainOptions options;
  options.start = named_filter("casteljau", Topology::joined, 4, 2);
  options.rounds = 3;
  return options;
}

TrainResult trained(const std::vector<FitCurve>& curves, const TrainOptions& options) {
  Watch watch;
  return train(curves, options, watch);
}

TEST(Training, BettersTheSketchesOfItsCurvesAndOfCurvesThatItHasNotSeen) {
  TrainOptions options = quick();
  options.hold_out = 4;
  const TrainResult result = trained(family(24), options);
  EXPECT_EQ(result.trained, 18);
  EXPECT_EQ(result.held_out, 6);
  EXPECT_EQ(result.sketches, 18 * 2);  // budgets 16 and 32
  EXPECT_LT(result.ratio, 0.98);
  EXPECT_LT(result.held_out_ratio, 0.99);
  EXPECT_NE(result.reason, TrainReason::start_best);
  EXPECT_LE(result.filter->condition(), options.limits.condition);
  EXPECT_EQ(result.filter->contractivity(), Contractivity::proven);
}

TEST(Training, SaysWhatItsRatioIs) {
  const auto curves = family(5);
  const TrainOptions options = quick();
  const TrainResult result = trained(curves, options);
  const Watch watch;
  double logarithms = 0;
  for (const FilterPtr& filter : {options.start, result.filter}) {
    Sketchbook book(curves, filter, std::vector<std::vector<Index>>(5, {16, 32}), Limits{}, watch);
    logarithms = book.judged(book.best(filter->matrix(), 12)) - logarithms;
  }
  // Choices may be found better or worse from afresh: the training's own came from round to round.
  EXPECT_NEAR(result.ratio, std::exp(logarithms / 2 / 10), 0.02);
}

TEST(Training, GivesTheSameBitsTwiceAndOnAnyNumberOfThreads) {
  const auto curves = family(7);
  const TrainResult first = trained(curves, quick()), second = trained(curves, quick());
  EXPECT_EQ(first.filter->matrix(), second.filter->matrix());
  for (const int threads : {1, 2, 5}) {
    const Threads bound(threads);
    const TrainResult other = trained(curves, quick());
    EXPECT_EQ(other.filter->matrix(), first.filter->matrix()) << threads;
    EXPECT_EQ(other.ratio, first.ratio) << threads;
  }
}

TEST(Training, LeavesTheStartWhenNothingCanBeBettered) {
  TrainOptions options = quick();
  options.start = named_filter("koch", Topology::joined, 0, 0);
  options.budgets = {3};
  const TrainResult result = trained({{koch_samples(3), false}}, options);
  EXPECT_EQ(result.reason, TrainReason::start_best);
  EXPECT_EQ(result.filter->matrix(), options.start->matrix());
  EXPECT_EQ(result.ratio, 1.0);
  EXPECT_TRUE(std::isnan(result.held_out_ratio));
}

TEST(Training, GivesEachCurveTheBudgetsThatItHolds) {
  TrainOptions options = quick();
  options.budgets = {8, 40};
  std::vector<FitCurve> curves = family(3);
  curves.push_back({walk(13, 2, 1), false});  // 13 vectors in all
  options.rounds = 1;
  EXPECT_EQ(trained(curves, options).sketches, 3 * 2 + 1);
}

TEST(Training, TellsHowFarItIsAndStopsWhenAsked) {
  std::vector<double> fractions;
  Watch watch(nullptr, [&](double fraction, const char* stage) {
    EXPECT_TRUE(std::string(stage) == "train" || std::string(stage) == "done") << stage;
    fractions.push_back(fraction);
    return false;
  });
  train(family(4), quick(), watch);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_GT(fractions.size(), 3u);
  EXPECT_EQ(fractions.back(), 1.0);

  int told = 0;
  Watch stopping(nullptr, [&](double, const char*) { return ++told == 2; });
  EXPECT_THROW(train(family(4), quick(), stopping), Cancelled);
  CancelToken token;
  token.request();
  Watch cancelled(&token, nullptr);
  EXPECT_THROW(train(family(4), quick(), cancelled), Cancelled);
}

Error refused(const std::vector<FitCurve>& curves, const TrainOptions& options) {
  try {
    trained(curves, options);
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "nothing was refused";
  return {Status::ok, "", ""};
}

TEST(Training, RefusesWhatItCannotTrainOn) {
  EXPECT_EQ(refused({}, quick()).argument(), "curve_count");

  TrainOptions square = quick();
  square.start = named_filter("haar", Topology::square, 0, 0);
  EXPECT_EQ(refused(family(2), square).argument(), "start");

  TrainOptions small = quick();
  small.budgets = {16, 3};
  const Error error = refused(family(2), small);
  EXPECT_EQ(error.argument(), "budgets");
  EXPECT_EQ(error.index(), 1);
  EXPECT_EQ(error.value(), 3);

  TrainOptions large = quick();
  large.budgets = {5000};
  EXPECT_EQ(refused(family(2), large).argument(), "budgets");
}

}  // namespace
}  // namespace ifsm::core
