// What the chaos game's loops have in common, compiled once a vector target: tables, and which map each orbit takes.
#if defined(IFSM_RASTER_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef IFSM_RASTER_LANES_INL_H
#undef IFSM_RASTER_LANES_INL_H
#else
#define IFSM_RASTER_LANES_INL_H
#endif

#include <hwy/highway.h>

#include <cstdint>
#include <vector>

#include "raster/orbits.h"

HWY_BEFORE_NAMESPACE();
namespace ifsm::core {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

const hn::CappedTag<std::int32_t, 16> integers;
const hn::RebindToUnsigned<decltype(integers)> words;
using Integers = hn::Vec<decltype(integers)>;
using Words = hn::Vec<decltype(words)>;
constexpr std::size_t width = hn::MaxLanes(decltype(integers)());

// A table that an index is looked up in, lane by lane. In one register, in two, or in memory.
enum class Held { one, two, memory };

template <class Tag, Held held>
class Table {
 public:
  using Number = hn::TFromD<Tag>;
  using Vector = hn::Vec<Tag>;
  using Index = hn::Vec<hn::RebindToSigned<Tag>>;

  // As many entries as slots, a power of two.
  explicit Table(const std::vector<Number>& entries) : memory_(entries.data()) {
    if constexpr (held != Held::memory) {
      HWY_ALIGN Number filled[2 * lanes];
      for (std::size_t k = 0; k < 2 * lanes; ++k) filled[k] = entries[k % entries.size()];
      low_ = hn::Load(Tag(), filled);
      high_ = hn::Load(Tag(), filled + lanes);
    }
  }

  HWY_INLINE Vector operator()(const Index index) const {
    const Tag tag;
    const hn::RebindToSigned<Tag> indices;
    if constexpr (held == Held::memory) return hn::GatherIndex(tag, memory_, index);
    if constexpr (held == Held::one) return hn::TableLookupLanes(low_, hn::IndicesFromVec(tag, index));
    const Index last = hn::Set(indices, static_cast<hn::TFromD<decltype(indices)>>(lanes - 1));
    const auto within = hn::IndicesFromVec(tag, hn::And(index, last));
    return hn::IfThenElse(hn::RebindMask(tag, hn::Gt(index, last)), hn::TableLookupLanes(high_, within),
                          hn::TableLookupLanes(low_, within));
  }

 private:
  static constexpr std::size_t lanes = hn::MaxLanes(Tag());

  const Number* memory_;
  Vector low_{}, high_{};
};

// The next random word of each of some orbits, and the map that it chooses, as Choice does.
template <Held held>
class Draw {
 public:
  explicit Draw(const Choice& choice) : bits_(choice.bits()), share_(choice.share()), other_(choice.other()) {}

  HWY_INLINE Integers operator()(RandomWords& r, std::size_t orbit) const {
    const Words random = next(r, orbit);
    const Integers slot = hn::BitCast(integers, hn::ShiftRightSame(random, 32 - bits_));
    const Integers rest = hn::BitCast(integers, hn::ShiftRight<1>(hn::ShiftLeftSame(random, bits_)));
    return hn::IfThenElse(hn::Lt(rest, share_(slot)), slot, other_(slot));
  }

 private:
  static HWY_INLINE Words next(RandomWords& r, std::size_t orbit) {
    const Words a = hn::Load(words, &r.a[orbit]), b = hn::Load(words, &r.b[orbit]), c = hn::Load(words, &r.c[orbit]);
    const Words counter = hn::Load(words, &r.counter[orbit]);
    const Words word = hn::Add(hn::Add(a, b), counter);
    hn::Store(hn::Add(counter, hn::Set(words, 1)), words, &r.counter[orbit]);
    hn::Store(hn::Xor(b, hn::ShiftRight<9>(b)), words, &r.a[orbit]);
    hn::Store(hn::Add(c, hn::ShiftLeft<3>(c)), words, &r.b[orbit]);
    hn::Store(hn::Add(hn::RotateRight<11>(c), word), words, &r.c[orbit]);
    return word;
  }

  int bits_;
  Table<decltype(integers), held> share_, other_;
};

}  // namespace HWY_NAMESPACE
}  // namespace ifsm::core
HWY_AFTER_NAMESPACE();

#endif  // once a target
