// The filter R = (T_0 … T_N-1 over U_0 … U_N-1) of paper 002, eq. (5): synthesis multiplies by R, analysis by R^-1.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "curve/shape.h"
#include "linalg/contractivity.h"

namespace ifsm::core {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

class Filter {
 public:
  // Takes R after checking it: rows × rows, finite, columns of T of sum 1, joints shared, invertible.
  Filter(const Shape& shape, RowMatrix matrix);

  const Shape& shape() const { return shape_; }
  const RowMatrix& matrix() const { return matrix_; }
  const RowMatrix& inverse() const { return inverse_; }
  double condition() const { return condition_; }                 // 2-norm
  Contractivity contractivity() const { return contractivity_; }  // of the T_i, on vectors of sum zero

  // T_i, n × n.
  RowMatrix map(int i) const;
  // U_i, details_per_node × n.
  RowMatrix detail_map(int i) const;

 private:
  Shape shape_;
  RowMatrix matrix_;
  RowMatrix inverse_;
  double condition_;
  Contractivity contractivity_;
};

using FilterPtr = std::shared_ptr<const Filter>;

// Columns of R that the polygon of child i occupies: first column, count n.
inline int first_column(const Shape& shape, int child) { return child * shape.polygon_step(); }

// R^-1 with its structure exact (joined: the ends pass unchanged), or a singular error.
RowMatrix inverse_of(const Shape& shape, const RowMatrix& matrix);

// Ratio of the extreme singular values; infinite when singular.
double condition_of(const RowMatrix& matrix);

// T (joined: C) alone: n rows, as many columns as R. A word is lengthened until its norm is below 1; proven when all
// are, refuted when a short word has a spectral radius of 1 or more.
Contractivity contractivity_of(const Shape& shape, const Eigen::Ref<const RowMatrix>& maps);

}  // namespace ifsm::core
