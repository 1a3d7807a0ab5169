// K-detail errors of curves:  bench_budgets [--auto | --unfitted FILTER] SAMPLES curve.csv …
// Every curve is resampled by arc length to SAMPLES + 1 points and fitted at each budget K on its own (--auto: the
// shape chosen as well; --unfitted: under a filter by name, as it is), control points counted. Prints, a line a curve
// and budget: name K rms n N milliseconds (processor time), for bench/compare.py and bench/splprep.py.
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include <ifsm.hpp>

#include "coast.h"

namespace {

constexpr std::int64_t budgets[] = {16, 32, 64, 128, 256, 512};

struct Told {
  double rms;
  ifsm_model_info shape;
};

Told fitted(const ifsm_curve& curve, std::int64_t budget, bool automatic) {
  ifsm_fit_options options{};
  options.struct_size = sizeof options;
  options.budgets = &budget;
  options.budget_count = 1;
  options.control_points = options.maps = automatic ? -1 : 0;
  ifsm_fit handle{};
  if (ifsm_fit_sparse(&curve, 1, &options, &handle) != IFSM_OK) throw std::runtime_error("the fit failed");
  const ifsm::Fit fit(handle);
  return {fit.describe_budget(0, 0).rms, fit.model(0).describe()};
}

Told unfitted(const std::vector<double>& points, std::int64_t budget, const std::string& name) {
  const ifsm::Model model(ifsm::Filter::named(name), ifsm::Curve(points, 2));
  const auto shape = model.describe();
  const auto kept = ifsm::most_significant(budget - shape.control_points).resolved(ifsm::Resolve::choice);
  const std::vector<double> sketch = model.keep(kept).samples();
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) sum += (sketch[i] - points[i]) * (sketch[i] - points[i]);
  return {std::sqrt(2 * sum / static_cast<double>(points.size())), shape};
}

void measure(const std::string& path, int samples, bool automatic, const std::string& filter) {
  const std::vector<double> points = resampled(read_points(path), samples + 1);
  const ifsm_curve curve = {points.data(), samples + 1, 2, 0};
  const std::string name = path.substr(path.rfind('/') + 1);
  for (const std::int64_t budget : budgets) {
    const std::clock_t start = std::clock();
    const Told told = filter.empty() ? fitted(curve, budget, automatic) : unfitted(points, budget, filter);
    const double took = 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    std::printf("%s %d %.17g %d %d %.0f\n", name.c_str(), static_cast<int>(budget), told.rms, told.shape.control_points,
                told.shape.maps, took);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  int first = 1;
  bool automatic = false;
  std::string filter;
  if (argc > 1 && std::string_view(argv[1]) == "--auto") automatic = true, first = 2;
  if (argc > 2 && std::string_view(argv[1]) == "--unfitted") filter = argv[2], first = 3;
  if (argc < first + 2) {
    std::fprintf(stderr, "usage: bench_budgets [--auto | --unfitted FILTER] SAMPLES curve.csv ...\n");
    return 2;
  }
  for (int i = first + 1; i < argc; ++i) measure(argv[i], std::atoi(argv[first]), automatic, filter);
}
