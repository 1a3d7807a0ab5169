#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/set_points.cpp"
#include <hwy/foreach_target.h>  // compiles this file once a target
// The order matters: highway.h after foreach_target.h.
#include <hwy/highway.h>

#include "raster/compress-inl.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <memory>
#include <vector>

#include "raster/set_points.h"

// What all targets share; this file is read once a target.
#ifndef IFSM_RASTER_SET_POINTS_ONCE
#define IFSM_RASTER_SET_POINTS_ONCE
namespace ifsm::core {

// Points that go through a map together, on every machine; a whole number of vectors.
constexpr std::size_t block = 32;

// Points, from the box's middle; the last come first. In chunks, so that none is moved when there are more.
class Points {
 public:
  static constexpr std::size_t room = 4 * block;
  struct Chunk {
    static constexpr std::size_t most = 4096;
    std::array<double, most + block> x, y;  // vectors write beyond
    std::size_t size = 0;
  };

  Points() { grow(); }

  bool empty() const { return used_ == 1 && chunks_[0]->size == 0; }
  bool has_block() const { return used_ > 1 || chunks_[0]->size >= block; }

  // With room for so many.
  Chunk& top() {
    if (chunks_[used_ - 1]->size + room > Chunk::most) grow();
    return *chunks_[used_ - 1];
  }

  // Up to a block of them; the numbers after these are anything.
  std::size_t pop(double* x, double* y) {
    if (chunks_[used_ - 1]->size == 0 && used_ > 1) --used_;
    Chunk& chunk = *chunks_[used_ - 1];
    const std::size_t count = std::min(block, chunk.size);
    chunk.size -= count;
    std::copy_n(&chunk.x[chunk.size], block, x);
    std::copy_n(&chunk.y[chunk.size], block, y);
    return count;
  }

 private:
  void grow() {
    if (used_ == chunks_.size()) chunks_.push_back(std::make_unique_for_overwrite<Chunk>());
    chunks_[used_++]->size = 0;
  }

  std::vector<std::unique_ptr<Chunk>> chunks_;  // what was needed once is kept
  std::size_t used_ = 0;
};

// What is followed next: points that were the first in their pixel, and those that were only the first in its half.
struct Open {
  Points pixels, halves;
};

constexpr int pixel_bits = 30;  // of the largest windows

// Points that came to pixels, or halves of them, not met when they were looked up; those of one pixel may be several.
struct Found {
  static constexpr std::size_t most = Points::room;
  alignas(64) std::array<double, most + block> x, y;  // vectors write beyond
  alignas(64) std::array<std::int32_t, most + block> pixel_and_half;
  std::size_t size = 0;
};

}  // namespace ifsm::core
#endif

HWY_BEFORE_NAMESPACE();
namespace ifsm::core {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

const hn::CappedTag<double, 8> reals;
const hn::Rebind<std::int32_t, decltype(reals)> integers;
using Reals = hn::Vec<decltype(reals)>;
using Integers = hn::Vec<decltype(integers)>;
constexpr std::size_t width = hn::MaxLanes(decltype(reals)());

class Follower {
 public:
  Follower(const InPixels& attractor, const Window& window, std::uint8_t* met)
      : attractor_(attractor),
        met_(met),
        width_(static_cast<std::int32_t>(window.width)),
        across_(hn::Set(reals, static_cast<double>(window.width))),
        down_(hn::Set(reals, static_cast<double>(window.height))) {
    // The image of a pixel under such a map is so large that one point may well miss the pixels that it meets.
    const auto is_slow = [](const Piece& m) { return std::abs(m.a * m.d - m.b * m.c) > .5; };
    std::copy_if(attractor.maps.begin(), attractor.maps.end(), std::back_inserter(slow_), is_slow);
    both_halves_ = hn::Set(integers, slow_.empty() ? 3 : 0);
  }

  const std::vector<Piece>& maps() const { return attractor_.maps; }
  const std::vector<Piece>& slow_maps() const { return slow_; }

  // A block of the points; what they find is open.
  void follow(Points& points, const std::vector<Piece>& maps, Open& open) {
    alignas(64) std::array<double, block> x, y;
    const std::size_t count = points.pop(x.data(), y.data());
    // Some maps' images are looked up before the first is taken: what was written a moment ago is slow to read.
    Found found;
    for (const Piece& map : maps) {
      if (found.size > Found::most - block) take(found, open);
      for (std::size_t k = 0; k < count; k += width)
        look_up(map, hn::Load(reals, &x[k]), hn::Load(reals, &y[k]), count - k, found);
    }
    take(found, open);
  }

 private:
  // Written to both, and counted where it belongs: which it is nobody can foresee.
  void take(Found& found, Open& open) {
    Points::Chunk &all = open.pixels.top(), &rest = open.halves.top();
    double *const x = all.x.data(), *const y = all.y.data();
    double *const half_x = rest.x.data(), *const half_y = rest.y.data();
    std::size_t pixels = all.size, halves = rest.size;
    std::uint8_t* const states = met_;
    for (std::size_t k = 0; k < found.size; ++k) {
      const auto both = static_cast<std::uint32_t>(found.pixel_and_half[k]), half = both >> pixel_bits;
      std::uint8_t& met = states[both % (1U << pixel_bits)];
      const std::uint32_t before = met;
      met = static_cast<std::uint8_t>(before | half);
      x[pixels] = half_x[halves] = found.x[k];
      y[pixels] = half_y[halves] = found.y[k];
      const std::size_t is_first = before == 0 ? 1 : 0, is_known = (before & half) != 0 ? 1 : 0;
      pixels += is_first;
      halves += 1 - (is_first | is_known);
    }
    all.size = pixels;
    rest.size = halves;
    found.size = 0;
  }

