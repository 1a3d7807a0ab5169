// What each stage of the fit is worth:  bench_stages SAMPLES curve.csv …
// Every curve is resampled by arc length to SAMPLES + 1 points. A filter by each way; then, at each budget K (control
// points counted), the RMS of the best sketch under it: choice bettered, values solved. Prints geometric means over the
// curves of the ratio to de Casteljau's filter, and each filter's condition.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include <ifsm.hpp>

#include "coast.h"

namespace {

constexpr std::int64_t budgets[] = {16, 32, 64, 128, 256, 512};
constexpr int control_points = 5;

double sketch_rms(const ifsm::Model& model, std::int64_t budget, const std::vector<double>& points) {
  const std::vector<double> near =
      model.keep(ifsm::Keep(IFSM_KEEP_COUNT).count(budget - control_points).resolved(ifsm::Resolve::choice)).samples();
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) sum += (near[i] - points[i]) * (near[i] - points[i]);
  return std::sqrt(2 * sum / static_cast<double>(points.size()));
}

struct Way {
  double log_ratio[6] = {};
  double log_condition = 0;
};

void measure(const std::string& path, int samples, std::map<std::string, Way>& ways) {
  const std::vector<double> points = resampled(read_points(path), samples + 1);
  const std::vector<ifsm::Curve> curves = {{points, 2}};
  const auto casteljau = ifsm::Filter::named("casteljau");
  const ifsm::Model plain(casteljau, curves[0]);

  const ifsm::Fit first = ifsm::fit_curve(curves);
  const ifsm::Filter maps = first.model(0).filter();
  ifsm::FitFilterOptions levels;
  levels.start = &maps;
  const ifsm::Fit second = ifsm::fit_filter(curves, levels);
  levels.start = &casteljau;
  const ifsm::Fit alone = ifsm::fit_filter(curves, levels);
  const auto told = [](const char* what, const ifsm::Fit& fit) {
    const auto row = fit.describe_budget(0, 0);
    std::printf("  %s: RMS %.4g -> %.4g\n", what, row.start_rms, row.rms);
  };
  std::printf("%s\n", path.substr(path.rfind('/') + 1).c_str());
  told("curve alone", first);
  told("three levels after step 1, U fitted", second);
  told("three levels under casteljau, U fitted", alone);

  for (std::size_t b = 0; b < 6; ++b) {
    const double base = std::log(sketch_rms(plain, budgets[b], points));
    const auto add = [&](const char* name, double rms) { ways[name].log_ratio[b] += std::log(rms) - base; };
    add("1 curve (T)", sketch_rms(first.model(0), budgets[b], points));
    add("2 curve, then filter (T, then U)", sketch_rms(second.model(0), budgets[b], points));
    add("3 filter alone (U)", sketch_rms(alone.model(0), budgets[b], points));
    ifsm::FitOptions sparse;
    sparse.budgets = {budgets[b]};
    const ifsm::Fit all = ifsm::fit_sparse(curves, sparse);
    add("4 sparse (all of R, at each budget)", all.describe_budget(0, 0).rms);
    if (b == 3) ways["4 sparse (all of R, at each budget)"].log_condition += std::log(all.describe().final_condition);
  }
  ways["1 curve (T)"].log_condition += std::log(first.describe().final_condition);
  ways["2 curve, then filter (T, then U)"].log_condition += std::log(second.describe().final_condition);
  ways["3 filter alone (U)"].log_condition += std::log(alone.describe().final_condition);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: bench_stages SAMPLES curve.csv ...\n");
    return 2;
  }
  std::map<std::string, Way> ways;
  for (int i = 2; i < argc; ++i) measure(argv[i], std::atoi(argv[1]), ways);
  std::printf("| stage | condition | K = 16 | 32 | 64 | 128 | 256 | 512 |\n");
  for (const auto& [name, way] : ways) {
    std::printf("| %s | %.1f |", name.c_str() + 2, std::exp(way.log_condition / (argc - 2)));
    for (const double ratio : way.log_ratio) std::printf(" %.3f |", std::exp(ratio / (argc - 2)));
    std::printf("\n");
  }
}
