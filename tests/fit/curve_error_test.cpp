#include "fit/curve_error.h"

#include <ceres/autodiff_cost_function.h>
#include <ceres/crs_matrix.h>
#include <ceres/gradient_checker.h>
#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "curve_rows.h"
#include "curves.h"
#include "fit/loss.h"

namespace ifsm::core {
namespace {

struct Case {
  int control_points, maps;
  Index dimension, samples;
  bool closed, covariances, constrained;
};

const Case cases[] = {{2, 2, 1, 33, false, false, false}, {5, 2, 2, 40, false, false, true},
                      {5, 2, 2, 65, true, false, false},  {4, 3, 3, 50, false, true, true},
                      {3, 4, 4, 90, true, true, false},   {4, 2, 2, 30, false, true, false}};

// Weights or covariances, and parameters between places: nothing that could hide a factor.
FitSamples told(const Case& c, const Points& points) {
  FitSamples samples;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> weight(0.5, 2);
  const Index d = c.dimension;
  for (Index k = 0; k < c.samples; ++k) {
    samples.parameters.push_back((static_cast<double>(k) + 0.3 * weight(random) / 2) / static_cast<double>(c.samples));
    if (!c.covariances) {
      samples.weights.push_back(weight(random));
      continue;
    }
    Eigen::MatrixXd root = Eigen::MatrixXd::NullaryExpr(d, d, [&] { return weight(random) - 1.25; });
    const RowMatrix covariance = root * root.transpose() + 0.3 * Eigen::MatrixXd::Identity(d, d);
    samples.covariances.insert(samples.covariances.end(), covariance.data(), covariance.data() + d * d);
  }
  if (c.constrained) {
    samples.fixed_ends = true;
    samples.constraints.push_back({ConstraintKind::tangent, 0, std::vector<double>(static_cast<std::size_t>(d), 1.0)});
    std::vector<double> through(static_cast<std::size_t>(d));
    for (Index a = 0; a < d; ++a) through[static_cast<std::size_t>(a)] = points.matrix()(c.samples / 3, a) + 0.5;
    samples.constraints.push_back({ConstraintKind::point, 0.37, through});
  }
  return samples;
}

struct Setting {
  explicit Setting(const Case& c)
      : filter(named_filter("casteljau", Topology::joined, c.control_points, c.maps)),
        shape(filter->shape()),
        curve{c.closed ? loop(c.samples, c.dimension, 7) : walk(c.samples, c.dimension, 7), c.closed},
        model(analyze(filter, curve.samples, c.closed)),
        target(make_target(curve, told(c, curve.samples), ParameterRule::given, *model, "")),
        parameters(parameters_of(shape, filter->matrix(), Part::maps)) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> step(-0.02, 0.02);
    for (double& p : parameters) p += step(random);
  }

  CurveTerm term() const {
    CurveTerm term{&target,
                   ConstraintSet(target, shape, model->levels()),
                   positions_of(shape, model->levels(), target.parameters),
                   model->parts().polygon.matrix(),
                   {},
                   0.25};
    for (Index k = 0; k < target.count(); ++k) term.slopes.push_back(1.0 / static_cast<double>(1 + k % 3));
    return term;
  }
  CurveError error() const { return {shape, model->levels(), {term()}, watch}; }
  RowMatrix matrix(const Eigen::VectorXd& p) const { return matrix_of(shape, p.data(), Part::maps, filter->matrix()); }
  RowMatrix matrix() const { return matrix(parameters); }

