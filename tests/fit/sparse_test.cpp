#include "fit/sparse.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "base/parallel.h"
#include "curve/keep.h"
#include "curve/resolve.h"
#include "curve/significance.h"
#include "curves.h"

namespace ifsm::core {
namespace {

FitOptions quick(std::vector<Index> budgets) {
  FitOptions options;
  options.budgets = std::move(budgets);
  options.iterations = 12;
  options.polish_rounds = 2;
  return options;
}

FitResult fitted(const std::vector<FitCurve>& curves, const FitOptions& options) {
  Watch watch;
  return fit_sparse(curves, options, watch);
}

double rms(const Model& model, const Points& wanted) {
  return std::sqrt((samples(model).matrix() - wanted.matrix()).rowwise().squaredNorm().mean());
}

TEST(SparseFit, TellsThePolishsCostsWhereItHasNoSparsity) {
  FitOptions options;
  options.budgets = {128};  // from coast: sparsity is spared
  Watch watch;
  const FitResult fit = fit_sparse({{walk(1025, 2, 1), false}}, options, watch);
  EXPECT_GT(fit.start_cost, 0);
  EXPECT_LE(fit.final_cost, fit.start_cost);
  EXPECT_GT(fit.final_cost, 0);
}

TEST(SparseFit, IsNeverWorseThanItsStartAtAnyBudgetAsked) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const bool closed = seed % 2 == 0;
    const Points points = closed ? loop(300, 2, seed) : walk(300, 2, seed);
    const FitResult result = fitted({{points, closed}}, quick({10, 40, 120}));
    for (const FitBudget& row : result.budgets[0]) EXPECT_LE(row.fitted.rms, row.start.rms * (1 + 1e-12)) << row.budget;
  }
}

TEST(SparseFit, MakesFewDetailsSayMore) {
  const Points points = walk(513, 2, 3);
  FitOptions options = quick({32});
  options.start = named_filter("casteljau", Topology::joined, 5, 2);
  const FitResult result = fitted({{points, false}}, options);
  EXPECT_LT(result.budgets[0][0].fitted.rms, 0.95 * result.budgets[0][0].start.rms);
  EXPECT_EQ(result.budgets[0][0].details, 32 - 5);
}

// R^-1 is bounded but its powers are not: polish alone has led to polygons of 1e15 diagonals, and models half a curve
// off.
TEST(SparseFit, KeepsCoarsePolygonsNearTheCurveAndModelsExact) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const Points points = loop(400, 2, seed);
    FitOptions options = quick({8, 32});
    options.polish_rounds = 8;
    const FitResult result = fitted({{points, true}}, options);
    const double start =
        analyze(named_filter("casteljau", Topology::joined, 5, 2), points, true)->parts().largest_polygon;
    const ModelParts& parts = result.models[0]->parts();
    // Twice the start's, where that is the larger bound; 1e-9 for another order of the same sums.
    EXPECT_LE(parts.largest_polygon, std::max(3 * parts.diagonal, 2 * start) * (1 + 1e-9)) << seed;
    EXPECT_LE((samples(*result.models[0]).matrix() - points.matrix()).cwiseAbs().maxCoeff(), 1e-12 * parts.diagonal)
        << seed;
  }
}

TEST(SparseFit, TellsOfSketchesWhatTheyAre) {
  const Points points = loop(400, 3, 5);
  const FitResult result = fitted({{points, true}}, quick({20, 60}));
  for (const FitBudget& row : result.budgets[0])
    for (const Sketch* sketch : {&row.start, &row.fitted}) {
      EXPECT_LE(sketch->model->details_kept(), row.details);
      EXPECT_DOUBLE_EQ(rms(*sketch->model, points), sketch->rms);
      EXPECT_GE(sketch->max, sketch->rms);
    }
  // The model of the fit is exact: 1e-12 of the diagonal, times the condition number of R where it is large.
  EXPECT_LT(rms(*result.models[0], points), 1e-13 * result.final_condition * diagonal(points));
}

RowMatrix shaken(RowMatrix matrix, double by, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> step(-by, by);
  for (Index c = 1; c + 1 < matrix.cols(); ++c) {
    for (Index r = 0; r < matrix.rows(); ++r) matrix(r, c) += step(random);
    matrix(0, c) += 1 - matrix.col(c).head(3).sum();
  }
  return matrix;
}

double largest_significance(const Model& model) {
  double largest = 0;
  for (int level = 0; level < model.levels(); ++level)
    largest = std::max(largest, significance(model, level).maxCoeff());
  return largest;
}

