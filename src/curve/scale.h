// Scaling by powers of two, which keeps all bits: least squares squares coordinates, and those of curves far from unit
// size leave the range of doubles.
#pragma once

#include "curve/model.h"

namespace ifsm::core {

// 0 for sizes whose squares, and sums of them, are safe; else the exponent to take away first and to put back after.
int exponent_to_remove(double size);

// Times 2^exponent.
Points scaled(Points points, int exponent);
ModelPtr scaled(const Model& model, int exponent);

}  // namespace ifsm::core
