// Curves that the tests of the nouns share.
#pragma once

#include <ifsm.h>

#include <cmath>
#include <cstdint>
#include <vector>

// A wavy line with a kink: count points of the plane, interleaved.
inline std::vector<double> wavy(int count) {
  std::vector<double> points;
  for (int k = 0; k < count; ++k) {
    const double t = static_cast<double>(k) / (count - 1);
    points.push_back(10 * t);
    points.push_back(std::sin(9 * t) + (t > 0.5 ? t : 1 - t));
  }
  return points;
}

inline ifsm_curve curve_of(const std::vector<double>& points, int32_t dimension = 2, int32_t closed = 0) {
  return {points.data(), static_cast<int64_t>(points.size()) / dimension, dimension, closed};
}
