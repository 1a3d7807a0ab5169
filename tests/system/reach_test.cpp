#include "system/reach.h"

#include <numbers>

#include "base/cancel.h"
#include "base/error.h"
#include "support.h"
#include "system/named.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

constexpr double tolerance = 1e-10;

void expect_box(const System& system, const Vector3& low, const Vector3& high) {
  const Box box = bounding_box(system, tolerance);
  for (int axis = 0; axis < system.dimension(); ++axis) {
    EXPECT_LE(box.low(axis), low(axis) + 1e-12);
    EXPECT_GE(box.low(axis), low(axis) - tolerance - 1e-12);
    EXPECT_GE(box.high(axis), high(axis) - 1e-12);
    EXPECT_LE(box.high(axis), high(axis) + tolerance + 1e-12);
  }
}

TEST(BoundingBox, IsThatOfTheMathPageForTheFernAndTheTwinDragon) {
  expect_box(*named_system("fern"), {-2.181921150310, 0, 0}, {2.655783227091, 9.998265036619, 0});
  expect_box(*named_system("twin_dragon"), {-19. / 24, -11. / 24, 0}, {43. / 24, 35. / 24, 0});
}

TEST(BoundingBox, IsThatOfTheUnitSquareAndCubeWhoseSidesHaveManyPiecesAlike) {
  for (const char* name : {"carpet", "cantor_dust", "vicsek", "menger_sponge", "cantor_dust_3d"})
    expect_box(*named_system(name), Vector3::Zero(), Vector3::Ones());
}

TEST(BoundingBox, IsThatOfClassicsWithClosedForms) {
  expect_box(*named_system("gasket"), {0, 0, 0}, {1, std::sqrt(3.0) / 2, 0});
  expect_box(*named_system("koch"), {0, 0, 0}, {1, std::sqrt(3.0) / 6, 0});
  expect_box(*named_system("octahedron"), {-1, -1, -1}, {1, 1, 1});
  expect_box(*named_system("heighway_dragon"), {-1. / 3, -1. / 3, 0}, {7. / 6, 2. / 3, 0});
  expect_box(*named_system("levy"), {-.5, -.25, 0}, {1.5, 1, 0});
  expect_box(*named_system("cantor_set"), {0, 0, 0}, {1, 0, 0});
}

TEST(BoundingBox, HoldsRandomAttractorsAndIsTouchedByThem) {
  Random random(2);
  for (int k = 0; k < 30; ++k) {
    const System system = random_system(random, k % 2 + 2, .5);
    const Box box = bounding_box(system, 1e-9);
    // All words of 7 letters come as near to the sides as their pieces are large.
    const double piece = system.enclosure().axes.norm() * 2 * std::pow(.5, 7);
    Vector3 low = Vector3::Constant(INFINITY), high = -low;
    for (const Vector3& x : points_of(system, 7)) low = low.cwiseMin(x), high = high.cwiseMax(x);
    for (int axis = 0; axis < system.dimension(); ++axis) {
      EXPECT_LE(box.low(axis), low(axis));
      EXPECT_GE(box.low(axis), low(axis) - piece);
      EXPECT_GE(box.high(axis), high(axis));
      EXPECT_LE(box.high(axis), high(axis) + piece);
    }
  }
}

TEST(BoundingBox, DoesNotChangeWhenThePlaneLiesInSpace) {
  for (const char* name : {"fern", "twin_dragon", "carpet"}) {
    const auto flat = named_system(name);
    const Box in_plane = bounding_box(*flat, tolerance), in_space = bounding_box(embedded(*flat), tolerance);
    for (int axis = 0; axis < 2; ++axis) {
      EXPECT_NEAR(in_plane.low(axis), in_space.low(axis), tolerance);
      EXPECT_NEAR(in_plane.high(axis), in_space.high(axis), tolerance);
    }
    EXPECT_NEAR(in_space.low(2), 0, tolerance);
    EXPECT_NEAR(in_space.high(2), 0, tolerance);
  }
}

TEST(BoundingBox, KeepsItsDigitsFarFromTheOrigin) {
  std::vector<Affine> maps = named_system("fern")->maps();
  const Vector3 far(0x1p30, -0x1p31, 0);
  for (Affine& map : maps) map.shift += far - map.linear * far;
  const Box box = bounding_box(System(2, maps), 1e-6);
  EXPECT_NEAR(box.high(0) - far(0), 2.655783227091, 2e-6);
  EXPECT_NEAR(box.low(0) - far(0), -2.181921150310, 2e-6);
}

