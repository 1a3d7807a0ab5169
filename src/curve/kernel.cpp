#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "curve/kernel.cpp"
#include <hwy/foreach_target.h>  // compiles this file once a target
// The order matters: highway.h after foreach_target.h.
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <utility>
#include <vector>

#include "curve/kernel.h"

HWY_BEFORE_NAMESPACE();
namespace ifsm::core::kernel {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// A fixed virtual width would cost speed and buy nothing here: an output is never a sum over lanes.
const hn::CappedTag<double, 8> lanes;
const hn::Half<decltype(lanes)> half_lanes;
using Lanes = hn::Vec<decltype(lanes)>;
using Layout = Product::Layout;

Index width() { return static_cast<Index>(hn::Lanes(lanes)); }

bool shares_one_vector(const Layout& p) { return p.second_count > 0 && p.second_column < width(); }

// Any shape: columns [column, column + blocks · width) of one node, the sums in registers while the rows go by.
template <int blocks>
HWY_INLINE void columns(const Layout& p, const Input& above, const Input& below, Index column, double* out) {
  Lanes sum[blocks];
  const double* row = p.matrix + column;
  const auto times_row = [&](double value, auto&& take) {
    const Lanes all = hn::Set(lanes, value);
    for (int b = 0; b < blocks; ++b) take(sum[b], hn::Mul(all, hn::LoadU(lanes, row + b * width())));
    row += p.pitch;
  };
  const auto set = [](Lanes& s, const Lanes product) { s = product; };
  const auto add = [](Lanes& s, const Lanes product) { s = hn::Add(s, product); };
  times_row(above.data[0], set);
  for (int r = 1; r < above.count; ++r) times_row(above.data[r], add);
  for (int r = 0; r < below.count; ++r) times_row(below.data[r], add);
  for (int b = 0; b < blocks; ++b) hn::StoreU(sum[b], lanes, out + b * width());
}

struct AnyShape {
  AnyShape(const Layout& layout, const Input& above, const Input& below) : p(layout), a(above), b(below) {}

