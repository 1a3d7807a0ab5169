// What a call costs that only looks up.
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include <ifsm.hpp>

namespace {

void model_describe(benchmark::State& state) {
  std::vector<double> points;
  for (int k = 0; k < 4097; ++k) points.insert(points.end(), {std::cos(k * 0.01), std::sin(k * 0.013)});
  const ifsm_curve curve = {points.data(), 4097, 2, 0};
  ifsm_filter filter{};
  ifsm_model model{};
  if (ifsm_filter_named("casteljau", IFSM_TOPOLOGY_JOINED, 5, 2, &filter) != IFSM_OK ||
      ifsm_model_create(filter, &curve, nullptr, &model) != IFSM_OK)
    state.SkipWithError("no model");
  ifsm_model_info info{};
  info.struct_size = sizeof info;
  for (auto _ : state) benchmark::DoNotOptimize(ifsm_model_describe(model, &info));
  benchmark::DoNotOptimize(ifsm_model_destroy(model) + ifsm_filter_destroy(filter));
}
BENCHMARK(model_describe);

}  // namespace
