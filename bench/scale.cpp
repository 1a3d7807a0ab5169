// How every stage of the fit grows with its samples:  bench_scale [THREADS [MOST [STAGE]]]
// A random walk of 10^4, 10^5 … 10^7 (MOST: an exponent) points in the plane, n = 5, N = 2; the same few iterations at
// every size; each case in a process of its own. Prints processor time (all threads, user and system), time by the
// clock, the largest memory that the process ever held (curve, models and sketches counted), and the slope of the
// processor time in log-log, by least squares over all sizes.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <ifsm.hpp>

namespace {

struct Cost {
  double processor = 0, clock = 0;  // seconds
  long peak = 0;                    // KiB
};

std::vector<double> walk(std::int64_t count) {
  std::vector<double> points(static_cast<std::size_t>(2 * count), 0.0);
  unsigned random = 1;
  for (std::size_t i = 2; i < points.size(); ++i) {
    random = random * 1664525U + 1013904223U;
    points[i] = points[i - 2] + static_cast<double>(random >> 8) / (1 << 24) - 0.5;
  }
  return points;
}

double processor_seconds() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

void fit(const std::string& stage, const std::vector<ifsm::Curve>& curves, int threads) {
  if (stage == "sparse") {
    const auto coast = ifsm::Filter::named("coast");  // or two starts are compared
    ifsm::FitOptions options;
    options.start = &coast;
    options.threads = threads;
    options.iterations = 2;
    options.rounds = options.polish = 1;
    ifsm::fit_sparse(curves, options);
  } else if (stage == "curve") {
    ifsm::FitCurveOptions options;
    options.threads = threads;
    options.starts = 1;
    options.iterations = 10;
    options.tolerance = 1e-300;
    ifsm::fit_curve(curves, options);
  } else {
    ifsm::FitFilterOptions options;
    options.threads = threads;
    options.iterations = 10;
    options.tolerance = 1e-300;
    ifsm::fit_filter(curves, options);
  }
}

// In a process of its own, so that its memory is its alone.
Cost cost(const std::string& stage, std::int64_t samples, int threads) {
  int ends[2];
  if (pipe(ends) != 0) std::exit(1);
  const pid_t child = fork();
  if (child == 0) {
    const std::vector<double> points = walk(samples);
    const double before = processor_seconds();
    const auto start = std::chrono::steady_clock::now();
    fit(stage, {{points, 2}}, threads);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    const double told[] = {processor_seconds() - before, took.count()};
    _exit(write(ends[1], told, sizeof told) == static_cast<ssize_t>(sizeof told) ? 0 : 1);
  }
  close(ends[1]);
  double told[2] = {};
  const bool read_all = read(ends[0], told, sizeof told) == static_cast<ssize_t>(sizeof told);
  close(ends[0]);
  int status = 0;
  rusage used{};
  wait4(child, &status, 0, &used);
  if (!read_all || status != 0) {
    std::fprintf(stderr, "%s of %ld samples failed\n", stage.c_str(), static_cast<long>(samples));
    std::exit(1);
  }
  return {told[0], told[1], used.ru_maxrss};
}

void measure(const std::string& stage, int most, int threads) {
  double x = 0, y = 0, xx = 0, xy = 0;
  int sizes = 0;
  for (int exponent = 4; exponent <= most; ++exponent, ++sizes) {
    const auto samples = static_cast<std::int64_t>(std::llround(std::pow(10, exponent)));
    const Cost found = cost(stage, samples, threads);
    std::printf("%-6s 10^%d  %9.3f s of processor  %9.3f s by the clock  %8.1f MiB\n", stage.c_str(), exponent,
                found.processor, found.clock, static_cast<double>(found.peak) / 1024);
    std::fflush(stdout);
    const double time = std::log10(found.processor);
    x += exponent, y += time, xx += exponent * exponent, xy += exponent * time;
  }
  if (sizes > 1) std::printf("%-6s slope %.3f\n", stage.c_str(), (sizes * xy - x * y) / (sizes * xx - x * x));
}

}  // namespace

int main(int argc, char** argv) {
  const int threads = argc > 1 ? std::atoi(argv[1]) : 0;
  const int most = argc > 2 ? std::atoi(argv[2]) : 7;
  for (const std::string stage : {"sparse", "curve", "filter"})
    if (argc <= 3 || stage == argv[3]) measure(stage, most, threads);
}
