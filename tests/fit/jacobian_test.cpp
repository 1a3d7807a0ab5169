// Derivatives are never trusted.
#include <ceres/gradient_checker.h>
#include <gtest/gtest.h>

#include <cmath>

#include "curves.h"
#include "fit/minimise.h"
#include "fit/parameters.h"
#include "fit/projection.h"
#include "fit/sparsity.h"

namespace ifsm::core {
namespace {

struct Case {
  int control_points, maps;
  Index dimension, samples;
  bool closed;
};

const Case cases[] = {{2, 2, 1, 33, false}, {3, 2, 2, 40, false}, {5, 2, 2, 65, true},
                      {4, 3, 3, 50, false}, {3, 4, 4, 90, true},  {3, 2, 1, 9000, false}};  // in several blocks

// A model, its finest line, and an R near de Casteljau's with no symmetry left.
struct Setting {
  explicit Setting(const Case& c)
      : filter(named_filter("casteljau", Topology::joined, c.control_points, c.maps)),
        shape(filter->shape()),
        model(analyze(filter, c.closed ? loop(c.samples, c.dimension, 7) : walk(c.samples, c.dimension, 7), c.closed)),
        finest(line(*model, model->levels())),
        solver(shape, model->levels(), c.closed, sample_weights(*model)),
        parameters(parameters_of(shape, filter->matrix())) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> step(-0.02, 0.02);
    for (double& p : parameters) p += step(random);
  }

  Sparsity sparsity() { return {shape, {{&finest, model->levels(), {0.4, 1.7}}}, watch}; }
  Projection projection() {
    const Index kept = model->details_total() / 3;
    return {shape, {{&solver, &finest, model->levels(), most_significant(*model, kept), 0.7}}, watch};
  }

  FilterPtr filter;
  Shape shape;
  ModelPtr model;
  Points finest;
  TreeSolver solver;
  Eigen::VectorXd parameters;
  Watch watch;
};

// Central differences are good to h² f''' / 6 + eps f / h: with h = 1e-5 about 1e-9 of the objective's size.
void expect_gradient_of_value(Objective& objective, const Setting& setting) {
  constexpr double h = 1e-5;
  Normal normal(free_count(setting.shape));
  objective.gather(matrix_of(setting.shape, setting.parameters.data()), normal);
  const Eigen::MatrixXd product = normal.product();
  const Index count = setting.parameters.size();
  const double value = objective.value(matrix_of(setting.shape, setting.parameters.data()));
  EXPECT_NEAR(product(count, count), value, 1e-12 * value);
  for (Index p = 0; p < count; ++p) {
    Eigen::VectorXd up = setting.parameters, down = setting.parameters;
    up(p) += h;
    down(p) -= h;
    const double difference = (objective.value(matrix_of(setting.shape, up.data())) -
                               objective.value(matrix_of(setting.shape, down.data()))) /
                              (2 * h);
    EXPECT_NEAR(2 * product(count, p), difference, 1e-7 * (value + std::abs(difference))) << "parameter " << p;
  }
}

TEST(Sparsity, HasTheGradientThatCentralDifferencesSee) {
  for (const Case& c : cases) {
    Setting setting(c);
    Sparsity objective = setting.sparsity();
    expect_gradient_of_value(objective, setting);
  }
}

TEST(Projection, HasTheGradientThatCentralDifferencesSee) {
  for (const Case& c : cases) {
    Setting setting(c);
    Projection objective = setting.projection();
    expect_gradient_of_value(objective, setting);
  }
}

// All rows of an objective, as a cost that Ceres can check.
class AllRows : public ceres::CostFunction {
 public:
  AllRows(const Shape& shape, const Sparsity& objective, int rows) : shape_(shape), objective_(objective) {
    set_num_residuals(rows);
    mutable_parameter_block_sizes()->push_back(free_count(shape));
  }
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    Sink sink(num_residuals(), free_count(shape_));
    objective_.rows(matrix_of(shape_, parameters[0]), sink);
    Eigen::Map<Eigen::VectorXd>(residuals, num_residuals()) = sink.rows.rightCols(1);
    if (jacobians != nullptr && jacobians[0] != nullptr)
      Eigen::Map<RowMatrix>(jacobians[0], num_residuals(), free_count(shape_)) = sink.rows.leftCols(free_count(shape_));
    return sink.used == num_residuals();
  }

 private:
  struct Sink : RowSink {
    Sink(int count, int parameters) : rows(count, parameters + 1) {}
    double* row() override { return rows.row(used++).data(); }
    RowMatrix rows;
    int used = 0;
  };
  Shape shape_;
  const Sparsity& objective_;
};

