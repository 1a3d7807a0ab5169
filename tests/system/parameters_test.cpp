#include "system/parameters.h"

#include <numbers>

#include "support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

constexpr double pi = std::numbers::pi;

TEST(MapOf, ShearsThenScalesThenTurnsThenMoves) {
  Parameters p;
  p.rotation = {0, 0, pi / 2};
  p.scale = {2, 3, 0};
  p.shear = {.5, 0, 0};
  p.shift = {10, 20, 0};
  // (1, 1) → (1.5, 1) → (3, 3) → (-3, 3) → (7, 23).
  EXPECT_NEAR((map_of(p, 2)(Vector3(1, 1, 0)) - Vector3(7, 23, 0)).norm(), 0, 16 * epsilon);
}

TEST(ParametersOf, GiveEveryMapBack) {
  Random random(6);
  for (int k = 0; k < 400; ++k) {
    const int d = k % 2 + 2;
    Affine map;
    // Of every rank, also 0, and with columns of zeros.
    const auto rank = uniform(random, 0, d);
    map.linear.topLeftCorner(d, d) = random_matrix(random, d, rank) * random_matrix(random, rank, d);
    if (k % 5 == 0) map.linear.col(uniform(random, 0, d - 1)).setZero();
    if (k % 7 == 0) map.linear *= 1e-200;
    map.shift.head(d) = random_matrix(random, d, 1);
    const Parameters p = parameters_of(map, d);
    const double largest = map.linear.cwiseAbs().maxCoeff();
    // Where a column nearly depends on the others, what is left of it is rounding: 2^-48 of the largest entry counts as
    // nothing.
    EXPECT_LE((map_of(p, d).linear - map.linear).cwiseAbs().maxCoeff(), 64 * epsilon * largest) << k;
    EXPECT_EQ(map_of(p, d).shift, map.shift);
    for (int axis = 0; axis + 1 < d; ++axis) EXPECT_GE(p.scale(axis), 0) << k;
  }
}

TEST(ParametersOf, TellReflectionsByTheLastScaleAndAnglesAsTheyAre) {
  const Parameters leaf = parameters_of(plane(-.15, .28, .26, .24, 0, .44), 2);
  EXPECT_NEAR(leaf.rotation(2), std::atan2(.26, -.15), 4 * epsilon);
  EXPECT_GT(leaf.scale(0), 0);
  EXPECT_LT(leaf.scale(1), 0);
  EXPECT_NEAR(leaf.scale(0) * leaf.scale(1), -.15 * .24 - .28 * .26, 4 * epsilon);
  const Parameters half = parameters_of(plane(-1, 0, 0, -1, 0, 0), 2);
  EXPECT_NEAR(std::abs(half.rotation(2)), pi, 4 * epsilon);
  EXPECT_EQ(half.scale, Vector3(1, 1, 1));
}

}  // namespace
