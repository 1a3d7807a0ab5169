// Lines are thinned without anyone seeing it.
#include "plot/thin.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace plot {
namespace {

bool same(const Point& a, const Point& b) { return a.x == b.x && a.y == b.y; }

std::vector<Point> random_line(bool graph) {
  std::vector<Point> line;
  Point at;
  const auto count = *rc::gen::inRange(0, 400);
  for (int k = 0; k < count; ++k) {
    const auto step = [&] { return static_cast<double>(*rc::gen::inRange(-100, 100)) / 70; };
    at = graph ? Point{at.x + std::abs(step()), 20 * step()} : Point{at.x + step(), at.y + step()};
    line.push_back(at);
  }
  return line;
}

double distance_to(const std::vector<Point>& line, const Point& point) {
  double least = INFINITY;
  for (const auto& other : line) least = std::min(least, std::hypot(point.x - other.x, point.y - other.y));
  return least;
}

RC_GTEST_PROP(Thinned, EveryPointStaysNearAPointThatIsLeft, ()) {
  const double tolerance = 0.5;
  const auto line = random_line(false);
  const auto thin = thinned(line, tolerance);
  RC_ASSERT(thin.size() <= line.size());
  if (line.empty()) return;
  RC_ASSERT(same(thin.front(), line.front()));
  RC_ASSERT(same(thin.back(), line.back()));
  if (!std::is_sorted(line.begin(), line.end(), [](auto& a, auto& b) { return a.x < b.x; }))
    for (const auto& point : line) RC_ASSERT(distance_to(thin, point) <= tolerance * (1 + 1e-9));
}

RC_GTEST_PROP(Thinned, AGraphKeepsItsHeightInEveryColumn, ()) {
  const auto line = random_line(true);
  const auto thin = thinned(line, 0.5);
  for (const auto& point : line) {
    double low = INFINITY, high = -INFINITY;
    for (const auto& other : thin)
      if (std::abs(other.x - point.x) <= 1) low = std::min(low, other.y), high = std::max(high, other.y);
    RC_ASSERT(low - 0.5 <= point.y && point.y <= high + 0.5);
  }
}

TEST(Thinned, ALongGraphHasAsManyPointsAsThePageHasRoomFor) {
  std::vector<Point> line;
  for (int k = 0; k < 100000; ++k) line.push_back({k / 100.0, 500 * std::sin(k * 1.7)});
  EXPECT_LE(thinned(line, 0.5).size(), 4u * 2u * 1000u + 8u);
}

}  // namespace
}  // namespace plot
