#include "system/dimension.h"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/error.h"

namespace ifsm::core {
namespace {

double ratio(const System& system, int i) {
  const Vector3 values = singular_values(system.maps()[static_cast<std::size_t>(i)].linear);
  const double least = values(system.dimension() - 1);
  // Entries such as sqrt(3) / 6 are rounded, and what is made of them a few times more.
  constexpr double tolerance = 32 * std::numeric_limits<double>::epsilon();
  if (values(0) - least <= tolerance * values(0)) return values(0);
  throw Error(
      Status::shape, "system",
      "Map " + std::to_string(i) + " stretches by " + text_of(values(0)) + " at most and by " + text_of(least) +
          " at least, so it is no similarity and the system has no similarity dimension; its box-counting dimension "
          "can be estimated.")
      .at(i)
      .with(values(0) - least);
}

}  // namespace

double similarity_dimension(const System& system) {
  static_cast<void>(system.enclosure());  // refuses what has no attractor: all ratios are below 1
  std::vector<double> ratios;
  for (const int i : system.active())
    if (const double r = ratio(system, i); r > 0) ratios.push_back(r);
  if (ratios.size() < 2) return 0;  // a point

  // The sum falls from above 1, and is convex: Newton's steps from the left never pass the root.
  double s = 0;
  for (;;) {
    double sum = -1, slope = 0;
    for (const double r : ratios) {
      const double power = std::pow(r, s);
      sum += power;
      slope += power * std::log(r);
    }
    const double next = s - sum / slope;
    if (!(next > s)) return s;
    s = next;
  }
}

}  // namespace ifsm::core
