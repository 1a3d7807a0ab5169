// Handles: the points of a level, which edits take hold of. Joined polygons of a level share their end points, square
// ones of a stride below n any: a handle may have several seats.
#pragma once

#include <vector>

#include "curve/shape.h"

namespace ifsm::core {

// Point `point` of the polygon of node `node`.
struct Seat {
  Index node;
  int point;

  friend bool operator==(const Seat&, const Seat&) = default;
};

// A level's handles, in order along the curve; a ring's last one is followed by its first.
class Handles {
 public:
  Handles(const Shape& shape, bool closed, int level);

  Index count() const { return count_; }

  // The seats of a handle, by node.
  std::vector<Seat> seats(Index handle) const;
  // The finest node above `level` that holds all of them.
  struct Holder {
    int level;
    Index node;
  };
  Holder holder(Index handle) const;
  // The handle that a point of a polygon is.
  Index handle(const Seat& seat) const;

  // The handles of the polygons of nodes first … last (both included) begin here, and are so many.
  struct Run {
    Index first, count;
  };
  Run held_by(Index first, Index last) const;

 private:
  int level_;
  int maps_;
  int points_;  // n
  Index step_;  // from a polygon to the next one, in handles
  Index nodes_;
  Index count_;
};

}  // namespace ifsm::core
