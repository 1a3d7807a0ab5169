// The box-counting dimension of an attractor, estimated: how many cubes of a grid it meets, at sides that halve.
#pragma once

#include <vector>

#include "base/cancel.h"
#include "linalg/trend.h"
#include "system/system.h"

namespace ifsm::core {

struct BoxCounts {
  std::vector<double> sides;   // growing smaller, in the attractor's units
  std::vector<double> counts;  // cubes that it meets
  Trend line;                  // of log count over log side; its slope is minus the dimension
};

// Grids of 2, 4, … 2^finest cells a side of the smallest cube that holds the attractor with its lowest corner; the line
// is fitted to those of 16 cells and more. finest: 6 … 13 in the plane, 6 … 9 in space (range). A cube counts when a
// piece lies in it, or when a point is found in it of one that lies across its side and is smaller than an eighth of
// it: a piece that comes nearer than that to a cube without such a point is not seen. Slopes over so few scales are
// some hundredths off, more where a shape that fills the plane has a rough edge (dragons: .1) or where grid and shape
// beat (Cantor dust: .1). A shape error when the attractor is a point.
BoxCounts count_boxes(const System& system, int finest, Watch& watch);

}  // namespace ifsm::core
