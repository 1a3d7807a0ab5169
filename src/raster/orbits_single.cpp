#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/orbits_single.cpp"
#include <hwy/foreach_target.h>  // compiles this file once a target
// The order matters: highway.h after foreach_target.h.
#include <hwy/highway.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "raster/lanes-inl.h"
#include "raster/orbits.h"

HWY_BEFORE_NAMESPACE();
namespace ifsm::core {
namespace HWY_NAMESPACE {

const hn::CappedTag<float, 16> reals;
using Reals = hn::Vec<decltype(reals)>;

// The pixel of each lane's point. Single precision may see a point on the wrong side of a pixel's edge; those near one
// are seen again in double, which tells points that are *on* an edge as plain::chaos_counts does.
class Pixels {
 public:
  explicit Pixels(const Window& window)
      : grid_(window),
        left_(hn::Set(reals, static_cast<float>(window.left + .5 / parts / grid_.columns_per_unit))),
        top_(hn::Set(reals, static_cast<float>(window.top - .5 / parts / grid_.rows_per_unit))),
        columns_per_unit_(hn::Set(reals, static_cast<float>(grid_.columns_per_unit * parts))),
        rows_per_unit_(hn::Set(reals, static_cast<float>(grid_.rows_per_unit * parts))),
        width_(hn::Set(integers, static_cast<std::int32_t>(window.width))),
        height_(hn::Set(words, static_cast<std::uint32_t>(window.height))),
        outside_(hn::Set(integers, static_cast<std::int32_t>(window.pixels()))) {}

  HWY_INLINE void operator()(const Reals x, const Reals y, std::int32_t* pixels) const {
    const Integers across = in_parts(hn::Mul(hn::Sub(x, left_), columns_per_unit_));
    const Integers down = in_parts(hn::Mul(hn::Sub(top_, y), rows_per_unit_));
    const Integers column = hn::ShiftRight<part_bits>(across), row = hn::ShiftRight<part_bits>(down);
    // Negative ones are large when read as unsigned.
    const auto inside = hn::And(hn::Lt(hn::BitCast(words, column), hn::BitCast(words, width_)),
                                hn::Lt(hn::BitCast(words, row), height_));
    const Integers pixel = hn::Add(hn::Mul(row, width_), column);
    hn::Store(hn::IfThenElse(hn::RebindMask(integers, inside), pixel, outside_), integers, pixels);

    // The first or the last part of a pixel: all bits between the lowest and the pixel's are zero after adding 1.
    const Integers one = hn::Set(integers, 1), between = hn::Set(integers, parts - 2), zero = hn::Zero(integers);
    const auto near_edge = hn::Or(hn::Eq(hn::And(hn::Add(across, one), between), zero),
                                  hn::Eq(hn::And(hn::Add(down, one), between), zero));
    if (!hn::AllFalse(integers, near_edge)) see_again(x, y, near_edge, pixels);
  }

 private:
  // Coordinates are below 2^11 pixels (single_precision_suffices), so one is rounded to 2^-13 of a pixel; the roundings
  // of the point, the corner, their difference, the factor and the product add up to less than a part.
  static constexpr int part_bits = 10;
  static constexpr std::int32_t parts = 1 << part_bits;

  // The nearest whole number of one below 2^22: that of 2^-10 pixels below a coordinate, since half a one is in the
  // corner already. In the sum with 1.5 · 2^23 the unit is the last place.
  HWY_INLINE static Integers in_parts(const Reals coordinate) {
    const Reals middle = hn::Set(reals, 0x1.8p23F);
    return hn::Sub(hn::BitCast(integers, hn::Add(coordinate, middle)), hn::BitCast(integers, middle));
  }

  HWY_NOINLINE void see_again(const Reals x, const Reals y, const hn::Mask<decltype(integers)> which,
                              std::int32_t* pixels) const {
    HWY_ALIGN float xs[width], ys[width];
    hn::Store(x, reals, xs);
    hn::Store(y, reals, ys);
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(integers, which, bits);
    for (std::uint32_t left = bits[0] | static_cast<std::uint32_t>(bits[1]) << 8; left != 0; left &= left - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(left));
      pixels[lane] =
          static_cast<std::int32_t>(grid_.pixel(static_cast<double>(xs[lane]), static_cast<double>(ys[lane])));
    }
  }

  Grid grid_;
  Reals left_, top_, columns_per_unit_, rows_per_unit_;
  Integers width_;
  Words height_;
  Integers outside_;
};

template <Held held>
class Step {
 public:
  explicit Step(const Coefficients<float>& m) : draw_(m.choice), a_(m.a), b_(m.b), c_(m.c), d_(m.d), e_(m.e), f_(m.f) {}

