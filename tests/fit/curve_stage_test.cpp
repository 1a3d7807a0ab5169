#include "fit/curve_stage.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <thread>

#include "base/parallel.h"
#include "curve/evaluate.h"
#include "curves.h"
#include "fit/certainty.h"

namespace ifsm::core {
namespace {

FitResult fitted(const std::vector<FitCurve>& curves, const CurveOptions& options) {
  Watch watch;
  return fit_curve(curves, options, watch);
}

CurveOptions shaped(int control_points, int maps) {
  CurveOptions options;
  options.control_points = control_points;
  options.maps = maps;
  return options;
}

// A quadratic Bézier curve's places; and the same with noise of a covariance that turns from sample to sample.
constexpr double triangle[] = {0, 0, 0.5, 1, 2, 0};
Points bezier(int levels) {
  return samples(*from_polygon(named_filter("casteljau", Topology::joined, 3, 2),
                               Points::from_interleaved(triangle, 3, 2), false, levels));
}

Points noisy(Points points, double deviation, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0, deviation);
  for (double& x : points.matrix().reshaped()) x += noise(random);
  return points;
}

std::vector<double> covariances(Index count, double deviation) {
  std::vector<double> all;
  for (Index k = 0; k < count; ++k) all.insert(all.end(), {deviation * deviation, 0, 0, deviation * deviation});
  return all;
}

double mahalanobis(const Eigen::VectorXd& error, const Eigen::MatrixXd& covariance) {
  return error.dot(covariance.fullPivLu().solve(error));
}

// 200 runs of probability .95: a count outside happens once in a thousand times to a right program.
void expect_95_of_100(int inside) {
  EXPECT_GE(inside, 179);
  EXPECT_LE(inside, 198);
}

TEST(CurveStage, RecoversControlPointsWithinTheirCovarianceIn95Of100RunsWhenTIsKnown) {
  const Points exact = bezier(5);
  CurveOptions options = shaped(3, 2);
  options.fixed_filter = true;
  options.samples = {{{}, {}, covariances(exact.count(), 0.01), {}, false}};
  const Eigen::Map<const Eigen::VectorXd> truth(triangle, 6);
  int inside = 0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const FitResult result = fitted({{noisy(exact, 0.01, seed), false}}, options);
    const Eigen::MatrixXd control = control_points(*result.budgets[0][0].fitted.model).matrix().transpose();
    const double square =
        mahalanobis(Eigen::VectorXd(control.reshaped()) - truth, control_covariance(*result.certainty, 0));
    inside += square < 12.592 ? 1 : 0;  // chi² of 6 degrees at .95
  }
  expect_95_of_100(inside);
}

// (P, T) and (P A, A^-1 T A) are one curve, so control points are not compared: the curve is.
TEST(CurveStage, RecoversTheCurveWithinItsCovarianceIn95Of100RunsWhenTIsFree) {
  const Points exact = bezier(5);
  CurveOptions options = shaped(3, 2);
  options.samples = {{{}, {}, covariances(exact.count(), 0.01), {}, false}};
  const std::vector<double> at = {0.0, 0.3, 0.5, 0.8125};
  const Points truth = evaluate(*from_polygon(named_filter("casteljau", Topology::joined, 3, 2),
                                              Points::from_interleaved(triangle, 3, 2), false, 5),
                                Curve::polyline, at);
  std::vector<int> inside(at.size(), 0);
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const FitResult result = fitted({{noisy(exact, 0.01, seed), false}}, options);
    const Points curve = evaluate(*result.budgets[0][0].fitted.model, Curve::polyline, at);
    const Lanes covariance = curve_covariance(*result.certainty, 0, at, Watch{});
    for (std::size_t i = 0; i < at.size(); ++i) {
      const auto row = static_cast<Index>(i);
      const Eigen::VectorXd error = (curve.matrix().row(row) - truth.matrix().row(row)).transpose();
      inside[i] += mahalanobis(error, covariance.middleRows(2 * row, 2)) < 5.991 ? 1 : 0;  // chi² of 2 at .95
    }
  }
  for (const int count : inside) expect_95_of_100(count);
}

