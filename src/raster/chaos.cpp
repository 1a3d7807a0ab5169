#include "raster/chaos.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <thread>

#include "base/error.h"
#include "base/parallel.h"
#include "raster/histogram.h"
#include "raster/orbits.h"
#include "system/reach.h"

namespace ifsm::core {

void require_window(const Window& window) {
  constexpr std::int64_t most = 32768;
  in_range(window.width, 1, most, "width");
  in_range(window.height, 1, most, "height");
  const auto require_side = [](double low, double high, std::int64_t count, const char* name) {
    require_finite(low, name);
    require_finite(high, name);
    const double pixel = (high - low) / static_cast<double>(count);
    const double rounding = std::max(std::abs(low), std::abs(high)) * std::numeric_limits<double>::epsilon();
    if (high > low && pixel > rounding && std::isfinite(pixel)) return;
    throw Error(Status::range, name,
                "The window runs from " + text_of(low) + " to " + text_of(high) + " in " + std::to_string(count) +
                    " pixels; give ends that grow, and pixels that doubles can tell apart.")
        .with(high - low);
  };
  require_side(window.left, window.right, window.width, "window");
  require_side(window.bottom, window.top, window.height, "window");
}

void require_plane(const System& system) {
  if (system.dimension() == 2) return;
  throw Error(Status::shape, "system", "The system lies in space; project it to the plane first.")
      .with(system.dimension());
}

namespace {

// Plain double precision.
void run(Orbits<double>& orbits, const Coefficients<double>& maps, const Window& window, std::int64_t steps,
         const Tally* tally) {
  const Grid grid(window);
  for (std::int64_t step = 0; step < steps; ++step)
    for (std::size_t orbit = 0; orbit < orbit_count; ++orbit) {
      maps.step(orbits.random.next(orbit), orbits.x[orbit], orbits.y[orbit]);
      if (tally != nullptr) tally->count(grid.pixel(orbits.x[orbit], orbits.y[orbit]));
    }
}

// One chunk's points, the last few of them perhaps of some orbits alone.
template <class Real>
class Game {
 public:
  Game(const System& system, const Window& window, std::uint64_t seed, std::int64_t points)
      : maps_(system), window_(window), seed_(seed), points_(points), start_(system) {}

  std::int64_t chunks() const { return (points_ + points_per_chunk - 1) / points_per_chunk; }

  // Of points outside, how many.
  std::int64_t play(std::int64_t chunk, Histogram& histogram) const {
    const Tally tally = histogram.tally();
    Orbits<Real> orbits(seed_, static_cast<std::uint64_t>(chunk), start_.point);
    run(orbits, maps_, window_, start_.steps, nullptr);
    const std::int64_t points = std::min(points_per_chunk, points_ - chunk * points_per_chunk);
    constexpr auto side_by_side = static_cast<std::int64_t>(orbit_count);
    run(orbits, maps_, window_, points / side_by_side, &tally);
    for (std::size_t orbit = 0; orbit < static_cast<std::size_t>(points % side_by_side); ++orbit) {
      maps_.step(orbits.random.next(orbit), orbits.x[orbit], orbits.y[orbit]);
      tally.count(Grid(window_).pixel(static_cast<double>(orbits.x[orbit]), static_cast<double>(orbits.y[orbit])));
    }
    return histogram.take_outside();
  }

 private:
  Coefficients<Real> maps_;
  Window window_;
  std::uint64_t seed_;
  std::int64_t points_;
  Start start_;
};

// Histograms that are filled side by side, added up at the end: as many as there are threads, but a single one where
// more would take more memory than the counts themselves by a quarter.
std::int64_t histograms_of(const Window& window) {
  constexpr std::int64_t small = 1 << 24;  // pixels of all together, below which memory is no matter: 80 MB
  const auto threads = static_cast<std::int64_t>(std::thread::hardware_concurrency());
  return std::clamp(small / window.pixels(), std::int64_t{1}, std::max(threads, std::int64_t{1}));
}

template <class Real>
Counts play(const System& system, const Window& window, std::uint64_t seed, std::int64_t points, Watch& watch) {
  require_plane(system);
  require_window(window);
  static_cast<void>(system.enclosure());  // refuses what has no attractor
  in_range(points, 1, std::int64_t{1} << 50, "points");
  const Game<Real> game(system, window, seed, points);
  std::vector<Histogram> histograms;
  for (std::int64_t k = 0; k < histograms_of(window); ++k) histograms.emplace_back(window.pixels());
  const auto groups = static_cast<std::int64_t>(histograms.size());
  std::vector<std::int64_t> outside(histograms.size(), 0);
  // Rounds of chunks, between which progress is told. Sums do not depend on who counted what.
  for (std::int64_t done = 0; done < game.chunks(); done += groups) {
    parallel_for(std::min(groups, game.chunks() - done), 0, [&](std::int64_t group) {
      watch.poll();
      const auto g = static_cast<std::size_t>(group);
      outside[g] += game.play(done + group, histograms[g]);
    });
    watch.report(static_cast<double>(done) / static_cast<double>(game.chunks()), "points");
  }
  for (std::size_t g = 1; g < histograms.size(); ++g) histograms[0].add(histograms[g]);
  watch.finish();
  return {histograms[0].take(), points - std::accumulate(outside.begin(), outside.end(), std::int64_t{0})};
}

}  // namespace

bool single_precision_suffices(const System& system, const Window& window) {
  constexpr double most = 0x1p11 - 1;  // pixels: a float then is rounded to 2^-13 of one (orbits.cpp)
  const double size = system.enclosure().axes.norm();
  const Box box = bounding_box(system, size * 0x1p-20);
  const Grid grid(window);
  for (int axis = 0; axis < 2; ++axis) {
    const double pixels = axis == 0 ? grid.columns_per_unit : grid.rows_per_unit;
    const double largest =
        std::max({std::abs(box.low(axis)), std::abs(box.high(axis)), std::abs(axis == 0 ? window.left : window.bottom),
                  std::abs(axis == 0 ? window.right : window.top)});
    if (largest * pixels > most) return false;
    if (box.high(axis) - box.low(axis) < 0x1p-16 * size) return false;  // flat: all of it may lie on pixels' edges
    // Pieces that lie across an axis may lie on pixels' edges: their place must be exact.
    bool flat = false, kept = false;
    for (const int i : system.active()) {
      const Affine& map = system.maps()[static_cast<std::size_t>(i)];
      const double along = map.linear(axis, axis), across = map.linear(axis, 1 - axis), shift = map.shift(axis);
      if (along == 0 && across == 0) {
        flat = true;
        if (static_cast<double>(static_cast<float>(shift)) != shift) return false;
      } else if (along == 0 || across == 0) {
        kept = true;
      }
    }
    if (flat && kept) return false;
  }
  return true;
}

Counts chaos_counts(const System& system, const Window& window, std::uint64_t seed, std::int64_t points, Watch& watch) {
  require_plane(system);
  require_window(window);
  if (single_precision_suffices(system, window)) return play<float>(system, window, seed, points, watch);
  return play<double>(system, window, seed, points, watch);
}

Counts plain::chaos_counts(const System& system, const Window& window, std::uint64_t seed, std::int64_t points) {
  Watch watch;
  return play<double>(system, window, seed, points, watch);
}

}  // namespace ifsm::core
