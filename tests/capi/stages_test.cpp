// Stages curve and filter through the C ABI: arrays about samples, and what is refused in them.
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "shapes.h"
#include "support.h"

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

class Stages : public testing::Test {
 protected:
  void SetUp() override {
    WORKS(ifsm_fit_curve_options_init(&options, sizeof options));
    options.control_points = 3;
    options.iterations = 5;
    options.samples = &known;
    options.sample_count = 1;
  }
  void TearDown() override { WORKS(ifsm_fit_destroy(fit)); }

  std::vector<double> points = wavy(9);
  ifsm_curve curve = curve_of(points);
  ifsm_fit_samples known{};
  ifsm_fit_curve_options options{};
  ifsm_fit fit{};
};

TEST_F(Stages, ReportWhatTheyFound) {
  const std::vector<double> weights(9, 2.0);
  known.weights = weights.data(), known.weight_count = 9;
  WORKS(ifsm_fit_curve(&curve, 1, &options, &fit));
  ifsm_fit_report report{};
  report.struct_size = sizeof report;
  WORKS(ifsm_fit_describe(fit, &report));
  EXPECT_EQ(report.stage, IFSM_STAGE_CURVE);
  EXPECT_EQ(report.budgets, 1);
  EXPECT_LE(report.final_cost, report.start_cost);
  EXPECT_GT(report.freedom, 0);
  EXPECT_GT(report.noise, 0);
  ifsm_fit_budget row{};
  row.struct_size = sizeof row;
  WORKS(ifsm_fit_describe_budget(fit, 0, 0, &row));
  EXPECT_EQ(row.budget, 3);
  EXPECT_EQ(row.details, 0);
  EXPECT_NEAR(report.final_cost, 2 * 9 * row.rms * row.rms, 1e-9 * report.final_cost);

  // Its sketch, at the parameters of the fit, is as far from the samples as told.
  std::vector<double> parameters(9), at(18);
  std::int64_t count = 0;
  WORKS(ifsm_fit_parameters(fit, 0, parameters.data(), 9, &count));
  ifsm_model sketch{};
  WORKS(ifsm_fit_sketch(fit, 0, 0, &sketch));
  WORKS(ifsm_model_evaluate(sketch, IFSM_CURVE_POLYLINE, parameters.data(), 9, at.data(), 18, &count));
  double sum = 0;
  for (std::size_t i = 0; i < 18; ++i) sum += (at[i] - points[i]) * (at[i] - points[i]);
  EXPECT_NEAR(std::sqrt(sum / 9), row.rms, 1e-9);
  WORKS(ifsm_model_destroy(sketch));
}

