#include "measure/dimension.h"

#include <numeric>

#include "support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

const double koch_dimension = std::log(4.0) / std::log(3.0);

TEST(Trend, IsTheLineThatMadeThePointsAndDoubtsItByTheirScatter) {
  const std::vector<double> x = {1, 2, 3, 4}, line = {5, 3, 1, -1};
  const Trend exact = trend(x, line);
  EXPECT_NEAR(exact.slope, -2, 8 * epsilon);
  EXPECT_NEAR(exact.intercept, 7, 64 * epsilon);
  EXPECT_NEAR(exact.standard_error, 0, 64 * epsilon);
  EXPECT_NEAR(exact.r_squared, 1, 64 * epsilon);
  // By hand: slope 0.8, residuals .3 -.5 .7 -.5 … of y = 1 1 3 3: slope 0.8, rest 0.8, s.e. sqrt(0.8 / 2 / 5).
  const std::vector<double> rough = {1, 1, 3, 3};
  EXPECT_NEAR(trend(x, rough).slope, 0.8, 8 * epsilon);
  EXPECT_NEAR(trend(x, rough).standard_error, std::sqrt(0.8 / 2 / 5), 8 * epsilon);
  EXPECT_NEAR(trend(x, rough).r_squared, 0.8, 8 * epsilon);
  EXPECT_EQ(trend(x, std::vector<double>{2, 2, 2, 2}).r_squared, 1);
}

TEST(DividerDimension, OfALineIsOneWhateverItsDirectionAndItsSteps) {
  for (const Index dimension : {1, 2, 3, 4}) {
    Points line(dimension, 301);
    for (Index k = 0; k < line.count(); ++k)
      line.matrix().row(k).setLinSpaced(dimension, static_cast<double>(k), 0.3 * static_cast<double>(k));
    const Dimension found = measure_dimension(Polyline(line, false), Counting::divider, {});
    // Steps are counted with the share that is left: the slope is that of a pure power, to rounding.
    EXPECT_NEAR(found.dimension, 1, 1e-10);
    EXPECT_NEAR(found.r_squared, 1, 1e-10);
    ASSERT_EQ(found.scales.size(), 12U);
    EXPECT_NEAR(found.scales.front(), diagonal(line) / 4, 1e-12 * diagonal(line));
    for (std::size_t i = 0; i < 12; ++i)
      EXPECT_NEAR(found.counts[i] * found.scales[i], diagonal(line), 1e-9 * diagonal(line));
  }
}

TEST(BoxDimension, OfALineIsNearlyOne) {
  const Polyline line(points_of({{0, 0}, {0.3, 0.1}, {3, 1}}), false);
  ScaleRange range;
  range.smallest = 0.001;
  const Dimension found = measure_dimension(line, Counting::boxes, range);
  // A count is one or two boxes too many at the largest scale, one in ten: that tilts the slope by less than 0.03.
  EXPECT_NEAR(found.dimension, 1, 0.03);
}

TEST(BothDimensions, OfTheKochCurveAreLogFourOverLogThreeWithinTheirBias) {
  const Points points = koch_curve(7);
  const Polyline koch(points, false);
  ScaleRange thirds;                 // those of the curve itself: a divider then meets the points of each level
  const double short_of = 1 - 1e-9;  // so that rounding does not make the compasses miss a vertex
  thirds.largest = short_of / 3;
  thirds.smallest = short_of / 729;
  thirds.scales = 6;
  // Divider: at each third the compasses step four times as often, from vertex to vertex.
  const Dimension stepped = measure_dimension(koch, Counting::divider, thirds);
  EXPECT_NEAR(stepped.dimension, koch_dimension, 1e-6);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(stepped.counts[i], std::pow(4, i + 1), 1e-6 * stepped.counts[i]);
  // Boxes: counts wobble by the grid's chance; a slope over two decades is biased by less than 0.04.
  const Dimension boxed = measure_dimension(koch, Counting::boxes, {});
  EXPECT_NEAR(boxed.dimension, koch_dimension, 0.04);
  EXPECT_GT(boxed.r_squared, 0.998);
  EXPECT_NEAR(measure_dimension(koch, Counting::divider, {}).dimension, koch_dimension, 0.04);
}

