// Least squares of any number of rows in the memory of a few: rows (J | r) are gathered into their outer product, and
// given to Ceres as parameters + 1 rows that have the same JᵀJ, Jᵀr and rᵀr.
#pragma once

#include <Eigen/Core>

#include "curve/tree_solver.h"

namespace ifsm::core {

// Takes rows one by one.
class RowSink {
 public:
  virtual ~RowSink() = default;
  // Room for the next row: the derivatives, then the residual. Fill it before asking for another.
  virtual double* row() = 0;
};

class Normal : public RowSink {
 public:
  explicit Normal(int parameters);

  int parameters() const { return static_cast<int>(rows_.cols()) - 1; }
  double* row() override;

  struct Rows {
    RowMatrix jacobian;        // parameters + 1 × parameters
    Eigen::VectorXd residual;  // parameters + 1
  };
  // Directions that change nothing (R has a gauge: control polygons and details may change their basis) get zeros, so
  // that no step is made of rounding.
  Rows compressed();

  // (J | r)ᵀ (J | r), lower half.
  const Eigen::MatrixXd& product();

  // Takes another's rows away, or adds them.
  Normal& operator-=(Normal& other);
  Normal& operator+=(Normal& other);
  // Adds rows of which the product is known.
  void add(const Eigen::MatrixXd& product);

 private:
  void flush();

  Eigen::MatrixXd product_;
  Lanes rows_;
  Index used_ = 0;
};

}  // namespace ifsm::core
