// The set of pixels that an attractor meets, 1024 x 1024, tolerance 1/64, beside a plain recursion to half-pixel balls,
// which proves nothing: milliseconds, the least of several, in turns (the short ones twice: the first finds the caches
// that the other one left); processor time of one thread, wall time of two. Aim: a tenth of the recursion's for the
// fern.
//   bench_set [turns [name …]]
#include "raster/set.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <string>

#include "base/parallel.h"
#include "set_textbook.h"
#include "system/named.h"
#include "system/reach.h"

using namespace ifsm::core;

namespace {

constexpr std::int64_t size = 1024;
constexpr double tolerance = 1. / 64;

struct Recursion {
  std::vector<PixelMap> maps;
  PixelMap whole;
  double radius;
  std::vector<std::uint8_t> marks = std::vector<std::uint8_t>(size * size);

  std::int64_t run() {
    std::fill(marks.begin(), marks.end(), std::uint8_t{0});
    return textbook_set(maps, whole, radius, size, size, marks.data());
  }
};

// The maps about the middle of the box, in pixels; the ball is the one about the box, or the largest distance in it.
Recursion recursion_of(const System& system, const Window& window, const Box& box) {
  const Grid grid(window);
  const double across = grid.columns_per_unit, down = -grid.rows_per_unit;
  const Vector3 middle = (box.low + box.high) / 2;
  std::vector<PixelMap> maps;
  for (const int i : system.active()) {
    const Affine& map = system.maps()[static_cast<std::size_t>(i)];
    const Vector3 moved = map(middle) - middle;
    maps.push_back({map.linear(0, 0), map.linear(0, 1) * across / down, map.linear(1, 0) * down / across,
                    map.linear(1, 1), moved(0) * across, moved(1) * down});
  }
  // Of the attractor, not of its box: a ball as small as can be had.
  std::vector<Affine> in_pixels;
  for (const PixelMap& m : maps) {
    Affine map;
    map.linear.topLeftCorner<2, 2>() << m.a, m.b, m.c, m.d;
    map.shift << m.e, m.f, 0;
    in_pixels.push_back(map);
  }
  const double radius = farthest(System(2, in_pixels), Vector3::Zero(), 1e-3);
  return {maps, {1, 0, 0, 1, (middle(0) - window.left) * across, (middle(1) - window.top) * down}, radius};
}

// Of this process, so that others on the machine count little.
template <class Call>
double processor_milliseconds(const Call& call) {
  const std::clock_t start = std::clock();
  call();
  return 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

template <class Call>
double milliseconds(const Call& call) {
  const auto start = std::chrono::steady_clock::now();
  call();
  return 1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void compare(const std::string& name, int turns) {
  const auto system = named_system(name);
  const Box box = bounding_box(*system, 1e-6 * system->enclosure().axes.norm());
  const Window window{box.low(0), box.low(1), box.high(0), box.high(1), size, size};
  Recursion recursion = recursion_of(*system, window, box);
  constexpr double never = std::numeric_limits<double>::infinity();
  double plain = never, one = never, two = never;
  std::int64_t words = 0;
  std::vector<Meets> states;
  const auto ours = [&](int threads) {
    const Threads most(threads);
    Watch watch;
    states = set_pixels(*system, window, tolerance, watch);
  };
  for (int turn = 0; turn < turns; ++turn) {
    plain = std::min(plain, processor_milliseconds([&] { words = recursion.run(); }));
    for (int again = 0; again < 2; ++again) one = std::min(one, processor_milliseconds([&] { ours(1); }));
    for (int again = 0; again < 2; ++again) two = std::min(two, milliseconds([&] { ours(2); }));
  }
  // Where the recursion marks what is proven to be empty.
  std::int64_t wrong = 0;
  for (std::size_t k = 0; k < states.size(); ++k) wrong += states[k] == Meets::no && recursion.marks[k] == 1;
  const auto count = [&](Meets wanted) { return static_cast<long>(std::count(states.begin(), states.end(), wanted)); };
  std::printf(
      "%-16s recursion %7.1f ms %9ld words   one thread %6.1f ms, %6.1f times as fast   two %6.1f ms, %6.1f times   "
      "met %7ld undecided %6ld; marked though empty %ld\n",
      name.c_str(), plain, static_cast<long>(words), one, plain / one, two, plain / two, count(Meets::yes),
      count(Meets::undecided), static_cast<long>(wrong));
}

}  // namespace

int main(int argc, char** argv) {
  const int turns = argc > 1 ? std::atoi(argv[1]) : 7;
  std::vector<std::string> names(argv + std::min(argc, 2), argv + argc);
  if (names.empty())
    names = {"fern", "gasket", "carpet", "maple_leaf", "tree_type2", "fern_cyclosorus", "heighway_dragon"};
  for (const std::string& name : names) compare(name, turns);
}
