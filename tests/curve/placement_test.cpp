#include "curve/placement.h"

#include "support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

TEST(Placement, GivesEverySampleAPlaceOfItsOwn) {
  for (Index places = 1; places <= 130; ++places)
    for (Index samples = 1; samples <= places; ++samples)
      for (const bool closed : {false, true}) {
        const Placement placement(samples, places, closed);
        EXPECT_EQ(placement.place(0), 0);
        for (Index k = 1; k < samples; ++k)
          ASSERT_LT(placement.place(k - 1), placement.place(k)) << samples << " of " << places;
        ASSERT_LT(placement.place(samples - 1), places);
        if (!closed && samples > 1) {
          ASSERT_EQ(placement.place(samples - 1), places - 1);
        }
      }
}

TEST(Placement, IsTheFormula) {
  for (const Index places : {5, 17, 100, 1025})
    for (const Index m : {2, 3, 4, 5}) {
      const Placement open(m, places, false), closed(m, places, true);
      for (Index k = 0; k < m; ++k) {
        EXPECT_EQ(open.place(k), (2 * k * (places - 1) + (m - 1)) / (2 * (m - 1)));
        EXPECT_EQ(closed.place(k), k * places / m);
      }
    }
}

TEST(Placement, HoldsForAsManyPlacesAsThereMayBe) {
  const Index many = Index{1} << 40;
  const Placement open(many - 3, many, false), closed(many - 3, many, true);
  EXPECT_EQ(open.place(many - 4), many - 1);
  EXPECT_EQ(open.place(0), 0);
  for (Index k = 1; k < many - 3; k += many / 97 + 1) {
    EXPECT_EQ(open.place(k) - open.place(k - 1) >= 1, true) << k;
    EXPECT_EQ(closed.place(k) - closed.place(k - 1) >= 1, true) << k;
  }
}

TEST(Placement, FindsEverySamplesPlaceExactlyFromItsParameter) {
  for (Index places = 1; places <= 700; places += 1 + places / 40)
    for (const bool closed : {false, true}) {
      const Placement all(places, places, closed);
      for (Index k = 0; k < places; ++k) {
        EXPECT_EQ(all.place(k), k);
        ASSERT_EQ(all.position(all.parameter(k)), static_cast<double>(k)) << places << (closed ? " closed" : " open");
      }
    }
  const Index many = (Index{1} << 40) - 87;
  const Placement all(many, many, false);
  for (Index k = 0; k < many; k += many / 1009) ASSERT_EQ(all.position(all.parameter(k)), static_cast<double>(k));
}

TEST(Placement, TakesClosedParametersModuloOne) {
  const Placement ring(8, 8, true);
  EXPECT_EQ(ring.position(1.0), 0.0);
  EXPECT_EQ(ring.position(-0.125), 7.0);
  EXPECT_EQ(ring.position(-1e-30), 0.0);
  EXPECT_EQ(ring.position(1e6 + 0.25), 2.0);
  EXPECT_EQ(Placement(2, 9, false).position(1.0), 8.0);
}

TEST(Placement, TellsBetweenWhichPlacesAParameterLies) {
  const Placement open(3, 9, false), ring(3, 8, true);
  const auto told = [](const Placement::Between& b) { return std::tuple(b.place, b.next, b.part); };
  EXPECT_EQ(told(open.between(0.3125)), std::tuple(2, 3, 0.5));
  EXPECT_EQ(std::get<2>(told(open.between(1))), 0);
  EXPECT_EQ(open.between(1).place, 8);
  EXPECT_EQ(told(ring.between(0.90625)), std::tuple(7, 0, 0.25));
  EXPECT_EQ(told(ring.between(-0.09375)), std::tuple(7, 0, 0.25));
  EXPECT_EQ(told(ring.between(1.0)), std::tuple(0, 1, 0.0));
}

TEST(Placement, FillsLinearlyAndPicksTheSamplesBackBitForBit) {
  Random random(1);
  for (Index places = 2; places <= 60; ++places)
    for (Index samples = 2; samples <= places; ++samples)
      for (const bool closed : {false, true}) {
        const Points given = random_curve(random, samples, 2, Kind::noise);
        const Placement placement(samples, places, closed);
        const Points filled = placement.fill(given);
        ASSERT_EQ(placement.pick(filled), given);
        for (Index k = 0; k + (closed ? 0 : 1) < samples; ++k) {
          const Index from = placement.place(k), to = k + 1 < samples ? placement.place(k + 1) : places;
          for (Index p = from; p < to; ++p) {
            const double t = static_cast<double>(p - from) / static_cast<double>(to - from);
            const Eigen::RowVectorXd wanted =
                given.matrix().row(k) + t * (given.matrix().row((k + 1) % samples) - given.matrix().row(k));
            ASSERT_LE((filled.matrix().row(p) - wanted).norm(), 16 * epsilon * 4);  // values below 4, four operations
          }
        }
      }
}

}  // namespace
