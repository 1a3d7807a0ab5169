// How a tree is cut for the threads: into the subtrees of one level, of a few thousand places each, in groups that
// each sum into a place of their own. Depends on the tree alone, so that sums have the same bits on any number of
// threads; a small tree is one block, summed as it stands.
#pragma once

#include <algorithm>

#include "curve/shape.h"

namespace ifsm::core {

class Blocks {
 public:
  // Their roots lie on level `least` or below it.
  Blocks(const Shape& shape, int levels, int least = 0) : level_(levels) {
    while (level_ > least && shape.polygon_step() * shape.nodes(levels - level_ + 1) <= most_places) --level_;
    count_ = shape.nodes(level_);
  }

  int level() const { return level_; }  // of the blocks' roots
  Index count() const { return count_; }
  // Every group holds an outer product of parameters: few are enough for the threads.
  Index groups() const { return std::min(count_, most_groups); }
  // Group g's blocks are first(g) … first(g + 1) - 1.
  Index first(Index group) const { return count_ * group / groups(); }

 private:
  static constexpr Index most_places = 1 << 12;  // what its tangents take stays in the cache
  static constexpr Index most_groups = 16;

  int level_;
  Index count_;
};

}  // namespace ifsm::core
