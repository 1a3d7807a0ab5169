#include "fit/parameters.h"

#include <limits>

#include "curve/complement.h"

namespace ifsm::core {
namespace {

// The row that is eliminated from column c of C: the control point nearest to it, which is the largest entry of a
// subdivision.
int eliminated_row(const Shape& shape, int column) {
  const int last = shape.rows() - 1;
  return (2 * column * (shape.control_points() - 1) + last) / (2 * last);
}

void set_entries(const Shape& shape, const double* parameters, Part part, RowMatrix& matrix) {
  for (const FreeEntry& entry : free_entries(shape, part)) matrix(entry.row, entry.column) = *parameters++;
  if (part == Part::details) return;
  for (int column = 1; column + 1 < shape.rows(); ++column) {
    const int row = eliminated_row(shape, column);
    matrix(row, column) = 0;
    matrix(row, column) = 1 - matrix.col(column).head(shape.control_points()).sum();
  }
}

}  // namespace

std::vector<FreeEntry> free_entries(const Shape& shape, Part part) {
  const int n = shape.control_points();
  std::vector<FreeEntry> entries;
  for (int column = 1; column + 1 < shape.rows(); ++column) {
    const int opposite = eliminated_row(shape, column);
    for (int row = part == Part::details ? n : 0; row < (part == Part::maps ? n : shape.rows()); ++row) {
      if (row >= n)
        entries.push_back({row, column, -1});
      else if (row != opposite)
        entries.push_back({row, column, opposite});
    }
  }
  return entries;
}

Eigen::VectorXd parameters_of(const Shape& shape, const RowMatrix& matrix, Part part) {
  const auto entries = free_entries(shape, part);
  Eigen::VectorXd parameters(static_cast<Index>(entries.size()));
  for (std::size_t p = 0; p < entries.size(); ++p)
    parameters(static_cast<Index>(p)) = matrix(entries[p].row, entries[p].column);
  return parameters;
}

RowMatrix matrix_of(const Shape& shape, const double* parameters) {
  const int rows = shape.rows();
  RowMatrix matrix = RowMatrix::Zero(rows, rows);
  matrix(0, 0) = matrix(shape.control_points() - 1, rows - 1) = 1;
  set_entries(shape, parameters, Part::all, matrix);
  return matrix;
}

RowMatrix matrix_of(const Shape& shape, const double* parameters, Part part, const RowMatrix& base) {
  if (part == Part::all) return matrix_of(shape, parameters);
  RowMatrix matrix = base;
  set_entries(shape, parameters, part, matrix);
  if (part == Part::details || !matrix.allFinite()) return matrix;
  try {
    return with_complement(shape, matrix.topRows(shape.control_points()));
  } catch (const Error&) {  // rows of C that depend on each other: outside every region
    return RowMatrix::Constant(shape.rows(), shape.rows(), std::numeric_limits<double>::quiet_NaN());
  }
}

}  // namespace ifsm::core