  HWY_INLINE void operator()(const double* above, const double* below, double* first, double* second) const {
    const Input here_a{above, a.count, a.step}, here_b{below, b.count, b.step};
    if (shares_one_vector(p)) {
      double both[8];
      columns<1>(p, here_a, here_b, 0, both);
      std::copy_n(both, p.second_column, first);
      std::copy_n(both + p.second_column, p.second_column, second);
      return;
    }
    some(here_a, here_b, 0, p.second_column, first);
    some(here_a, here_b, p.second_column, p.pitch, second);
  }
  HWY_INLINE void some(const Input& above, const Input& below, Index from, Index to, double* out) const {
    Index c = from;
    for (; c + 4 * width() <= to; c += 4 * width()) columns<4>(p, above, below, c, out + (c - from));
    for (; c + 2 * width() <= to; c += 2 * width()) columns<2>(p, above, below, c, out + (c - from));
    for (; c < to; c += width()) columns<1>(p, above, below, c, out + (c - from));
  }
  const Layout& p;
  const Input &a, &b;
};

// A shape that the compiler knows: the matrix stays in registers, A rows for the first input and B for the second. Of
// the vectors, `firsts` go to the first output, the others to the second; with 0 of them, the halves of one.
template <int blocks, int firsts, int A, int B>
struct KnownShape {
  explicit KnownShape(const Layout& p) {
    for (int r = 0; r < A + B; ++r)
      for (int b = 0; b < blocks; ++b) row[r][b] = hn::LoadU(lanes, p.matrix + r * p.pitch + b * width());
  }
  HWY_INLINE void operator()(const double* above, const double* below, double* first, double* second) const {
    Lanes sum[blocks];
    const Lanes all = hn::Set(lanes, above[0]);
    for (int b = 0; b < blocks; ++b) sum[b] = hn::Mul(all, row[0][b]);
    add<1>(above + 1, sum, std::make_integer_sequence<int, A - 1>{});
    add<A>(below, sum, std::make_integer_sequence<int, B>{});
#if HWY_TARGET != HWY_SCALAR  // whose vectors have no halves
    if constexpr (firsts == 0) {
      hn::StoreU(hn::LowerHalf(sum[0]), half_lanes, first);
      hn::StoreU(hn::UpperHalf(half_lanes, sum[0]), half_lanes, second);
    }
#endif
    for (int b = 0; b < firsts; ++b) hn::StoreU(sum[b], lanes, first + b * width());
    for (int b = firsts; firsts > 0 && b < blocks; ++b) hn::StoreU(sum[b], lanes, second + (b - firsts) * width());
  }
  template <int from, int... r>
  HWY_INLINE void add(const double* values, Lanes* sum, std::integer_sequence<int, r...>) const {
    [[maybe_unused]] const auto one = [&](const Lanes all, const Lanes* at) {
      for (int b = 0; b < blocks; ++b) sum[b] = hn::Add(sum[b], hn::Mul(all, at[b]));
    };
    (one(hn::Set(lanes, values[r]), row[from + r]), ...);
  }
  Lanes row[A + B][blocks];
};

// Nodes whose vectors end before the output does: what each writes past its own values, the next ones overwrite.
Index straight_nodes(Index nodes, Index count, Index written) {
  if (count == 0) return nodes;
  return nodes * count < written ? 0 : (nodes * count - written) / count + 1;
}

// The last nodes, whose vectors pass the end, go through a buffer.
template <class Node>
HWY_INLINE void all_nodes(const Node node, const Layout& p, Index nodes, Index straight, const Input& above,
                          const Input& below, double* first, double* second) {
  for (Index q = 0; q < straight; ++q)
    node(above.data + q * above.step, below.data + q * below.step, first + q * p.first_count,
         second + q * p.second_count);
  constexpr Index most = 2 * 136;  // columns of the widest R, 8 maps of 16 points, and a vector
  double buffer[most];
  double* const second_buffer = buffer + most / 2;
  for (Index q = straight; q < nodes; ++q) {
    node(above.data + q * above.step, below.data + q * below.step, buffer, second_buffer);
    std::copy_n(buffer, p.first_count, first + q * p.first_count);
    std::copy_n(second_buffer, p.second_count, second + q * p.second_count);
  }
}

// Joined with two maps and n = A control points, when reading a polygon and n - 1 details; n = (A + 1) / 2 when reading
// 2n - 1 places.
template <int A, int B>
bool known(const Layout& p, const Input& above, const Input& below, const auto& run) {
  if (above.count != A || below.count != B) return false;
  const Index firsts = shares_one_vector(p) ? 0 : p.second_column / width(), blocks = p.pitch / width();
  if (blocks == 1 && firsts == 0)
    run(KnownShape<1, 0, A, B>(p));
  else if (blocks == 1)
    run(KnownShape<1, 1, A, B>(p));
  else if (blocks == 2 && firsts == 1)
    run(KnownShape<2, 1, A, B>(p));
  else if (blocks == 2)
    run(KnownShape<2, 2, A, B>(p));
  else
    return false;
  return true;
}

void multiply(const Layout& p, Index nodes, const Input& above, const Input& below, double* first, double* second) {
  const bool shared = shares_one_vector(p);
  const Index first_written = p.second_column, second_written = shared ? width() / 2 : p.pitch - p.second_column;
  const Index straight = std::min(straight_nodes(nodes, p.first_count, first_written),
                                  straight_nodes(nodes, p.second_count, second_written));
  const auto run = [&](const auto& node) { all_nodes(node, p, nodes, straight, above, below, first, second); };
  if (known<3, 2>(p, above, below, run) || known<4, 3>(p, above, below, run) || known<5, 4>(p, above, below, run) ||
      known<6, 5>(p, above, below, run) || known<5, 0>(p, above, below, run) || known<7, 0>(p, above, below, run) ||
      known<9, 0>(p, above, below, run) || known<11, 0>(p, above, below, run))
    return;
  run(AnyShape(p, above, below));
}

// As integers, magnitudes are in the order of the numbers, with infinity and then NaN above them.
double largest(const double* values, Index count) {
  const hn::RebindToSigned<decltype(lanes)> integers;
  auto most = hn::Zero(integers);
  Index i = 0;
  for (; i + width() <= count; i += width())
    most = hn::Max(most, hn::BitCast(integers, hn::Abs(hn::LoadU(lanes, values + i))));
  std::int64_t result = hn::GetLane(hn::MaxOfLanes(integers, most));
  for (; i < count; ++i) result = std::max(result, std::bit_cast<std::int64_t>(values[i]) & INT64_MAX);
  return std::bit_cast<double>(result);
}

}  // namespace HWY_NAMESPACE
}  // namespace ifsm::core::kernel
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ifsm::core::kernel {

HWY_EXPORT(width);
HWY_EXPORT(multiply);
HWY_EXPORT(largest);

Product::Product(const RowMatrix& matrix, const std::vector<int>& first, const std::vector<int>& second) {
  const Index vector = HWY_DYNAMIC_DISPATCH(width)();
  const auto padded = [&](std::size_t count) { return (static_cast<Index>(count) + vector - 1) / vector * vector; };
  const bool shared = !second.empty() && std::max(first.size(), second.size()) <= static_cast<std::size_t>(vector / 2);
  layout_.second_column = shared ? vector / 2 : padded(first.size());
  layout_.pitch = shared ? vector : layout_.second_column + padded(second.size());
  layout_.first_count = static_cast<Index>(first.size());
  layout_.second_count = static_cast<Index>(second.size());
  padded_.resize(static_cast<std::size_t>(matrix.rows() * layout_.pitch));
  for (Index r = 0; r < matrix.rows(); ++r) {
    double* const row = padded_.data() + r * layout_.pitch;
    for (std::size_t c = 0; c < first.size(); ++c) row[c] = matrix(r, first[c]);
    for (std::size_t c = 0; c < second.size(); ++c)
      row[layout_.second_column + static_cast<Index>(c)] = matrix(r, second[c]);
  }
}

void Product::operator()(Index nodes, const Input& above, const Input& below, double* first, double* second) const {
  Layout layout = layout_;
  layout.matrix = padded_.data();
  HWY_DYNAMIC_DISPATCH(multiply)(layout, nodes, above, below, first, second);
}

double largest(std::span<const double> values) {
  return HWY_DYNAMIC_DISPATCH(largest)(values.data(), static_cast<Index>(values.size()));
}

}  // namespace ifsm::core::kernel
#endif
