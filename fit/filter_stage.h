// Stage *filter*: with T as it is, the U whose first levels of details tell the samples best (paper 002, section 4,
// step 2).
#pragma once

#include <vector>

#include "base/cancel.h"
#include "fit/fit.h"

namespace ifsm::core {

struct FilterOptions {
  FilterPtr start;  // joined; null: de Casteljau's of the shape below
  int control_points = 5;
  int maps = 2;
  int kept_levels = 3;  // whose details count; a curve of no more levels is told exactly whatever U is
  int iterations = 40;
  double tolerance = 1e-9;
};

// Never above its start by the objective: the sum of squared distances at the samples.
FitResult fit_filter(const std::vector<FitCurve>& curves, const FilterOptions& options, Watch& watch);

}  // namespace ifsm::core
