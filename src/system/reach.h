// How far an attractor reaches: into a direction, so its box; from a point; and across.
#pragma once

#include "system/system.h"

namespace ifsm::core {

struct Box {
  Vector3 low, high;

  friend bool operator==(const Box& a, const Box& b) { return a.low == b.low && a.high == b.high; }
};

struct Ball {
  Vector3 centre;
  double radius;
};

// All results lie above the exact value and pass it by at most `tolerance`, in the attractor's units; rounding
// included. A range error when the tolerance is not above 2^-44 of the attractor's size (of the origin alone, which has
// none, 0 will do), a limit error when it takes too many pieces.

// The largest direction·x of the attractor's points, for a unit vector.
double reach(const System& system, const Vector3& direction, double tolerance);

// Each side is passed by at most the tolerance; flat attractors have a box of that thickness.
Box bounding_box(const System& system, double tolerance);

// The distance of the farthest of its points.
double farthest(const System& system, const Vector3& from, double tolerance);

// The distance of its two points that are farthest from each other.
double diameter(const System& system, double tolerance);

// Holds the attractor, and so do balls of the same centre that are smaller by no more than the tolerance. The radius is
// above that of the smallest ball by a hundredth of it at most: measured, not proven.
Ball enclosing_ball(const System& system, double tolerance);

}  // namespace ifsm::core
