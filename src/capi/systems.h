// Maps and points of systems, as C tells them: maps row by row (M | t), points of d doubles.
#pragma once

#include <vector>

#include "linalg/affine.h"

namespace ifsm::core {

inline Affine map_from(const double* rows, int dimension) {
  Affine map;
  for (int row = 0; row < dimension; ++row) {
    for (int column = 0; column < dimension; ++column) map.linear(row, column) = *rows++;
    map.shift(row) = *rows++;
  }
  return map;
}

inline void append_rows(const Affine& map, int dimension, std::vector<double>& rows) {
  for (int row = 0; row < dimension; ++row) {
    for (int column = 0; column < dimension; ++column) rows.push_back(map.linear(row, column));
    rows.push_back(map.shift(row));
  }
}

inline void append_point(const Vector3& point, int dimension, std::vector<double>& values) {
  values.insert(values.end(), point.data(), point.data() + dimension);
}

}  // namespace ifsm::core
