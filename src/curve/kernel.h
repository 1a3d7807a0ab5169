// Many small products by one matrix: the inner loop of every transform. Vectorised with run-time dispatch; each output
// is the sum over the rows in their order, without fused multiply-add, so every target gives the same bits.
#pragma once

#include <cstdint>

#include "curve/filter.h"

namespace ifsm::core::kernel {

// Node q's values are data[q·step] … data[q·step + count - 1].
struct Input {
  const double* data;
  int count;
  int step;
};

// Node q's results are data[q·count] …, those of the matrix' columns first_column … first_column + count - 1.
struct Output {
  double* data;
  int first_column;
  int count;
};

// For every node: output = (first | second) · matrix, on the output's columns.
void multiply(const RowMatrix& matrix, Index nodes, const Input& first, const Input& second, const Output& output);

}  // namespace ifsm::core::kernel
