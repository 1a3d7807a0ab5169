// What a model file says, as it says it: keys, types and finite numbers are checked, what they mean is not yet.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/format.h"

namespace ifsm::core {

struct FilterEntry {
  std::string topology;
  Index control_points = 0;
  Index maps = 0;
  Index stride = 0;
  std::vector<double> matrix;
};

// Details of one level: all, or those at some indices; an absent array is an empty one.
struct LevelEntry {
  std::vector<double> dense;
  std::vector<Index> at;
  std::vector<double> vectors;
};

struct Document {
  std::string format;
  Index version = 0;
  Index dimension = 0;
  bool closed = false;
  Index samples = 0;
  Index levels = 0;
  FilterEntry filter;
  std::vector<double> center;
  double diagonal = 0;
  double largest_polygon = 0;
  std::vector<double> control_points;
  std::vector<LevelEntry> details;
};

// Errors: format, version, limit, not finite; they name the entry ("details[3].at[17]") or the byte ("bytes").
// Memory: at most 24 bytes a byte of the file.
Document read_document(std::span<const std::uint8_t> bytes);

}  // namespace ifsm::core
