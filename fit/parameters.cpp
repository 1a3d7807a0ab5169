#include "fit/parameters.h"

namespace ifsm::core {
namespace {

// The row that is eliminated from column c of C: the control point nearest to it, which is the largest entry of a
// subdivision.
int eliminated_row(const Shape& shape, int column) {
  const int last = shape.rows() - 1;
  return (2 * column * (shape.control_points() - 1) + last) / (2 * last);
}

}  // namespace

std::vector<FreeEntry> free_entries(const Shape& shape) {
  std::vector<FreeEntry> entries;
  for (int column = 1; column + 1 < shape.rows(); ++column) {
    const int opposite = eliminated_row(shape, column);
    for (int row = 0; row < shape.rows(); ++row) {
      if (row >= shape.control_points())
        entries.push_back({row, column, -1});
      else if (row != opposite)
        entries.push_back({row, column, opposite});
    }
  }
  return entries;
}

Eigen::VectorXd parameters_of(const Shape& shape, const RowMatrix& matrix) {
  const auto entries = free_entries(shape);
  Eigen::VectorXd parameters(static_cast<Index>(entries.size()));
  for (std::size_t p = 0; p < entries.size(); ++p)
    parameters(static_cast<Index>(p)) = matrix(entries[p].row, entries[p].column);
  return parameters;
}

RowMatrix matrix_of(const Shape& shape, const double* parameters) {
  const int rows = shape.rows();
  RowMatrix matrix = RowMatrix::Zero(rows, rows);
  matrix(0, 0) = matrix(shape.control_points() - 1, rows - 1) = 1;
  for (const FreeEntry& entry : free_entries(shape)) matrix(entry.row, entry.column) = *parameters++;
  for (int column = 1; column + 1 < rows; ++column) {
    const int row = eliminated_row(shape, column);
    matrix(row, column) = 0;
    matrix(row, column) = 1 - matrix.col(column).head(shape.control_points()).sum();
  }
  return matrix;
}

}  // namespace ifsm::core
