#include "measure/nearest.h"

#include "support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

TEST(NearestPoint, IsWhatComparingWithEverySegmentFindsToTheBit) {
  Random random(1);
  for (const Kind kind : all_kinds)
    for (const Index dimension : {1, 2, 3, 4})
      for (const bool closed : {false, true})
        for (const Index count : {1, 2, 3, 9, 300}) {
          const Points curve = random_curve(random, count, dimension, kind);
          const Polyline polyline(curve, closed);
          const Points queries = queries_about(curve, random, 60);
          const Nearest found = nearest(polyline, queries);
          const Nearest wanted = plain::nearest(polyline, queries);
          expect_same(found, wanted);
          if (HasFailure()) FAIL() << "kind " << static_cast<int>(kind) << ", d = " << dimension << ", " << count;
        }
}

TEST(NearestPoint, OfTiesIsTheOneOfTheSmallestParameter) {
  // A square on integers, and queries on its axes of symmetry: every distance is exact.
  const Polyline square(points_of({{-2, -2}, {2, -2}, {2, 2}, {-2, 2}}), true);
  const Nearest found = nearest(square, points_of({{0, 0}, {1, 1}, {-3, -3}, {5, 0}}));
  EXPECT_EQ(found.parameters, (std::vector<double>{0.125, 0.25 + 0.75 * 0.25, 0.0, 0.375}));
  EXPECT_EQ(found.distances, (std::vector<double>{2, 1, std::sqrt(2.0), 3}));
  // A curve that goes there and back: the way there.
  const Polyline back(points_of({{0, 0}, {4, 0}, {0, 0}}), false);
  EXPECT_EQ(nearest(back, points_of({{1, 1}})).parameters, std::vector<double>{0.125});
}

TEST(NearestPoint, OfAPointOfTheCurveIsThatPointToTheBit) {
  Random random(2);
  for (const Kind kind : {Kind::walk, Kind::offset, Kind::tiny, Kind::huge}) {
    const Points curve = random_curve(random, 500, 2, kind);
    const Nearest found = nearest(Polyline(curve, false), curve);
    EXPECT_EQ(found.points, curve);
    EXPECT_EQ(found.distances, std::vector<double>(500, 0.0));
    for (std::size_t k = 0; k < 500; ++k) EXPECT_EQ(found.parameters[k], static_cast<double>(k) / 499);
  }
}

TEST(NearestPoint, OnACircleIsTheFootOfTheRadius) {
  constexpr Index n = 100000;
  constexpr double radius = 3;
  const Polyline ring(circle(n, radius), true);
  Random random(3);
  for (int trial = 0; trial < 50; ++trial) {
    const double angle = std::uniform_real_distribution<double>(0, 2 * M_PI)(random);
    const double far = std::uniform_real_distribution<double>(0.5, 6)(random);
    const Nearest found = nearest(ring, points_of({{far * std::cos(angle), far * std::sin(angle)}}));
    // The ring's segments lie at most radius · (pi / n)² / 2 inside the circle.
    EXPECT_NEAR(found.distances[0], std::abs(far - radius), radius * std::pow(M_PI / n, 2));
    EXPECT_NEAR(found.parameters[0], angle / (2 * M_PI), 1.0 / n);
  }
}

TEST(NearestPoint, IsRefusedForPointsOfAnotherDimensionAndForDistancesThatAreNoDoubles) {
  const Polyline polyline(points_of({{0, 0}, {1, 1}}), false);
  EXPECT_EQ(refusal([&] { nearest(polyline, points_of({{1}})); }).status(), Status::shape);
  const Error error = refusal([&] { nearest(polyline, points_of({{1, 1}, {1e300, 0}})); });
  EXPECT_EQ(error.status(), Status::numerical);
  EXPECT_EQ(error.index(), 2);
  EXPECT_EQ(nearest(polyline, Points(2, 0)).parameters.size(), 0U);
}

}  // namespace
