// Analysis and synthesis of 2^20 points in the plane, n = 5, N = 2, one core, beside a copy of the same memory and the
// plain formula. The peer is PyWavelets: bench/wavelet_speed.py.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstring>
#include <vector>

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

template <auto analyze, auto synthesize>
void there_and_back(benchmark::State& state) {
  const FilterPtr filter = named_filter("casteljau", Topology::joined, 5, 2);
  Lines planes[2] = {Lines(filter->shape()), Lines(filter->shape())};
  for (auto _ : state)
    for (Lines& plane : planes) {
      for (std::size_t l = levels; l-- > 0;) analyze(*filter, plane.line[l + 1], plane.line[l], plane.details[l]);
      for (std::size_t l = 0; l < levels; ++l) synthesize(*filter, plane.line[l], plane.details[l], plane.line[l + 1]);
      benchmark::ClobberMemory();
    }
  state.SetItemsProcessed(state.iterations() * (1 << 20));
}

void fast(benchmark::State& state) { there_and_back<analyze_level, synthesize_level>(state); }
void by_the_formula(benchmark::State& state) { there_and_back<plain::analyze_level, plain::synthesize_level>(state); }
BENCHMARK(fast)->Unit(benchmark::kMillisecond);
BENCHMARK(by_the_formula)->Unit(benchmark::kMillisecond);

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