  FilterPtr filter;
  Shape shape;
  FitCurve curve;
  ModelPtr model;
  Target target;
  Eigen::VectorXd parameters;
  Watch watch;
};

// Central differences are good to h² f''' / 6 + eps f / h: with h = 1e-5 about 1e-9 of the objective's size.
TEST(CurveError, HasTheGradientThatCentralDifferencesSeeControlPointsFollowingAndConstraintsHolding) {
  constexpr double h = 1e-5;
  for (const Case& c : cases) {
    const Setting setting(c);
    CurveError error = setting.error();
    const Index count = setting.parameters.size();
    Normal normal(static_cast<int>(count));
    error.gather(setting.matrix(), normal);
    const Eigen::MatrixXd product = normal.product();
    const double value = error.value(setting.matrix());
    EXPECT_NEAR(product(count, count), value, 1e-10 * value);  // after an elimination: its condition
    for (Index p = 0; p < count; ++p) {
      Eigen::VectorXd up = setting.parameters, down = setting.parameters;
      up(p) += h;
      down(p) -= h;
      const double difference = (error.value(setting.matrix(up)) - error.value(setting.matrix(down))) / (2 * h);
      EXPECT_NEAR(2 * product(count, p), difference, 1e-7 * (value + std::abs(difference)))
          << "n = " << c.control_points << ", parameter " << p;
    }
  }
}

TEST(CurveError, PassesTheGradientCheckerOfCeresRowByRow) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "Eigen's allocation differs between this build and Ceres'";  // as in jacobian_test.cpp
#endif
  for (const Case& c : cases) {
    const Setting setting(c);
    const CurveError error = setting.error();
    const CurveRows cost(setting.shape, setting.filter->matrix(), error);
    const std::vector<const ceres::Manifold*> no_manifolds(2, nullptr);
    const ceres::GradientChecker checker(&cost, &no_manifolds, ceres::NumericDiffOptions());
    const Eigen::VectorXd control = stacked(error.terms()[0].reference);
    const double* blocks[] = {control.data(), setting.parameters.data()};
    ceres::GradientChecker::ProbeResults results;
    checker.Probe(blocks, 1e-9, &results);
    for (std::size_t b = 0; b < 2; ++b)
      EXPECT_LT((results.jacobians[b] - results.numeric_jacobians[b]).cwiseAbs().maxCoeff(),
                1e-8 * results.jacobians[b].cwiseAbs().maxCoeff())
          << "n = " << c.control_points << ", block " << b;
  }
}

TEST(CurveError, GathersPlainWeightsIntoTheProductOfAllRows) {
  for (const Case& c : cases) {
    const Setting setting(c);
    const CurveError error = setting.error();
    const CurveTerm& term = error.terms()[0];
    const Eigen::MatrixXd product = error.product(term, setting.matrix(), term.reference);
    Normal normal(static_cast<int>(product.rows()) - 1);
    error.rows(term, setting.matrix(), term.reference, normal);
    const Eigen::MatrixXd wanted = normal.product().selfadjointView<Eigen::Lower>();
    // Sums of at most a few hundred products, in another order.
    EXPECT_LT((product - wanted).cwiseAbs().maxCoeff(), 1e-13 * wanted.cwiseAbs().maxCoeff());
  }
}

// Solved for control points under one C, no step of them betters the value.
TEST(CurveError, SolvesForControlPointsToTheirOptimum) {
  for (const Case& c : cases) {
    const Setting setting(c);
    CurveError error = setting.error();
    const CurveTerm& term = error.terms()[0];
    const Lanes control = error.solved(setting.matrix())->front().control;
    const Eigen::MatrixXd product = error.product(term, setting.matrix(), control);
    const Index unknowns = control.size(), last = product.rows() - 1;
    const Equations equations = term.constraints.equations(setting.matrix(), setting.watch);
    const Held held(equations.left, equations.right, setting.target.diagonal);
    const Eigen::VectorXd gradient = product.col(last).head(unknowns);
    EXPECT_LT((held.free().transpose() * gradient).norm(),
              1e-11 * product.topLeftCorner(unknowns, unknowns).norm() * control.norm());
    EXPECT_LT((equations.left * stacked(control) - equations.right).norm(), 1e-12 * setting.target.diagonal);
  }
}

// Ceres' losses on the uncompressed rows, a sample a block, against slopes inside the compressed ones.
struct Sample {
  template <class T>
  bool operator()(const T* p, T* residual) const {
    for (int a = 0; a < 2; ++a) {
      residual[a] = T(-wanted[a]);
      for (int i = 0; i < n; ++i) residual[a] += basis[static_cast<std::size_t>(i)] * p[2 * i + a];
    }
    return true;
  }
  static constexpr int n = 4;
  std::vector<double> basis;
  double wanted[2];
};