TEST_F(Stages, RefuseArraysThatDoNotHoldWhatTheyMust) {
  struct Wrong {
    const char* argument;
    ifsm_status status;
    std::int64_t index;
    std::function<void(ifsm_fit_samples&)> make;
  };
  const double increasing[] = {0, .1, .2, .3, .4, .5, .6, .7, .8}, falling[] = {0, .1, .2, .1, .4, .5, .6, .7, .8};
  const double weights[] = {1, 1, 1, 0, 1, 1, 1, 1, 1}, endless[] = {1, 1, nan, 1, 1, 1, 1, 1, 1};
  std::vector<double> covariances(36, 1.0);  // singular
  const std::int32_t kinds[] = {1, 7}, two_points[] = {1, 1};
  const double at[] = {0.5, 0.5}, values[] = {1, 1, 2, 2};
  const auto constrain = [&](ifsm_fit_samples& s) {
    s.constraint_kinds = two_points, s.constraint_parameters = at, s.constraint_values = values;
    s.constraint_count = 2;
  };
  const Wrong table[] = {
      {"samples[0].parameters", IFSM_ERROR_NULL, -1, [](auto& s) { s.parameter_count = 9; }},
      {"samples[0].parameter_count", IFSM_ERROR_RANGE, -1, [](auto& s) { s.parameter_count = -1; }},
      {"samples[0].parameters", IFSM_ERROR_RANGE, -1,  // the rule says to compute them
       [&](auto& s) { s.parameters = increasing, s.parameter_count = 9; }},
      {"samples[0].weights", IFSM_ERROR_SHAPE, -1, [&](auto& s) { s.weights = weights, s.weight_count = 8; }},
      {"samples[0].weights", IFSM_ERROR_RANGE, 3, [&](auto& s) { s.weights = weights, s.weight_count = 9; }},
      {"samples[0].weights", IFSM_ERROR_NOT_FINITE, 2, [&](auto& s) { s.weights = endless, s.weight_count = 9; }},
      {"samples[0].covariances", IFSM_ERROR_RANGE, 0,
       [&](auto& s) { s.covariances = covariances.data(), s.covariance_count = 36; }},
      {"samples[0].constraint_kinds", IFSM_ERROR_NULL, -1, [](auto& s) { s.constraint_count = 1; }},
      {"samples[0].constraint_count", IFSM_ERROR_RANGE, -1, [](auto& s) { s.constraint_count = 1025; }},
      {"samples[0].constraint_kinds", IFSM_ERROR_RANGE, 1, [&](auto& s) { constrain(s), s.constraint_kinds = kinds; }},
      {"samples[0].constraint_values", IFSM_ERROR_NULL, -1,
       [&](auto& s) { constrain(s), s.constraint_values = nullptr; }},
      {"samples[0].constraint_values", IFSM_ERROR_RANGE, 2, constrain},  // contradict each other
      {"samples[0].fixed_ends", IFSM_ERROR_RANGE, -1, [](auto& s) { s.fixed_ends = 2; }},
      {"samples[0].reserved", IFSM_ERROR_RANGE, -1, [](auto& s) { s.reserved = 1; }},
  };
  for (const Wrong& wrong : table) {
    known = {};
    wrong.make(known);
    EXPECT_EQ(ifsm_fit_curve(&curve, 1, &options, &fit), wrong.status) << wrong.argument;
    EXPECT_EQ(fit.id, 0U);
    const ifsm_error error = last_error();
    EXPECT_STREQ(error.argument, wrong.argument) << error.message;
    EXPECT_EQ(error.index, wrong.index) << error.message;
  }
  known = {};
  options.parameters = IFSM_PARAMETERS_GIVEN;
  known.parameters = falling, known.parameter_count = 9;
  EXPECT_EQ(ifsm_fit_curve(&curve, 1, &options, &fit), IFSM_ERROR_RANGE);
  EXPECT_EQ(last_error().index, 3);
  EXPECT_EQ(last_error().value, 0.1);
}

TEST_F(Stages, RefuseScalesAndCountsThatCannotBe) {
  const auto refused = [&](const char* argument, ifsm_status status) {
    EXPECT_EQ(ifsm_fit_curve(&curve, 1, &options, &fit), status) << argument;
    EXPECT_STREQ(last_error().argument, argument) << last_error().message;
  };
  options.loss = IFSM_LOSS_TUKEY;
  for (const double scale : {0.0, -1.0}) options.loss_scale = scale, refused("loss_scale", IFSM_ERROR_RANGE);
  options.loss = IFSM_LOSS_SQUARES, options.loss_scale = 0;
  options.tolerance = -1e-6, refused("tolerance", IFSM_ERROR_RANGE);
  options.tolerance = 0, options.levels = 1, refused("levels", IFSM_ERROR_RANGE);
  options.levels = 0, options.sample_count = 2, options.samples = nullptr, refused("samples", IFSM_ERROR_NULL);
  const ifsm_fit_samples two[2] = {};
  options.samples = two, refused("samples", IFSM_ERROR_SHAPE);
}

TEST_F(Stages, TellCovariancesOfTheStageThatHasThem) {
  WORKS(ifsm_fit_filter(&curve, 1, nullptr, &fit));
  std::int64_t count = 0;
  WORKS(ifsm_fit_filter_covariance(fit, nullptr, 0, &count));
  EXPECT_EQ(count, 36 * 36);
  EXPECT_EQ(ifsm_fit_covariance(fit, 0, nullptr, 0, &count), IFSM_ERROR_RANGE);
  const double middle = 0.5;
  EXPECT_EQ(ifsm_fit_curve_covariance(fit, 0, &middle, 1, nullptr, 0, &count), IFSM_ERROR_RANGE);
  ifsm_fit sparse{};
  WORKS(ifsm_fit_sparse(&curve, 1, nullptr, &sparse));
  EXPECT_EQ(ifsm_fit_filter_covariance(sparse, nullptr, 0, &count), IFSM_ERROR_RANGE);
  WORKS(ifsm_fit_parameters(sparse, 0, nullptr, 0, &count));
  EXPECT_EQ(count, 9);
  WORKS(ifsm_fit_destroy(sparse));
}

}  // namespace
