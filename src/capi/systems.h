// Maps and points of systems, as C tells them: maps row by row (M | t), points of d doubles.
#pragma once

#include <vector>

#include "linalg/affine.h"

namespace ifsm::core {

Affine map_from(const double* rows, int dimension);
void append_rows(const Affine& map, int dimension, std::vector<double>& rows);

inline void append_point(const Vector3& point, int dimension, std::vector<double>& values) {
  values.insert(values.end(), point.data(), point.data() + dimension);
}

}  // namespace ifsm::core
