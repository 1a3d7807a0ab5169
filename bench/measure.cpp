// Questions asked of a coast-like curve of 2^17 segments, beside the same by comparing with every segment or pair.
#include <benchmark/benchmark.h>

#include <cmath>
#include <map>

#include "base/parallel.h"
#include "base/random.h"
#include "measure/crossings.h"
#include "measure/nearest.h"

namespace {

using namespace ifsm::core;

// A ring by midpoint displacement, each midpoint off by a quarter of its segment's length, normally: dimension 1.3.
const Polyline& coast(Index segments) {
  static std::map<Index, Polyline> made;
  if (const auto found = made.find(segments); found != made.end()) return found->second;
  Points points(2, 4);
  points.matrix() << 0, 0, 1, 0, 1, 1, 0, 1;
  for (std::uint32_t level = 0; points.count() < segments; ++level) {
    Points fine(2, 2 * points.count());
    for (Index k = 0; k < points.count(); ++k) {
      const Eigen::RowVector2d a = points.matrix().row(k), b = points.matrix().row((k + 1) % points.count());
      const auto random = normal_pair(1, level, static_cast<std::uint64_t>(k));
      fine.matrix().row(2 * k) = a;
      fine.matrix().row(2 * k + 1) = (a + b) / 2 + 0.25 * random[0] * Eigen::RowVector2d(a(1) - b(1), b(0) - a(0));
    }
    points = fine;
  }
  return made.emplace(segments, Polyline(points, true)).first->second;
}

Points queries(Index count) {
  Points points(2, count);
  for (Index k = 0; k < count; ++k) {
    const auto random = normal_pair(2, 0, static_cast<std::uint64_t>(k));
    points.matrix().row(k) << 0.5 + 0.5 * random[0], 0.5 + 0.5 * random[1];
  }
  return points;
}

void nearest_by_tree(benchmark::State& state) {
  const Polyline& curve = coast(1 << 17);
  const Points asked = queries(10000);
  set_default_threads(1);
  for (auto _ : state) benchmark::DoNotOptimize(nearest(curve, asked));
  set_default_threads(0);
  state.SetItemsProcessed(state.iterations() * asked.count());
}
BENCHMARK(nearest_by_tree)->Unit(benchmark::kMillisecond);

void nearest_by_all(benchmark::State& state) {
  const Polyline& curve = coast(1 << 17);
  const Points asked = queries(50);
  set_default_threads(1);
  for (auto _ : state) benchmark::DoNotOptimize(plain::nearest(curve, asked));
  set_default_threads(0);
  state.SetItemsProcessed(state.iterations() * asked.count());
}
BENCHMARK(nearest_by_all)->Unit(benchmark::kMillisecond);

void crossings_by_tree(benchmark::State& state) {
  const Polyline& curve = coast(state.range(0));
  std::size_t found = 0;
  for (auto _ : state) found = crossings(curve).size();
  state.counters["crossings"] = static_cast<double>(found);
}
BENCHMARK(crossings_by_tree)->Arg(1 << 13)->Arg(1 << 17)->Unit(benchmark::kMillisecond);

void crossings_by_all(benchmark::State& state) {
  const Polyline& curve = coast(state.range(0));
  std::size_t found = 0;
  for (auto _ : state) found = plain::crossings(curve).size();
  state.counters["crossings"] = static_cast<double>(found);
}
BENCHMARK(crossings_by_all)->Arg(1 << 13)->Unit(benchmark::kMillisecond);

}  // namespace
