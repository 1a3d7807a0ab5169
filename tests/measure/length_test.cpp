#include "measure/length.h"

#include "support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

TEST(Polyline, TellsThePointsOfAModelAtTheModelsParameters) {
  Random random(1);
  for (const bool closed : {false, true})
    for (const Topology topology : {Topology::joined, Topology::square}) {
      const ModelPtr model = analyze(casteljau(Shape(topology, 4, 3)), random_curve(random, 50, 3, Kind::walk), closed);
      const Polyline polyline(*model);
      ASSERT_EQ(polyline.count(), model->placement().places());
      for (Index k = 0; k < polyline.segments(); k += 7) {
        const double t[] = {polyline.parameter(k, 0)};
        const Points there = evaluate(*model, Curve::polyline, t);
        for (Index axis = 0; axis < 3; ++axis)
          EXPECT_EQ(polyline.start(k)[axis] * polyline.unit(), there.matrix()(0, axis)) << "point " << k;
        EXPECT_EQ(polyline.position(t[0]), static_cast<double>(k));
      }
    }
}

TEST(Polyline, IsInUnitsThatAPowerOfTwoMakesAndNoBitIsLost) {
  for (const double scale : {1.0, 0.3, 1e-310, 1e300, 5e-324}) {
    const Points points = points_of({{scale, 0}, {-scale, scale}});
    const Polyline polyline(points, false);
    EXPECT_EQ(std::abs(polyline.end(0)[0]) * polyline.unit(), scale);
    EXPECT_GE(polyline.start(0)[0], 1.0);
    EXPECT_LT(polyline.start(0)[0], 2.0);
  }
}

TEST(Length, IsThatOfSegmentsWhoseLengthsAreKnown) {
  const Points square = points_of({{0, 0}, {3, 0}, {3, 4}, {0, 4}});
  EXPECT_EQ(length_between(Polyline(square, true), 0, 1), 14.0);
  EXPECT_EQ(length_between(Polyline(square, false), 0, 1), 10.0);
  EXPECT_EQ(length_between(Polyline(points_of({{1, 2, 3, 4}, {2, 3, 4, 5}}), false), 0, 1), 2.0);
  EXPECT_EQ(length_between(Polyline(points_of({{7}, {7}, {5}}), false), 0, 1), 2.0);
  EXPECT_EQ(length_between(Polyline(points_of({{7, 7}}), false), 0, 1), 0.0);
}

TEST(Length, BetweenParametersAddsUpAndCountsTheTurnsOfARing) {
  Random random(2);
  for (const Kind kind : {Kind::walk, Kind::repeated, Kind::offset, Kind::huge, Kind::tiny})
    for (const bool closed : {false, true}) {
      const Polyline polyline(random_curve(random, 100, 2, kind), closed);
      const double whole = length_between(polyline, 0, 1);
      ASSERT_GT(whole, 0);
      // Three differences of sums that are each known to a few roundings of the whole.
      const double tolerance = 16 * epsilon * whole;
      EXPECT_NEAR(length_between(polyline, 0, 0.3) + length_between(polyline, 0.3, 1), whole, tolerance);
      EXPECT_EQ(length_between(polyline, 0.7, 0.2), -length_between(polyline, 0.2, 0.7));
      if (!closed) continue;
      EXPECT_NEAR(length_between(polyline, 0.25, 1.25), whole, tolerance);
      EXPECT_NEAR(length_between(polyline, -2, 1), 3 * whole, 3 * tolerance);
      // 1 - eps/2 is told as the ring's end, not as its start.
      EXPECT_NEAR(length_between(polyline, 0, std::nextafter(1.0, 0.0)), whole, tolerance);
    }
}

TEST(Length, OfAMillionEqualStepsIsTheirNumberToTheLastBits) {
  Points points(2, 1000001);
  for (Index k = 0; k < points.count(); ++k) points.matrix()(k, 0) = 0.1 * static_cast<double>(k);
  // 2: each step is known to a rounding of its end points, which telescopes; the sum keeps what it loses.
  EXPECT_NEAR(length_between(Polyline(points, false), 0, 1), points.matrix()(1000000, 0), 2 * epsilon * 1e5);
}

TEST(Length, ThatLeavesTheRangeOfDoublesIsRefused) {
  const Polyline polyline(points_of({{-1.5e308, 0}, {1.5e308, 0}}), false);
  EXPECT_EQ(refusal([&] { length_between(polyline, 0, 1); }).status(), Status::numerical);
  EXPECT_GT(length_between(polyline, 0, 0.25), 0);
}

