// Stage *sparse*: the filter under which few details tell a curve.
#pragma once

#include <vector>

#include "base/cancel.h"
#include "curve/model.h"
#include "fit/curve.h"

namespace ifsm::core {

struct FitOptions {
  FilterPtr start;             // joined; null: default_filter of the shape below
  int control_points = 5;      // 0: chosen among 2 … 6
  int maps = 2;                // 0: chosen among 2 … 4
  std::vector<Index> budgets;  // vectors of a sketch, control points and details; empty: 128, or all of smaller curves
  int iterations = 40;         // of each round
  int sparse_rounds = 2;
  int polish_rounds = 8;  // 0: none
};

enum class FitReason : std::int32_t { converged = 0, iterations = 1, start_best = 2 };

// The nearest sketch found, and how near it is to the samples.
struct Sketch {
  ModelPtr model;
  double rms;
  double max;
};

struct FitBudget {
  Index budget;
  Index details;
  Sketch start;
  Sketch fitted;
};

struct FitResult {
  FilterPtr filter;
  std::vector<ModelPtr> models;                 // exact, a curve each
  std::vector<std::vector<FitBudget>> budgets;  // [curve][budget]; fitted never worse than start
  FitReason reason = FitReason::converged;
  int iterations = 0;
  double start_cost = 0;  // the sparsity objective of the last round, of its start and of its end
  double final_cost = 0;
  double start_condition = 0;
  double final_condition = 0;
};

// Fits one filter to curves of one dimension. Deterministic.
FitResult fit_sparse(const std::vector<FitCurve>& curves, const FitOptions& options, Watch& watch);

}  // namespace ifsm::core