  HWY_INLINE void look_up(const Piece& m, const Reals x, const Reals y, std::size_t count, Found& found) const {
    const auto set = [](double value) { return hn::Set(reals, value); };
    const Reals next_x = hn::Add(hn::Add(hn::Mul(set(m.a), x), hn::Mul(set(m.b), y)), set(m.e));
    const Reals next_y = hn::Add(hn::Add(hn::Mul(set(m.c), x), hn::Mul(set(m.d), y)), set(m.f));
    // In one pixel of the window, whatever rounding did.
    const Reals rounding = set(attractor_.rounding);
    const Reals across = hn::Add(next_x, set(attractor_.whole.e)), down = hn::Add(next_y, set(attractor_.whole.f));
    const Reals left = hn::Sub(across, rounding), right = hn::Add(across, rounding), top = hn::Sub(down, rounding),
                bottom = hn::Add(down, rounding);
    const auto inside = hn::And(hn::And(hn::Ge(left, hn::Zero(reals)), hn::Lt(right, across_)),
                                hn::And(hn::Ge(top, hn::Zero(reals)), hn::Lt(bottom, down_)));
    // Where it is outside, anything.
    const auto whole_part = [&](const Reals v) { return hn::DemoteTo(integers, hn::IfThenElseZero(inside, v)); };
    const Integers columns = whole_part(hn::Add(left, left));  // of half pixels
    const Integers column = hn::ShiftRight<1>(columns), row = whole_part(top), one = hn::Set(integers, 1);
    const Integers pixel = hn::Add(hn::Mul(row, hn::Set(integers, width_)), column);
    const Integers met = hn::GatherOffset(integers, reinterpret_cast<const std::int32_t*>(met_), pixel);
    const Integers half = hn::Or(hn::Add(hn::And(columns, one), one), both_halves_);
    const auto fresh = hn::And(hn::Eq(hn::And(met, half), hn::Zero(integers)),
                               hn::And(hn::Eq(column, whole_part(right)), hn::Eq(row, whole_part(bottom))));
    std::uint8_t bits[8] = {}, fresh_bits[8] = {};
    hn::StoreMaskBits(reals, hn::And(inside, hn::FirstN(reals, count)), bits);
    hn::StoreMaskBits(integers, fresh, fresh_bits);
    bits[0] &= fresh_bits[0];
    // No branch where there are none: nobody can foresee it.
    const Compress<decltype(reals)> compress(bits[0]);
    compress(next_x, &found.x[found.size]);
    compress(next_y, &found.y[found.size]);
    const Integers pixel_and_half = hn::Or(pixel, hn::ShiftLeft<pixel_bits>(half));
    hn::StoreU(hn::Compress(pixel_and_half, hn::LoadMaskBits(integers, bits)), integers,
               &found.pixel_and_half[found.size]);
    found.size += static_cast<std::size_t>(std::popcount(bits[0]));
  }

  const InPixels& attractor_;
  std::uint8_t* met_;
  std::int32_t width_;
  Reals across_, down_;
  std::vector<Piece> slow_;
  Integers both_halves_;  // where they are one: without slow maps
};

// A point may be the image of another under more maps than InPixels::longest_word. What a map rounds, the next ones
// shrink; where they shrink so little that it adds up to more, pieces do not get small either, and end in an error.
void follow(const InPixels& attractor, const Window& window, std::uint8_t* met, const Watch& watch) {
  Follower follower(attractor, window, met);
  Open open;
  Points::Chunk& start = open.pixels.top();
  start.size = attractor.points.x.size();
  std::copy_n(attractor.points.x.begin(), start.size, start.x.begin());
  std::copy_n(attractor.points.y.begin(), start.size, start.y.begin());
  constexpr int blocks_between = 1 << 8;
  for (int blocks = 0; !open.pixels.empty() || !open.halves.empty(); ++blocks) {
    if (blocks % blocks_between == 0) watch.poll();
    if (open.halves.has_block() || open.pixels.empty())
      follower.follow(open.halves, follower.slow_maps(), open);
    else
      follower.follow(open.pixels, follower.maps(), open);
  }
}

// The states of pixels in which halves were met.
void tell(std::uint8_t* met, std::size_t pixels) {
  const hn::CappedTag<std::uint8_t, 64> bytes;
  constexpr auto yes = static_cast<std::uint8_t>(Meets::yes);
  const auto met_state = hn::Set(bytes, yes);
  std::size_t k = 0;
  for (; k + hn::Lanes(bytes) <= pixels; k += hn::Lanes(bytes)) {
    const auto halves = hn::LoadU(bytes, met + k);
    hn::StoreU(hn::IfThenElseZero(hn::Ne(halves, hn::Zero(bytes)), met_state), bytes, met + k);
  }
  for (; k < pixels; ++k) met[k] = met[k] == 0 ? 0 : yes;
}

}  // namespace HWY_NAMESPACE
}  // namespace ifsm::core
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ifsm::core {

HWY_EXPORT(follow);
HWY_EXPORT(tell);

void follow_points(const InPixels& attractor, const Window& window, Meets* states, const Watch& watch) {
  auto* const met = reinterpret_cast<std::uint8_t*>(states);
  HWY_DYNAMIC_DISPATCH(follow)(attractor, window, met, watch);
  HWY_DYNAMIC_DISPATCH(tell)(met, static_cast<std::size_t>(window.pixels()));
}

}  // namespace ifsm::core
#endif
