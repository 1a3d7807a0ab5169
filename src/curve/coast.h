// The filter `coast`: trained on coastlines of Natural Earth 1:10m (scripts/train-coast).
#pragma once

#include <cstdint>
#include <vector>

namespace ifsm::core {

// R of a joined shape: rows × rows entries, times 2^20.
struct Trained {
  static constexpr double unit = 0x1p-20;
  int control_points;
  int maps;
  std::vector<std::int32_t> entries;
};

// The first is the one that a name alone chooses.
const std::vector<Trained>& coast_filters();

}  // namespace ifsm::core
