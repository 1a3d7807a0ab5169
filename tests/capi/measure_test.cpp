// Questions through the C ABI: each function's answer, and the refusals that the misuse matrix does not know of.
#include <cmath>
#include <vector>

#include "shapes.h"
#include "support.h"

namespace {

// A square of 17 places, corners at 0, 1/4, …, going round; and an eight, which crosses itself in the middle.
std::vector<double> square() {
  std::vector<double> points;
  for (int k = 0; k < 16; ++k) {
    const double along = k % 4;
    const double x[] = {along, 4, 4 - along, 0}, y[] = {0, along, 4, 4 - along};
    points.push_back(x[k / 4]);
    points.push_back(y[k / 4]);
  }
  return points;
}

class Questions : public testing::Test {
 protected:
  void SetUp() override {
    WORKS(ifsm_filter_named("casteljau", IFSM_TOPOLOGY_JOINED, 3, 2, &filter));
    const ifsm_curve ring = curve_of(square_, 2, 1), eight = curve_of(eight_, 2, 1), wave = curve_of(wave_);
    WORKS(ifsm_model_create(filter, &ring, nullptr, &square_model));
    WORKS(ifsm_model_create(filter, &eight, nullptr, &eight_model));
    WORKS(ifsm_model_create(filter, &wave, nullptr, &wave_model));
  }
  void TearDown() override {
    for (const ifsm_model model : {square_model, eight_model, wave_model, made}) WORKS(ifsm_model_destroy(model));
    WORKS(ifsm_filter_destroy(filter));
  }
  const std::vector<double> square_ = square(), eight_ = {0, 0, 2, 2, 2, 0, 0, 2}, wave_ = wavy(129);
  ifsm_filter filter{};
  ifsm_model square_model{}, eight_model{}, wave_model{}, made{};
  double rows[600]{};
  int64_t count = 0;
};

TEST_F(Questions, LengthsAddUpAndGoRound) {
  double all = 0, part = 0, back = 0, turns = 0;
  WORKS(ifsm_model_length(square_model, 0, 1, &all));
  WORKS(ifsm_model_length(square_model, 0.125, 0.5, &part));
  WORKS(ifsm_model_length(square_model, 0.5, 0.125, &back));
  WORKS(ifsm_model_length(square_model, -1, 1.5, &turns));
  EXPECT_NEAR(all, 16, 1e-12);
  EXPECT_NEAR(part, 6, 1e-12);
  EXPECT_EQ(back, -part);
  EXPECT_NEAR(turns, 40, 1e-12);
}

TEST_F(Questions, SpacedPointsAreAskedForByTheirNumberOrTheirDistance) {
  WORKS(ifsm_model_spaced(square_model, 4, 0, rows, 600, &count));
  ASSERT_EQ(count, 4);
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(rows[k], 0.25 * k, 1e-14);
  WORKS(ifsm_model_spaced(square_model, 0, 2.0, nullptr, 0, &count));
  EXPECT_EQ(count, 8);
  WORKS(ifsm_model_spaced(wave_model, int64_t{1} << 40, 0, nullptr, 0, &count));  // the count costs nothing
  EXPECT_EQ(count, int64_t{1} << 40);
  FAILS(ifsm_model_spaced(square_model, 0, 0, rows, 600, &count), IFSM_ERROR_RANGE, "spacing");
  FAILS(ifsm_model_spaced(square_model, 4, 2.0, rows, 600, &count), IFSM_ERROR_RANGE, "spacing");
  FAILS(ifsm_model_spaced(square_model, 0, 1e-13, rows, 600, &count), IFSM_ERROR_RANGE, "spacing");
}

TEST_F(Questions, NearestPointsAreTellingRows) {
  const double queries[] = {2, 1, 5, 5};
  WORKS(ifsm_model_nearest(square_model, queries, 4, rows, 600, &count));
  ASSERT_EQ(count, 8);
  const double wanted[] = {0.125, 1, 2, 0, 0.5, std::sqrt(2.0), 4, 4};
  for (int k = 0; k < 8; ++k) EXPECT_NEAR(rows[k], wanted[k], 1e-12) << k;
  FAILS(ifsm_model_nearest(square_model, queries, 3, rows, 600, &count), IFSM_ERROR_RANGE, "query_count");
  const double far[] = {1e300, 0};
  FAILS(ifsm_model_nearest(square_model, far, 2, rows, 600, &count), IFSM_ERROR_NUMERICAL, "queries");
}

TEST_F(Questions, CurvatureIsZeroOnAStraightAndPositiveAtALeftCorner) {
  const double parameters[] = {0.125, 0.25};
  WORKS(ifsm_model_curvature(square_model, 1, parameters, 2, rows, 600, &count));
  ASSERT_EQ(count, 2);
  EXPECT_NEAR(rows[0], 0, 1e-12);
  EXPECT_GT(rows[1], 0.5);
  FAILS(ifsm_model_curvature(square_model, 8.1, parameters, 2, rows, 600, &count), IFSM_ERROR_RANGE, "scale");
}

TEST_F(Questions, AnEightCrossesItselfOnce) {
  WORKS(ifsm_model_crossings(eight_model, rows, 600, &count));
  ASSERT_EQ(count, 6);
  const double wanted[] = {0.125, 0.625, 0.125, 0.625, 1, 1};
  for (int k = 0; k < 6; ++k) EXPECT_NEAR(rows[k], wanted[k], 1e-14);
  WORKS(ifsm_model_crossings(square_model, rows, 600, &count));
  EXPECT_EQ(count, 0);
}

TEST_F(Questions, DimensionsComeWithTheirCounts) {
  ifsm_dimension_report report{};
  report.struct_size = sizeof report;
  ifsm_dimension_options options;
  WORKS(ifsm_dimension_options_init(&options, sizeof options));
  options.method = IFSM_DIMENSION_DIVIDER, options.scales = 5, options.smallest = 0.5, options.largest = 4;
  WORKS(ifsm_model_dimension(wave_model, &options, &report, rows, 600, &count));
  ASSERT_EQ(count, 10);
  EXPECT_EQ(report.scales, 5);
  EXPECT_NEAR(rows[0], 4, 1e-12);
  EXPECT_NEAR(rows[8], 0.5, 1e-12);
  EXPECT_GT(report.dimension, 0.9);
  EXPECT_LT(report.dimension, 1.3);  // a smooth wave
  WORKS(ifsm_model_dimension(wave_model, nullptr, &report, nullptr, 0, &count));
  EXPECT_EQ(count, 24);
  options.largest = 1000;
  FAILS(ifsm_model_dimension(wave_model, &options, &report, rows, 600, &count), IFSM_ERROR_RANGE, "largest");
}

TEST_F(Questions, TheSpectrumHasARowForEachLevel) {
  ifsm_spectrum_report report{};
  report.struct_size = sizeof report;
  WORKS(ifsm_model_spectrum(wave_model, &report, rows, 600, &count));
  EXPECT_EQ(count, 2 * report.levels);
  EXPECT_EQ(report.first, 2);
  EXPECT_EQ(report.last, report.levels - 2);
  EXPECT_EQ(rows[2], 0.5);
  EXPECT_GT(report.hurst, 1);  // smooth, but for a kink
  EXPECT_EQ(report.dimension, 1);
}

TEST_F(Questions, RefiningKeepsTheSamplesAndIsSeeded) {
  ifsm_refine_options options;
  WORKS(ifsm_refine_options_init(&options, sizeof options));
  options.levels = 2, options.seed = uint64_t{1} << 60;
  WORKS(ifsm_model_refine(wave_model, &options, &made));
  ifsm_model_info info{};
  info.struct_size = sizeof info;
  WORKS(ifsm_model_describe(made, &info));
  EXPECT_EQ(info.samples, 513);
  std::vector<double> parameters(129), points(258);
  WORKS(ifsm_model_parameters(wave_model, parameters.data(), 129, &count));
  WORKS(ifsm_model_evaluate(made, IFSM_CURVE_POLYLINE, parameters.data(), 129, points.data(), 258, &count));
  for (std::size_t k = 0; k < 258; ++k) EXPECT_NEAR(points[k], wave_[k], 1e-11);
  options.roughness = -2;
  FAILS(ifsm_model_refine(wave_model, &options, &made), IFSM_ERROR_RANGE, "roughness");
  ifsm_filter haar{};
  ifsm_model stairs{};
  const ifsm_curve wave = curve_of(wave_);
  WORKS(ifsm_filter_named("haar", IFSM_TOPOLOGY_SQUARE, 0, 0, &haar));
  WORKS(ifsm_model_create(haar, &wave, nullptr, &stairs));
  ifsm_model none{};
  FAILS(ifsm_model_refine(stairs, nullptr, &none), IFSM_ERROR_SHAPE, "model");
  EXPECT_EQ(none.id, 0U);
  WORKS(ifsm_model_destroy(stairs));
  WORKS(ifsm_filter_destroy(haar));
}

}  // namespace
