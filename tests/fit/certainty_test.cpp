#include "fit/certainty.h"

#include <ceres/covariance.h>
#include <ceres/problem.h>
#include <gtest/gtest.h>

#include "curve_rows.h"
#include "curves.h"
#include "fit/curve_problem.h"

namespace ifsm::core {
namespace {

// A noisy quadratic curve on few levels, where the polyline still tells (P, T) and (P A, A^-1 T A) apart, so that Ceres
// finds the full rank that it asks for.
Points measured() {
  const double triangle[] = {0, 0, 0.5, 1, 2, 0};
  Points points = samples(*from_polygon(named_filter("casteljau", Topology::joined, 3, 2),
                                        Points::from_interleaved(triangle, 3, 2), false, 3));
  std::mt19937 random(8);
  std::normal_distribution<double> noise(0, 0.01);
  for (double& x : points.matrix().reshaped()) x += noise(random);
  return points;
}

// Ceres' own covariances of (control points, C) from the uncompressed rows at the end of a fit.
struct ByCeres {
  Eigen::MatrixXd control, mixed, filter;
};

ByCeres covariances_by_ceres(const std::vector<FitCurve>& curves, const FitResult& fit, const CurveOptions& options) {
  const Watch watch;
  const FilterPtr start = named_filter("casteljau", Topology::joined, options.control_points, options.maps);
  const CurveProblem problem(curves, start, options, watch);
  const CurveState state = problem.state(fit.filter->matrix(), Loss{}, problem.levels()).value();
  const CurveError error = problem.error(state, Loss{}, problem.levels());
  Eigen::VectorXd control = stacked(state.controls[0]);
  Eigen::VectorXd maps = parameters_of(problem.shape(), state.matrix, Part::maps);
  ceres::Problem rows;
  rows.AddResidualBlock(new CurveRows(problem.shape(), state.matrix, error), nullptr, control.data(), maps.data());
  if (options.fixed_filter) rows.SetParameterBlockConstant(maps.data());
  ceres::Covariance::Options dense;
  dense.algorithm_type = ceres::DENSE_SVD;
  ceres::Covariance covariance(dense);
  const double* c = control.data();
  const double* m = maps.data();
  EXPECT_TRUE(covariance.Compute({{c, c}, {c, m}, {m, m}}, &rows));
  RowMatrix cc(control.size(), control.size()), cm(control.size(), maps.size()), mm(maps.size(), maps.size());
  EXPECT_TRUE(covariance.GetCovarianceBlock(c, c, cc.data()));
  EXPECT_TRUE(covariance.GetCovarianceBlock(c, m, cm.data()));
  EXPECT_TRUE(covariance.GetCovarianceBlock(m, m, mm.data()));
  const double variance = fit.certainty->noise * fit.certainty->noise;
  return {variance * cc, variance * cm, variance * mm};
}

TEST(Certainty, IsWhatCeresFindsFromTheUncompressedRows) {
  const std::vector<FitCurve> curves = {{measured(), false}};
  for (const bool fixed : {true, false}) {
    CurveOptions options;
    options.control_points = 3;
    options.fixed_filter = fixed;
    Watch watch;
    const FitResult fit = fit_curve(curves, options, watch);
    const ByCeres theirs = covariances_by_ceres(curves, fit, options);
    // From JᵀJ: the condition number of J squared, some 1e6 with T free, times eps.
    const double tolerance = fixed ? 1e-12 : 1e-8;
    const Eigen::MatrixXd control = control_covariance(*fit.certainty, 0);
    EXPECT_LT((control - theirs.control).norm(), tolerance * theirs.control.norm());
    EXPECT_LT((fit.certainty->filter - theirs.filter).norm(), tolerance * theirs.filter.norm() + 1e-300);

    const std::vector<double> at = {0.9, 0.1, 0.55};  // in any order
    const Lanes curve = curve_covariance(*fit.certainty, 0, at, watch);
    const Shape& shape = fit.certainty->shape;
    for (std::size_t i = 0; i < at.size(); ++i) {
      Eigen::MatrixXd wanted(2, 2);
      CurveWalk(shape, fit.certainty->levels, fit.certainty->matrix, watch)
          .tangents(positions_of(shape, fit.certainty->levels, std::vector<double>{at[i]}),
                    fit.certainty->curves[0].control, [&](Index, const double* basis, const double* tangent) {
                      Eigen::MatrixXd by_control(2, 6);
                      for (int p = 0; p < 3; ++p)
                        by_control.middleCols(2 * p, 2) = basis[p] * Eigen::Matrix2d::Identity();
                      const Eigen::MatrixXd by_filter = Eigen::Map<const Lanes>(tangent, 2, 6);
                      const Eigen::MatrixXd cross = by_control * theirs.mixed * by_filter.transpose();
                      wanted = by_control * theirs.control * by_control.transpose() + cross + cross.transpose() +
                               by_filter * theirs.filter * by_filter.transpose();
                    });
      EXPECT_LT((curve.middleRows(2 * static_cast<Index>(i), 2) - wanted).norm(), tolerance * wanted.norm());
    }
  }
}

TEST(Certainty, OfWhatIsHeldIsZero) {
  CurveOptions options;
  options.control_points = 4;
  options.samples.resize(1);
  options.samples[0].fixed_ends = true;
  options.samples[0].constraints = {{ConstraintKind::point, 0.3, {1, 0.4}}};
  Watch watch;
  for (const bool fixed : {true, false}) {
    options.fixed_filter = fixed;
    const FitResult fit = fit_curve({{measured(), false}}, options, watch);
    const Lanes curve = curve_covariance(*fit.certainty, 0, std::vector<double>{0, 0.3, 1, 0.6}, watch);
    EXPECT_LT(curve.topRows(6).cwiseAbs().maxCoeff(), 1e-12 * curve.bottomRows(2).norm());
    EXPECT_GT(curve.bottomRows(2).norm(), 0);
  }
}

TEST(Certainty, RefusesWhatNothingTells) {
  Watch watch;
  CurveOptions options;
  options.control_points = 3;
  options.fixed_filter = true;
  Points three(2, 3);
  three.matrix() << 0, 0, 1, 1, 2, 0;
  const FitResult exact = fit_curve({{three, false}}, options, watch);  // as many unknowns as coordinates
  EXPECT_EQ(exact.certainty->freedom, 0);
  EXPECT_THROW(control_covariance(*exact.certainty, 0), Error);
  options.samples.resize(1);  // told by covariances, it can be
  options.samples[0].covariances = {1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1};
  EXPECT_NO_THROW(control_covariance(*fit_curve({{three, false}}, options, watch).certainty, 0));
  for (const bool fixed : {true, false}) {  // three samples never tell four control points, noise known or not
    options.fixed_filter = fixed;
    options.control_points = 4;
    EXPECT_THROW(control_covariance(*fit_curve({{three, false}}, options, watch).certainty, 0), Error);
  }
  const FitResult fit = fit_curve({{measured(), false}}, CurveOptions{}, watch);
  EXPECT_THROW(curve_covariance(*fit.certainty, 0, std::vector<double>{0.5, 1.5}, watch), Error);
}

}  // namespace
}  // namespace ifsm::core
