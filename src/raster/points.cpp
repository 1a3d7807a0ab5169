#include "raster/points.h"

#include <algorithm>
#include <cstddef>

#include "base/error.h"
#include "base/parallel.h"
#include "raster/walk.h"

namespace ifsm::core {
namespace {

// What maps the orbits of one chunk have taken, a byte each; before the first step, the one that where they begin is
// the fixed point of.
class Letters {
 public:
  static_assert(System::most_maps <= 256);

  Letters(std::int64_t length, std::int64_t steps, int before)
      : length_(static_cast<std::size_t>(length)),
        stride_(length == 0 ? 0 : static_cast<std::size_t>(length + steps)),
        taken_(orbit_count * stride_, static_cast<std::uint8_t>(before)) {}

  bool wanted() const { return length_ != 0; }
  void take(std::size_t orbit, std::size_t step, int map) { *at(orbit, step) = static_cast<std::uint8_t>(map); }

  // From that step backwards.
  void tell(std::size_t orbit, std::size_t step, std::int32_t* letters) {
    const std::uint8_t* last = at(orbit, step);
    for (std::size_t k = 0; k < length_; ++k) letters[k] = *(last - k);
  }

 private:
  std::uint8_t* at(std::size_t orbit, std::size_t step) { return taken_.data() + orbit * stride_ + length_ + step; }

  std::size_t length_, stride_;
  std::vector<std::uint8_t> taken_;  // orbit by orbit
};

template <std::size_t d>
class Sampler {
 public:
  Sampler(const System& system, std::uint64_t seed, std::int64_t length)
      : maps_(system), start_(system), seed_(seed), length_(length) {}

  // So many of the chunk's points.
  void play(std::int64_t chunk, std::size_t count, double* points, std::int32_t* letters, const Watch& watch) const {
    const auto forget = static_cast<std::size_t>(start_.steps), steps = (count + orbit_count - 1) / orbit_count;
    Letters taken(length_, static_cast<std::int64_t>(forget + steps), start_.letter);
    walk<d>(maps_, start_, seed_, chunk, static_cast<std::int64_t>(steps), watch,
            [&](std::int64_t step, std::size_t orbit, const auto& x, int letter) {
              if (taken.wanted()) taken.take(orbit, static_cast<std::size_t>(step), letter);
              if (step < start_.steps) return;
              const std::size_t place = (static_cast<std::size_t>(step) - forget) * orbit_count + orbit;
              if (place >= count) return;
              if (points != nullptr) std::copy_n(x.begin(), d, points + place * d);
              if (taken.wanted())
                taken.tell(orbit, static_cast<std::size_t>(step), letters + place * static_cast<std::size_t>(length_));
            });
  }

 private:
  WalkMaps<d> maps_;
  Start start_;
  std::uint64_t seed_;
  std::int64_t length_;
};

template <std::size_t d>
void sample(const System& system, std::uint64_t seed, std::int64_t count, double* points, std::int64_t length,
            std::int32_t* letters, Watch& watch) {
  const Sampler<d> sampler(system, seed, letters == nullptr ? 0 : length);
  const std::int64_t chunks = (count + points_per_chunk - 1) / points_per_chunk;
  const std::int64_t round = threads_at_once();
  for (std::int64_t done = 0; done < chunks; done += round) {  // between rounds, progress is told
    parallel_for(std::min(round, chunks - done), 0, [&](std::int64_t within) {
      const std::int64_t first = (done + within) * points_per_chunk;
      const auto wanted = static_cast<std::size_t>(std::min(points_per_chunk, count - first));
      sampler.play(done + within, wanted, points == nullptr ? nullptr : points + first * static_cast<std::int64_t>(d),
                   letters == nullptr ? nullptr : letters + first * length, watch);
    });
    watch.report(static_cast<double>(std::min(done + round, chunks)) / static_cast<double>(chunks), "points");
  }
  watch.finish();
}

}  // namespace

void tell_points(const System& system, std::uint64_t seed, std::int64_t count, double* points, std::int64_t length,
                 std::int32_t* letters, Watch& watch) {
  static_cast<void>(system.enclosure());  // refuses what has no attractor
  in_range(count, 1, std::int64_t{1} << 40, "count");
  in_range(length, 0, most_letters, "length");
  if (system.dimension() == 2)
    sample<2>(system, seed, count, points, length, letters, watch);
  else
    sample<3>(system, seed, count, points, length, letters, watch);
}

ChaosPoints chaos_points(const System& system, std::uint64_t seed, std::int64_t count, std::int64_t length,
                         Watch& watch) {
  in_range(count, 1, std::int64_t{1} << 40, "count");
  in_range(length, 0, most_letters, "length");
  ChaosPoints told;
  told.points.resize(static_cast<std::size_t>(count * system.dimension()));
  told.letters.resize(static_cast<std::size_t>(count * length));
  tell_points(system, seed, count, told.points.data(), length, length == 0 ? nullptr : told.letters.data(), watch);
  return told;
}

}  // namespace ifsm::core
