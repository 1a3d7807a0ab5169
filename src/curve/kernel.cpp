#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "curve/kernel.cpp"
#include <hwy/foreach_target.h>  // compiles this file once a target
// The order matters: highway.h after foreach_target.h.
#include <hwy/highway.h>

#include <vector>

#include "curve/kernel.h"

HWY_BEFORE_NAMESPACE();
namespace ifsm::core::kernel {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// A fixed virtual width would cost speed and buy nothing here: an output is never a sum over lanes.
const hn::ScalableTag<double> lanes;

struct Product {
  const double* matrix;  // rows of `pitch` doubles, padded with zeros
  Index pitch;
  Input first, second;
  Output output;
};

// Columns [column, column + blocks · Lanes) of one node. Accumulators stay in registers while the rows go by.
template <int blocks>
HWY_INLINE void columns(const Product& p, const double* first, const double* second, Index column, double* out) {
  const Index width = static_cast<Index>(hn::Lanes(lanes));
  hn::Vec<decltype(lanes)> sum[blocks];
  for (int b = 0; b < blocks; ++b) sum[b] = hn::Zero(lanes);
  const double* row = p.matrix + column;
  for (int r = 0; r < p.first.count; ++r, row += p.pitch) {
    const auto value = hn::Set(lanes, first[r]);
    for (int b = 0; b < blocks; ++b) sum[b] = hn::Add(sum[b], hn::Mul(value, hn::LoadU(lanes, row + b * width)));
  }
  for (int r = 0; r < p.second.count; ++r, row += p.pitch) {
    const auto value = hn::Set(lanes, second[r]);
    for (int b = 0; b < blocks; ++b) sum[b] = hn::Add(sum[b], hn::Mul(value, hn::LoadU(lanes, row + b * width)));
  }
  for (int b = 0; b < blocks; ++b) hn::StoreU(sum[b], lanes, out + b * width);
}

// All columns of one node; writes up to a vector more than output.count values.
HWY_INLINE void node(const Product& p, const double* first, const double* second, double* out) {
  const Index width = static_cast<Index>(hn::Lanes(lanes));
  Index column = 0;
  for (; column + 4 * width <= p.pitch; column += 4 * width) columns<4>(p, first, second, column, out + column);
  for (; column + 2 * width <= p.pitch; column += 2 * width) columns<2>(p, first, second, column, out + column);
  for (; column < p.pitch; column += width) columns<1>(p, first, second, column, out + column);
}

void multiply(const RowMatrix& matrix, Index nodes, const Input& first, const Input& second, const Output& output) {
  const Index width = static_cast<Index>(hn::Lanes(lanes));
  const Index pitch = (output.count + width - 1) / width * width;
  std::vector<double> padded(static_cast<std::size_t>(matrix.rows() * pitch));
  for (Index r = 0; r < matrix.rows(); ++r)
    for (int c = 0; c < output.count; ++c)
      padded[static_cast<std::size_t>(r * pitch + c)] = matrix(r, output.first_column + c);
  const Product p{padded.data(), pitch, first, second, output};

  // What a node writes past its own values is overwritten by the next one; the last ones go through a buffer.
  const Index total = nodes * output.count;
  std::vector<double> buffer(static_cast<std::size_t>(pitch));
  for (Index q = 0; q < nodes; ++q) {
    const double* a = first.data + q * first.step;
    const double* b = second.data + q * second.step;
    double* out = output.data + q * output.count;
    if (q * output.count + pitch <= total) {
      node(p, a, b, out);
    } else {
      node(p, a, b, buffer.data());
      std::copy(buffer.begin(), buffer.begin() + output.count, out);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace ifsm::core::kernel
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ifsm::core::kernel {

HWY_EXPORT(multiply);

void multiply(const RowMatrix& matrix, Index nodes, const Input& first, const Input& second, const Output& output) {
  HWY_DYNAMIC_DISPATCH(multiply)(matrix, nodes, first, second, output);
}

}  // namespace ifsm::core::kernel
#endif
