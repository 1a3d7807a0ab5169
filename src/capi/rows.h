// Answers that are rows of numbers.
#pragma once

#include <cstdint>
#include <vector>

#include "capi/arguments.h"
#include "measure/crossings.h"

namespace ifsm::core {

inline std::vector<double> rows_of(const std::vector<Crossing>& crossings) {
  std::vector<double> rows;
  rows.reserve(crossings.size() * 6);
  for (const Crossing& c : crossings)
    rows.insert(rows.end(), {c.first_p, c.first_q, c.last_p, c.last_q, c.point[0], c.point[1]});
  return rows;
}

// Two columns side by side.
inline std::vector<double> rows_of(const std::vector<double>& left, const std::vector<double>& right) {
  std::vector<double> rows;
  rows.reserve(2 * left.size());
  for (std::size_t i = 0; i < left.size(); ++i) rows.insert(rows.end(), {left[i], right[i]});
  return rows;
}

inline void deliver_rows(const std::vector<double>& rows, const Output<double>& to, std::int64_t& count) {
  deliver(
      static_cast<std::int64_t>(rows.size()), to, count, [&]() -> const auto& { return rows; });
}

}  // namespace ifsm::core
