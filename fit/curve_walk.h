// The curve without details at parameters, and how it moves with C: x(t) = Pᵀ b(t; C), b = T_θ1 … T_θL e_c between
// neighbouring places. One way down the tree, depth first: prefix products are shared, and no more than a path of them
// is held at a time.
#pragma once

#include <algorithm>
#include <functional>
#include <span>
#include <vector>

#include "base/cancel.h"
#include "curve/kernel.h"
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

// Samples that follow each other, in groups which share the threads and sum on their own: so many, whatever the number
// of threads.
class SampleGroups {
 public:
  explicit SampleGroups(std::span<const Position> positions)
      : positions_(positions),
        count_(std::clamp<Index>(static_cast<Index>(positions.size()) / fewest_together, 1, most_groups)) {}

  Index count() const { return count_; }
  Index first(Index group) const { return static_cast<Index>(positions_.size()) * group / count_; }
  std::span<const Position> positions(Index group) const {
    return positions_.subspan(static_cast<std::size_t>(first(group)),
                              static_cast<std::size_t>(first(group + 1) - first(group)));
  }

 private:
  static constexpr Index fewest_together = 1 << 13;  // samples
  static constexpr Index most_groups = 16;           // each holds an outer product of parameters

  std::span<const Position> positions_;
  Index count_;
};

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
  // Polygons of a node, a lane each: first the basis (a lane a control point), then its tangents. A lane's points lie
  // side by side, `step` from the next lane's.
  struct Lines {
    const double* data;
    Index step;
  };

  void start(std::span<const Position> positions, Index tangents);
  void visit(int level, Index node, Index first, Index last, const Lines& lines);
  void add_own_tangent(const Lines& lines, double* fine);
  void hand_out(Index node, Index first, Index last, const Lines& lines);

  Shape shape_;
  int levels_;
  kernel::Product maps_;  // by C
  const Watch& watch_;
  std::vector<FreeEntry> entries_;
  std::span<const Position> positions_;
  const Lanes* control_ = nullptr;
  TakeTangent take_;
  std::vector<std::vector<double>> buffers_;  // a level each: lanes × rows
  std::vector<double> point_;                 // a lane each
  std::vector<double> polygon_;               // of one coordinate
};

}  // namespace ifsm::core
