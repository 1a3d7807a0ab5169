// Many small products by one matrix: the inner loop of every transform. Vectorised with run-time dispatch; each output
// is the sum over the rows in their order, without fused multiply-add, so every target gives the same bits.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "curve/filter.h"

namespace ifsm::core::kernel {

// Node q's values are data[q·step] … data[q·step + count - 1].
struct Input {
  const double* data;
  int count;
  int step;
};

// A matrix whose columns part into two outputs, laid out for the vectors of this machine: of each output a node fills
// whole vectors, or of both outputs together one vector's halves.
class Product {
 public:
  Product(const RowMatrix& matrix, const std::vector<int>& first, const std::vector<int>& second = {});

  // For every node q: (first[q·first_count …] | second[q·second_count …]) = (above | below) · matrix. `below` may be
  // empty, and `second` NULL when no column goes there. Writes nothing beyond the last node's values.
  void operator()(Index nodes, const Input& above, const Input& below, double* first, double* second) const;

  // What the kernel sees.
  struct Layout {
    const double* matrix;  // rows of `pitch` doubles; columns that are none are zeros
    Index pitch;
    Index second_column;  // where the second output's columns begin
    Index first_count, second_count;
  };

 private:
  std::vector<double> padded_;
  Layout layout_;
};

// The largest magnitude; infinite or NaN when one of the values is.
double largest(std::span<const double> values);

}  // namespace ifsm::core::kernel
