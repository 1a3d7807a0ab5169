#include "raster/chaos.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/parallel.h"
#include "raster/bands.h"
#include "raster/histogram.h"
#include "raster/orbits.h"
#include "raster/parts.h"
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

void require_tolerance(double tolerance, double rounding) {
  if (!(rounding < 1))
    throw Error(
        Status::range, "window",
        "Rounding, added up over long words, may move points of this window by more than a pixel; give larger or fewer "
        "pixels, or a window and a system that are not so far from the origin for their size.")
        .with(rounding);
  if (tolerance > rounding && tolerance <= 1) return;
  throw Error(Status::range, "tolerance",
              "tolerance is " + text_of(tolerance) + " of a pixel; give one above " + text_of(rounding) +
                  ", what rounding does to points of this window, up to 1.")
      .with(tolerance);
}

void require_plane(const System& system) {
  if (system.dimension() == 2) return;
  throw Error(Status::shape, "system",
              "The system lies in space; counts, sets and distances are those of systems of the plane.")
      .with(system.dimension());
}

namespace {

template <class Real>
struct Game {
  Game(const System& system, const Window& in, std::uint64_t seeded, std::int64_t count)
      : maps(system), window(in), seed(seeded), points(count), start(system) {}

  std::int64_t chunks() const { return (points + points_per_chunk - 1) / points_per_chunk; }
  Orbits<Real> orbits(std::int64_t chunk) const { return {seed, static_cast<std::uint64_t>(chunk), start.point}; }

  // A chunk's points: so many steps of all orbits, and one more of the first few.
  std::int64_t points_of(std::int64_t chunk) const {
    return std::min(points_per_chunk, points - chunk * points_per_chunk);
  }
  std::int64_t steps(std::int64_t chunk) const { return points_of(chunk) / side_by_side; }
  std::size_t rest(std::int64_t chunk) const { return static_cast<std::size_t>(points_of(chunk) % side_by_side); }

  // The pixel of an orbit's next point.
  std::int64_t next(Orbits<Real>& orbits, std::size_t orbit) const {
    maps.step(orbits.random.next(orbit), orbits.x[orbit], orbits.y[orbit]);
    return Grid(window).pixel(static_cast<double>(orbits.x[orbit]), static_cast<double>(orbits.y[orbit]));
  }

  Coefficients<Real> maps;
  Window window;
  std::uint64_t seed;
  std::int64_t points;
  Start start;

