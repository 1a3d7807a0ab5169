// Training: one filter from a family of curves, to be chosen by name as a wavelet is. What is minimised is the error of
// the curves' solved sketches, relatively, all curves and budgets alike.
#pragma once

#include <vector>

#include "base/cancel.h"
#include "curve/model.h"
#include "fit/curve.h"
#include "fit/sketchbook.h"

namespace ifsm::core {

struct TrainOptions {
  FilterPtr start;             // joined
  std::vector<Index> budgets;  // vectors of a sketch; each curve takes those that it holds. Empty: 16, 32, … up to an
                               // eighth of its samples
  int hold_out = 0;            // every so-manyth curve is kept out of the training and judged at the end; 0: none
  int iterations = 10;         // of a round: the choice of details changes after them
  int rounds = 12;
  Limits limits{30, 3};  // narrower than those of a fit: many will edit what the filter makes of their curves
};

enum class TrainReason : std::int32_t { converged = 0, rounds = 1, start_best = 2 };

struct TrainResult {
  FilterPtr filter;
  TrainReason reason = TrainReason::converged;
  Index trained = 0;   // curves
  Index held_out = 0;  // curves
  Index sketches = 0;  // trained on
  int rounds = 0;
  int iterations = 0;
  double ratio = 1;           // geometric mean of the sketches' RMS, trained over start: at most 1
  double held_out_ratio = 1;  // of the curves held out; NaN when there are none
};

// Deterministic, whatever the number of threads. Never worse than its start over the curves trained on.
TrainResult train(const std::vector<FitCurve>& given, const TrainOptions& options, Watch& watch);

}  // namespace ifsm::core
