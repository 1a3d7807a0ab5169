// What every stage of the fit takes and gives.
#pragma once

#include <vector>

#include "curve/model.h"
#include "fit/curve.h"

namespace ifsm::core {

struct Certainty;

enum class Stage : std::int32_t { sparse = 0, curve = 1, filter = 2 };

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
  Stage stage = Stage::sparse;
  FilterPtr filter;
  std::vector<ModelPtr> models;                 // exact, a curve each
  std::vector<std::vector<FitBudget>> budgets;  // [curve][budget]; fitted never worse than start
  FitReason reason = FitReason::converged;
  int iterations = 0;
  double start_cost = 0;  // of the stage's objective; sparse: of the last round
  double final_cost = 0;
  double start_condition = 0;
  double final_condition = 0;
  std::vector<std::vector<double>> parameters;  // stage curve: where each sample was fitted
  std::shared_ptr<const Certainty> certainty;   // stages curve and filter
};

// A range error when there is no curve, a shape error when dimensions differ.
void require_curves(const std::vector<FitCurve>& curves);

// A range error unless it is above zero.
void require_tolerance(double tolerance);

// The start, when a fit can take it: joined, and not too many free entries.
FilterPtr require_start(FilterPtr start);

}  // namespace ifsm::core
