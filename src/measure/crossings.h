// Where a plane curve meets itself.
#pragma once

#include <array>
#include <vector>

#include "measure/polyline.h"

namespace ifsm::core {

// A pair of different parameters p, q at which the curve is at the same point, p in an earlier segment than q.
// Overlapping: along a whole piece, from (first_p, first_q) at `point` to (last_p, last_q), last_p > first_p; last_q <
// first_q when the two run against each other. Else first and last are the same.
struct Crossing {
  double first_p, first_q, last_p, last_q;
  std::array<double, 2> point;  // in the samples' units

  friend bool operator==(const Crossing&, const Crossing&) = default;
};

// All of them, by p's segment, then by q's. Whether segments meet is decided exactly, for the polyline's points as they
// are (coordinates below 2^-397 of the largest are first rounded to 2^-450 of it).
//
// Repeated points count once. A segment owns its start and not its end (an open curve's last one owns both), so a curve
// that passes through, or just touches, one of its own points does so once. Neighbouring segments meet in their common
// point, which is no crossing; one that turns back onto the other overlaps it, and is told. An overlap is told for each
// pair of segments, ends included, so the next pair may tell its end again, as a touch.
//
// A tree of boxes over the curve. Errors: not in the plane (shape); more than 2^22 crossings (limit).
std::vector<Crossing> crossings(const Polyline& polyline);

// The same by comparing all pairs: what the tree is tested against.
namespace plain {
std::vector<Crossing> crossings(const Polyline& polyline);
}  // namespace plain

}  // namespace ifsm::core