TEST(CurveStage, FallsToTheNoiseAndNotBelowWhatItsParametersAllow) {
  const double deviation = 0.02;
  for (const bool fixed : {true, false}) {
    CurveOptions options = shaped(3, 2);
    options.fixed_filter = fixed;
    const Points points = noisy(bezier(8), deviation, 4);
    const FitResult result = fitted({{points, false}}, options);
    const auto residuals = static_cast<double>(points.size());
    // 6 coordinates; 6 entries of T beside them, of which 2 are the limit curve's gauge: the polyline hardly sees them.
    const double taken = residuals - static_cast<double>(result.certainty->freedom);
    EXPECT_GE(taken, fixed ? 6 : 10);
    EXPECT_LE(taken, fixed ? 6 : 12);
    // RMS² is chi² of freedom degrees times deviation² / points: three standard deviations of that.
    const double expected = deviation * deviation * (residuals - taken) / static_cast<double>(points.count());
    EXPECT_NEAR(std::pow(result.budgets[0][0].fitted.rms, 2), expected, 3 * expected * std::sqrt(2 / residuals));
    EXPECT_NEAR(result.certainty->noise, deviation, 3 * deviation / std::sqrt(2 * residuals));
  }
}

TEST(CurveStage, IsNeverWorseThanItsStartByItsOwnObjective) {
  for (unsigned seed = 1; seed <= 4; ++seed)
    for (const LossKind kind : {LossKind::squares, LossKind::huber, LossKind::cauchy, LossKind::tukey})
      for (const ParameterRule rule : {ParameterRule::index, ParameterRule::chord, ParameterRule::centripetal}) {
        const bool closed = seed % 2 == 0;
        CurveOptions options = shaped(4, 2);
        options.loss = {kind, 1.5};
        options.parameters = rule;
        options.reparameterise = seed > 2 ? 5 : 0;
        options.iterations = 10;
        const FitResult result = fitted({{closed ? loop(200, 2, seed) : walk(200, 2, seed), closed}}, options);
        EXPECT_LE(result.final_cost, result.start_cost);
        EXPECT_EQ(result.reason == FitReason::start_best, result.final_cost == result.start_cost);
      }
}

TEST(CurveStage, FindsTheKochCurveAgainFromDeCasteljausFilter) {
  const Points points = koch_samples(4);
  for (int starts = 1; starts <= 3; ++starts) {
    CurveOptions options = shaped(3, 4);
    options.starts = starts;
    const FitResult result = fitted({{points, false}}, options);
    EXPECT_GT(result.budgets[0][0].start.rms, 0.05);
    EXPECT_LT(result.budgets[0][0].fitted.rms, 1e-9);
    EXPECT_EQ(result.reason, FitReason::converged);
  }
}

TEST(CurveStage, TellsOfItsCurveWhatItIs) {
  CurveOptions options = shaped(4, 2);
  options.parameters = ParameterRule::chord;
  options.reparameterise = 4;
  const Points points = loop(150, 3, 3);
  const FitResult result = fitted({{points, true}}, options);
  const Model& curve = *result.budgets[0][0].fitted.model;
  EXPECT_EQ(curve.details_kept(), 0);
  const Points now = evaluate(curve, Curve::polyline, result.parameters[0]);
  const double rms = std::sqrt((now.matrix() - points.matrix()).rowwise().squaredNorm().mean());
  EXPECT_NEAR(rms, result.budgets[0][0].fitted.rms, 1e-12 * diagonal(points));
  EXPECT_NEAR(result.final_cost, rms * rms * 150, 1e-10 * result.final_cost);
  // The exact model is under the fitted filter and gives the samples back.
  EXPECT_EQ(&result.models[0]->filter(), result.filter.get());
  EXPECT_LT((samples(*result.models[0]).matrix() - points.matrix()).cwiseAbs().maxCoeff(), 1e-12 * diagonal(points));
}

double moved_by_outlier(const CurveOptions& options, const Points& points, const Points& with_outlier) {
  const ModelPtr plain = fitted({{points, false}}, options).budgets[0][0].fitted.model;
  const ModelPtr moved = fitted({{with_outlier, false}}, options).budgets[0][0].fitted.model;
  return (samples(*plain).matrix() - samples(*moved).matrix()).rowwise().norm().maxCoeff();
}

TEST(CurveStage, OneGrossOutlierInFiftyMovesARobustFitByLessThanAHundredthOfThePlainOne) {
  for (const bool fixed : {true, false})
    for (unsigned seed = 1; seed <= 3; ++seed) {
      const Points points = noisy(resampled(bezier(6), 50), 0.01, seed);
      Points with_outlier = points;
      with_outlier.matrix().row(17 + seed) += Eigen::RowVector2d(-40, 30);
      CurveOptions options = shaped(3, 2);
      options.fixed_filter = fixed;
      const double plain = moved_by_outlier(options, points, with_outlier);
      for (const LossKind kind : {LossKind::huber, LossKind::cauchy, LossKind::tukey}) {
        options.loss = {kind, kind == LossKind::tukey ? 0.047 : 0.02};
        const double robust = moved_by_outlier(options, points, with_outlier);
        EXPECT_LT(robust, 0.01 * plain) << "loss " << static_cast<int>(kind) << ", T fixed " << fixed;
        options.loss = {};
      }
    }
}

