// The curve without details at parameters, and how it moves with C: x(t) = Pᵀ b(t; C), b = T_θ1 … T_θL e_c between
// neighbouring places. One way down the tree, depth first: prefix products are shared, and no more than a path of them
// is held at a time.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "base/cancel.h"
#include "fit/normal.h"
#include "fit/parameters.h"

namespace ifsm::core {

// On the finest line, between place `leg` and the next one.
struct Position {
  Index leg;
  double fraction;
};

// Parameters 0 … 1, from the first place to the last (closed: back to the first).
std::vector<Position> positions_of(const Shape& shape, int levels, std::span<const double> parameters);

class CurveWalk {
 public:
  CurveWalk(const Shape& shape, int levels, const RowMatrix& matrix, const Watch& watch);

  // take(k, basis): x at position k is control^T basis, n numbers. Positions must not fall.
  using TakeBasis = std::function<void(Index k, const double* basis)>;
  void basis(std::span<const Position> positions, const TakeBasis& take);

  // take(k, basis, tangent): and dx by every parameter of C (Part::maps), coordinate by coordinate, at these control
  // points (n × dimension).
  using TakeTangent = std::function<void(Index k, const double* basis, const double* tangent)>;
  void tangents(std::span<const Position> positions, const Lanes& control, const TakeTangent& take);

 private:
  struct Buffers {
    Lanes basis, tangent;
  };

  void start(std::span<const Position> positions, Index lanes);
  void visit(int level, Index node, Index first, Index last, const Eigen::Ref<const Lanes>& basis,
             const Eigen::Ref<const Lanes>& tangent);
  void add_own_tangent(const Eigen::Ref<const Lanes>& basis, Lanes& tangent) const;
  void hand_out(Index node, Index first, Index last, const Eigen::Ref<const Lanes>& basis,
                const Eigen::Ref<const Lanes>& tangent);

  Shape shape_;
  int levels_;
  Eigen::MatrixXd maps_;  // C transposed
  const Watch& watch_;
  std::vector<FreeEntry> entries_;
  std::span<const Position> positions_;
  const Lanes* control_ = nullptr;
  TakeTangent take_;
  std::vector<Buffers> buffers_;  // a level each
  Eigen::RowVectorXd basis_, tangent_;
};

}  // namespace ifsm::core
