// What the fits' exported functions have in common: curves, counts with defaults, progress.
#pragma once

#include <ifsm.h>

#include <vector>

#include "base/cancel.h"
#include "fit/curve.h"

namespace ifsm::core {

std::vector<FitCurve> curves_of(const ifsm_curve* curves, std::int64_t count);

std::vector<Index> budgets_of(const std::int64_t* budgets, std::int64_t count);

// A count whose zero means a default.
int count_or(std::int32_t value, std::int32_t most, int otherwise, const char* argument);
// A count whose zero means a default and whose -1 means none, or "choose one": the core's zero.
int count_or_none(std::int32_t value, std::int32_t most, int otherwise, const char* argument);

Watch::Progress progress_of(ifsm_progress_callback progress, void* user);

}  // namespace ifsm::core
