#include "system/box_count.h"

#include <cmath>

#include "base/error.h"
#include "support.h"
#include "system/dimension.h"
#include "system/named.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

BoxCounts counted(const char* name, int finest) {
  Watch watch;
  return count_boxes(*named_system(name), finest, watch);
}

// The right gasket's cells of side 2^-k are the triangles' own: 3^k, and those that a triangle's slanted side touches
// in single points, which own their lower sides: (3^k - 1) / 2 corners lie between two triangles' cells, none of them
// new.
TEST(CountedBoxes, OfTheRightGasketAreThreeTimesAsManyAtHalfTheSide) {
  const BoxCounts boxes = counted("gasket_right", 9);
  ASSERT_EQ(boxes.counts.size(), 9U);
  for (std::size_t k = 0; k < 9; ++k) EXPECT_NEAR(boxes.sides[k], std::pow(.5, static_cast<double>(k + 1)), 1e-11);
  for (std::size_t k = 0; k + 1 < 9; ++k) {
    const double ratio = boxes.counts[k + 1] / boxes.counts[k];
    EXPECT_NEAR(ratio, 3, 3 * std::pow(.5, static_cast<double>(k))) << k;
  }
  EXPECT_NEAR(-boxes.line.slope, std::log2(3.), .02);
}

// Grids of powers of two and shapes of powers of three beat against each other: some hundredths.
TEST(CountedBoxes, GrowByTheSimilarityDimensionWherePiecesHardlyOverlap) {
  for (const char* name : {"koch", "carpet", "vicsek", "hexaflake", "pentagon_gasket"}) {
    const BoxCounts boxes = counted(name, 9);
    EXPECT_NEAR(-boxes.line.slope, similarity_dimension(*named_system(name)), .06) << name;
    EXPECT_GT(boxes.line.r_squared, .99) << name;
  }
}

TEST(CountedBoxes, OfSpaceAreCubes) {
  for (const char* name : {"menger_sponge", "tetrahedron", "octahedron"}) {
    const BoxCounts boxes = counted(name, 6);
    EXPECT_NEAR(-boxes.line.slope, similarity_dimension(*named_system(name)), .1) << name;
  }
}

TEST(CountedBoxes, OfOverlappingSystemsComeToAnEnd) {
  EXPECT_GT(-counted("fern_cyclosorus", 7).line.slope, 1.5);
  EXPECT_LE(-counted("maple_leaf", 7).line.slope, 2);
}

TEST(CountedBoxes, RefuseAPointAndScalesThatAreNone) {
  Affine to_a_point = Affine::identity(2);
  to_a_point.linear *= .5;
  Watch watch;
  const System point(2, {to_a_point});
  EXPECT_EQ(refusal([&] { count_boxes(point, 8, watch); }).status(), Status::shape);
  for (const int bad : {-1, 5, 14}) EXPECT_EQ(refusal([&] { counted("fern", bad); }).argument(), "finest");
  EXPECT_EQ(refusal([&] { counted("sponge", 10); }).argument(), "finest");
}

}  // namespace
