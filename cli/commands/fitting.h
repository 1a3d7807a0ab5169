// What `ifsm fit` computes: a model of each curve.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <ifsm.hpp>

#include "curves.h"
#include "interrupt.h"

namespace cli {

struct FitSettings {
  std::string stage = "sparse";
  std::optional<int> levels;  // of stage filter
  std::vector<std::int64_t> budgets;
  std::string control_points;  // a number, "auto", or empty for the default; so is `maps`
  std::string maps;
  std::string filter;
  int iterations = 0;  // 0: the library's default, here and below
  std::optional<int> rounds;
  std::optional<int> polish;
  int threads = 0;
  bool no_fit = false;
  double within = 0;     // 0: not asked for
  std::string distance;  // empty: RMS
  bool sketch = false;   // models are the sketches of the largest budget
};

struct FittedModel {
  ifsm::Model model;                    // as it is written
  std::optional<ifsm_distances> apart;  // of a sketch from its exact model
  std::optional<ifsm::Fit> fit;         // none with no_fit
};

// One for each curve, each fitted alone; of several curves, those that are too small for a budget go without it.
// `source` names the file in errors. Throws Failure, ifsm::Error, ifsm::Cancelled.
std::vector<FittedModel> fitted_models(const std::vector<Samples>& curves, const FitSettings& settings,
                                       const std::string& source, bool quiet, Interrupt& interrupt);

}  // namespace cli
