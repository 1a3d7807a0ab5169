// The sparse objective: Σ over details and scales ε of log(1 + |δ|² g² / ε²), which is small when few details are
// large. Its Jacobian is analytic.
#pragma once

#include <vector>

#include "base/cancel.h"
#include "fit/objective.h"
#include "fit/parameters.h"

namespace ifsm::core {

// One curve of the objective: its finest line (joined), and the scales ε, one a budget, in the samples' units.
struct SparseCurve {
  const Points* line;
  int levels;
  std::vector<double> scales;
};

class Sparsity : public Objective {
 public:
  Sparsity(const Shape& shape, std::vector<SparseCurve> curves, const Watch& watch);

  double value(const RowMatrix& matrix) override;
  void gather(const RowMatrix& matrix, Normal& normal) override;
  // The rows themselves.
  void rows(const RowMatrix& matrix, RowSink& sink) const;

 private:
  double value_of(const SparseCurve& curve, const RowMatrix& matrix, const RowMatrix& inverse) const;
  void gather_curve(const SparseCurve& curve, const RowMatrix& matrix, const RowMatrix& inverse, RowSink& sink) const;
  void subtract_own_tangent(const Eigen::MatrixXd& values, const RowMatrix& inverse, const std::vector<int>& out,
                            Lanes& tangent) const;

  Shape shape_;
  std::vector<SparseCurve> curves_;
  const Watch& watch_;
  std::vector<FreeEntry> entries_;
};

// g of every level (levels × details a node) and its derivative along every parameter.
struct GainTangents {
  std::vector<Eigen::VectorXd> gain;
  std::vector<Lanes> tangent;  // details a node × parameters, a level each
};
GainTangents gain_tangents(const Shape& shape, int levels, const RowMatrix& matrix,
                           const std::vector<FreeEntry>& entries);

}  // namespace ifsm::core
