// The chaos game's inner loop: 64 orbits side by side, whose choices and points do not depend on the machine's vectors.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "raster/chaos.h"
#include "raster/choice.h"
#include "raster/histogram.h"

namespace ifsm::core {

constexpr std::size_t orbit_count = 64;
constexpr std::int64_t points_per_chunk = 1 << 20;

// Random words of each orbit. Source: C. Doty-Humphrey's sfc32, of PractRand; begun by Philox, so that chunks are
// independent and need no order.
struct RandomWords {
  alignas(64) std::array<std::uint32_t, orbit_count> a, b, c, counter;

  RandomWords(std::uint64_t seed, std::uint64_t chunk);
  std::uint32_t next(std::size_t orbit) {
    const std::uint32_t word = a[orbit] + b[orbit] + counter[orbit]++;
    a[orbit] = b[orbit] ^ (b[orbit] >> 9);
    b[orbit] = c[orbit] + (c[orbit] << 3);
    c[orbit] = (c[orbit] << 21 | c[orbit] >> 11) + word;
    return word;
  }
};

template <class Real>
struct Orbits {
  RandomWords random;
  alignas(64) std::array<Real, orbit_count> x, y;

  Orbits(std::uint64_t seed, std::uint64_t chunk, const Vector3& start) : random(seed, chunk) {
    x.fill(static_cast<Real>(start(0)));
    y.fill(static_cast<Real>(start(1)));
  }
};

// x' = a x + b y + e, y' = c x + d y + f, by number of map; with zeros up to the choice's slots.
template <class Real>
struct Coefficients {
  explicit Coefficients(const System& system);

  Choice choice;
  std::vector<Real> a, b, c, d, e, f;

  void step(std::uint32_t random, Real& x, Real& y) const {
    const auto i = static_cast<std::size_t>(choice(random));
    const Real next = a[i] * x + b[i] * y + e[i];
    y = c[i] * x + d[i] * y + f[i];
    x = next;
  }
};

// Where all orbits begin, and how many steps each takes before its points count.
struct Start {
  static constexpr std::int64_t most_steps = 1 << 14;

  explicit Start(const System& system);

  int letter;     // of an active map
  Vector3 point;  // which that map leaves where it is: the letter repeated for ever is its address
  // After which a point has forgotten where it began, to 2^-32 of the attractor's size: the longest of some hundred
  // random words whose products shrink to that.
  std::int64_t steps;
};

// `steps` steps of all orbits, counted in the pixels of the window, or not at all where there is no tally.
void run(Orbits<float>& orbits, const Coefficients<float>& maps, const Window& window, std::int64_t steps,
         const Tally* tally);

// `steps` steps of all orbits, of the same points as Coefficients::step's. Tells the pixels of those in the window,
// step by step, and how many; `pixels` has room for all points and `beyond_pixels` more. Null: steps alone.
constexpr std::size_t beyond_pixels = 16;
std::size_t run(Orbits<double>& orbits, const Coefficients<double>& maps, const Window& window, std::int64_t steps,
                std::int32_t* pixels);

}  // namespace ifsm::core