TEST(BoundingBox, RefusesTolerancesThatRoundingPasses) {
  const auto fern = named_system("fern");
  for (const double bad : {0.0, -1.0, 1e-18, double(NAN), double(INFINITY)}) {
    try {
      bounding_box(*fern, bad);
      ADD_FAILURE() << bad;
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), Status::range);
      EXPECT_EQ(error.argument(), "tolerance");
    }
  }
}

TEST(Reach, IsTheBoxInTurnedCoordinates) {
  const auto fern = named_system("fern");
  const Vector3 u(std::cos(.3), std::sin(.3), 0);
  double most = -INFINITY;
  for (const Vector3& x : points_of(*fern, 9)) most = std::max(most, u.dot(x));
  const double reached = reach(*fern, u, 1e-9);
  EXPECT_GE(reached, most);
  EXPECT_LE(reached, most + .5);
}

TEST(Diameter, IsThatOfShapesWithClosedForms) {
  const auto expect = [](const char* name, double wanted) {
    const double found = diameter(*named_system(name), 1e-8);
    EXPECT_GE(found, wanted - 1e-12) << name;
    EXPECT_LE(found, wanted + 1e-8 + 1e-12) << name;
  };
  expect("gasket", 1);
  expect("gasket_right", std::numbers::sqrt2);
  expect("carpet", std::numbers::sqrt2);
  expect("cantor_set", 1);
  expect("koch", 1);
  expect("menger_sponge", std::sqrt(3.0));
  expect("tetrahedron", 2 * std::numbers::sqrt2);
  expect("octahedron", 2);
}

TEST(Farthest, IsTheFarthestOfAllPointsSeenFromAnywhere) {
  Random random(3);
  for (int k = 0; k < 6; ++k) {
    const System system = random_system(random, k % 2 + 2, .5);
    Vector3 from = Vector3::Zero();
    from.head(system.dimension()) = random_matrix(random, system.dimension(), 1);
    double most = 0;
    for (const Vector3& x : points_of(system, 7)) most = std::max(most, (x - from).norm());
    const double found = farthest(system, from, 1e-7);
    EXPECT_GE(found, most);
    EXPECT_LE(found, most + system.enclosure().axes.norm() * 2 * std::pow(.5, 7));
  }
}

TEST(EnclosingBall, IsNearlyTheSmallest) {
  struct Known {
    const char* name;
    double radius;
  };
  for (const auto& [name, radius] :
       {Known{"gasket", 1 / std::sqrt(3.0)}, Known{"carpet", std::sqrt(.5)}, Known{"menger_sponge", std::sqrt(.75)},
        Known{"koch", .5}, Known{"octahedron", 1}}) {
    const Ball ball = enclosing_ball(*named_system(name), 1e-7);
    EXPECT_GE(ball.radius, radius - 1e-12) << name;
    EXPECT_LE(ball.radius, 1.01 * radius) << name;
  }
}

TEST(EnclosingBall, HoldsAllPoints) {
  const auto fern = named_system("fern");
  const Ball ball = enclosing_ball(*fern, 1e-6);
  for (const Vector3& x : points_of(*fern, 8)) EXPECT_LE((x - ball.centre).norm(), ball.radius);
}

TEST(BoundingBox, OfTheOriginAloneTakesATolerance) {
  for (const int dimension : {2, 3}) {
    Affine half = Affine::identity(dimension);
    half.linear /= 2;
    const System origin(dimension, {half});
    // Its size is 0, and so is a share of that.
    EXPECT_EQ(bounding_box(origin, 0), (Box{Vector3::Zero(), Vector3::Zero()}));
    EXPECT_EQ(enclosing_ball(origin, 0).radius, 0);
    EXPECT_EQ(diameter(origin, 0), 0);
    EXPECT_EQ(farthest(origin, Vector3::Zero(), 0), 0);
    EXPECT_NEAR(farthest(origin, Vector3::UnitX(), 1e-6), 1, 1e-6);
    EXPECT_EQ(refusal([&] { bounding_box(origin, -1); }).argument(), "tolerance");
  }
}

// Shrinks by a ten-thousandth a step: its ball takes minutes, if nobody asks to stop.
TEST(Reach, StopsWhenTheThreadIsInterrupted) {
  const double c = .9999 * std::cos(.1), s = .9999 * std::sin(.1);
  const System slow(2, {similar(c, s, 1, 0), similar(.5, 0, 0, 0)});
  const double tolerance = 1e-9 * slow.enclosure().axes.norm();
  set_interrupt([](void*) { return std::int32_t{1}; }, nullptr);
  EXPECT_THROW(enclosing_ball(slow, tolerance), Cancelled);
  EXPECT_THROW(diameter(slow, tolerance), Cancelled);
  set_interrupt(nullptr, nullptr);
}

}  // namespace
