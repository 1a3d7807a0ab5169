// What a caller may say wrongly about samples: each is refused by argument, index and value, before Ceres sees it.
#include "fit/target.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "curves.h"
#include "fit/curve_stage.h"

namespace ifsm::core {
namespace {

FitResult fitted(const std::vector<FitCurve>& curves, const CurveOptions& options) {
  Watch watch;
  return fit_curve(curves, options, watch);
}

TEST(Target, PutsSamplesWhereTheRuleSays) {
  Points points(1, 5);
  points.matrix() << 0, 1, 5, 5, 14;  // gaps 1, 4, 0, 9
  const FilterPtr filter = named_filter("casteljau", Topology::joined, 3, 2);
  for (const bool closed : {false, true}) {
    const FitCurve curve{points, closed};
    const ModelPtr model = analyze(filter, points, closed);
    const auto at = [&](ParameterRule rule) { return make_target(curve, {}, rule, *model, "").parameters; };
    const double chord = closed ? 28 : 14, centripetal = closed ? 6 + std::sqrt(14) : 6;
    const double roots[] = {0, 1, 3, 3, 6}, lengths[] = {0, 1, 5, 5, 14};
    for (std::size_t k = 0; k < 5; ++k) {
      EXPECT_DOUBLE_EQ(at(ParameterRule::chord)[k], lengths[k] / chord);
      EXPECT_DOUBLE_EQ(at(ParameterRule::centripetal)[k], roots[k] / centripetal);
      EXPECT_EQ(at(ParameterRule::index)[k], model->placement().parameter(static_cast<Index>(k)));
    }
  }
}

TEST(Target, MeasuresResidualsInUnitsOfTheirCovariance) {
  const FitCurve curve{walk(3, 2, 1), false};
  const ModelPtr model = analyze(named_filter("casteljau", Topology::joined, 3, 2), curve.samples, false);
  FitSamples told;
  told.covariances = {1, 0, 0, 1, 4, 1, 1, 2, 9, 0, 0, 0.25};
  const Target target = make_target(curve, told, ParameterRule::index, *model, "");
  const Eigen::RowVector2d error(3, -1);
  EXPECT_DOUBLE_EQ(target.squared(0, error), 10);
  EXPECT_NEAR(target.squared(1, error), (2 * 9 + 2 * 3 + 4) / 7.0, 1e-14);  // inverse ((2, -1), (-1, 4)) / 7
  EXPECT_NEAR(target.squared(2, error), 5, 1e-14);
}

struct Refused {
  const char* what;
  FitSamples samples;
  ParameterRule rule;
  Status status;
  std::string argument;
  Index index;
};

TEST(Target, RefusesWhatCannotBeFittedAndSaysWhich) {
  const Points points = walk(5, 2, 1);
  using Kind = ConstraintKind;
  constexpr auto given = ParameterRule::given, by_index = ParameterRule::index;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> right = {0, 0.1, 0.5, 0.7, 1};
  const Refused table[] = {
      {"too few parameters", {{0, 1}, {}, {}, {}, false}, given, Status::shape, "samples[0].parameters", -1},
      {"not increasing", {{0, 0.5, 0.5, 0.7, 1}, {}, {}, {}, false}, given, Status::range, "samples[0].parameters", 2},
      {"outside", {{0, 0.1, 0.5, 0.7, 1.5}, {}, {}, {}, false}, given, Status::range, "samples[0].parameters", 4},
      {"not finite", {{0, 0.1, nan, 0.7, 1}, {}, {}, {}, false}, given, Status::not_finite, "samples[0].parameters", 2},
      {"given against the rule", {right, {}, {}, {}, false}, by_index, Status::range, "samples[0].parameters", -1},
      {"zero weight", {{}, {1, 1, 0, 1, 1}, {}, {}, false}, by_index, Status::range, "samples[0].weights", 2},
      {"negative weight", {{}, {1, 1, 1, 1, -2}, {}, {}, false}, by_index, Status::range, "samples[0].weights", 4},
      {"infinite weight",
       {{}, {1, 1, 1 / 0., 1, 1}, {}, {}, false},
       by_index,
       Status::not_finite,
       "samples[0].weights",
       2},
      {"too few weights", {{}, {1, 1}, {}, {}, false}, by_index, Status::shape, "samples[0].weights", -1},
      {"indefinite covariance",
       {{}, {}, {1, 0, 0, 1, 1, 0, 0, 1, 1, 2, 2, 1, 1, 0, 0, 1, 1, 0, 0, 1}, {}, false},
       by_index,
       Status::range,
       "samples[0].covariances",
       8},
      {"asymmetric covariance",
       {{}, {}, {1, 0, 0, 1, 1, 0.5, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, {}, false},
       by_index,
       Status::range,
       "samples[0].covariances",
       4},
      {"both",
       {{}, {1, 1, 1, 1, 1}, std::vector<double>(20, 1.0), {}, false},
       by_index,
       Status::range,
       "samples[0].covariances",
       -1},
      {"two points at one parameter",
       {{}, {}, {}, {{Kind::point, 0.5, {1, 1}}, {Kind::point, 0.5, {1, 2}}}, false},
       by_index,
       Status::range,
       "samples[0].constraint_values",
       2},
      {"more points than control points",
       {{},
        {},
        {},
        {{Kind::point, 0.1, {0, 1}},
         {Kind::point, 0.3, {5, 1}},
         {Kind::point, 0.6, {1, 1}},
         {Kind::point, 0.9, {1, 2}}},
        false},
       by_index,
       Status::range,
       "samples[0].constraint_values",
       6},
      {"a point against a fixed end",
       {{}, {}, {}, {{Kind::point, 0, {7, 7}}}, true},
       by_index,
       Status::range,
       "samples[0].constraint_values",
       0},
      {"a constraint outside",
       {{}, {}, {}, {{Kind::point, 1.5, {7, 7}}}, true},
       by_index,
       Status::range,
       "samples[0].constraint_parameters",
       0},
      {"a tangent inside",
       {{}, {}, {}, {{Kind::tangent, 0.5, {7, 7}}}, true},
       by_index,
       Status::range,
       "samples[0].constraint_parameters",
       0},
      {"no direction",
       {{}, {}, {}, {{Kind::tangent, 0, {0, 0}}}, true},
       by_index,
       Status::range,
       "samples[0].constraint_values",
       0},
      {"a point not finite",
       {{}, {}, {}, {{Kind::point, 0.5, {1, nan}}}, true},
       by_index,
       Status::not_finite,
       "samples[0].constraint_values",
       1},
  };
  for (const Refused& refused : table) {
    CurveOptions options;
    options.control_points = 3;
    options.parameters = refused.rule;
    options.samples = {refused.samples};
    try {
      fitted({{points, false}}, options);
      ADD_FAILURE() << refused.what;
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), refused.status) << refused.what << ": " << error.what();
      EXPECT_EQ(error.argument(), refused.argument) << refused.what << ": " << error.what();
      EXPECT_EQ(error.index(), refused.index) << refused.what << ": " << error.what();
    }
  }
}

TEST(CurveStage, RefusesScalesAndTolerancesThatAreNotAboveZero) {
  const Points points = walk(40, 2, 1);
  for (const double wrong : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    CurveOptions scale, tolerance;
    scale.loss = {LossKind::cauchy, wrong};
    tolerance.tolerance = wrong;
    EXPECT_THROW(fitted({{points, false}}, scale), Error);
    EXPECT_THROW(fitted({{points, false}}, tolerance), Error);
  }
  CurveOptions few;
  few.levels = 1;
  EXPECT_THROW(fitted({{points, false}}, few), Error);
  CurveOptions uneven;
  uneven.samples.resize(2);
  EXPECT_THROW(fitted({{points, false}}, uneven), Error);
}

}  // namespace
}  // namespace ifsm::core
