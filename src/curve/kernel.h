// Many small products by one matrix: the inner loop of every transform. Vectorised with run-time dispatch; each output
// is the sum over the rows in their order, without fused multiply-add, so every target gives the same bits.
#pragma once

#include <cstdint>
#include <vector>

#include "curve/filter.h"

namespace ifsm::core::kernel {

// Node q's values are data[q·step] … data[q·step + count - 1].
struct Input {
  const double* data;
  int count;
  int step;
};

// Node q's results: those of the first columns are first[q·first_count] …, the others second[q·second_count] ….
struct Output {
  double* first;
  int first_count;
  double* second;
  int second_count;
};

// For every node: output = (first | second) · matrix, on the columns `chosen` of the matrix.
void multiply(const RowMatrix& matrix, const std::vector<int>& chosen, Index nodes, const Input& first,
              const Input& second, const Output& output);

}  // namespace ifsm::core::kernel
