// The lanes of doubles that are kept, side by side. Included by each target's code, within its namespace's reach.
#if defined(IFSM_RASTER_COMPRESS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef IFSM_RASTER_COMPRESS_INL_H
#undef IFSM_RASTER_COMPRESS_INL_H
#else
#define IFSM_RASTER_COMPRESS_INL_H
#endif

#include <hwy/highway.h>

#include <array>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace ifsm::core {
namespace HWY_NAMESPACE {

// For each set of 8 lanes the numbers of those in it, four bits each, the lowest first.
constexpr std::array<std::uint64_t, 256> lane_numbers() {
  std::array<std::uint64_t, 256> all{};
  for (std::size_t set = 0; set < all.size(); ++set)
    for (std::uint64_t lane = 0, found = 0; lane < 8; ++lane)
      if ((set >> lane & 1) != 0) all[set] |= lane << 4 * found++;
  return all;
}
inline constexpr std::array<std::uint64_t, 256> numbers_of_lanes = lane_numbers();

// Vectors are permuted and stored whole: the instruction that compresses into memory takes six times as long. Doubles
// are permuted by a table.
template <class Tag>
class Compress {
 public:
  HWY_INLINE explicit Compress(std::uint32_t which) {
    namespace hn = hwy::HWY_NAMESPACE;
    if constexpr (permutes) {
      const hn::RebindToUnsigned<Tag> words;
      const auto shifts = hn::Mul(hn::Iota(words, 0), hn::Set(words, 4));
      numbers_ = hn::And(hn::Shr(hn::Set(words, numbers_of_lanes[which]), shifts), hn::Set(words, 7));
    } else {
      const std::uint8_t bits[8] = {static_cast<std::uint8_t>(which), static_cast<std::uint8_t>(which >> 8)};
      kept_ = hn::LoadMaskBits(Tag(), bits);
    }
  }

  HWY_INLINE void operator()(const hwy::HWY_NAMESPACE::Vec<Tag> v, hwy::HWY_NAMESPACE::TFromD<Tag>* to) const {
    namespace hn = hwy::HWY_NAMESPACE;
    if constexpr (permutes)
      hn::StoreU(hn::TableLookupLanes(v, hn::IndicesFromVec(Tag(), numbers_)), Tag(), to);
    else
      hn::StoreU(hn::Compress(v, kept_), Tag(), to);
  }

 private:
  static constexpr bool permutes =
      sizeof(hwy::HWY_NAMESPACE::TFromD<Tag>) == sizeof(double) && hwy::HWY_NAMESPACE::MaxLanes(Tag()) == 8;
  hwy::HWY_NAMESPACE::Vec<hwy::HWY_NAMESPACE::RebindToUnsigned<Tag>> numbers_{};
  hwy::HWY_NAMESPACE::Mask<Tag> kept_{};
};

}  // namespace HWY_NAMESPACE
}  // namespace ifsm::core
HWY_AFTER_NAMESPACE();

#endif
