// Counts the boxes of a grid that a polyline touches, in whole numbers.
#pragma once

#include <vector>

#include "measure/polyline.h"

namespace ifsm::core {

// A polyline in two or three dimensions, its coordinates whole numbers of a lattice of 2^30 steps across the bounding
// box's longest side, from the box's lowest corner.
class Lattice {
 public:
  static constexpr Index steps = Index{1} << 30;
  static constexpr Index smallest_side = Index{1} << 10;  // so that three box indices fit into 63 bits

  explicit Lattice(const Polyline& polyline);  // which is not a point

  double step() const { return step_; }  // in units of the polyline
  Index side_of(double scale) const;     // the nearest whole number of steps, from smallest_side on
  Index visits_at_most(Index side) const;

  // How many half-open boxes [k side, (k + 1) side) the closed segments touch.
  Index count(Index side) const;

 private:
  Index dimension_;
  Index count_;
  Index segments_;
  double step_;
  std::vector<Index> values_;  // point by point
};

}  // namespace ifsm::core
