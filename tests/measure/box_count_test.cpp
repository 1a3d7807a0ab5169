#include "measure/box_count.h"

#include <algorithm>

#include "support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

__extension__ using Wide = __int128;

// A point's coordinates in lattice steps, as the class rounds them: from the lowest corner, over the longest side.
std::vector<std::vector<Index>> whole(const Points& points) {
  const Eigen::RowVectorXd low = points.matrix().colwise().minCoeff();
  const double longest = (points.matrix().colwise().maxCoeff() - low).maxCoeff();
  std::vector<std::vector<Index>> rows;
  for (Index k = 0; k < points.count(); ++k) {
    rows.emplace_back();
    for (Index axis = 0; axis < points.dimension(); ++axis)
      rows.back().push_back(
          static_cast<Index>(std::round((points.matrix()(k, axis) - low(axis)) / longest * Lattice::steps)));
  }
  return rows;
}

// Does the segment touch the half-open box? The times at which it is between each pair of faces, as fractions, cut.
bool touches(const std::vector<Index>& a, const std::vector<Index>& b, const std::vector<Index>& box, Index side) {
  struct Bound {
    Index above, below;  // above / below, below > 0
    bool closed;
  };
  Bound from{0, 1, true}, to{1, 1, true};
  const auto compare = [](const Bound& x, const Bound& y) {
    const Wide left = Wide{x.above} * y.below, right = Wide{y.above} * x.below;
    return left < right ? -1 : left > right ? 1 : 0;
  };
  for (std::size_t axis = 0; axis < a.size(); ++axis) {
    const Index step = b[axis] - a[axis], low = box[axis] * side, high = low + side;
    if (step == 0) {
      if (a[axis] < low || a[axis] >= high) return false;
      continue;
    }
    const Index of = std::abs(step), sign = step > 0 ? 1 : -1;
    Bound enter{sign * ((step > 0 ? low : high) - a[axis]), of, step > 0};  // the lower face belongs to the box
    Bound leave{sign * ((step > 0 ? high : low) - a[axis]), of, step < 0};
    if (const int c = compare(enter, from); c > 0 || (c == 0 && !enter.closed)) from = enter;
    if (const int c = compare(leave, to); c < 0 || (c == 0 && !leave.closed)) to = leave;
  }
  const int c = compare(from, to);
  return c < 0 || (c == 0 && from.closed && to.closed);
}

Index by_every_box(const Points& points, bool closed, Index side) {
  const auto rows = whole(points);
  const Index boxes = Lattice::steps / side + 1;
  const auto d = static_cast<std::size_t>(points.dimension());
  Index count = 0;
  std::vector<Index> box(d, 0);
  while (box[0] < boxes) {
    bool touched = false;
    for (std::size_t k = 0; k + (closed ? 0 : 1) < rows.size() && !touched; ++k)
      touched = touches(rows[k], rows[(k + 1) % rows.size()], box, side);
    count += touched;
    for (std::size_t axis = d; axis-- > 0;) {
      if (++box[axis] < boxes || axis == 0) break;
      box[axis] = 0;
    }
  }
  return count;
}

TEST(BoxCount, IsThatOfLookingAtEveryBox) {
  Random random(1);
  for (int trial = 0; trial < 60; ++trial) {
    const Index dimension = 2 + trial % 2;
    const bool closed = trial % 4 < 2;
    Points points(dimension, uniform(random, 2, 12));
    // Every other time on a coarse grid, whose lines are those of the boxes: faces, edges and corners are hit.
    const Index grid = trial % 3 == 0 ? 0 : 8;
    for (Index k = 0; k < points.count(); ++k)
      for (Index axis = 0; axis < dimension; ++axis)
        points.matrix()(k, axis) = grid > 0 ? static_cast<double>(uniform(random, 0, grid)) : normal(random);
    if (points.matrix().colwise().maxCoeff() == points.matrix().colwise().minCoeff()) continue;
    const Lattice lattice{Polyline(points, closed)};
    for (const Index side : {Lattice::steps / 8, Lattice::steps / 4, Lattice::steps / 5, Lattice::steps * 2})
      ASSERT_EQ(lattice.count(side), by_every_box(points, closed, side)) << "trial " << trial << ", side " << side;
  }
}

TEST(BoxCount, OfADiagonalIsOneBoxAStepAndOfAnAntidiagonalThoseThatOwnItsCornersToo) {
  const Polyline up(points_of({{0, 0}, {1, 1}}), false), down(points_of({{0, 1}, {1, 0}}), false);
  const Index side = Lattice::steps / 16;
  EXPECT_EQ(Lattice(up).count(side), 17);  // 16, and the one that owns the end
  // From (0, 1) in box (0, 16): to (0, 15), and at each corner through the box that owns it.
  EXPECT_EQ(Lattice(down).count(side), 33);
}

TEST(BoxCount, VisitsNoMoreBoxesThanItSaysBefore) {
  Random random(2);
  for (const Index dimension : {2, 3}) {
    const Lattice lattice{Polyline(random_curve(random, 300, dimension, Kind::walk), true)};
    for (Index side = Lattice::smallest_side; side < Lattice::steps; side *= 7) {
      if (lattice.visits_at_most(side) > 1000000) continue;
      EXPECT_LE(lattice.count(side), lattice.visits_at_most(side));
    }
  }
}

}  // namespace
