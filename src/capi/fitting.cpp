#include "capi/fitting.h"

#include <string>

#include "capi/arguments.h"
#include "capi/curves.h"

namespace ifsm::core {
namespace {

constexpr std::int64_t most_curves = std::int64_t{1} << 20;
constexpr std::int64_t most_budgets = 64;
constexpr std::int32_t chosen = -1;  // in C's options; the core says 0

}  // namespace

std::vector<FitCurve> curves_of(const ifsm_curve* curves, std::int64_t count) {
  in_range(count, 1, most_curves, "curve_count");
  required(curves, "curves");
  std::vector<FitCurve> copies;
  for (std::int64_t c = 0; c < count; ++c) {
    const std::string prefix = "curves[" + std::to_string(c) + "].";
    copies.push_back({samples_of(curves[c], prefix), is_closed(curves[c], prefix)});
  }
  return copies;
}

std::vector<Index> budgets_of(const std::int64_t* budgets, std::int64_t count) {
  in_range(count, 0, most_budgets, "budget_count");
  const auto given = input(budgets, count, "budgets", "budget_count");
  return {given.begin(), given.end()};
}

int count_or(std::int32_t value, std::int32_t most, int otherwise, const char* argument) {
  in_range(value, 0, most, argument);
  return value == 0 ? otherwise : value;
}

int count_or_none(std::int32_t value, std::int32_t most, int otherwise, const char* argument) {
  in_range(value, chosen, most, argument);
  return value == 0 ? otherwise : value == chosen ? 0 : value;
}

Watch::Progress progress_of(ifsm_progress_callback progress, void* user) {
  if (progress == nullptr) return nullptr;
  return [progress, user](double fraction, const char* stage) { return progress(user, fraction, stage) != 0; };
}

}  // namespace ifsm::core
