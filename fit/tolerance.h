// Stage *sparse* to a tolerance: the filter under which the fewest details bring curves within a bound of their
// samples.
#pragma once

#include <vector>

#include "fit/sparse.h"
#include "measure/distance.h"

namespace ifsm::core {

struct Tolerance {
  double bound;
  Distance distance;
};

// How many details the start needs is found first (no start: default_filter of the shape, which must be told), the
// filter fitted at that many, and the details that it needs found in turn; when they are not fewer, the start is the
// answer. A row of budgets a curve: the sketches within the bound.
FitResult fit_to_tolerance(const std::vector<FitCurve>& curves, const FitOptions& options, const Tolerance& tolerance,
                           Watch& watch);

}  // namespace ifsm::core