// Up to a change of the control points' basis, which the curve does not see: that there is no detail left says it all.
TEST(SparseFit, FindsTheKochFilterAgainFromAPerturbedStart) {
  const Points points = koch_samples(4);
  const FilterPtr koch = named_filter("koch", Topology::joined, 0, 0);
  EXPECT_LT(largest_significance(*analyze(koch, points, false)), 1e-13);
  for (const unsigned seed : {5U, 6U}) {
    FitOptions options = quick({12});
    options.start = std::make_shared<Filter>(koch->shape(), shaken(koch->matrix(), 0.03, seed));
    options.iterations = 100;
    options.polish_rounds = 20;
    const FitResult result = fitted({{points, false}}, options);
    const Model& model = *result.models[0];
    // Levenberg-Marquardt stops when a step changes the error by less than a ten-thousandth: far below what a
    // perturbation of 0.03 leaves, 1e-1 here, and above rounding.
    EXPECT_GT(largest_significance(*analyze(options.start, points, false)), 1e-2);
    EXPECT_LT(largest_significance(model), 1e-7);
    EXPECT_LT(rms(*resolve(model, first_levels(model, 0), Watch{}), points), 1e-9);
  }
}

TEST(SparseFit, GivesTheSameBitsAgainAndOnAnyNumberOfThreads) {
  const std::vector<FitCurve> curves = {{walk(200, 2, 1), false}, {loop(300, 2, 2), true}};
  const FitResult once = fitted(curves, quick({16, 64}));
  for (const int threads : {1, 2, 7}) {
    set_default_threads(threads);
    const FitResult again = fitted(curves, quick({16, 64}));
    EXPECT_EQ(once.filter->matrix(), again.filter->matrix());
    EXPECT_EQ(once.budgets[1][1].fitted.rms, again.budgets[1][1].fitted.rms);
  }
  set_default_threads(0);
}

TEST(SparseFit, SharesOneFilterBetweenCurves) {
  const std::vector<FitCurve> curves = {{walk(200, 2, 1), false}, {loop(260, 2, 2), true}, {walk(150, 2, 9), false}};
  const FitResult result = fitted(curves, quick({30}));
  ASSERT_EQ(result.models.size(), 3U);
  for (std::size_t c = 0; c < curves.size(); ++c) {
    EXPECT_EQ(&result.models[c]->filter(), result.filter.get());
    EXPECT_LE(result.budgets[c][0].fitted.rms, result.budgets[c][0].start.rms * (1 + 1e-12));
  }
}

TEST(SparseFit, ChoosesAShapeThatIsNoWorseThanTheDefault) {
  FitOptions options = quick({24});
  options.iterations = 4;
  options.polish_rounds = 1;
  const Points points = walk(200, 2, 4);
  const double plain = fitted({{points, false}}, options).budgets[0][0].fitted.rms;
  options.control_points = options.maps = 0;
  EXPECT_LE(fitted({{points, false}}, options).budgets[0][0].fitted.rms, plain);
}

TEST(SparseFit, TakesCurvesOfEveryDimensionAndDegenerateOnes) {
  for (const Index dimension : {1, 2, 3, 4})
    EXPECT_NO_THROW(fitted({{walk(70, dimension, 3), false}}, quick({12}))) << dimension;
  Points same(2, 50);
  same.matrix().setConstant(3);
  EXPECT_EQ(fitted({{same, false}}, quick({8})).budgets[0][0].fitted.rms, 0);
  EXPECT_EQ(fitted({{walk(2, 2, 1), false}}, {}).reason, FitReason::start_best);
  EXPECT_EQ(fitted({{walk(6, 2, 1), false}}, {}).budgets[0][0].budget,
            5);  // a quarter, but the control points at least
  EXPECT_EQ(fitted({{walk(100, 2, 1), false}}, {}).budgets[0][0].budget, 25);
  EXPECT_LT(fitted({{walk(6, 2, 1), false}}, quick({9})).budgets[0][0].fitted.rms, 1e-12);  // all there are
  Points straight(2, 129);  // as many as places: equally spaced, a polynomial of degree 1
  for (Index k = 0; k < 129; ++k) straight.matrix().row(k) << static_cast<double>(k), 2.0 * static_cast<double>(k);
  // Coast does not reproduce straight lines, de Casteljau does: the better start is taken.
  EXPECT_LT(fitted({{straight, false}}, quick({6})).budgets[0][0].start.rms, 1e-12 * diagonal(straight));
}

TEST(SparseFit, StartsFromCoastUnlessDeCasteljauIsNowhereWorse) {
  const auto start_of = [](const Points& points) {
    FitOptions options = quick({16, 40});
    options.sparse_rounds = options.polish_rounds = 0;
    return fitted({{points, false}}, options).filter->matrix();
  };
  const RowMatrix coast = named_filter("coast", Topology::joined, 5, 2)->matrix();
  const RowMatrix casteljau = named_filter("casteljau", Topology::joined, 5, 2)->matrix();
  EXPECT_EQ(start_of(walk(513, 2, 5)), coast);
  Points smooth(2, 513);
  for (Index k = 0; k < 513; ++k) {
    const double t = static_cast<double>(k) / 512;
    smooth.matrix().row(k) << t, t * t * t - t;
  }
  EXPECT_EQ(start_of(smooth), casteljau);
}

