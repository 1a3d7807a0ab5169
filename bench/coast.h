// Curves for the programs that measure: the points of a table, and the same number of them for every curve.
#pragma once

#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

inline std::vector<double> read_points(const std::string& path) {
  std::ifstream file(path);
  std::vector<double> points;
  std::string row;
  for (double x = 0, y = 0; std::getline(file, row);)
    if (std::sscanf(row.c_str(), "%lf,%lf", &x, &y) == 2) points.insert(points.end(), {x, y});
  return points;
}

inline std::vector<double> resampled(const std::vector<double>& points, int count) {
  const std::size_t given = points.size() / 2;
  std::vector<double> along(given, 0.0), result;
  for (std::size_t i = 1; i < given; ++i)
    along[i] = along[i - 1] + std::hypot(points[2 * i] - points[2 * i - 2], points[2 * i + 1] - points[2 * i - 1]);
  std::size_t i = 0;
  for (int k = 0; k < count; ++k) {
    const double at = along.back() * k / (count - 1);
    while (i + 2 < given && along[i + 1] < at) ++i;
    const double t = (at - along[i]) / (along[i + 1] - along[i]);
    for (std::size_t axis = 0; axis < 2; ++axis)
      result.push_back((1 - t) * points[2 * i + axis] + t * points[2 * i + 2 + axis]);
  }
  return result;
}