  struct Points {
    Reals x, y;
  };

  // Of a vector of orbits.
  HWY_INLINE Points operator()(Orbits<float>& o, std::size_t orbit) const {
    const Integers map = draw_(o.random, orbit);
    const Reals x = hn::Load(reals, &o.x[orbit]), y = hn::Load(reals, &o.y[orbit]);
    const Reals next_x = hn::Add(hn::Add(hn::Mul(a_(map), x), hn::Mul(b_(map), y)), e_(map));
    const Reals next_y = hn::Add(hn::Add(hn::Mul(c_(map), x), hn::Mul(d_(map), y)), f_(map));
    hn::Store(next_x, reals, &o.x[orbit]);
    hn::Store(next_y, reals, &o.y[orbit]);
    return {next_x, next_y};
  }

 private:
  Draw<held> draw_;
  Table<decltype(reals), held> a_, b_, c_, d_, e_, f_;
};

// Counts in bytes; those that are full are carried together.
class Counter {
 public:
  explicit Counter(const Tally& tally) : tally_(tally) {}

  // A vector of pixels, without a loop: the processor foresees its end too seldom.
  HWY_INLINE void operator()(const std::int32_t* pixels) { count(pixels, std::make_index_sequence<width>()); }

  // Now and then, and at the end.
  void carry() {
    for (std::size_t k = 0; k < full_count_; ++k) tally_.carry(full_[k]);
    full_count_ = 0;
  }
  // Before there is no room for the pixels of another step.
  bool is_to_carry() const { return full_count_ > full_.size() - orbit_count; }

 private:
  // With copies of the members: a byte that is counted could be a part of them, for all that the compiler knows.
  template <std::size_t... lane>
  HWY_INLINE void count(const std::int32_t* pixels, std::index_sequence<lane...> /*all*/) {
    const Tally tally = tally_;
    std::size_t full = full_count_;
    const auto count_one = [&](std::int32_t pixel) {
      if (tally.fills(pixel)) full_[full++] = pixel;
    };
    (count_one(pixels[lane]), ...);
    full_count_ = full;
  }

  Tally tally_;
  std::size_t full_count_ = 0;
  std::array<std::int32_t, 1024> full_;
};

// Pixels are counted a step after they were found, between the vectors of the next one: counts wait for the
// second-level cache, and vectors do not.
template <Held held>
HWY_NOINLINE void run_held(Orbits<float>& orbits, const Coefficients<float>& maps, const Window& window,
                           std::int64_t steps, const Tally* tally) {
  const Step<held> step(maps);
  if (tally == nullptr || steps < 1) {
    for (std::int64_t k = 0; k < steps; ++k)
      for (std::size_t orbit = 0; orbit < orbit_count; orbit += width) step(orbits, orbit);
    return;
  }
  const Pixels pixels(window);
  Counter count(*tally);
  HWY_ALIGN std::int32_t room[2][orbit_count] = {};
  std::int32_t *now = room[0], *before = room[1];
  for (std::int64_t k = 0; k < steps; ++k) {
    std::swap(now, before);
    for (std::size_t orbit = 0; orbit < orbit_count; orbit += width) {
      const auto [x, y] = step(orbits, orbit);
      pixels(x, y, now + orbit);
      if (k != 0) count(before + orbit);
    }
    if (count.is_to_carry()) count.carry();
  }
  for (std::size_t orbit = 0; orbit < orbit_count; orbit += width) count(now + orbit);
  count.carry();
}

void run_orbits(Orbits<float>& orbits, const Coefficients<float>& maps, const Window& window, std::int64_t steps,
                const Tally* tally) {
  if (maps.choice.slots() <= width)
    run_held<Held::one>(orbits, maps, window, steps, tally);
  else if (maps.choice.slots() <= 2 * width)
    run_held<Held::two>(orbits, maps, window, steps, tally);
  else
    run_held<Held::memory>(orbits, maps, window, steps, tally);
}

}  // namespace HWY_NAMESPACE
}  // namespace ifsm::core
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ifsm::core {

HWY_EXPORT(run_orbits);

void run(Orbits<float>& orbits, const Coefficients<float>& maps, const Window& window, std::int64_t steps,
         const Tally* tally) {
  HWY_DYNAMIC_DISPATCH(run_orbits)(orbits, maps, window, steps, tally);
}

}  // namespace ifsm::core
#endif
