// Synthesis without details.
#pragma once

#include "curve/shape.h"
#include "curve/tree_solver.h"

namespace ifsm::core {

// The line of level `to` that a line of level `from` becomes under C, a value a row.
Lanes refined(const Shape& shape, const RowMatrix& matrix, const Lanes& coarse, int from, int to);

}  // namespace ifsm::core