TEST(SparseFit, IsTheSameForCurvesOfAnySizeUpToPowersOfTwo) {
  const Points points = loop(150, 2, 9);
  const FitResult plain = fitted({{points, true}}, quick({20}));
  for (const int exponent : {900, -950}) {  // squares of such coordinates are beyond doubles
    const Points far = scaled(points, exponent);
    const FitResult result = fitted({{far, true}}, quick({20}));
    EXPECT_EQ(result.filter->matrix(), plain.filter->matrix());
    const FitBudget &row = result.budgets[0][0], &expected = plain.budgets[0][0];
    EXPECT_EQ(row.fitted.rms, std::scalbn(expected.fitted.rms, exponent));
    EXPECT_EQ(row.start.max, std::scalbn(expected.start.max, exponent));
    EXPECT_EQ(samples(*row.fitted.model), scaled(samples(*expected.fitted.model), exponent));
    EXPECT_LT((samples(*result.models[0]).matrix() - far.matrix()).cwiseAbs().maxCoeff(), 1e-12 * diagonal(far));
  }
}

// A budget that holds everything leaves errors of rounding alone, which may change: the other budget still counts.
TEST(SparseFit, IsNotHeldBackByABudgetThatLeavesNoError) {
  const Points points = walk(50, 2, 4);
  const FitResult alone = fitted({{points, false}}, quick({20}));
  const FitResult both = fitted({{points, false}}, quick({20, 65}));
  EXPECT_LT(alone.budgets[0][0].fitted.rms, alone.budgets[0][0].start.rms);
  EXPECT_LT(both.budgets[0][0].fitted.rms, 1.1 * alone.budgets[0][0].fitted.rms);
}

// No details: the control points are all there is to solve, and they must be solved under the filter that is told.
TEST(SparseFit, SolvesControlPointsAloneUnderTheFittedFilter) {
  const Points points = walk(50, 2, 4);
  const FitResult fit = fitted({{points, false}}, quick({5, 20}));
  const FitBudget& none = fit.budgets[0][0];
  EXPECT_EQ(none.details, 0);
  EXPECT_LE(none.fitted.rms, none.start.rms * (1 + 1e-12));
  const ModelPtr again = resolve(*fit.models[0], Kept(static_cast<std::size_t>(fit.models[0]->details_total()), 0), {});
  EXPECT_NEAR(rms(*again, points), none.fitted.rms, 1e-12 * diagonal(points));
}

TEST(SparseFit, ToldProgressGrowsFromZeroToOne) {
  std::vector<double> told;
  Watch watch(nullptr, [&](double fraction, const char*) {
    told.push_back(fraction);
    return false;
  });
  fit_sparse({{walk(300, 2, 1), false}}, quick({20, 50}), watch);
  ASSERT_GT(told.size(), 5U);
  EXPECT_TRUE(std::ranges::is_sorted(told));
  EXPECT_GE(told.front(), 0);
  EXPECT_EQ(told.back(), 1);
}

TEST(SparseFit, StopsWhenTheCallbackSaysSo) {
  int calls = 0;
  Watch watch(nullptr, [&](double, const char*) { return ++calls == 3; });
  EXPECT_THROW(fit_sparse({{walk(300, 2, 1), false}}, quick({20}), watch), Cancelled);
  EXPECT_EQ(calls, 3);
}

TEST(SparseFit, StopsWhenAnotherThreadRaisesTheToken) {
  CancelToken token;
  Watch watch(&token, nullptr);
  std::thread raiser([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    token.request();
  });
  FitOptions options = quick({200});
  options.iterations = 1000;
  options.polish_rounds = 100;
  options.sparse_rounds = 100;
  EXPECT_THROW(fit_sparse({{walk(20000, 2, 1), false}}, options, watch), Cancelled);
  raiser.join();
}

struct Refused {
  std::vector<FitCurve> curves;
  FitOptions options;
  Status status;
  std::string argument;
  Index index;
};

TEST(SparseFit, RefusesWhatCannotBeFittedAndSaysWhich) {
  const Points points = walk(100, 2, 1);
  FitOptions square = quick({10});
  square.start = named_filter("haar", Topology::square, 0, 0);
  FitOptions large = quick({40});
  large.control_points = 16;
  large.maps = 8;
  const Refused table[] = {
      {{}, quick({10}), Status::range, "curve_count", -1},
      {{{points, false}, {walk(9, 3, 1), false}}, quick({10}), Status::shape, "curves", 1},
      {{{points, false}}, square, Status::range, "start", -1},
      {{{points, false}}, large, Status::limit, "start", -1},
      {{{points, false}}, quick({10, 4}), Status::range, "budgets", 1},
      {{{points, false}}, quick({10, 20, 100000}), Status::range, "budgets", 2},
  };
  for (const Refused& refused : table) {
    try {
      fitted(refused.curves, refused.options);
      ADD_FAILURE() << refused.argument;
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), refused.status) << error.what();
      EXPECT_EQ(error.argument(), refused.argument) << error.what();
      EXPECT_EQ(error.index(), refused.index) << error.what();
    }
  }
}

}  // namespace
}  // namespace ifsm::core
