// The sparse objective: Σ over details and scales ε of log(1 + |δ|² g² / ε²), which is small when few details are
// large. Its Jacobian is analytic.
#pragma once

#include <functional>
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
  struct Part;
  struct Climb;
  // Of one stage of a climb: calls work(group, take) for each of so many groups, in turn or at once; work hands each
  // of the group's parts to take.
  using Take = std::function<void(Part& part)>;
  using Work = std::function<void(Index group, const Take& take)>;
  using Stage = std::function<void(Index groups, const Work& work)>;

  void climb(const SparseCurve& curve, Index tangents, const Stage& stage) const;
  double value_of(const SparseCurve& curve, const RowMatrix& matrix, const RowMatrix& inverse) const;
  double value_of(const Climb& climb, Part& part) const;
  Climb climb_of(const SparseCurve& curve, const RowMatrix& matrix, const RowMatrix& inverse) const;
  void gather(const SparseCurve& curve, const RowMatrix& matrix, const RowMatrix& inverse, Normal& normal) const;
  void gather(const Climb& climb, Part& part, RowSink& sink) const;
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