TEST(BothDimensions, OfTheKochFiltersModelAreThose) {
  const FilterPtr filter = named_filter("koch", Topology::square, 0, 0);
  const ModelPtr model = from_polygon(filter, points_of({{0, 0}, {0.5, std::sqrt(3.0) / 6}, {1, 0}}), false, 6);
  const Polyline koch(*model);
  for (const Counting counting : {Counting::boxes, Counting::divider})
    EXPECT_NEAR(measure_dimension(koch, counting, {}).dimension, koch_dimension, 0.04);
}

TEST(BothDimensions, DoNotChangeWithTheUnits) {
  Random random(1);
  const Points curve = random_curve(random, 2000, 2, Kind::walk);
  for (const Counting counting : {Counting::boxes, Counting::divider}) {
    const Dimension seen = measure_dimension(Polyline(curve, true), counting, {});
    for (const double size : {0x1p-900, 0x1p40}) {  // powers of two: to the bit
      Points other = curve;
      other.matrix() *= size;
      const Dimension told = measure_dimension(Polyline(other, true), counting, {});
      EXPECT_EQ(told.counts, seen.counts);
      EXPECT_NEAR(told.dimension, seen.dimension, 1e-9);
      EXPECT_EQ(told.scales[3], seen.scales[3] * size);
    }
  }
}

TEST(Divider, GoesRoundARingAndBackToItsStart) {
  const Polyline square(points_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}}), true);
  ScaleRange range;
  range.scales = 3, range.largest = 0.5, range.smallest = 0.125;
  EXPECT_EQ(measure_dimension(square, Counting::divider, range).counts, (std::vector<double>{8, 16, 32}));
}

TEST(Dimension, IsRefusedForWhatHasNone) {
  const Polyline line(points_of({{0, 0}, {3, 4}}), false);
  const auto refused = [&](int scales, double smallest, double largest) {
    ScaleRange range;
    range.scales = scales, range.smallest = smallest, range.largest = largest;
    return refusal([&] { measure_dimension(line, Counting::boxes, range); });
  };
  EXPECT_EQ(refused(2, 0, 0).argument(), "scales");
  EXPECT_EQ(refused(257, 0, 0).argument(), "scales");
  EXPECT_EQ(refused(3, 0, 6).argument(), "largest");
  EXPECT_EQ(refused(3, 1, 1.5).argument(), "smallest");
  EXPECT_EQ(refused(3, -1, 0).argument(), "smallest");
  EXPECT_EQ(refused(3, 1e-9, 0).argument(), "smallest");
  EXPECT_EQ(refused(3, std::nan(""), 0).status(), Status::not_finite);
  const Polyline point(points_of({{1, 1}, {1, 1}}), false), profile(points_of({{1}, {2}, {0}}), false);
  for (const Counting counting : {Counting::boxes, Counting::divider})
    EXPECT_EQ(refusal([&] { measure_dimension(point, counting, {}); }).status(), Status::shape);
  EXPECT_EQ(refusal([&] { measure_dimension(profile, Counting::boxes, {}); }).status(), Status::shape);
  EXPECT_NO_THROW(measure_dimension(profile, Counting::divider, {}));
  // Long and finely asked about: refused before anything is allocated.
  Points comb(2, 4000);
  for (Index k = 0; k < comb.count(); ++k) comb.matrix().row(k) << 1e-3 * static_cast<double>(k), (k % 2 == 0 ? 0 : 4);
  ScaleRange fine;
  fine.smallest = 1e-5;
  EXPECT_EQ(refusal([&] { measure_dimension(Polyline(comb, false), Counting::boxes, fine); }).status(), Status::limit);
}

}  // namespace
