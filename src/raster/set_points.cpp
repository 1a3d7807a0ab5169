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
#include <vector>

#include "raster/set_points.h"

// What all targets share; this file is read once a target.
#ifndef IFSM_RASTER_SET_POINTS_ONCE
#define IFSM_RASTER_SET_POINTS_ONCE
namespace ifsm::core {

// Points, from the box's middle.
struct Points {
  std::vector<double> x, y;
  std::size_t size = 0;

  void make_room(std::size_t more) {
    if (x.size() >= size + more) return;
    x.resize(2 * (size + more));
    y.resize(2 * (size + more));
  }
};

// What is followed next: points that were the first in their pixel, and those that were only the first in its half.
struct Front {
  Points pixels, halves;
};

constexpr int pixel_bits = 30;  // of the largest windows

// Points that came to pixels, or halves of them, not met when they were looked up; those of one pixel may be several.
struct Found {
  alignas(64) std::array<double, 64> x, y;
  alignas(64) std::array<std::int32_t, 64> pixel_and_half;
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
// Points that go through a map together, on every machine; a whole number of vectors.
constexpr std::size_t block = 32;

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

  // Of one block, to the next front.
  void follow(const Points& points, std::size_t first, const std::vector<Piece>& maps, Front& next) {
    const std::size_t count = std::min(block, points.size - first);
    for (const Piece& map : maps) {
      Found found;
      for (std::size_t k = 0; k < count; k += width)
        look_up(map, hn::LoadU(reals, &points.x[first + k]), hn::LoadU(reals, &points.y[first + k]), count - k, found);
      take(found, next);
    }
  }

 private:
  // Written to both, and counted where it belongs: which it is nobody can foresee.
  void take(const Found& found, Front& next) {
    next.pixels.make_room(block);
    next.halves.make_room(block);
    double *const x = next.pixels.x.data(), *const y = next.pixels.y.data();
    double *const half_x = next.halves.x.data(), *const half_y = next.halves.y.data();
    std::size_t pixels = next.pixels.size, halves = next.halves.size;
    for (std::size_t k = 0; k < found.size; ++k) {
      const auto both = static_cast<std::uint32_t>(found.pixel_and_half[k]);
      std::uint8_t& met = met_[both % (1U << pixel_bits)];
      const auto before = met, half = static_cast<std::uint8_t>(both >> pixel_bits);
      met = before | half;
      x[pixels] = half_x[halves] = found.x[k];
      y[pixels] = half_y[halves] = found.y[k];
      pixels += before == 0 ? 1 : 0;
      halves += before != 0 && (before & half) == 0 ? 1 : 0;
    }
    next.pixels.size = pixels;
    next.halves.size = halves;
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
    hn::CompressStore(hn::Or(pixel, hn::ShiftLeft<pixel_bits>(half)), hn::LoadMaskBits(integers, bits), integers,
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

void follow(const InPixels& attractor, const Window& window, std::uint8_t* met, const Watch& watch) {
  Follower follower(attractor, window, met);
  Front front, next;
  Points& start = front.pixels;
  start.make_room(block);
  start.size = attractor.points.x.size();
  std::copy_n(attractor.points.x.begin(), start.size, start.x.begin());
  std::copy_n(attractor.points.y.begin(), start.size, start.y.begin());
  const auto follow_all = [&](Points& points, const std::vector<Piece>& maps) {
    points.make_room(block);  // vectors are read whole
    for (std::size_t first = 0; first < points.size; first += block) {
      constexpr std::size_t blocks_between = 1 << 8;
      if (first / block % blocks_between == 0) watch.poll();
      follower.follow(points, first, maps, next);
    }
    points.size = 0;
  };
  for (int length = 0; front.pixels.size + front.halves.size != 0 && length < InPixels::longest_word; ++length) {
    follow_all(front.pixels, follower.maps());
    follow_all(front.halves, follower.slow_maps());
    std::swap(front, next);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace ifsm::core
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ifsm::core {

HWY_EXPORT(follow);

void follow_points(const InPixels& attractor, const Window& window, Meets* states, const Watch& watch) {
  auto* const met = reinterpret_cast<std::uint8_t*>(states);
  HWY_DYNAMIC_DISPATCH(follow)(attractor, window, met, watch);
  std::transform(met, met + window.pixels(), states,
                 [](std::uint8_t halves) { return halves == 0 ? Meets::no : Meets::yes; });
}

}  // namespace ifsm::core
#endif
