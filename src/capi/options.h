// What options of several calls have in common: counts and numbers whose zero means a default, threads, progress.
#pragma once

#include "base/cancel.h"
#include "base/parallel.h"
#include "capi/arguments.h"

namespace ifsm::core {

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

// A finite number within its range.
double in_between(double value, double low, double high, const char* argument);

// At most so many, for Threads; results never depend on their number.
inline int threads_of(std::int32_t threads) { return static_cast<int>(in_range(threads, 0, 1024, "threads")); }

template <class Options>
Watch::Progress progress_of(const Options& given) {
  if (given.progress == nullptr) return nullptr;
  return [call = given.progress, user = given.user](double fraction, const char* stage) {
    return call(user, fraction, stage) != 0;
  };
}

}  // namespace ifsm::core
