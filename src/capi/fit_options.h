// What the options of all stages of the fit have in common.
#pragma once

#include <ifsm.h>

#include <string>
#include <vector>

#include "base/cancel.h"
#include "base/parallel.h"
#include "capi/arguments.h"
#include "capi/curves.h"
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

// A count whose zero means a default.
inline int count_or(std::int32_t value, std::int32_t most, int otherwise, const char* argument) {
  in_range(value, 0, most, argument);
  return value == 0 ? otherwise : value;
}

// A count whose zero means a default and whose -1 means none, or "choose one".
inline int count_or_none(std::int32_t value, std::int32_t most, int otherwise, const char* argument) {
  in_range(value, -1, most, argument);
  return value == 0 ? otherwise : value == -1 ? 0 : value;
}

// A number that may not be below zero, and whose zero means a default.
double positive_or(double value, double otherwise, const char* argument);

// At most so many, for Threads; results never depend on their number.
inline int threads_of(std::int32_t threads) { return static_cast<int>(in_range(threads, 0, 1024, "threads")); }

inline std::vector<Index> budgets_of(const std::int64_t* budgets, std::int64_t count) {
  constexpr std::int64_t most_budgets = 64;
  in_range(count, 0, most_budgets, "budget_count");
  const auto given = input(budgets, count, "budgets", "budget_count");
  return {given.begin(), given.end()};
}

template <class Options>
Watch::Progress progress_of(const Options& given) {
  if (given.progress == nullptr) return nullptr;
  return [call = given.progress, user = given.user](double fraction, const char* stage) {
    return call(user, fraction, stage) != 0;
  };
}

// A line to the log.
void log_summary(const char* function, const FitResult& fit);

}  // namespace ifsm::core
