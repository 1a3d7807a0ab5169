#include "measure/spectrum.h"

#include "support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

// A profile of 2^levels + 1 values under the filter whose details displace midpoints.
ModelPtr midpoints(int levels) {
  return from_polygon(named_filter("casteljau", Topology::joined, 2, 2), points_of({{0}, {1}}), false, levels);
}

// Fractional Brownian motion by midpoint displacement: displacements at level l of variance 2^(-2 l H).
ModelPtr brownian(double hurst, int levels, Random& random) {
  ModelPtr model = midpoints(levels);
  for (int level = 0; level < levels; ++level) {
    Points details = model->details(level);
    for (double& value : details.plane(0)) value = std::pow(2, -hurst * level) * normal(random);
    model = with_details(*model, level, details, Frame::absolute);
  }
  return model;
}

TEST(Spectrum, OfMidpointDisplacementFindsItsHurstExponent) {
  constexpr int levels = 14;
  // log rms of level l is known to 1 / sqrt(2 · 2^l); the slope's error follows from least squares over 2 … L - 2.
  double mean = 0, xx = 0, variance = 0;
  for (int l = 2; l < levels - 1; ++l) mean += l / (levels - 3.0);
  for (int l = 2; l < levels - 1; ++l) xx += (l - mean) * (l - mean);
  for (int l = 2; l < levels - 1; ++l) variance += std::pow((l - mean) / xx / std::log(2.0), 2) / (2 * std::pow(2, l));
  const double standard_error = std::sqrt(variance);
  ASSERT_LT(standard_error, 0.06);
  constexpr double bias = 0.01;  // hats of few places have a little more energy than hats of many, see Takagi's below
  for (const double hurst : {0.2, 0.5, 0.8})
    for (const int seed : {1, 2, 3}) {
      Random random(static_cast<Random::result_type>(seed));
      const Spectrum told = spectrum(*brownian(hurst, levels, random));
      EXPECT_EQ(told.first, 2);
      EXPECT_EQ(told.last, levels - 2);
      EXPECT_NEAR(told.hurst, hurst, bias + 5 * standard_error) << "seed " << seed;
      EXPECT_NEAR(told.dimension, 2 - hurst, bias + 5 * standard_error);
      EXPECT_GT(told.r_squared, 0.8);
    }
}

TEST(Spectrum, OfTakagisFunctionIsThatOfItsHats) {
  // T(x) = sum of 2^-l times the distance of 2^l x from the nearest whole number, at 2^-10's multiples.
  Points takagi(1, 1025);
  for (Index k = 0; k < takagi.count(); ++k)
    for (int l = 0; l < 10; ++l) {
      const double x = std::ldexp(static_cast<double>(k), l - 10);
      takagi.matrix()(k, 0) += std::ldexp(std::abs(x - std::round(x)), -l);
    }
  const Spectrum told = spectrum(*analyze(named_filter("casteljau", Topology::joined, 2, 2), takagi, false));
  ASSERT_EQ(told.rms.size(), 10U);
  for (std::size_t l = 0; l < 10; ++l) {
    EXPECT_EQ(told.scales[l], std::ldexp(1.0, -static_cast<int>(l)));
    // The level's own part of the function: 2^l hats of height 2^-l / 2, each over 2^(10 - l) places, m each side:
    // their squares add up to (2 m² + 1) / (3 m) of height².
    const double m = std::ldexp(1.0, 9 - static_cast<int>(l)), height = std::ldexp(0.5, -static_cast<int>(l));
    const double squares = std::ldexp(height * height * (2 * m * m + 1) / (3 * m), static_cast<int>(l));
    EXPECT_NEAR(told.rms[l], std::sqrt(squares / 1025), 1e-12);
  }
  // 1, but for the hats of few places: 2 m² + 1 over 2 m² is 9/8 at the finest level that is fitted, m = 2.
  EXPECT_NEAR(told.hurst, 1, 0.02);
  EXPECT_NEAR(told.dimension, 1, 0.02);
  EXPECT_LT(told.standard_error, 0.02);
}

TEST(Spectrum, ScalesWithTheCurveAndKeepsItsExponent) {
  Random random(4);
  for (const Topology topology : {Topology::joined, Topology::square}) {
    const Points curve = random_curve(random, 1025, 2, Kind::walk);
    const FilterPtr filter = casteljau(Shape(topology, 5, 2));
    const Spectrum told = spectrum(*analyze(filter, curve, false));
    for (const double size : {1e-200, 3.0, 1e200}) {
      Points other = curve;
      other.matrix() *= size;
      const Spectrum scaled = spectrum(*analyze(filter, other, false));
      EXPECT_NEAR(scaled.hurst, told.hurst, 1e-9);
      for (std::size_t l = 0; l < told.rms.size(); ++l)
        EXPECT_NEAR(scaled.rms[l], told.rms[l] * size, 1e-9 * told.rms[l] * size);
    }
  }
}

TEST(Spectrum, OfARandomWalkInThePlaneImpliesItsDimensionTwo) {
  Random random(5);
  const ModelPtr model =
      analyze(casteljau(Shape(Topology::joined, 5, 2)), random_curve(random, 4 * 4096 + 1, 2, Kind::walk), false);
  const Spectrum told = spectrum(*model);
  EXPECT_NEAR(told.hurst, 0.5, 0.06);  // a walk's own scatter over ten levels
  EXPECT_NEAR(told.dimension, 2, 0.25);
}

TEST(Spectrum, IsTheSignificancesOfEachLevelAndLeavesLevelsWithoutDetailsOut) {
  Random random(6);
  const ModelPtr model = brownian(0.5, 9, random);
  Points none = model->details(4);
  none.matrix().setZero();
  const Spectrum told = spectrum(*with_details(*model, 4, none, Frame::absolute));
  EXPECT_EQ(told.rms[4], 0);
  std::vector<double> x, y;
  for (const int l : {2, 3, 5, 6, 7}) {
    x.push_back(-l * std::log(2.0));
    y.push_back(0.5 *
                std::log(significance(*model, l).squaredNorm() / static_cast<double>(model->placement().places())));
    EXPECT_NEAR(std::log(told.rms[static_cast<std::size_t>(l)]), y.back(), 1e-12);
  }
  EXPECT_NEAR(told.hurst, trend(x, y).slope, 1e-12);
}

TEST(Spectrum, OfTooFewLevelsOrOfNoDetailsHasNoExponent) {
  for (const int levels : {0, 1, 2, 8}) {
    const Spectrum told = spectrum(*midpoints(levels));
    EXPECT_EQ(told.rms, std::vector<double>(static_cast<std::size_t>(levels), 0.0));
    EXPECT_TRUE(std::isnan(told.hurst));
    EXPECT_TRUE(std::isnan(told.dimension));
  }
}

}  // namespace
