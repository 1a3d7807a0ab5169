// The chaos game into a histogram of 1024 x 1024 pixels, beside a plain loop in double precision: points a second,
// medians of several, in turns. The bounds: one thread 4 times the plain loop, two threads 1.7 times one. Then
// a part of the attractor ten times enlarged, which takes double precision: that of 2 times the plain loop is the aim.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>

#include "base/parallel.h"
#include "chaos_textbook.h"
#include "raster/chaos.h"
#include "system/named.h"
#include "system/reach.h"

using namespace ifsm::core;

namespace {

template <class Call>
double seconds(const Call& call) {
  const auto start = std::chrono::steady_clock::now();
  call();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

std::vector<TextbookMap> textbook(const System& system) {
  std::vector<TextbookMap> maps;
  double until = 0;
  for (std::size_t i = 0; i < system.maps().size(); ++i) {
    const Affine& m = system.maps()[i];
    until += system.probabilities()[i];
    maps.push_back({m.linear(0, 0), m.linear(0, 1), m.linear(1, 0), m.linear(1, 1), m.shift(0), m.shift(1), until});
  }
  maps.back().until = 2;
  return maps;
}

void compare(const char* name, bool enlarged) {
  constexpr std::int64_t points = 100'000'000, fewer = points / 4;
  constexpr int turns = 7;
  const auto system = named_system(name);
  const Box box = bounding_box(*system, 1e-6 * system->enclosure().axes.norm());
  const double from = enlarged ? .4 : 0, part = enlarged ? .1 : 1;
  const Vector3 low = box.low + from * (box.high - box.low), high = low + part * (box.high - box.low);
  const Window window{low(0), low(1), high(0), high(1), 1024, 1024};
  const Grid grid(window);
  const auto maps = textbook(*system);
  std::vector<std::uint32_t> counts(static_cast<std::size_t>(window.pixels()));
  const auto ours = [&](int threads) {
    return seconds([&] {
      const Threads most(threads);
      Watch watch;
      chaos_counts(*system, window, 1, points, watch);
    });
  };
  std::vector<double> plain, one, two, over_plain, over_one;
  for (int turn = 0; turn < turns; ++turn) {
    plain.push_back(points / fewer * seconds([&] {
                      textbook_chaos(maps, {grid.left, grid.top, grid.columns_per_unit, grid.rows_per_unit, 1024, 1024},
                                     fewer, counts.data());
                    }));
    one.push_back(ours(1));
    two.push_back(ours(2));
    over_plain.push_back(plain.back() / one.back());
    over_one.push_back(one.back() / two.back());
  }
  const auto rate = [&](const std::vector<double>& times) {
    return 1e-6 * static_cast<double>(points) / median(times);
  };
  std::printf("%-12s %-8s plain %5.0f   one thread %5.0f   two %5.0f million/s   one/plain %5.2f   two/one %4.2f\n",
              name, enlarged ? "enlarged" : "whole", rate(plain), rate(one), rate(two), median(over_plain),
              median(over_one));
}

}  // namespace

int main() {
  for (const bool enlarged : {false, true})
    for (const char* name : {"fern", "gasket", "twin_dragon", "maple_leaf", "carpet"}) compare(name, enlarged);
}
