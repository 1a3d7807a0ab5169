// Gaps: cut at them or bridged, open curves and rings; nothing that is known changes or moves.
#include "gaps.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace cli {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
using Points = std::vector<double>;

TEST(Gaps, CutAnOpenCurveIntoItsPieces) {
  const auto split = split_at_gaps({nan, 1, 2, nan, nan, 3, nan, 4, 5, 6}, 1, false);
  EXPECT_EQ(split.pieces, (std::vector<Points>{{1, 2}, {4, 5, 6}}));
  EXPECT_EQ(split.gaps, 3u);
  EXPECT_EQ(split.singles, 1u);
  EXPECT_FALSE(split.closed);
}

TEST(Gaps, CutARingIntoOpenPiecesOfWhichOneRunsThroughItsStart) {
  const auto split = split_at_gaps({1, 2, nan, 3, 4, nan, nan, 5}, 1, true);
  EXPECT_EQ(split.pieces, (std::vector<Points>{{3, 4}, {5, 1, 2}}));
  EXPECT_EQ(split.gaps, 2u);
  EXPECT_FALSE(split.closed);
  EXPECT_EQ(split_at_gaps({nan, 1, 2, 3, nan}, 1, true).gaps, 1u);  // one gap across the start, not two
}

TEST(Gaps, LeaveACurveWithoutAnyAsItIs) {
  for (const bool closed : {false, true}) {
    const auto split = split_at_gaps({1, 2, 3, 4}, 2, closed);
    EXPECT_EQ(split.pieces, (std::vector<Points>{{1, 2, 3, 4}}));
    EXPECT_EQ(split.closed, closed);
    EXPECT_EQ(bridge_gaps({1, 2, 3, 4}, 2, closed).points, (Points{1, 2, 3, 4}));
  }
}

TEST(Gaps, AnUnknownCoordinateMakesItsPointUnknown) {
  EXPECT_EQ(split_at_gaps({1, 2, 3, 4, 5, nan, 7, 8, 9, 10}, 2, false).pieces,
            (std::vector<Points>{{1, 2, 3, 4}, {7, 8, 9, 10}}));
  EXPECT_EQ(bridge_gaps({1, 2, 99, nan, 3, 6}, 2, false).points, (Points{1, 2, 2, 4, 3, 6}));
}

TEST(Gaps, AreBridgedByEvenStepsOnAStraightLine) {
  const auto bridge = bridge_gaps({nan, 0, nan, nan, nan, 4, nan, 6, nan, nan}, 1, false);
  EXPECT_EQ(bridge.points, (Points{0, 1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(bridge.gaps, 2u);
  EXPECT_EQ(bridge.filled, 4u);
  EXPECT_EQ(bridge.cut_off, 3u);
}

TEST(Gaps, AreBridgedRoundARing) {
  const auto bridge = bridge_gaps({nan, 0, 3, 6, nan}, 1, true);
  EXPECT_EQ(bridge.points, (Points{2, 0, 3, 6, 4}));
  EXPECT_EQ(bridge.gaps, 1u);
  EXPECT_EQ(bridge.filled, 2u);
  EXPECT_EQ(bridge.cut_off, 0u);
}

TEST(Gaps, OfEverythingLeaveNothing) {
  for (const bool closed : {false, true}) {
    EXPECT_TRUE(split_at_gaps({nan, nan, nan}, 1, closed).pieces.empty());
    EXPECT_TRUE(bridge_gaps({nan, nan, nan}, 1, closed).points.empty());
  }
  EXPECT_EQ(bridge_gaps({nan, 7, nan}, 1, true).points, (Points{7, 7, 7}));
}

// A random row of numbers, each its own place, some of them unknown.
Points with_holes(const std::vector<bool>& known) {
  Points points;
  for (std::size_t k = 0; k < known.size(); ++k) points.push_back(known[k] ? static_cast<double>(k) : nan);
  return points;
}

RC_GTEST_PROP(Gaps, PiecesHoldEveryKnownPointOnceInOrder, (const std::vector<bool>& known, bool closed)) {
  const auto split = split_at_gaps(with_holes(known), 1, closed);
  std::size_t held = split.singles;
  for (const auto& piece : split.pieces) {
    held += piece.size();
    for (std::size_t k = 1; k < piece.size(); ++k) {
      const bool round_the_start = closed && piece[k] == 0 && piece[k - 1] == static_cast<double>(known.size() - 1);
      RC_ASSERT(piece[k] == piece[k - 1] + 1 || round_the_start);
    }
  }
  if (!known.empty()) RC_ASSERT(held == static_cast<std::size_t>(std::count(known.begin(), known.end(), true)));
}

RC_GTEST_PROP(Gaps, BridgesKeepWhatIsKnownInItsPlace, (const std::vector<bool>& known, bool closed)) {
  const auto points = with_holes(known);
  const auto bridge = bridge_gaps(points, 1, closed);
  const bool any = std::find(known.begin(), known.end(), true) != known.end();
  RC_ASSERT(bridge.points.empty() == !any);
  if (!any) return;
  const auto first = closed ? 0 : std::find(known.begin(), known.end(), true) - known.begin();
  for (std::size_t k = 0; k < bridge.points.size(); ++k) {
    const auto from = static_cast<std::size_t>(first) + k;
    RC_ASSERT(std::isfinite(bridge.points[k]));
    if (known[from]) RC_ASSERT(bridge.points[k] == points[from]);
  }
  if (!closed)  // a row of equal steps is given back
    for (std::size_t k = 1; k < bridge.points.size(); ++k)
      RC_ASSERT(std::abs(bridge.points[k] - bridge.points[k - 1] - 1) < 1e-9);
  RC_ASSERT(bridge.points.size() + bridge.cut_off == known.size());
}

}  // namespace
}  // namespace cli
