// Stage *sparse*: the filter under which few details tell a curve.
#pragma once

#include <vector>

#include "base/cancel.h"
#include "fit/fit.h"

namespace ifsm::core {

inline constexpr int by_default = -1;

struct FitOptions {
  FilterPtr start;                 // joined; null: default_filter of the shape below
  int control_points = 5;          // 0: chosen among 2 … 6
  int maps = 2;                    // 0: chosen among 2 … 4
  std::vector<Index> budgets;      // vectors of a sketch, control points and details; empty: 128, or a quarter of the
                                   // samples of smaller curves
  int iterations = 40;             // of each round
  int sparse_rounds = by_default;  // 0: none; by default 2, or none from `coast` to budgets of 128 and more
  int polish_rounds = 8;           // 0: none
};

// Fits one filter to curves of one dimension. Deterministic.
FitResult fit_sparse(const std::vector<FitCurve>& curves, const FitOptions& options, Watch& watch);

}  // namespace ifsm::core
