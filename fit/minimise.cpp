#include "fit/minimise.h"

#include <ceres/cost_function.h>
#include <ceres/iteration_callback.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <algorithm>
#include <cmath>

#include "fit/quiet.h"

namespace ifsm::core {
namespace {

Contractivity contractivity(const Shape& shape, const RowMatrix& matrix) {
  return contractivity_of(shape, matrix.topRows(shape.control_points()));
}

struct Region {
  const MinimiseOptions& options;
  Contractivity least;

  bool holds(const Shape& shape, const RowMatrix& matrix) const {
    return matrix.allFinite() && condition_of(matrix) <= options.condition && contractivity(shape, matrix) >= least &&
           (!options.admits || options.admits(matrix));
  }
};

class Cost : public ceres::CostFunction {
 public:
  Cost(const Shape& shape, const RowMatrix& start, Objective& objective, const Region& region)
      : shape_(shape),
        start_(start),
        objective_(objective),
        region_(region),
        count_(free_count(shape, region.options.part)) {
    set_num_residuals(count_ + 1);
    mutable_parameter_block_sizes()->push_back(count_);
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const RowMatrix matrix = matrix_of(shape_, parameters[0], region_.options.part, start_);
    if (!region_.holds(shape_, matrix)) return false;
    Eigen::Map<Eigen::VectorXd> residual(residuals, count_ + 1);
    if (jacobians == nullptr || jacobians[0] == nullptr) {
      residual.setZero();
      residual(0) = std::sqrt(objective_.value(matrix));
      return std::isfinite(residual(0));
    }
    Normal normal(count_);
    objective_.gather(matrix, normal);
    const Normal::Rows rows = normal.compressed();
    residual = rows.residual;
    Eigen::Map<RowMatrix>(jacobians[0], count_ + 1, count_) = rows.jacobian;
    return rows.residual.allFinite() && rows.jacobian.allFinite();
  }

 private:
  Shape shape_;
  const RowMatrix& start_;
  Objective& objective_;
  Region region_;
  int count_;
};

class Report : public ceres::IterationCallback {
 public:
  Report(Watch& watch, const MinimiseOptions& options) : watch_(watch), options_(options) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    watch_.report(static_cast<double>(summary.iteration) / options_.iterations, options_.stage);
    return ceres::SOLVER_CONTINUE;
  }

 private:
  Watch& watch_;
  const MinimiseOptions& options_;
};

}  // namespace

Minimised minimise(const Shape& shape, Objective& objective, const RowMatrix& start, const MinimiseOptions& options,
                   Watch watch) {
  const double start_value = objective.value(start);
  const Minimised unmoved{start, start_value, start_value, 0, true};
  if (!(start_value > 0) || free_count(shape, options.part) == 0) return unmoved;

  Eigen::VectorXd parameters = parameters_of(shape, start, options.part);
  Cost cost(shape, start, objective, {options, contractivity(shape, start)});
  Report report(watch, options);
  ceres::Problem::Options borrowed;
  borrowed.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(borrowed);
  problem.AddResidualBlock(&cost, nullptr, parameters.data());

  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  solver.num_threads = 1;
  solver.max_num_iterations = options.iterations;
  solver.function_tolerance = options.tolerance;
  solver.logging_type = ceres::SILENT;
  solver.callbacks.push_back(&report);
  ceres::Solver::Summary summary;
  const Quiet quiet;
  ceres::Solve(solver, &problem, &summary);

  // Ceres calls it convergence when every step was refused: what counts is the value at the end.
  const RowMatrix found = matrix_of(shape, parameters.data(), options.part, start);
  const double value = objective.value(found);
  const int iterations = std::max(0, static_cast<int>(summary.iterations.size()) - 1);
  if (!(value < start_value)) return {start, start_value, start_value, iterations, true};
  return {found, start_value, value, iterations, summary.termination_type == ceres::CONVERGENCE};
}

}  // namespace ifsm::core
