// K-detail errors of fitted curves:  bench_budgets [--auto] SAMPLES curve.csv …
// Every curve is resampled by arc length to SAMPLES + 1 points and fitted at each budget K on its own, control points
// counted. Prints, a line a curve and budget: name K rms n N milliseconds, for bench/compare.py.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include <ifsm.hpp>

namespace {

constexpr std::int64_t budgets[] = {16, 32, 64, 128, 256, 512};

std::vector<double> read_points(const std::string& path) {
  std::ifstream file(path);
  std::vector<double> points;
  std::string row;
  for (double x = 0, y = 0; std::getline(file, row);)
    if (std::sscanf(row.c_str(), "%lf,%lf", &x, &y) == 2) points.insert(points.end(), {x, y});
  return points;
}

std::vector<double> resampled(const std::vector<double>& points, int count) {
  const std::size_t given = points.size() / 2;
  std::vector<double> along(given, 0.0), result;
  for (std::size_t i = 1; i < given; ++i)
    along[i] = along[i - 1] + std::hypot(points[2 * i] - points[2 * i - 2], points[2 * i + 1] - points[2 * i - 1]);
  std::size_t i = 0;
  for (int k = 0; k < count; ++k) {
    const double at = along.back() * k / (count - 1);
    while (i + 2 < given && along[i + 1] < at) ++i;
    const double t = (at - along[i]) / (along[i + 1] - along[i]);
    for (std::size_t axis = 0; axis < 2; ++axis)
      result.push_back((1 - t) * points[2 * i + axis] + t * points[2 * i + 2 + axis]);
  }
  return result;
}

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
