// Ceres' Levenberg-Marquardt on an objective of R. "Modified": barycentric by elimination, rows compressed before Ceres
// sees them, steps out of the contractive or the well-conditioned region refused (the start must lie in it, but for
// contraction, which is asked for when the start has it).
#pragma once

#include <functional>

#include "base/cancel.h"
#include "fit/objective.h"
#include "fit/parameters.h"

namespace ifsm::core {

struct MinimiseOptions {
  int iterations = 40;
  double tolerance = 1e-6;                            // relative fall of the objective at which it stops
  double condition = 1e3;                             // of R, at most
  const char* stage = "";                             // told to the watch
  std::function<bool(const RowMatrix&)> admits = {};  // what else a step must hold to
  Part part = Part::all;                              // what moves: the objective's parameters
};

struct Minimised {
  RowMatrix matrix;
  double start_value;
  double value;  // never above start_value
  int iterations;
  bool converged;  // false: all iterations were used
};

Minimised minimise(const Shape& shape, Objective& objective, const RowMatrix& start, const MinimiseOptions& options,
                   Watch watch);

}  // namespace ifsm::core
