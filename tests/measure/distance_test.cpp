#include "measure/distance.h"

#include "support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

FilterPtr joined_filter() { return named_filter("casteljau", Topology::joined, 3, 2); }

ModelPtr model_of(const Points& samples, bool closed = false) { return analyze(joined_filter(), samples, closed); }

Points moved(Points points, double x, double y) {
  points.matrix().rowwise() += Eigen::RowVector2d(x, y);
  return points;
}

Points straight(Index count) {
  Points points(2, count);
  points.matrix().col(0).setLinSpaced(0, static_cast<double>(count - 1));
  return points;
}

// What models promise of their samples, of each of both.
double promised(const Model& model) { return 2e-12 * model.parts().diagonal; }

TEST(Distance, BetweenParallelLinesIsTheirsByAllMeasures) {
  const ModelPtr line = model_of(straight(33)), other = model_of(moved(straight(33), 0, 3));
  const Distances found = distances(*line, *other);
  EXPECT_NEAR(found.rms, 3, promised(*line));
  EXPECT_NEAR(found.largest, 3, promised(*line));
  EXPECT_NEAR(found.hausdorff, 3, promised(*line));
}

TEST(Distance, OfHausdorffDoesNotCountWhereAlongTheCurveItIs) {
  // A ring that begins at another of its samples is the same set.
  const Points ring = circle(64, 10);
  Points turned = ring;
  turned.matrix() << ring.matrix().bottomRows(63), ring.matrix().topRows(1);
  const ModelPtr model = model_of(ring, true), other = model_of(turned, true);
  const Distances found = distances(*model, *other);
  EXPECT_NEAR(found.hausdorff, 0, promised(*model));
  EXPECT_NEAR(found.rms, 20 * std::sin(M_PI / 64), promised(*model));
}

TEST(Distance, TellsTheSampleThatIsFarthest) {
  Points spike = straight(17);
  spike.matrix()(5, 1) = 4;
  const ModelPtr line = model_of(straight(17));
  const Distances found = distances(*line, *model_of(spike));
  EXPECT_EQ(found.farthest, 5);
  EXPECT_NEAR(found.largest, 4, promised(*line));
  EXPECT_NEAR(found.rms, 4 / std::sqrt(17.0), promised(*line));
  EXPECT_NEAR(found.hausdorff, 4, promised(*line)) << "from the spike to the line; back it is less";
}

TEST(Distance, IsTheSameInBothDirectionsAndZeroToItself) {
  Random random(1);
  for (const bool closed : {false, true})
    for (const Index dimension : {1, 2, 3, 4}) {
      const ModelPtr a = model_of(random_curve(random, 50, dimension, Kind::walk), closed);
      const ModelPtr b = model_of(random_curve(random, 50, dimension, Kind::walk), closed);
      const Distances there = distances(*a, *b), back = distances(*b, *a), none = distances(*a, *a);
      EXPECT_EQ(there.rms, back.rms);
      EXPECT_EQ(there.largest, back.largest);
      EXPECT_EQ(there.farthest, back.farthest);
      EXPECT_EQ(there.hausdorff, back.hausdorff);
      EXPECT_EQ(none.largest, 0);
      EXPECT_LE(none.hausdorff, epsilon * a->parts().diagonal) << "points within edges are rounded";
      for (const auto& [which, value] : {std::pair{Distance::rms, there.rms},
                                         {Distance::largest, there.largest},
                                         {Distance::hausdorff, there.hausdorff}})
        EXPECT_EQ(distance(*a, *b, which), value);
      // The largest pair of samples bounds what is nearest (places between samples are linear between them).
      EXPECT_LE(there.hausdorff, there.largest * (1 + 1e-9));
      EXPECT_LE(there.rms, there.largest);
    }
}

// Every edge cut into many, and every piece's end compared with every segment.
double farthest_by_brute_force(const Model& from, const Model& to, int cuts) {
  Points ends = places(from);
  const Index count = ends.count(), edges = from.closed() ? count : count - 1;
  Points dense(ends.dimension(), edges * cuts + 1);
  for (Index e = 0; e < edges; ++e)
    for (int c = 0; c <= cuts; ++c)
      dense.matrix().row(e * cuts + c) =
          ends.matrix().row(e) + (ends.matrix().row((e + 1) % count) - ends.matrix().row(e)) * c / cuts;
  return std::ranges::max(plain::nearest(Polyline(to), dense).distances);
}

TEST(Distance, OfHausdorffIsWhatComparingWithEverySegmentFinds) {
  Random random(2);
  constexpr int cuts = 400;
  for (const bool closed : {false, true})
    for (const Index dimension : {1, 2, 3}) {
      const ModelPtr a = model_of(random_curve(random, 40, dimension, Kind::walk), closed);
      const ModelPtr b = model_of(random_curve(random, 40, dimension, Kind::walk), closed);
      const double wanted = std::max(farthest_by_brute_force(*a, *b, cuts), farthest_by_brute_force(*b, *a, cuts));
      double longest = 0;
      for (const auto& model : {a, b})
        for (Index k = 0; k < Polyline(*model).segments(); ++k)
          longest = std::max(longest, Polyline(*model).length(k) * Polyline(*model).unit());
      const double found = distances(*a, *b).hausdorff;
      EXPECT_GE(found, wanted * (1 - 1e-6));
      EXPECT_LE(found, wanted + longest / cuts / 2 * (1 + 1e-9))
          << "between two cuts it rises by half of their distance";
    }
}

TEST(Distance, OfHausdorffCountsEdges) {
  // A tooth that both ends of a long edge are near to: its middle is 1 away, its ends none.
  const ModelPtr bent = model_of(points_of({{0, 0}, {0, 1}, {2, 1}, {2, 0}, {3, 0}}));
  const ModelPtr cut = model_of(points_of({{0, 0}, {0, 1}, {0, 0}, {2, 0}, {3, 0}}));
  EXPECT_NEAR(distance(*cut, *bent, Distance::hausdorff), 1, 1e-6);
  EXPECT_NEAR(distance(*bent, *cut, Distance::hausdorff), 1, 1e-6);
}

TEST(Distance, IsRefusedForCurvesThatAreNotAlike) {
  Random random(3);
  const ModelPtr model = model_of(straight(9));
  const ModelPtr longer = model_of(straight(10)), in_space = model_of(random_curve(random, 9, 3, Kind::walk));
  const Error count = refusal([&] { distances(*model, *longer); });
  EXPECT_EQ(count.status(), Status::shape);
  EXPECT_EQ(count.argument(), "other");
  EXPECT_EQ(count.required(), 9);
  const Error dimension = refusal([&] { distances(*model, *in_space); });
  EXPECT_EQ(dimension.status(), Status::shape);
  EXPECT_EQ(dimension.value(), 3);
  const ModelPtr far = model_of(moved(straight(9), 1.5e308, 0)), farther = model_of(moved(straight(9), -1.5e308, 0));
  const Error no_double = refusal([&] { distances(*far, *farther); });
  EXPECT_EQ(no_double.status(), Status::numerical);
  EXPECT_EQ(no_double.argument(), "other");
  EXPECT_EQ(no_double.index(), 0);
  EXPECT_GT(distance(*model, *longer, Distance::hausdorff), 0) << "needs no samples of the same number";
}

}  // namespace
