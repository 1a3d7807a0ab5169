// The free entries of a joined R: the interior columns of C, one entry of each column being 1 minus the others (so
// that T stays barycentric), and the interior columns of U.
#pragma once

#include <vector>

#include "curve/filter.h"

namespace ifsm::core {

// Parameter p is R(row, column); `opposite` is the row of C that takes the negative, -1 in U.
struct FreeEntry {
  int row;
  int column;
  int opposite;
};

// Ordered by column: the entries of a column are neighbours.
std::vector<FreeEntry> free_entries(const Shape& shape);

// A joined shape's number of them: (rows - 2)(rows - 1).
inline int free_count(const Shape& shape) { return (shape.rows() - 2) * (shape.rows() - 1); }

Eigen::VectorXd parameters_of(const Shape& shape, const RowMatrix& matrix);
RowMatrix matrix_of(const Shape& shape, const double* parameters);

}  // namespace ifsm::core
