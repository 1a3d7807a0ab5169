// The free entries of a joined R: the interior columns of C, one entry of each column being 1 minus the others (so
// that T stays barycentric), and the interior columns of U. A stage moves all of them, or one part.
#pragma once

#include <vector>

#include "curve/filter.h"

namespace ifsm::core {

enum class Part { all, maps, details };  // R, C, U

// Parameter p is R(row, column); `opposite` is the row of C that takes the negative, -1 in U.
struct FreeEntry {
  int row;
  int column;
  int opposite;
};

// Ordered by column: the entries of a column are neighbours.
std::vector<FreeEntry> free_entries(const Shape& shape, Part part = Part::all);

// A joined shape's number of them: rows - 2 columns, each with one entry less in C.
inline int free_count(const Shape& shape, Part part = Part::all) {
  const int maps = shape.control_points() - 1, details = shape.details_per_node();
  return (shape.rows() - 2) * (part == Part::all ? maps + details : part == Part::maps ? maps : details);
}

Eigen::VectorXd parameters_of(const Shape& shape, const RowMatrix& matrix, Part part = Part::all);
RowMatrix matrix_of(const Shape& shape, const double* parameters);

// R with one part from parameters. Details: C stays as it is in `base`. Maps: U is the canonical complement of the new
// C; R is not finite when there is none.
RowMatrix matrix_of(const Shape& shape, const double* parameters, Part part, const RowMatrix& base);

}  // namespace ifsm::core
