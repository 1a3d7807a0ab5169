#include "fit/foot_points.h"

#include <gtest/gtest.h>

#include <cmath>

#include "curves.h"

namespace ifsm::core {
namespace {

// Samples beside a polyline, at parameters that are not theirs.
Target beside(const Lanes& polyline, Index count, bool closed, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-1, 1);
  Target target;
  target.dimension = polyline.cols();
  target.closed = closed;
  target.samples = Lanes(count, polyline.cols());
  for (Index k = 0; k < count; ++k) {
    const Index place = k * (polyline.rows() - 1) / count;
    target.samples.row(k) = polyline.row(place);
    for (Index a = 0; a < polyline.cols(); ++a) target.samples(k, a) += 0.3 * any(random);
    target.parameters.push_back((static_cast<double>(k) + (k > 0 ? 0.4 * any(random) : 0)) /
                                static_cast<double>(count));
  }
  if (!closed) target.parameters.back() = 1;
  return target;
}

double squared(const Target& target, const Lanes& polyline, std::size_t k, double parameter) {
  const double place = parameter * static_cast<double>(polyline.rows() - 1);
  const Index leg = std::min(static_cast<Index>(place), polyline.rows() - 2);
  const double f = place - static_cast<double>(leg);
  return target.squared(static_cast<Index>(k), (1 - f) * polyline.row(leg) + f * polyline.row(leg + 1) -
                                                   target.samples.row(static_cast<Index>(k)));
}

TEST(FootPoints, ComeNearerSampleBySampleAndKeepTheirOrder) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const bool closed = seed % 2 == 0;
    const Lanes polyline = (closed ? loop(90, 2, seed) : walk(90, 2, seed)).matrix();
    Target target = beside(polyline, 40, closed, seed);
    if (seed % 3 == 0) target.weights.assign(40, 2.5);
    const std::vector<double> after = foot_points(target, target.parameters, polyline, Watch{});
    double before_sum = 0, after_sum = 0;
    for (std::size_t k = 0; k < after.size(); ++k) {
      const double was = squared(target, polyline, k, target.parameters[k]);
      EXPECT_LE(squared(target, polyline, k, after[k]), was * (1 + 1e-12)) << k;  // places come from parameters
      before_sum += was, after_sum += squared(target, polyline, k, after[k]);
      if (k > 0) {
        EXPECT_GT(after[k], after[k - 1]);
      }
    }
    EXPECT_LT(after_sum, before_sum);
    EXPECT_EQ(after.front(), target.parameters.front());
    if (closed)
      EXPECT_LT(after.back(), 1);
    else
      EXPECT_EQ(after.back(), 1);
  }
}

TEST(FootPoints, FindTheFootOnAStraightLineAtOnce) {
  Lanes line(11, 2);
  for (Index p = 0; p < 11; ++p) line.row(p) << static_cast<double>(p), 0.0;
  Target target;
  target.dimension = 2;
  target.samples = Lanes(4, 2);
  target.samples << 0, 1, 2.5, 1, 6.2, -3, 10, 0;
  target.parameters = {0, 0.3, 0.5, 1};
  const std::vector<double> after = foot_points(target, target.parameters, line, Watch{});
  EXPECT_NEAR(after[1], 0.25, 1e-15);
  EXPECT_NEAR(after[2], 0.62, 1e-15);
}

}  // namespace
}  // namespace ifsm::core
