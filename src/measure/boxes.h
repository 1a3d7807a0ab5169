// Bounding boxes over runs of neighbouring segments: a binary tree without pointers. A curve's neighbours in order are
// neighbours in space, so nothing is sorted.
#pragma once

#include <algorithm>
#include <vector>

#include "measure/polyline.h"

namespace ifsm::core {

class Boxes {
 public:
  explicit Boxes(const Polyline& polyline);  // which has a segment

  // Level 0 has a box for each run of segments, the highest level one for all; node q has the children 2q, 2q + 1.
  int levels() const { return static_cast<int>(levels_.size()); }
  Index nodes(int level) const {
    return static_cast<Index>(levels_[static_cast<std::size_t>(level)].size()) / (2 * dimension_);
  }
  // Corners: smallest coordinates, then largest ones.
  const double* low(int level, Index node) const {
    return levels_[static_cast<std::size_t>(level)].data() + 2 * dimension_ * node;
  }
  const double* high(int level, Index node) const { return low(level, node) + dimension_; }

  Index first_segment(Index leaf) const { return leaf * run; }
  Index end_segment(Index leaf) const { return std::min((leaf + 1) * run, segments_); }

 private:
  static constexpr Index run = 8;  // segments a leaf: measured, 4 to 16 are as good

  Index dimension_;
  Index segments_;
  std::vector<std::vector<double>> levels_;
};

}  // namespace ifsm::core