 private:
  static constexpr auto side_by_side = static_cast<std::int64_t>(orbit_count);
};

// Plays a chunk, and tells how many of its points are inside.
std::int64_t play(const Game<float>& game, std::int64_t chunk, Histogram& histogram) {
  const Tally tally = histogram.tally();
  Orbits<float> orbits = game.orbits(chunk);
  run(orbits, game.maps, game.window, game.start.steps, nullptr);
  run(orbits, game.maps, game.window, game.steps(chunk), &tally);
  for (std::size_t orbit = 0; orbit < game.rest(chunk); ++orbit) tally.count(game.next(orbits, orbit));
  return game.points_of(chunk) - histogram.take_outside();
}

// Plain double precision.
std::int64_t play_plain(const Game<double>& game, std::int64_t chunk, Histogram& histogram) {
  const Tally tally = histogram.tally();
  Orbits<double> orbits = game.orbits(chunk);
  for (std::int64_t step = 0; step < game.start.steps; ++step)
    for (std::size_t orbit = 0; orbit < orbit_count; ++orbit) game.next(orbits, orbit);
  for (std::int64_t step = 0; step < game.steps(chunk); ++step)
    for (std::size_t orbit = 0; orbit < orbit_count; ++orbit) tally.count(game.next(orbits, orbit));
  for (std::size_t orbit = 0; orbit < game.rest(chunk); ++orbit) tally.count(game.next(orbits, orbit));
  return game.points_of(chunk) - histogram.take_outside();
}

// Tells the pixels of the points that are inside, as many at once as `room` holds before what is beyond them.
template <class Take>
std::int64_t play(const Game<double>& game, std::int64_t chunk, std::span<std::int32_t> room, const Take& take) {
  const auto at_once = static_cast<std::int64_t>((room.size() - beyond_pixels) / orbit_count);
  Orbits<double> orbits = game.orbits(chunk);
  run(orbits, game.maps, game.window, game.start.steps, nullptr);
  std::int64_t inside = 0;
  const std::int64_t steps = game.steps(chunk);
  for (std::int64_t step = 0; step <= steps; step += at_once) {
    const std::int64_t now = std::min(at_once, steps - step);
    std::size_t count = run(orbits, game.maps, game.window, now, room.data());
    for (std::size_t orbit = 0; now < at_once && orbit < game.rest(chunk); ++orbit) {
      const std::int64_t pixel = game.next(orbits, orbit);
      if (pixel != game.window.pixels()) room[count++] = static_cast<std::int32_t>(pixel);
    }
    if (count > 0) take(room.first(count));
    inside += static_cast<std::int64_t>(count);
  }
  return inside;
}

// Of all histograms together, below which memory is no matter: 80 MB.
constexpr std::int64_t small_pixels = 2 * counted_in_place;

// Histograms that are filled side by side, added up at the end: as many as there are threads, but a single one where
// more would take more memory than the counts themselves by a quarter.
std::int64_t histograms_of(const Window& window) {
  return std::clamp(small_pixels / window.pixels(), std::int64_t{1}, threads_at_once());
}

// play(chunk, histogram) tells how many points are inside.
template <class Real, class Play>
Counts in_histograms(const Game<Real>& game, Watch& watch, const Play& play) {
  std::vector<Histogram> histograms;
  for (std::int64_t k = 0; k < histograms_of(game.window); ++k) histograms.emplace_back(game.window.pixels());
  const auto groups = static_cast<std::int64_t>(histograms.size());
  std::vector<std::int64_t> inside(histograms.size(), 0);
  // Rounds of chunks, between which progress is told. Sums do not depend on who counted what.
  for (std::int64_t done = 0; done < game.chunks(); done += groups) {
    parallel_for(std::min(groups, game.chunks() - done), 0, [&](std::int64_t group) {
      watch.poll();
      const auto g = static_cast<std::size_t>(group);
      inside[g] += play(done + group, histograms[g]);
    });
    watch.report(static_cast<double>(done) / static_cast<double>(game.chunks()), "points");
  }
  for (std::size_t g = 1; g < histograms.size(); ++g) histograms[0].add(histograms[g]);
  watch.finish();
  return {histograms[0].take(), std::accumulate(inside.begin(), inside.end(), std::int64_t{0})};
}

// All pages of large memory are asked for here, which may take seconds: not without a poll.
void clear(std::span<std::uint32_t> counts, const Watch& watch) {
  for_parts(counts.size(), watch,
            [&](std::size_t first, std::size_t end) { std::ranges::fill(counts.subspan(first, end - first), 0U); });
}

// Rounds of chunks are sorted, and then added.
std::int64_t in_bands(const Game<double>& game, std::span<std::uint32_t> counts, Watch& watch) {
  constexpr std::int64_t pieces = points_per_chunk / Bands::piece;  // a chunk
  clear(counts, watch);
  Bands bands(counts, pieces * game.chunks(), threads_at_once());
  const std::int64_t round = bands.slots() / pieces;
  std::vector<std::int64_t> inside(static_cast<std::size_t>(bands.groups()), 0);
  const auto fraction = [&](double chunks) { return chunks / static_cast<double>(game.chunks()); };
  for (std::int64_t done = 0; done < game.chunks(); done += round) {
    const std::int64_t chunks = std::min(round, game.chunks() - done);
    // Both take about as long.
    const auto begin = static_cast<double>(done), end = begin + static_cast<double>(chunks), half = (begin + end) / 2;
    Watch sorting = watch.part(fraction(begin), fraction(half)), adding = watch.part(fraction(half), fraction(end));
    for (std::int64_t first = 0; first < chunks; first += bands.groups()) {
      parallel_for(std::min(bands.groups(), chunks - first), 0, [&](std::int64_t group) {
        watch.poll();
        std::int64_t slot = (first + group) * pieces;
        const auto sort = [&](std::span<const std::int32_t> pixels) { bands.sort(pixels, group, slot++); };
        inside[static_cast<std::size_t>(group)] += play(game, done + first + group, bands.room(group), sort);
      });
      sorting.report(static_cast<double>(first) / static_cast<double>(chunks), "points");
    }
    bands.add(adding);
  }
  watch.finish();
  return std::accumulate(inside.begin(), inside.end(), std::int64_t{0});
}

void require(const System& system, const Window& window, std::int64_t points) {
  require_plane(system);
  require_window(window);
  static_cast<void>(system.enclosure());  // refuses what has no attractor
  in_range(points, 1, std::int64_t{1} << 50, "points");
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
  require(system, window, points);
  if (window.pixels() > counted_in_place) {
    Counts counts{std::vector<std::uint32_t>(static_cast<std::size_t>(window.pixels())), 0};
    counts.inside = count_in_place(system, window, seed, points, counts.pixels, watch);
    return counts;
  }
  if (single_precision_suffices(system, window)) {
    const Game<float> game(system, window, seed, points);
    return in_histograms(game, watch, [&](std::int64_t chunk, Histogram& all) { return play(game, chunk, all); });
  }
  const Game<double> game(system, window, seed, points);
  return in_histograms(game, watch, [&](std::int64_t chunk, Histogram& all) {
    std::array<std::int32_t, Histogram::most_at_once + beyond_pixels> room;
    return play(game, chunk, room, [&](std::span<const std::int32_t> pixels) { all.count(pixels); });
  });
}

std::int64_t count_in_place(const System& system, const Window& window, std::uint64_t seed, std::int64_t points,
                            std::span<std::uint32_t> counts, Watch& watch) {
  require(system, window, points);
  // In histograms these would leave a single thread.
  if (window.pixels() > counted_in_place) return in_bands(Game<double>(system, window, seed, points), counts, watch);
  const Counts made = chaos_counts(system, window, seed, points, watch);
  std::ranges::copy(made.pixels, counts.begin());
  return made.inside;
}

Counts plain::chaos_counts(const System& system, const Window& window, std::uint64_t seed, std::int64_t points) {
  require(system, window, points);
  const Game<double> game(system, window, seed, points);
  Watch watch;
  return in_histograms(game, watch, [&](std::int64_t chunk, Histogram& all) { return play_plain(game, chunk, all); });
}

}  // namespace ifsm::core
