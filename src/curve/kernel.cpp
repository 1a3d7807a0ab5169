#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "curve/kernel.cpp"
#include <hwy/foreach_target.h>  // compiles this file once a target
// The order matters: highway.h after foreach_target.h.
#include <hwy/highway.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "curve/kernel.h"

HWY_BEFORE_NAMESPACE();
namespace ifsm::core::kernel {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// A fixed virtual width would cost speed and buy nothing here: an output is never a sum over lanes.
const hn::ScalableTag<double> lanes;
using Lanes = hn::Vec<decltype(lanes)>;

Index width() { return static_cast<Index>(hn::Lanes(lanes)); }

struct Product {
  const double* matrix;  // rows of `pitch` doubles, padded with zeros
  Index pitch;
  Input first, second;
};

// Any shape: columns [column, column + blocks · width) of one node, the sums in registers while the rows go by.
template <int blocks>
HWY_INLINE void columns(const Product& p, const double* first, const double* second, Index column, double* out) {
  Lanes sum[blocks];
  for (int b = 0; b < blocks; ++b) sum[b] = hn::Zero(lanes);
  const double* row = p.matrix + column;
  const auto add = [&](double value) {
    const Lanes all = hn::Set(lanes, value);
    for (int b = 0; b < blocks; ++b) sum[b] = hn::Add(sum[b], hn::Mul(all, hn::LoadU(lanes, row + b * width())));
    row += p.pitch;
  };
  for (int r = 0; r < p.first.count; ++r) add(first[r]);
  for (int r = 0; r < p.second.count; ++r) add(second[r]);
  for (int b = 0; b < blocks; ++b) hn::StoreU(sum[b], lanes, out + b * width());
}

// A node writes whole vectors: up to one more than its columns fill.
struct AnyShape {
  explicit AnyShape(const Product& product) : p(product) {}
  HWY_INLINE void operator()(const double* first, const double* second, double* out) const {
    Index column = 0;
    for (; column + 4 * width() <= p.pitch; column += 4 * width()) columns<4>(p, first, second, column, out + column);
    for (; column + 2 * width() <= p.pitch; column += 2 * width()) columns<2>(p, first, second, column, out + column);
    for (; column < p.pitch; column += width()) columns<1>(p, first, second, column, out + column);
  }
  const Product& p;
};

// A shape that the compiler knows: the matrix stays in registers, F rows of the first input and S of the second.
template <int blocks, int F, int S>
struct KnownShape {
  explicit KnownShape(const Product& p) {
    for (int r = 0; r < F + S; ++r)
      for (int b = 0; b < blocks; ++b) row[r][b] = hn::LoadU(lanes, p.matrix + r * p.pitch + b * width());
  }
  HWY_INLINE void operator()(const double* first, const double* second, double* out) const {
    Lanes sum[blocks];
    for (int b = 0; b < blocks; ++b) sum[b] = hn::Zero(lanes);
    add<0>(first, sum, std::make_integer_sequence<int, F>{});
    add<F>(second, sum, std::make_integer_sequence<int, S>{});
    for (int b = 0; b < blocks; ++b) hn::StoreU(sum[b], lanes, out + b * width());
  }
  template <int from, int... r>
  HWY_INLINE void add(const double* values, Lanes* sum, std::integer_sequence<int, r...>) const {
    [[maybe_unused]] const auto one = [&](const Lanes all, const Lanes* at) {
      for (int b = 0; b < blocks; ++b) sum[b] = hn::Add(sum[b], hn::Mul(all, at[b]));
    };
    (one(hn::Set(lanes, values[r]), row[from + r]), ...);
  }
  Lanes row[F + S][blocks];
};

// What a node writes past its own values the next one overwrites; the last ones, and outputs in two parts, go through
// a buffer. `half`, when not 0, is the length of both parts.
template <int half, class Node>
HWY_INLINE void all_nodes(const Node node, const Product& p, Index nodes, const Output& output) {
  const Index count = output.first_count + output.second_count;
  const Index straight = output.second_count == 0 ? std::max<Index>(0, nodes - (p.pitch - 1) / count - 1) : 0;
  for (Index q = 0; q < straight; ++q)
    node(p.first.data + q * p.first.step, p.second.data + q * p.second.step, output.first + q * count);
  std::vector<double> buffer(static_cast<std::size_t>(p.pitch));
  double* const copy = buffer.data();
  for (Index q = straight; q < nodes; ++q) {
    node(p.first.data + q * p.first.step, p.second.data + q * p.second.step, copy);
    const int first_count = half > 0 ? half : output.first_count, second_count = half > 0 ? half : output.second_count;
    std::copy_n(copy, first_count, output.first + q * first_count);
    std::copy_n(copy + first_count, second_count, output.second + q * second_count);
  }
}

// Joined with two maps and n = F control points, when reading a polygon and n - 1 details; n = (F + 1) / 2 when reading
// 2n - 1 places.
template <int F, int S>
bool known(const Product& p, Index nodes, const Output& output) {
  if (p.first.count != F || p.second.count != S || p.pitch > 2 * width()) return false;
  constexpr int half = S == 0 ? (F - 1) / 2 : 0;
  const bool halves = output.first_count == half && output.second_count == half;
  const auto run = [&](const auto& node) {
    if (halves)
      all_nodes<half>(node, p, nodes, output);
    else
      all_nodes<0>(node, p, nodes, output);
  };
  if (p.pitch == width())
    run(KnownShape<1, F, S>(p));
  else
    run(KnownShape<2, F, S>(p));
  return true;
}

void multiply(const RowMatrix& matrix, const std::vector<int>& chosen, Index nodes, const Input& first,
              const Input& second, const Output& output) {
  const Index count = static_cast<Index>(chosen.size()), pitch = (count + width() - 1) / width() * width();
  std::vector<double> padded(static_cast<std::size_t>(matrix.rows() * pitch));
  for (Index r = 0; r < matrix.rows(); ++r)
    for (Index c = 0; c < count; ++c)
      padded[static_cast<std::size_t>(r * pitch + c)] = matrix(r, chosen[static_cast<std::size_t>(c)]);
  const Product p{padded.data(), pitch, first, second};
  const bool done = known<3, 2>(p, nodes, output) || known<4, 3>(p, nodes, output) || known<5, 4>(p, nodes, output) ||
                    known<6, 5>(p, nodes, output) || known<5, 0>(p, nodes, output) || known<7, 0>(p, nodes, output) ||
                    known<9, 0>(p, nodes, output) || known<11, 0>(p, nodes, output);
  if (!done) all_nodes<0>(AnyShape(p), p, nodes, output);
}

}  // namespace HWY_NAMESPACE
}  // namespace ifsm::core::kernel
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ifsm::core::kernel {

HWY_EXPORT(multiply);

void multiply(const RowMatrix& matrix, const std::vector<int>& chosen, Index nodes, const Input& first,
              const Input& second, const Output& output) {
  HWY_DYNAMIC_DISPATCH(multiply)(matrix, chosen, nodes, first, second, output);
}

}  // namespace ifsm::core::kernel
#endif