TEST(CurveStage, HoldsConstraintsTo1e10) {
  for (const bool fixed : {true, false})
    for (const bool closed : {false, true}) {
      const Points points = closed ? loop(120, 2, 5) : walk(120, 2, 5);
      CurveOptions options = shaped(5, 2);
      options.fixed_filter = fixed;
      FitSamples told;
      told.fixed_ends = true;
      told.constraints = {{ConstraintKind::point, 0.4, {3, -1}}, {ConstraintKind::tangent, 0, {1, 2}}};
      options.samples = {told};
      const FitResult result = fitted({{points, closed}}, options);
      const Model& curve = *result.budgets[0][0].fitted.model;
      const double tolerance = 1e-10 * diagonal(points);
      const Points line = core::points(curve, curve.levels());
      const Points at = evaluate(curve, Curve::polyline, std::vector<double>{0.4});
      EXPECT_NEAR(at.matrix()(0, 0), 3, tolerance);
      EXPECT_NEAR(at.matrix()(0, 1), -1, tolerance);
      EXPECT_LT((line.matrix().row(0) - points.matrix().row(0)).norm(), tolerance);
      const Index last = line.count() - 1, end = closed ? 0 : points.count() - 1;
      EXPECT_LT((line.matrix().row(last) - points.matrix().row(end)).norm(), tolerance);
      const Eigen::RowVector2d leg = line.matrix().row(1) - line.matrix().row(0);
      EXPECT_NEAR(leg(0) * 2 - leg(1) * 1, 0, tolerance * leg.norm());
      EXPECT_LT(result.final_cost, fixed ? result.start_cost * (1 + 1e-12) : result.start_cost);
    }
}

// On coarse levels three points lie on one leg, and only two of them can be had: the way there is not taken.
TEST(CurveStage, HoldsPointsThatLieCloserThanCoarseLevelsTell) {
  const Points points = walk(1025, 2, 5);
  CurveOptions options = shaped(5, 2);
  options.iterations = 5;
  options.starts = 3;
  FitSamples told;
  for (const double parameter : {0.501, 0.504, 0.507})
    told.constraints.push_back({ConstraintKind::point, parameter, {1, parameter}});
  options.samples = {told};
  const FitResult result = fitted({{points, false}}, options);
  EXPECT_LT(result.final_cost, result.start_cost);
  const Points at =
      evaluate(*result.budgets[0][0].fitted.model, Curve::polyline, std::vector<double>{0.501, 0.504, 0.507});
  for (Index k = 0; k < 3; ++k)
    EXPECT_NEAR(at.matrix()(k, 1), told.constraints[static_cast<std::size_t>(k)].parameter, 1e-10 * diagonal(points));
}

TEST(CurveStage, WeighsSamples) {
  const Points points = noisy(bezier(5), 0.1, 9);
  CurveOptions options = shaped(3, 2);
  options.fixed_filter = true;
  FitSamples told;
  told.weights.assign(static_cast<std::size_t>(points.count()), 1.0);
  told.weights[20] = 1e10;  // all but a constraint
  options.samples = {told};
  const FitResult heavy = fitted({{points, false}}, options);
  const Points near = evaluate(*heavy.budgets[0][0].fitted.model, Curve::polyline, heavy.parameters[0]);
  EXPECT_LT((near.matrix().row(20) - points.matrix().row(20)).norm(), 1e-8);
  // A weight of 4 is what half the standard deviation says.
  told.weights.assign(static_cast<std::size_t>(points.count()), 4.0);
  told.weights[3] = 1;
  options.samples = {told};
  const FitResult weighted = fitted({{points, false}}, options);
  told.weights.clear();
  told.covariances = covariances(points.count(), 0.5);
  told.covariances[12] = told.covariances[15] = 1;
  options.samples = {told};
  const FitResult covaried = fitted({{points, false}}, options);
  EXPECT_NEAR(weighted.final_cost, covaried.final_cost, 1e-12 * weighted.final_cost);
}

