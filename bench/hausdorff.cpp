// Hausdorff distances of sketches to their curves:  bench_hausdorff SAMPLES curve.csv …
// Every curve is resampled by arc length to SAMPLES + 1 points; its sketches under the filter by name coast hold 128 …
// 1024 floats, three a vector (two coordinates and the address; control points need none, and count three as well).
// Prints, a line a curve and number of floats: name floats hausdorff hausdorff-of-least-squares milliseconds, for
// bench/simplify.py.
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include <ifsm.hpp>

#include "coast.h"

namespace {

constexpr int floats[] = {128, 256, 512, 1024};
constexpr int floats_of_a_vector = 3;

void measure(const std::string& path, int samples) {
  const std::vector<double> points = resampled(read_points(path), samples + 1);
  const ifsm::Model model(ifsm::Filter::named("coast"), ifsm::Curve(points, 2));
  const std::string name = path.substr(path.rfind('/') + 1);
  for (const int stored : floats) {
    const auto kept = ifsm::most_significant(stored / floats_of_a_vector - model.describe().control_points)
                          .resolved(ifsm::Resolve::choice);
    const double squares = model.distance(model.keep(kept)).hausdorff;
    const auto start = std::chrono::steady_clock::now();
    const double nearest = model.distance(model.keep(ifsm::Keep(kept).by(ifsm::Distance::hausdorff))).hausdorff;
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    std::printf("%s %d %.17g %.17g %.0f\n", name.c_str(), stored, nearest, squares, took.count());
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: bench_hausdorff SAMPLES curve.csv ...\n");
    return 2;
  }
  for (int i = 2; i < argc; ++i) measure(argv[i], std::atoi(argv[1]));
}
