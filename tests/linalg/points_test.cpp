#include "linalg/points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

using namespace ifsm::core;

namespace {

TEST(Points, GiveInterleavedCoordinatesBackBitForBit) {
  for (Index dimension = 1; dimension <= 4; ++dimension)
    for (const Index count : {0, 1, 2, 7}) {
      std::vector<double> given(static_cast<std::size_t>(count * dimension));
      std::iota(given.begin(), given.end(), 0.1);
      const Points points = Points::from_interleaved(given.data(), count, dimension);
      EXPECT_EQ(points.count(), count);
      EXPECT_EQ(points.dimension(), dimension);
      std::vector<double> back(given.size(), -1.0);
      points.interleave(back.data());
      EXPECT_EQ(back, given);
    }
}

TEST(Points, KeepEachCoordinateTogether) {
  const double given[] = {1, 10, 2, 20, 3, 30};
  const Points points = Points::from_interleaved(given, 3, 2);
  EXPECT_EQ(std::vector<double>(points.plane(0).begin(), points.plane(0).end()), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(std::vector<double>(points.plane(1).begin(), points.plane(1).end()), (std::vector<double>{10, 20, 30}));
  EXPECT_EQ(points.matrix()(2, 1), 30.0);
  EXPECT_EQ(points.polygon(1, 2)(0, 1), 20.0);
}

TEST(Points, AreEqualOnlyWhenShapeAndCoordinatesAre) {
  const double given[] = {1, 2, 3, 4};
  const Points points = Points::from_interleaved(given, 2, 2);
  EXPECT_EQ(points, Points::from_interleaved(given, 2, 2));
  EXPECT_FALSE(points == Points::from_interleaved(given, 4, 1));
  EXPECT_FALSE(points == Points(2, 2));
}

TEST(Diagonal, IsThatOfTheBoundingBox) {
  const double given[] = {1, 1, -2, 5, 0, 3};
  EXPECT_DOUBLE_EQ(diagonal(Points::from_interleaved(given, 3, 2)), 5.0);
  EXPECT_EQ(diagonal(Points::from_interleaved(given, 1, 2)), 0.0);
  EXPECT_EQ(diagonal(Points()), 0.0);
}

TEST(Diagonal, NeitherOverflowsNorUnderflowsOnTheWay) {
  const double large[] = {0, 0, 3e200, 4e200}, small[] = {0, 0, 3e-200, 4e-200};
  EXPECT_DOUBLE_EQ(diagonal(Points::from_interleaved(large, 2, 2)), 5e200);
  EXPECT_DOUBLE_EQ(diagonal(Points::from_interleaved(small, 2, 2)), 5e-200);
}

}  // namespace