TEST(Sparsity, PassesTheGradientCheckerOfCeresRowByRow) {
#ifdef __SANITIZE_ADDRESS__
  // The checker hands out matrices that the distribution's Ceres allocated; under the sanitizer Eigen's inline
  // destructor expects another layout of the block (EIGEN_MALLOC_ALREADY_ALIGNED) and would read before it.
  GTEST_SKIP() << "Eigen's allocation differs between this build and Ceres'";
#endif
  for (const Case& c : cases) {
    Setting setting(c);
    Sparsity objective = setting.sparsity();
    const AllRows cost(setting.shape, objective, static_cast<int>(setting.model->details_total() * c.dimension));
    const std::vector<const ceres::Manifold*> no_manifolds(1, nullptr);
    ceres::NumericDiffOptions steps;
    steps.ridders_relative_initial_step_size = 1e-4;  // rows bend sharply where a detail is near 0: begin close
    const ceres::GradientChecker checker(&cost, &no_manifolds, steps);
    const double* blocks[] = {setting.parameters.data()};
    ceres::GradientChecker::ProbeResults results;
    checker.Probe(blocks, 1e-9, &results);  // its verdict is relative to each entry, however small
    // Steps end at 1e-6: rounding of the rows, some 1e-13 after ten levels, over that.
    const auto& analytic = results.jacobians[0];
    const auto& numeric = results.numeric_jacobians[0];
    Index row = 0, column = 0;
    const double worst = (analytic - numeric).cwiseAbs().maxCoeff(&row, &column);
    EXPECT_LT(worst, 1e-6 * analytic.cwiseAbs().maxCoeff())
        << "n = " << c.control_points << ", row " << row << ", parameter " << column << ": " << analytic(row, column)
        << " against " << numeric(row, column);
  }
}

TEST(GainTangents, AgreeWithDifferencesOfTheGains) {
  Setting setting(cases[2]);
  constexpr double h = 1e-6;
  const auto entries = free_entries(setting.shape);
  const auto at = [&](const Eigen::VectorXd& p) {
    return gain_tangents(setting.shape, 4, matrix_of(setting.shape, p.data()), entries);
  };
  const GainTangents here = at(setting.parameters);
  for (std::size_t p = 0; p < entries.size(); ++p) {
    Eigen::VectorXd up = setting.parameters, down = setting.parameters;
    up(static_cast<Index>(p)) += h;
    down(static_cast<Index>(p)) -= h;
    const GainTangents more = at(up), less = at(down);
    for (std::size_t level = 0; level < 4; ++level) {
      const Eigen::VectorXd difference = (more.gain[level] - less.gain[level]) / (2 * h);
      // h² g''' / 6 + eps g / h, g of the order of the root of the places below.
      EXPECT_LT((here.tangent[level].col(static_cast<Index>(p)) - difference).norm(),
                1e-7 * (1 + here.gain[level].norm()));
    }
  }
}

TEST(Normal, GivesCeresTheSameCostGradientAndGaussNewtonMatrixInFewRows) {
  Setting setting(cases[2]);
  Sparsity objective = setting.sparsity();
  Normal normal(free_count(setting.shape));
  objective.gather(matrix_of(setting.shape, setting.parameters.data()), normal);
  const int count = normal.parameters();
  const Eigen::MatrixXd product = normal.product().selfadjointView<Eigen::Lower>();
  const Normal::Rows rows = normal.compressed();
  ASSERT_EQ(rows.jacobian.rows(), count + 1);
  EXPECT_NEAR(rows.residual.squaredNorm(), product(count, count), 1e-13 * product(count, count));
  const Eigen::VectorXd gradient = rows.jacobian.transpose() * rows.residual;
  EXPECT_LT((gradient - product.row(count).head(count).transpose()).norm(), 1e-10 * gradient.norm());
  // Pivots below 1e-12 of the largest are the gauge's and dropped.
  const Eigen::MatrixXd gauss_newton = rows.jacobian.transpose() * rows.jacobian;
  EXPECT_LT((gauss_newton - product.topLeftCorner(count, count)).norm(), 1e-11 * product.norm());
}

TEST(Parameters, RoundTripAndKeepColumnsOfSumOne) {
  for (const Case& c : cases) {
    Setting setting(c);
    const RowMatrix matrix = matrix_of(setting.shape, setting.parameters.data());
    EXPECT_EQ(parameters_of(setting.shape, matrix), setting.parameters);
    EXPECT_NO_THROW(Filter(setting.shape, matrix));
  }
}

// A bowl with a wall: the minimum lies where R is no longer well conditioned.
class Shrink : public Objective {
 public:
  explicit Shrink(const Shape& shape) : shape_(shape) {}
  double value(const RowMatrix& matrix) override { return parameters_of(shape_, matrix).squaredNorm(); }
  void gather(const RowMatrix& matrix, Normal& normal) override {
    const Eigen::VectorXd parameters = parameters_of(shape_, matrix);
    for (Index p = 0; p < parameters.size(); ++p) {
      Eigen::Map<Eigen::VectorXd> row(normal.row(), parameters.size() + 1);
      row.setZero();
      row(p) = 1;
      row(parameters.size()) = parameters(p);
    }
  }

 private:
  Shape shape_;
};

TEST(Minimise, StaysInTheWellConditionedAndContractiveRegion) {
  const FilterPtr start = named_filter("casteljau", Topology::joined, 4, 2);
  Shrink objective(start->shape());
  const Minimised found = minimise(start->shape(), objective, start->matrix(), {60, 1e-12, 50, "test"}, Watch{});
  EXPECT_LT(found.value, found.start_value);
  EXPECT_LE(condition_of(found.matrix), 50);
  EXPECT_EQ(Filter(start->shape(), found.matrix).contractivity(), Contractivity::proven);
}

}  // namespace
}  // namespace ifsm::core
