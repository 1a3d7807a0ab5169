// K-detail errors of fitted curves:  bench_budgets [--auto] SAMPLES curve.csv …
// Every curve is resampled by arc length to SAMPLES + 1 points and fitted at each budget K on its own, control points
// counted. Prints, a line a curve and budget: name K rms n N milliseconds, for bench/compare.py.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include <ifsm.hpp>

#include "coast.h"

namespace {

constexpr std::int64_t budgets[] = {16, 32, 64, 128, 256, 512};

void measure(const std::string& path, int samples, bool automatic) {
  const std::vector<double> points = resampled(read_points(path), samples + 1);
  const ifsm_curve curve = {points.data(), samples + 1, 2, 0};
  const std::string name = path.substr(path.rfind('/') + 1);
  for (const std::int64_t budget : budgets) {
    ifsm_fit_options options{};
    options.struct_size = sizeof options;
    options.budgets = &budget;
    options.budget_count = 1;
    options.control_points = options.maps = automatic ? -1 : 0;
    ifsm_fit handle{};
    const auto start = std::chrono::steady_clock::now();
    if (ifsm_fit_sparse(&curve, 1, &options, &handle) != IFSM_OK) throw std::runtime_error("the fit failed");
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    const ifsm::Fit fit(handle);
    const ifsm_model_info info = fit.model(0).describe();
    std::printf("%s %d %.17g %d %d %.0f\n", name.c_str(), static_cast<int>(budget), fit.describe_budget(0, 0).rms,
                info.control_points, info.maps, took.count());
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  int first = 1;
  const bool automatic = argc > 1 && std::string_view(argv[1]) == "--auto";
  if (automatic) ++first;
  if (argc < first + 2) {
    std::fprintf(stderr, "usage: bench_budgets [--auto] SAMPLES curve.csv ...\n");
    return 2;
  }
  for (int i = first + 1; i < argc; ++i) measure(argv[i], std::atoi(argv[first]), automatic);
}