TEST(CurveError, CompressedHasTheCostGradientAndStepOfCeresOwnRobustProblem) {
  const Setting setting({4, 2, 2, 61, false, false, false});
  const RowMatrix matrix = setting.matrix();
  const Loss losses[] = {{LossKind::squares, 1}, {LossKind::huber, 0.8}, {LossKind::cauchy, 0.6}, {LossKind::tukey, 4}};
  for (const Loss& loss : losses) {
    Target target = setting.target;
    target.weights.clear();
    CurveTerm term = setting.term();
    term.target = &target;
    term.slopes.clear();
    term.offset = 0;
    Eigen::VectorXd control = stacked(term.reference);
    ceres::LossFunction* theirs = nullptr;
    if (loss.kind == LossKind::huber) theirs = new ceres::HuberLoss(loss.scale);
    if (loss.kind == LossKind::cauchy) theirs = new ceres::CauchyLoss(loss.scale);
    if (loss.kind == LossKind::tukey) theirs = new ceres::TukeyLoss(loss.scale);
    ceres::Problem problem;
    CurveWalk(setting.shape, setting.model->levels(), matrix, setting.watch)
        .basis(term.positions, [&](Index k, const double* basis) {
          auto* sample = new Sample{{basis, basis + Sample::n}, {target.samples(k, 0), target.samples(k, 1)}};
          problem.AddResidualBlock(new ceres::AutoDiffCostFunction<Sample, 2, 2 * Sample::n>(sample), theirs,
                                   control.data());
          Eigen::RowVector2d error = Eigen::Map<const Eigen::RowVectorXd>(basis, Sample::n) * term.reference;
          error -= target.samples.row(k);
          const Loss::Value value = loss(error.squaredNorm());
          term.slopes.push_back(value.slope);
          term.offset += value.rho - value.slope * error.squaredNorm();
        });
    double cost = 0;
    std::vector<double> gradient;
    ceres::CRSMatrix sparse;
    std::vector<double> residuals;
    ASSERT_TRUE(problem.Evaluate({}, &cost, &residuals, &gradient, &sparse));
    Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(sparse.num_rows, sparse.num_cols);
    for (int r = 0; r < sparse.num_rows; ++r)
      for (int i = sparse.rows[static_cast<std::size_t>(r)]; i < sparse.rows[static_cast<std::size_t>(r) + 1]; ++i)
        jacobian(r, sparse.cols[static_cast<std::size_t>(i)]) = sparse.values[static_cast<std::size_t>(i)];

    const CurveError error(setting.shape, setting.model->levels(), {term}, setting.watch);
    const Eigen::MatrixXd product = error.product(term, matrix, term.reference);
    const int unknowns = 2 * Sample::n;
    Normal normal(unknowns);
    Eigen::MatrixXd part(unknowns + 1, unknowns + 1);
    part << product.topLeftCorner(unknowns, unknowns), product.topRightCorner(unknowns, 1),
        product.bottomLeftCorner(1, unknowns), product(product.rows() - 1, product.rows() - 1) + term.offset;
    normal.add(part);
    const Normal::Rows rows = normal.compressed();
    const Eigen::Map<const Eigen::VectorXd> wanted(gradient.data(), unknowns);
    EXPECT_NEAR(0.5 * rows.residual.squaredNorm(), cost, 1e-10 * cost);
    EXPECT_LT((rows.jacobian.transpose() * rows.residual - wanted).norm(), 1e-10 * wanted.norm());
    // One Levenberg-Marquardt step at Ceres' first damping, 1e-4 of the diagonal.
    const auto step = [&](const Eigen::MatrixXd& j) {
      Eigen::MatrixXd form = j.transpose() * j;
      form.diagonal() *= 1 + 1e-4;
      return Eigen::VectorXd(form.ldlt().solve(wanted));
    };
    EXPECT_LT((step(rows.jacobian) - step(jacobian)).norm(), 1e-10 * step(jacobian).norm());
  }
}

}  // namespace
}  // namespace ifsm::core
