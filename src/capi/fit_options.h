// What the options of all stages of the fit have in common.
#pragma once

#include <ifsm.h>

#include <string>
#include <vector>

#include "capi/arguments.h"
#include "capi/curves.h"
#include "capi/options.h"
#include "fit/fit.h"

namespace ifsm::core {

inline constexpr std::int64_t most_curves = std::int64_t{1} << 20;

inline std::vector<FitCurve> curves_of(const ifsm_curve* curves, std::int64_t count) {
  in_range(count, 1, most_curves, "curve_count");
  required(curves, "curves");
  std::vector<FitCurve> copies;
  for (std::int64_t c = 0; c < count; ++c) {
    const std::string prefix = "curves[" + std::to_string(c) + "].";
    copies.push_back({samples_of(curves[c], prefix), is_closed(curves[c], prefix)});
  }
  return copies;
}

inline std::vector<Index> budgets_of(const std::int64_t* budgets, std::int64_t count) {
  constexpr std::int64_t most_budgets = 64;
  in_range(count, 0, most_budgets, "budget_count");
  const auto given = input(budgets, count, "budgets", "budget_count");
  return {given.begin(), given.end()};
}

// A line to the log.
void log_summary(const char* function, const FitResult& fit);

}  // namespace ifsm::core
