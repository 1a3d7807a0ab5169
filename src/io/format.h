// What both sides of the model format agree on: docs/format.md.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "curve/model.h"

namespace ifsm::core {

enum class Format : std::int32_t { json = 0, cbor = 1 };

constexpr std::string_view format_name = "ifsm-model";
constexpr Index format_version = 1;

constexpr std::string_view topology_name(Topology topology) {
  return topology == Topology::joined ? "joined" : "square";
}

// Doubles of a model in memory: its control points, and a vector for every detail, zero or not.
inline Index tree_doubles(const Shape& shape, Index dimension, int levels) {
  Index vectors = shape.control_points();
  for (int level = 0; level < levels; ++level) vectors += shape.detail_count(level);
  return checked_product(vectors, dimension, "levels");
}

// Zeros are not stored, so a short file may ask for a deep tree. What one may ask for: as many doubles as the file has
// bytes, and 2^26 (512 MiB; 33 million points of the plane) in any case.
inline Index most_tree_doubles(std::size_t bytes) { return std::max(Index{1} << 26, static_cast<Index>(bytes)); }

}  // namespace ifsm::core
