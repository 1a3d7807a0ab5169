// The chaos game into windows that no cache holds: time, and memory at its peak, beside the same points counted where
// they fall, one after the other. bench_large [pixels a side] [million points]
#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <numeric>

#include "base/parallel.h"
#include "raster/chaos.h"
#include "raster/orbits.h"
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

double peak_bytes() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return 1024.0 * static_cast<double>(used.ru_maxrss);
}

// The vectors' points, each counted at once: what sorting is to be faster than.
double at_once(const System& system, const Window& window, std::int64_t chunks, std::vector<std::uint32_t>& counts) {
  const Coefficients<double> maps(system);
  const Start start(system);
  constexpr std::int64_t steps = 64;
  std::vector<std::int32_t> pixels(steps * orbit_count + beyond_pixels);
  return seconds([&] {
    for (std::int64_t chunk = 0; chunk < chunks; ++chunk) {
      Orbits<double> orbits(1, static_cast<std::uint64_t>(chunk), start.point);
      run(orbits, maps, window, start.steps, nullptr);
      for (std::int64_t step = 0; step < points_per_chunk / static_cast<std::int64_t>(orbit_count); step += steps) {
        const std::size_t inside = run(orbits, maps, window, steps, pixels.data());
        for (std::size_t k = 0; k < inside; ++k) ++counts[static_cast<std::size_t>(pixels[k])];
      }
    }
  });
}

void compare(const char* name, std::int64_t side, std::int64_t millions) {
  const auto system = named_system(name);
  const Box box = bounding_box(*system, 1e-6 * system->enclosure().axes.norm());
  const Window window{box.low(0), box.low(1), box.high(0), box.high(1), side, side};
  const std::int64_t chunks = std::max(millions * 1'000'000 / points_per_chunk, std::int64_t{8});
  const auto ours = [&](int threads, std::int64_t points) {
    const Threads most(threads);
    Watch watch;
    return seconds([&] { chaos_counts(*system, window, 1, points, watch); });
  };
  const double empty = ours(1, 1);  // asking for the memory, and giving it back
  const auto ns = [&](double time) { return 1e9 * time / static_cast<double>(chunks * points_per_chunk); };
  const double one = ours(1, chunks * points_per_chunk), two = ours(2, chunks * points_per_chunk);
  const double peak = peak_bytes() / (4.0 * static_cast<double>(window.pixels()));
  std::vector<std::uint32_t> counts(static_cast<std::size_t>(window.pixels()));
  const std::int64_t fewer = std::max(chunks / 8, std::int64_t{1});  // it takes long
  const double single =
      at_once(*system, window, fewer, counts) * static_cast<double>(chunks) / static_cast<double>(fewer);
  std::printf(
      "%-12s %5lld^2, %5.0f million points: memory %4.2f s; a point in ns: one thread %5.2f, two %5.2f (%4.2f), at "
      "once %6.2f (%4.2f); peak %5.3f times the counts\n",
      name, static_cast<long long>(side), 1e-6 * static_cast<double>(chunks * points_per_chunk), empty, ns(one - empty),
      ns(two - empty), (one - empty) / (two - empty), ns(single), single / (one - empty), peak);
  std::fflush(stdout);
}

}  // namespace

int main(int count, char** arguments) {
  const std::int64_t side = count > 1 ? std::atoll(arguments[1]) : 8192;
  const std::int64_t millions = count > 2 ? std::atoll(arguments[2]) : 500;
  for (const char* name : {"fern", "gasket", "twin_dragon"}) compare(name, side, millions);
}
