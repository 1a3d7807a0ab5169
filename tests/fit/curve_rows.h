// The uncompressed problem of stage curve, for Ceres to look at.
#pragma once

#include <ceres/cost_function.h>

#include "fit/curve_error.h"

namespace ifsm::core {

// All rows of an objective's first term, by (control points, free entries of C).
class CurveRows : public ceres::CostFunction {
 public:
  CurveRows(const Shape& shape, RowMatrix base, const CurveError& error)
      : shape_(shape), base_(std::move(base)), error_(error) {
    const Target& target = *error.terms()[0].target;
    set_num_residuals(static_cast<int>(target.count() * target.dimension));
    mutable_parameter_block_sizes()->push_back(shape.control_points() * static_cast<int>(target.dimension));
    mutable_parameter_block_sizes()->push_back(free_count(shape, Part::maps));
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const int sizes[] = {parameter_block_sizes()[0], parameter_block_sizes()[1]}, all = sizes[0] + sizes[1];
    Sink sink(num_residuals(), all);
    const CurveTerm& term = error_.terms()[0];
    const Eigen::Map<const Eigen::VectorXd> control(parameters[0], sizes[0]);
    error_.rows(term, matrix_of(shape_, parameters[1], Part::maps, base_), unstacked(control, term.target->dimension),
                sink);
    Eigen::Map<Eigen::VectorXd>(residuals, num_residuals()) = sink.rows.rightCols(1);
    for (int b = 0; b < 2; ++b)
      if (jacobians != nullptr && jacobians[b] != nullptr)
        Eigen::Map<RowMatrix>(jacobians[b], num_residuals(), sizes[b]) =
            sink.rows.middleCols(b == 0 ? 0 : sizes[0], sizes[b]);
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
  RowMatrix base_;
  const CurveError& error_;
};

}  // namespace ifsm::core
