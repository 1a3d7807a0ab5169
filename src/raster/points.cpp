#include "raster/points.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <thread>

#include "base/error.h"
#include "base/parallel.h"
#include "raster/orbits.h"

namespace ifsm::core {
namespace {

// Maps of d dimensions, row by row: coefficients, then the shift. Sums are taken as Coefficients::step takes them.
template <std::size_t d>
class Maps {
 public:
  explicit Maps(const System& system) : choice_(system.probabilities()) {
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
  int step(std::uint32_t random, double* x) const {
    const int map = choice_(random);
    const auto& rows = rows_[static_cast<std::size_t>(map)];
    std::array<double, d> before;
    std::copy_n(x, d, before.begin());
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

// What maps the orbits of one chunk have taken, a byte each; before the first step, the one that where they begin is
// the fixed point of.
class Letters {
 public:
  static_assert(System::most_maps <= 256);

  Letters(std::int64_t length, std::int64_t steps, int before)
      : length_(static_cast<std::size_t>(length)),
        stride_(length == 0 ? 0 : static_cast<std::size_t>(length + steps)),
        taken_(orbit_count * stride_, static_cast<std::uint8_t>(before)),
        step_(length_) {}

  bool wanted() const { return length_ != 0; }
  void take(std::size_t orbit, int map) { taken_[orbit * stride_ + step_] = static_cast<std::uint8_t>(map); }
  void end_step() { ++step_; }

  // Of the step that has not ended yet, backwards.
  void tell(std::size_t orbit, std::int32_t* letters) const {
    const std::uint8_t* last = taken_.data() + orbit * stride_ + step_;
    for (std::size_t k = 0; k < length_; ++k) letters[k] = *(last - k);
  }

 private:
  std::size_t length_, stride_;
  std::vector<std::uint8_t> taken_;  // orbit by orbit
  std::size_t step_;
};

template <std::size_t d>
class Sampler {
 public:
  Sampler(const System& system, std::uint64_t seed, std::int64_t length)
      : maps_(system), start_(system), seed_(seed), length_(length) {}

  // The chunk's points, as many as there is room for.
  void play(std::int64_t chunk, std::span<double> points, std::int32_t* letters, const Watch& watch) const {
    const std::size_t count = points.size() / d;
    const auto forget = static_cast<std::size_t>(start_.steps), steps = (count + orbit_count - 1) / orbit_count;
    RandomWords random(seed_, static_cast<std::uint64_t>(chunk));
    Letters taken(length_, static_cast<std::int64_t>(forget + steps), start_.letter);
    std::array<double, orbit_count * d> x;
    for (std::size_t k = 0; k < x.size(); k += d) std::copy_n(start_.point.data(), d, &x[k]);
    for (std::size_t step = 0; step < forget + steps; ++step) {
      if (step % steps_per_poll == 0) watch.poll();
      for (std::size_t orbit = 0; orbit < orbit_count; ++orbit) {
        const int map = maps_.step(random.next(orbit), &x[orbit * d]);
        if (taken.wanted()) taken.take(orbit, map);
      }
      const std::size_t first = step < forget ? count : (step - forget) * orbit_count;  // none is told yet
      const std::size_t told = std::min(orbit_count, count - first);
      std::copy_n(x.begin(), told * d, points.begin() + static_cast<std::ptrdiff_t>(first * d));
      if (!taken.wanted()) continue;
      for (std::size_t orbit = 0; orbit < told; ++orbit)
        taken.tell(orbit, letters + (first + orbit) * static_cast<std::size_t>(length_));
      taken.end_step();
    }
  }

 private:
  static constexpr std::size_t steps_per_poll = 32;  // 2048 points: some µs, and with all letters some 10 ms

  Maps<d> maps_;
  Start start_;
  std::uint64_t seed_;
  std::int64_t length_;
};

template <std::size_t d>
ChaosPoints sample(const System& system, std::uint64_t seed, std::int64_t count, std::int64_t length, Watch& watch) {
  const Sampler<d> sampler(system, seed, length);
  ChaosPoints told;
  told.points.resize(static_cast<std::size_t>(count) * d);
  told.letters.resize(static_cast<std::size_t>(count * length));
  const std::int64_t chunks = (count + points_per_chunk - 1) / points_per_chunk;
  const auto round = std::max(std::int64_t{std::thread::hardware_concurrency()}, std::int64_t{1});
  for (std::int64_t done = 0; done < chunks; done += round) {  // between rounds, progress is told
    parallel_for(std::min(round, chunks - done), 0, [&](std::int64_t within) {
      const std::int64_t first = (done + within) * points_per_chunk;
      const std::int64_t points = std::min(points_per_chunk, count - first);
      sampler.play(done + within,
                   {told.points.data() + static_cast<std::size_t>(first) * d, static_cast<std::size_t>(points) * d},
                   told.letters.data() + first * length, watch);
    });
    watch.report(static_cast<double>(std::min(done + round, chunks)) / static_cast<double>(chunks), "points");
  }
  watch.finish();
  return told;
}

}  // namespace

ChaosPoints chaos_points(const System& system, std::uint64_t seed, std::int64_t count, std::int64_t length,
                         Watch& watch) {
  static_cast<void>(system.enclosure());  // refuses what has no attractor
  in_range(count, 1, std::int64_t{1} << 40, "count");
  in_range(length, 0, most_letters, "length");
  return system.dimension() == 2 ? sample<2>(system, seed, count, length, watch)
                                 : sample<3>(system, seed, count, length, watch);
}

}  // namespace ifsm::core
