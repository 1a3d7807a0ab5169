#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/orbits_double.cpp"
#include <hwy/foreach_target.h>  // compiles this file once a target
// The order matters: highway.h after foreach_target.h.
#include <hwy/highway.h>

#include <cstdint>

#include "raster/lanes-inl.h"
#include "raster/orbits.h"

HWY_BEFORE_NAMESPACE();
namespace ifsm::core {
namespace HWY_NAMESPACE {

const hn::CappedTag<double, 8> reals;
const hn::RebindToSigned<decltype(reals)> indices;
const hn::Rebind<std::int32_t, decltype(reals)> halves;  // as many, of half the size
using Reals = hn::Vec<decltype(reals)>;
using Indices = hn::Vec<decltype(indices)>;
constexpr std::size_t real_width = hn::MaxLanes(decltype(reals)());

// The operations of Grid::pixel, in its order. A pixel's number is below 2^31 and whole, so that double holds it.
class Pixels {
 public:
  explicit Pixels(const Window& window) : grid_(window) {}

  // Tells those of points inside; how many. Writes beyond them, up to the lanes' number.
  HWY_INLINE std::size_t operator()(const Reals x, const Reals y, std::int32_t* pixels) const {
    const Reals column = hn::Mul(hn::Sub(x, hn::Set(reals, grid_.left)), hn::Set(reals, grid_.columns_per_unit));
    const Reals row = hn::Mul(hn::Sub(hn::Set(reals, grid_.top), y), hn::Set(reals, grid_.rows_per_unit));
    const Reals columns = hn::Set(reals, static_cast<double>(grid_.width)),
                rows = hn::Set(reals, static_cast<double>(grid_.height)), zero = hn::Zero(reals);
    const auto inside =
        hn::And(hn::And(hn::Ge(column, zero), hn::Lt(column, columns)), hn::And(hn::Ge(row, zero), hn::Lt(row, rows)));
    const Reals pixel = hn::Add(hn::Mul(hn::Floor(row), columns), hn::Floor(column));
    const auto number = hn::DemoteTo(halves, hn::IfThenElse(inside, pixel, hn::Set(reals, -1)));
    return hn::CompressStore(number, hn::Gt(number, hn::Set(halves, -1)), halves, pixels);
  }

 private:
  Grid grid_;
};

template <Held held>
class Steps {
 public:
  explicit Steps(const Coefficients<double>& m)
      : draw_(m.choice), a_(m.a), b_(m.b), c_(m.c), d_(m.d), e_(m.e), f_(m.f) {}

  // One step of all orbits; tell(x, y) of each vector of them.
  template <class Tell>
  HWY_INLINE void operator()(Orbits<double>& o, const Tell& tell) const {
    HWY_ALIGN std::int32_t maps[orbit_count];
    for (std::size_t orbit = 0; orbit < orbit_count; orbit += width)
      hn::Store(draw_(o.random, orbit), integers, maps + orbit);
    for (std::size_t orbit = 0; orbit < orbit_count; orbit += real_width) {
      const Indices map = hn::PromoteTo(indices, hn::Load(halves, maps + orbit));
      const Reals x = hn::Load(reals, &o.x[orbit]), y = hn::Load(reals, &o.y[orbit]);
      const Reals next_x = hn::Add(hn::Add(hn::Mul(a_(map), x), hn::Mul(b_(map), y)), e_(map));
      const Reals next_y = hn::Add(hn::Add(hn::Mul(c_(map), x), hn::Mul(d_(map), y)), f_(map));
      hn::Store(next_x, reals, &o.x[orbit]);
      hn::Store(next_y, reals, &o.y[orbit]);
      tell(next_x, next_y);
    }
  }

 private:
  // One register of numbers half as large holds as much as two of doubles.
  static constexpr bool halved = held == Held::two && width >= 2 * real_width;
  Draw<halved ? Held::one : held> draw_;
  Table<decltype(reals), held> a_, b_, c_, d_, e_, f_;
};

template <Held held>
HWY_NOINLINE std::size_t run_held(Orbits<double>& orbits, const Coefficients<double>& maps, const Window& window,
                                  std::int64_t steps, std::int32_t* pixels) {
  const Steps<held> step(maps);
  if (pixels == nullptr) {
    for (std::int64_t k = 0; k < steps; ++k) step(orbits, [](const Reals, const Reals) {});
    return 0;
  }
  const Pixels tell(window);
  std::size_t inside = 0;
  for (std::int64_t k = 0; k < steps; ++k)
    step(orbits, [&](const Reals x, const Reals y) { inside += tell(x, y, pixels + inside); });
  return inside;
}

std::size_t run_orbits(Orbits<double>& orbits, const Coefficients<double>& maps, const Window& window,
                       std::int64_t steps, std::int32_t* pixels) {
  static_assert(real_width <= beyond_pixels);
  if (maps.choice.slots() <= real_width) return run_held<Held::one>(orbits, maps, window, steps, pixels);
  if (maps.choice.slots() <= 2 * real_width) return run_held<Held::two>(orbits, maps, window, steps, pixels);
  return run_held<Held::memory>(orbits, maps, window, steps, pixels);
}

}  // namespace HWY_NAMESPACE
}  // namespace ifsm::core
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ifsm::core {

HWY_EXPORT(run_orbits);

std::size_t run(Orbits<double>& orbits, const Coefficients<double>& maps, const Window& window, std::int64_t steps,
                std::int32_t* pixels) {
  return HWY_DYNAMIC_DISPATCH(run_orbits)(orbits, maps, window, steps, pixels);
}

}  // namespace ifsm::core
#endif
