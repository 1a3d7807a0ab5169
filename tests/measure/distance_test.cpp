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
      EXPECT_EQ(none.hausdorff, 0);
      for (const auto& [which, value] : {std::pair{Distance::rms, there.rms},
                                         {Distance::largest, there.largest},
                                         {Distance::hausdorff, there.hausdorff}})
        EXPECT_EQ(distance(*a, *b, which), value);
      // The largest pair of samples bounds what is nearest (places between samples are linear between them).
      EXPECT_LE(there.hausdorff, there.largest * (1 + 1e-9));
      EXPECT_LE(there.rms, there.largest);
    }
}

TEST(Distance, OfHausdorffIsWhatComparingWithEverySegmentFinds) {
  Random random(2);
  for (const bool closed : {false, true}) {
    const ModelPtr a = model_of(random_curve(random, 40, 2, Kind::walk), closed);
    const ModelPtr b = model_of(random_curve(random, 40, 2, Kind::walk), closed);
    double farthest = 0;
    for (const auto& [from, to] : {std::pair{a, b}, {b, a}})
      for (const double each : plain::nearest(Polyline(*to), places(*from)).distances)
        farthest = std::max(farthest, each);
    EXPECT_EQ(distances(*a, *b).hausdorff, farthest);
  }
}

TEST(Distance, IsRefusedForCurvesThatAreNotAlike) {
  Random random(3);
  const ModelPtr model = model_of(straight(9));
  const ModelPtr longer = model_of(straight(10)), in_space = model_of(random_curve(random, 9, 3, Kind::walk));
  const Error count = refusal([&] { distances(*model, *longer); });
  EXPECT_EQ(count.status(), Status::shape);
  EXPECT_EQ(count.argument(), "other");
  EXPECT_EQ(refusal([&] { distances(*model, *in_space); }).status(), Status::shape);
  EXPECT_GT(distance(*model, *longer, Distance::hausdorff), 0) << "needs no samples of the same number";
}

}  // namespace