TEST(CurveStage, FindsBetterParametersThanAreGivenAndKeepsTheirOrder) {
  const Points points = noisy(bezier(6), 0.01, 2);
  CurveOptions options = shaped(3, 2);
  options.fixed_filter = true;
  options.parameters = ParameterRule::given;
  FitSamples told;
  for (Index k = 0; k < points.count(); ++k)  // squeezed towards one end
    told.parameters.push_back(std::pow(static_cast<double>(k) / static_cast<double>(points.count() - 1), 1.4));
  options.samples = {told};
  const double as_given = fitted({{points, false}}, options).budgets[0][0].fitted.rms;
  options.reparameterise = 60;
  const FitResult result = fitted({{points, false}}, options);
  EXPECT_LT(result.budgets[0][0].fitted.rms, 0.5 * as_given);
  EXPECT_LT(result.budgets[0][0].fitted.rms, 0.015);
  const auto& parameters = result.parameters[0];
  EXPECT_EQ(parameters.front(), 0);
  EXPECT_EQ(parameters.back(), 1);
  for (std::size_t k = 1; k < parameters.size(); ++k) EXPECT_GT(parameters[k], parameters[k - 1]);
}

TEST(CurveStage, GivesTheSameBitsAgainAndOnAnyNumberOfThreads) {
  const std::vector<FitCurve> curves = {{walk(200, 2, 1), false}, {loop(300, 2, 2), true}};
  CurveOptions options = shaped(4, 2);
  options.loss = {LossKind::tukey, 2};
  options.reparameterise = 3;
  options.starts = 3;
  const FitResult once = fitted(curves, options);
  for (const int threads : {1, 2, 7}) {
    set_default_threads(threads);
    const FitResult again = fitted(curves, options);
    EXPECT_EQ(once.filter->matrix(), again.filter->matrix());
    EXPECT_EQ(once.final_cost, again.final_cost);
    EXPECT_EQ(once.parameters, again.parameters);
    EXPECT_EQ(once.certainty->filter, again.certainty->filter);
  }
  set_default_threads(0);
}

TEST(CurveStage, SharesOneFilterBetweenCurves) {
  const std::vector<FitCurve> curves = {{walk(200, 2, 1), false}, {loop(260, 2, 2), true}, {walk(150, 2, 9), false}};
  CurveOptions options = shaped(4, 2);
  options.samples.resize(3);
  options.samples[1].fixed_ends = true;
  const FitResult result = fitted(curves, options);
  ASSERT_EQ(result.models.size(), 3U);
  EXPECT_LT(result.final_cost, result.start_cost);
  double sum = 0;
  for (std::size_t c = 0; c < curves.size(); ++c)
    sum += std::pow(result.budgets[c][0].fitted.rms, 2) * static_cast<double>(curves[c].samples.count());
  EXPECT_NEAR(sum, result.final_cost, 1e-10 * sum);
}

TEST(CurveStage, TakesCurvesOfEveryDimensionAndDegenerateOnes) {
  for (const Index dimension : {1, 2, 3, 4})
    EXPECT_NO_THROW(fitted({{walk(70, dimension, 3), false}}, shaped(3, 3))) << dimension;
  Points same(2, 50);
  same.matrix().setConstant(3);
  for (const ParameterRule rule : {ParameterRule::index, ParameterRule::chord}) {
    CurveOptions options;
    options.parameters = rule;
    options.reparameterise = 2;
    options.loss = {LossKind::tukey, 1};
    EXPECT_LT(fitted({{same, false}}, options).budgets[0][0].fitted.rms, 1e-14);
  }
  const FitResult two = fitted({{walk(2, 2, 1), false}}, {});  // fewer samples than control points
  EXPECT_LT(two.budgets[0][0].fitted.rms, 1e-12);
  EXPECT_THROW(control_covariance(*two.certainty, 0), Error);
}

TEST(CurveStage, StopsWhenTheCallbackSaysSoAndWhenTheTokenIsRaised) {
  int calls = 0;
  Watch watch(nullptr, [&](double, const char*) { return ++calls == 3; });
  EXPECT_THROW(fit_curve({{walk(300, 2, 1), false}}, {}, watch), Cancelled);
  EXPECT_EQ(calls, 3);
  CancelToken token;
  Watch watched(&token, nullptr);
  std::thread raiser([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    token.request();
  });
  CurveOptions options;
  options.iterations = 1000;
  EXPECT_THROW(fit_curve({{walk(100000, 2, 1), false}}, options, watched), Cancelled);
  raiser.join();
}

}  // namespace
}  // namespace ifsm::core
