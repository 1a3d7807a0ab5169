// Analysis and synthesis of 2^20 points in the plane, n = 5, N = 2, one core, beside a copy of the same memory and the
// plain formula. The peer is PyWavelets: bench/wavelet_speed.py.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "base/parallel.h"
#include "curve/named.h"
#include "curve/transform.h"

namespace {

using namespace ifsm::core;

constexpr int levels = 18;  // 4 · 2^18 + 1 = 2^20 + 1 places

struct Lines {
  explicit Lines(const Shape& shape) {
    for (int level = 0; level <= levels; ++level) line.emplace_back(static_cast<std::size_t>(shape.line_length(level)));
    for (int level = 0; level < levels; ++level)
      details.emplace_back(static_cast<std::size_t>(shape.detail_count(level)));
    for (std::size_t k = 0; k < line.back().size(); ++k) line.back()[k] = std::sin(0.001 * static_cast<double>(k));
  }
  std::vector<std::vector<double>> line, details;
};

template <class Analyze, class Synthesize>
void there_and_back(benchmark::State& state, const Analyze& analyze, const Synthesize& synthesize) {
  const FilterPtr filter = named_filter("casteljau", Topology::joined, 5, 2);
  Lines planes[2] = {Lines(filter->shape()), Lines(filter->shape())};
  set_default_threads(static_cast<int>(state.range(0)));
  for (auto _ : state)
    for (Lines& plane : planes) {
      analyze(*filter, plane);
      synthesize(*filter, plane);
      benchmark::ClobberMemory();
    }
  set_default_threads(0);
  state.SetItemsProcessed(state.iterations() * (1 << 20));
}

void fast(benchmark::State& state) {
  there_and_back(
      state,
      [](const Filter& filter, Lines& plane) {
        analyze(filter, plane.line.back(), plane.line.front(),
                std::vector<Line>(plane.details.begin(), plane.details.end()));
      },
      [](const Filter& filter, Lines& plane) {
        synthesize(filter, plane.line.front(), std::vector<ConstLine>(plane.details.begin(), plane.details.end()),
                   plane.line.back());
      });
}
BENCHMARK(fast)
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

void by_the_formula(benchmark::State& state) {
  there_and_back(
      state,
      [](const Filter& filter, Lines& plane) {
        for (std::size_t l = levels; l-- > 0;)
          plain::analyze_level(filter, plane.line[l + 1], plane.line[l], plane.details[l]);
      },
      [](const Filter& filter, Lines& plane) {
        for (std::size_t l = 0; l < levels; ++l)
          plain::synthesize_level(filter, plane.line[l], plane.details[l], plane.line[l + 1]);
      });
}
BENCHMARK(by_the_formula)->ArgName("threads")->Arg(1)->Unit(benchmark::kMillisecond);

void copy(benchmark::State& state) {
  std::vector<double> from(2 << 20, 1.0), to(2 << 20);
  for (auto _ : state) {
    std::memcpy(to.data(), from.data(), from.size() * sizeof(double));
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * (1 << 20));
}
BENCHMARK(copy)->Unit(benchmark::kMillisecond);

}  // namespace