// The length between neighbours, whatever the curve's own speed.
void expect_equal_pieces(const Polyline& polyline, const std::vector<double>& parameters, double piece) {
  const ArcLength lengths(polyline);
  for (std::size_t k = 0; k + 1 < parameters.size(); ++k) {
    EXPECT_LT(parameters[k], parameters[k + 1]);
    // A parameter is rounded to eps, which the fastest segment makes eps · segments · its length, here less than the
    // whole; the lengths to a few roundings of the whole.
    EXPECT_NEAR(lengths.at(parameters[k + 1]) - lengths.at(parameters[k]), piece,
                8 * epsilon * lengths.total() * (1 + static_cast<double>(polyline.segments())))
        << "piece " << k;
  }
}

TEST(EquallySpacedPoints, CutTheCurveIntoPiecesOfEqualLength) {
  Random random(3);
  for (const Kind kind : {Kind::walk, Kind::smooth, Kind::repeated})
    for (const Index count : {2, 5, 64, 1000}) {
      const Points points = random_curve(random, 90, 3, kind);
      const Polyline open(points, false), ring(points, true);
      const std::vector<double> along = equally_spaced(open, count), round = equally_spaced(ring, count);
      ASSERT_EQ(static_cast<Index>(along.size()), count);
      EXPECT_EQ(along.front(), 0.0);
      EXPECT_EQ(along.back(), 1.0);
      expect_equal_pieces(open, along, ArcLength(open).total() / static_cast<double>(count - 1));
      ASSERT_EQ(static_cast<Index>(round.size()), count);
      EXPECT_EQ(round.front(), 0.0);
      EXPECT_LT(round.back(), 1.0);
      expect_equal_pieces(ring, round, ArcLength(ring).total() / static_cast<double>(count));
    }
}

TEST(EquallySpacedPoints, OfACurveThatIsOnePointAreItsStart) {
  EXPECT_EQ(equally_spaced(Polyline(points_of({{1, 2}}), false), 3), (std::vector<double>{0, 0, 0}));
  EXPECT_EQ(equally_spaced(Polyline(points_of({{1, 2}, {1, 2}, {1, 2}}), true), 2), (std::vector<double>{0, 0}));
  EXPECT_EQ(equally_spaced(Polyline(points_of({{1, 2}, {3, 4}}), false), 1), (std::vector<double>{0}));
}

TEST(SpacedPoints, LieThatFarApartAndTheRestIsShorter) {
  const Points line = points_of({{0, 0}, {0.1, 0}, {1, 0}});
  EXPECT_EQ(spaced(Polyline(line, false), 0.1).size(), 11U);  // ten times 0.1 is the whole line, rounding or not
  EXPECT_EQ(spaced(Polyline(line, false), 0.3).size(), 4U);
  EXPECT_EQ(spaced(Polyline(line, false), 5).size(), 1U);
  EXPECT_EQ(spaced(Polyline(line, false), 1e308), std::vector<double>{0});
  const Points square = points_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  EXPECT_EQ(spaced(Polyline(square, true), 0.1).size(), 40U);  // not the start again
  EXPECT_EQ(spaced(Polyline(square, true), 0.7).size(), 6U);
  EXPECT_EQ(spaced(Polyline(square, true), 9).size(), 1U);
  expect_equal_pieces(Polyline(square, true), spaced(Polyline(square, true), 0.7), 0.7);
}

TEST(SpacedPoints, AreRefusedWhenTheSpacingIsNoDistance) {
  const Polyline line(points_of({{0, 0}, {1, 0}}), false);
  for (const double spacing : {0.0, -1.0, 1e-13, 5e-324}) {
    const Error error = refusal([&] { spaced_count(line, spacing); });
    EXPECT_EQ(error.status(), Status::range) << spacing;
    EXPECT_EQ(error.argument(), "spacing");
    EXPECT_EQ(error.value(), spacing);
  }
  EXPECT_EQ(refusal([&] { spaced_count(line, std::nan("")); }).status(), Status::not_finite);
  EXPECT_EQ(refusal([&] { equally_spaced(line, 0); }).status(), Status::range);
}

TEST(LengthBetween, RefusesParametersThatTheCurveDoesNotHave) {
  const Polyline line(points_of({{0, 0}, {1, 0}}), false);
  EXPECT_EQ(refusal([&] { length_between(line, -0.1, 1); }).argument(), "from");
  EXPECT_EQ(refusal([&] { length_between(line, 0, 1.1); }).argument(), "to");
  EXPECT_EQ(refusal([&] { length_between(line, 0, std::nan("")); }).status(), Status::not_finite);
}

}  // namespace
