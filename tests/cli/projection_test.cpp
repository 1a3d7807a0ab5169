// Planes: lengths are right at the middle, degrees come back, curves across the 180th meridian stay whole.
#include "projection.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace cli {
namespace {

using Points = std::vector<double>;
constexpr double degree = 6371.0088 * std::numbers::pi / 180;  // km of latitude

TEST(Projection, IsInKilometresAboutTheMiddle) {
  Points points{10, 60, 11, 60, 10, 61};
  project(points, 2, {10, 60});
  EXPECT_EQ(points[0], 0);
  EXPECT_NEAR(points[2], degree / 2, 1e-9);  // cos 60° = 1/2
  EXPECT_EQ(points[3], 0);
  EXPECT_NEAR(points[5], degree, 1e-9);
}

TEST(Projection, LeavesFurtherCoordinatesAlone) {
  Points points{10, 60, 7, 11, 60, 8};
  project(points, 3, {10, 60});
  EXPECT_EQ(points[2], 7);
  EXPECT_EQ(points[5], 8);
}

RC_GTEST_PROP(Projection, GivesDegreesBack, ()) {
  const auto degrees = [](int range) {
    return static_cast<double>(*rc::gen::inRange(-range * 1000, range * 1000)) / 1000;
  };
  const Degrees middle{degrees(180), degrees(85)};
  Points points;
  for (int k = 0; k < 5; ++k) {
    points.push_back(middle.longitude + degrees(40));
    points.push_back(std::clamp(middle.latitude + degrees(40), -90.0, 90.0));
  }
  auto back = points;
  project(back, 2, middle);
  unproject(back, 2, middle);
  // Whole turns aside: the plane's longitudes start half a turn west of the middle.
  const double turns = std::round((back[0] - points[0]) / 360) * 360;
  for (std::size_t k = 0; k < points.size(); k += 2) {
    RC_ASSERT(std::abs(back[k] - points[k] - turns) < 1e-9);
    RC_ASSERT(std::abs(back[k + 1] - points[k + 1]) < 1e-9);
  }
}

TEST(Projection, ACurveAcrossThe180thMeridianStaysWhole) {
  Points points{179, 0, -179, 1, -178, 1, 178, 0};
  unwrap(points, 2);
  EXPECT_EQ(points, (Points{179, 0, 181, 1, 182, 1, 178, 0}));
  EXPECT_FALSE(runs_round_a_pole(points, 2));
  const auto middle = middle_of(points, 2);
  EXPECT_EQ(middle.longitude, 180);
  for (const double longitude : {180.0, -180.0}) {
    auto plane = points;
    project(plane, 2, {longitude, 0});
    EXPECT_NEAR(plane[0], -degree, 1e-9);
    EXPECT_NEAR(plane[2], degree, 1e-9);
  }
}

TEST(Projection, GapsAreStoodBy) {
  Points points{179, 0, NAN, NAN, -179, 1};
  unwrap(points, 2);
  EXPECT_EQ(points[4], 181);
  EXPECT_FALSE(first_off_the_earth(points, 2));
  EXPECT_EQ(middle_of(points, 2).longitude, 180);
}

TEST(Projection, ARingRoundAPoleIsTold) {
  Points points{0, -70, 90, -71, 180, -70, -90, -72};
  unwrap(points, 2);
  EXPECT_TRUE(runs_round_a_pole(points, 2));
}

TEST(Projection, WhatIsNoPlaceOnEarthIsTold) {
  EXPECT_EQ(first_off_the_earth({0, 90, 360, -90}, 2), std::nullopt);
  EXPECT_EQ(first_off_the_earth({0, 0, 0, 90.1}, 2), 1u);
  EXPECT_EQ(first_off_the_earth({400, 0, 1}, 3), 0u);
}

TEST(Projection, TellsHowWrongLengthsAre) {
  EXPECT_EQ(stretch({10, 0, 11, 0}, 2, {10, 0}), 1);
  EXPECT_NEAR(stretch({0, -60, 0, 60}, 2, {0, 0}), 2, 1e-12);
  EXPECT_NEAR(stretch({0, 0, 0, 60}, 2, {0, 60}), 2, 1e-12);
  EXPECT_TRUE(std::isinf(stretch({0, 80, 0, 90}, 2, {0, 85})));
}

}  // namespace
}  // namespace cli
