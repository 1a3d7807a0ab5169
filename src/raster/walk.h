// The chaos game in double precision, point by point, for whoever looks at each: in the plane and in space.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "base/cancel.h"
#include "raster/orbits.h"

namespace ifsm::core {

// Maps of d dimensions, row by row: coefficients, then the shift. Sums are taken as Coefficients::step takes them.
template <std::size_t d>
class WalkMaps {
 public:
  using Point = std::array<double, d>;

  explicit WalkMaps(const System& system) : choice_(system.probabilities()) {
    for (const Affine& map : system.maps()) {
      auto& rows = rows_.emplace_back();
      for (std::size_t i = 0; i < d; ++i) {
        for (std::size_t j = 0; j < d; ++j)
          rows[i][j] = map.linear(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
        rows[i][d] = map.shift(static_cast<Eigen::Index>(i));
      }
    }
  }

  // Moves x, and tells by which map.
  int step(std::uint32_t random, Point& x) const {
    const int map = choice_(random);
    const auto& rows = rows_[static_cast<std::size_t>(map)];
    const Point before = x;
    for (std::size_t i = 0; i < d; ++i) {
      double sum = rows[i][0] * before[0];
      for (std::size_t j = 1; j < d; ++j) sum += rows[i][j] * before[j];
      x[i] = sum + rows[i][d];
    }
    return map;
  }

 private:
  Choice choice_;
  std::vector<std::array<std::array<double, d + 1>, d>> rows_;
};

// 64 orbits of one chunk, all from the same point, step by step: `moved(step, orbit, x, letter)` after each step of
// each, those before `start.steps` included. Points are those of chaos_counts, in its order, from that step on.
template <std::size_t d, class Moved>
void walk(const WalkMaps<d>& maps, const Start& start, std::uint64_t seed, std::int64_t chunk, std::int64_t steps,
          const Watch& watch, const Moved& moved) {
  constexpr std::int64_t steps_per_poll = 32;  // 2048 points: some µs, and with all letters some 10 ms
  RandomWords random(seed, static_cast<std::uint64_t>(chunk));
  std::array<typename WalkMaps<d>::Point, orbit_count> x;
  for (auto& point : x) std::copy_n(start.point.data(), d, point.begin());
  for (std::int64_t step = 0; step < start.steps + steps; ++step) {
    if (step % steps_per_poll == 0) watch.poll();
    for (std::size_t orbit = 0; orbit < orbit_count; ++orbit) {
      const int letter = maps.step(random.next(orbit), x[orbit]);
      moved(step, orbit, x[orbit], letter);
    }
  }
}

}  // namespace ifsm::core
