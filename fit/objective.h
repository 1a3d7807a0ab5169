// What is minimised over R.
#pragma once

#include "curve/filter.h"
#include "fit/normal.h"

namespace ifsm::core {

class Objective {
 public:
  virtual ~Objective() = default;
  virtual double value(const RowMatrix& matrix) = 0;
  // Adds (J | r)ᵀ(J | r) with rᵀr = value(matrix), J by the part of R that the objective is about (fit/parameters.h).
  virtual void gather(const RowMatrix& matrix, Normal& normal) = 0;
};

}  // namespace ifsm::core
