// Edits through the C ABI, each with telling what it changed into the caller's array; beside a memcpy of the whole
// curve. A walk in the plane of 2^20 + 1 samples, and of 4097: n = 5, N = 2, de Casteljau's filter.
#include <benchmark/benchmark.h>

#include <cstring>
#include <map>
#include <random>
#include <stdexcept>
#include <vector>

#include <ifsm.hpp>

namespace {

constexpr int small = 10, large = 18;  // levels: 4 · 2^levels + 1 samples

const ifsm::Model& walk(int levels) {
  static std::map<int, ifsm::Model> made;
  if (const auto found = made.find(levels); found != made.end()) return found->second;
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::vector<double> points{0, 0};
  for (std::int64_t k = 0; k < std::int64_t{4} << levels; ++k)
    for (int axis = 0; axis < 2; ++axis) points.push_back(points[points.size() - 2] + normal(random));
  const auto filter = ifsm::Filter::named("casteljau", ifsm::Topology::joined, 5, 2);
  return made.emplace(levels, ifsm::Model(filter, {points, 2})).first->second;
}

// Asks for what the last edit changed, where it stands in the whole.
class Output {
 public:
  explicit Output(const ifsm::Deformer& deformer) : deformer_(deformer), levels_(deformer.describe().levels) {
    const auto all = deformer.changed(levels_);
    values_.resize(static_cast<std::size_t>(2 * all.number));
  }

  void take_what_changed() {
    const auto window = deformer_.changed(levels_);
    std::int64_t count = 0;
    const auto status = ifsm_deformer_points(deformer_.handle(), levels_, window.first, window.number,
                                             values_.data() + 2 * window.first, 2 * window.number, &count);
    if (status != IFSM_OK) throw std::runtime_error("the curve is not told");
    benchmark::DoNotOptimize(values_.data());
  }

  const std::vector<double>& values() const { return values_; }

 private:
  const ifsm::Deformer& deformer_;
  int levels_;
  std::vector<double> values_;
};

void copied(benchmark::State& state) {
  const ifsm::Deformer deformer(walk(static_cast<int>(state.range(0))));
  const std::vector<double> from = Output(deformer).values();
  std::vector<double> to(from.size());
  for (auto _ : state) {
    std::memcpy(to.data(), from.data(), from.size() * sizeof(double));
    benchmark::DoNotOptimize(to.data());
    benchmark::ClobberMemory();
  }
}
BENCHMARK(copied)->Arg(large)->Unit(benchmark::kMicrosecond)->UseRealTime();

// `edit` moves by what it is given; there and back again, so that nothing grows. The history does: it is undone.
template <class Edit>
void edited(benchmark::State& state, const Edit& edit) {
  ifsm::Deformer deformer(walk(static_cast<int>(state.range(0))));
  Output output(deformer);
  double by = 1;
  for (auto _ : state) {
    edit(deformer, by);
    output.take_what_changed();
    state.PauseTiming();
    deformer.undo();
    by = -by;
    state.ResumeTiming();
  }
}

void control_point(benchmark::State& state) {
  edited(state, [](ifsm::Deformer& deformer, double by) { deformer.move(0, {2}, {30 * by, 20 * by}); });
}
BENCHMARK(control_point)->Arg(large)->Arg(small)->Unit(benchmark::kMicrosecond)->UseRealTime();

// Of the 4 handles of a node the last is a joint.
void inner_handle(benchmark::State& state) {
  edited(state, [](ifsm::Deformer& deformer, double by) { deformer.move(6, {101}, {3 * by, 2 * by}); });
}
BENCHMARK(inner_handle)->Arg(large)->Arg(small)->Unit(benchmark::kMicrosecond)->UseRealTime();

void joint(benchmark::State& state) {
  edited(state, [](ifsm::Deformer& deformer, double by) { deformer.move(6, {100}, {3 * by, 2 * by}); });
}
BENCHMARK(joint)->Arg(large)->Arg(small)->Unit(benchmark::kMicrosecond)->UseRealTime();

void last_two_levels(benchmark::State& state) {
  const int levels = static_cast<int>(state.range(0));
  edited(state, [&](ifsm::Deformer& deformer, double by) { deformer.restyle(levels - 2, levels - 1, 1 + 0.5 * by); });
}
BENCHMARK(last_two_levels)->Arg(small)->Unit(benchmark::kMicrosecond)->UseRealTime();

void all_levels(benchmark::State& state) {
  const int levels = static_cast<int>(state.range(0));
  edited(state, [&](ifsm::Deformer& deformer, double by) { deformer.restyle(0, levels - 1, 1 + 0.5 * by); });
}
BENCHMARK(all_levels)->Arg(small)->Unit(benchmark::kMicrosecond)->UseRealTime();

void random_texture(benchmark::State& state) {
  const int levels = static_cast<int>(state.range(0));
  edited(state, [&](ifsm::Deformer& deformer, double) { deformer.texture(levels - 2, levels - 1); });
}
BENCHMARK(random_texture)->Arg(small)->Unit(benchmark::kMicrosecond)->UseRealTime();

void drag(benchmark::State& state, ifsm::Lead lead) {
  const auto from = ifsm::Deformer(walk(small)).evaluate({0.3, 0.31});
  edited(state, [&](ifsm::Deformer& deformer, double by) {
    deformer.drag(4, {0.3, 0.31}, {from[0] + 3 * by, from[1] + 2 * by, from[2], from[3]}, lead);
  });
}
BENCHMARK_CAPTURE(drag, by_handles, ifsm::Lead::handles)->Arg(small)->Unit(benchmark::kMicrosecond)->UseRealTime();
BENCHMARK_CAPTURE(drag, by_details, ifsm::Lead::details)->Arg(small)->Unit(benchmark::kMicrosecond)->UseRealTime();

void frame(benchmark::State& state) {
  ifsm::Deformer deformer(walk(small));
  deformer.time(0, 1).move(0, {2}, {30, 20}).move(4, {20}, {3, 2}).restyle(small - 2, small - 1, 2);
  for (auto _ : state) benchmark::DoNotOptimize(deformer.at_time(0.5).samples());
}
BENCHMARK(frame)->Unit(benchmark::kMicrosecond)->UseRealTime();

}  // namespace
