// The C++ wrapper, compiled as C++17 and as C++20.
#include <gtest/gtest.h>

#include <ifsm.hpp>

#include <cmath>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "shapes.h"

namespace {

static_assert(!std::is_copy_constructible_v<ifsm::Model> && std::is_nothrow_move_constructible_v<ifsm::Model>);
static_assert(!std::is_copy_constructible_v<ifsm::Filter> && std::is_nothrow_move_assignable_v<ifsm::Filter>);
static_assert(sizeof(ifsm::Model) == sizeof(ifsm_model));
static_assert(!std::is_constructible_v<ifsm::Curve, std::vector<double>&&, int>);

const std::vector<double> samples = wavy(129);

ifsm::Model wavy_model() {
  return ifsm::Model(ifsm::Filter::named("casteljau", ifsm::Topology::joined, 3), {samples, 2});
}

ifsm::FitOptions quick() {
  ifsm::FitOptions options;
  options.control_points = 3;
  options.iterations = 5;
  options.rounds = 1;
  return options;
}

TEST(Cpp, GivesTheSamplesBack) {
  const auto points = wavy_model().samples();
  ASSERT_EQ(points.size(), samples.size());
  for (std::size_t i = 0; i < points.size(); ++i) ASSERT_NEAR(points[i], samples[i], 1e-11);
}

TEST(Cpp, ThrowsAllThatTheRecordSays) {
  const ifsm::Model model = wavy_model();
  try {
    model.points(99);
    FAIL();
  } catch (const ifsm::Error& error) {
    EXPECT_EQ(error.status, IFSM_ERROR_RANGE);
    EXPECT_EQ(error.function, "ifsm_model_points");
    EXPECT_EQ(error.argument, "level");
    EXPECT_EQ(error.value, 99);
    EXPECT_EQ(error.index, -1);
    EXPECT_NE(std::string(error.what()).find("level"), std::string::npos);
  }
}

TEST(Cpp, LeavesTheNullHandleBehindAMove) {
  ifsm::Model model = wavy_model();
  const auto id = model.handle().id;
  ifsm::Model moved = std::move(model);
  EXPECT_EQ(moved.handle().id, id);
  EXPECT_EQ(model.handle().id, 0u);  // NOLINT: what a moved-from one is, is promised
  EXPECT_THROW(model.describe(), ifsm::Error);
  moved = wavy_model();
  EXPECT_NE(moved.handle().id, id);
  ifsm_model_info info{};
  info.struct_size = sizeof info;
  EXPECT_EQ(ifsm_model_describe(ifsm_model{id}, &info), IFSM_ERROR_INVALID_HANDLE);  // assignment destroyed the old one
}

TEST(Cpp, GivesItsHandleUpOnRelease) {
  ifsm::Model model = wavy_model();
  const ifsm_model released = model.release();
  EXPECT_EQ(model.handle().id, 0u);
  EXPECT_EQ(ifsm_model_destroy(released), IFSM_OK);
}

TEST(Cpp, MakesFiltersInEveryWay) {
  const auto named = ifsm::Filter::named("casteljau", ifsm::Topology::joined, 3, 2);
  const auto matrix = named.matrix();
  ASSERT_EQ(matrix.size(), 25u);
  EXPECT_EQ(ifsm::Filter::from_matrix(ifsm::Topology::joined, 3, 2, matrix).matrix(), matrix);
  const std::vector<double> maps(matrix.begin(), matrix.begin() + 15);
  EXPECT_EQ(ifsm::Filter::from_maps(ifsm::Topology::joined, 3, 2, maps).matrix(), matrix);
  EXPECT_EQ(named.describe().rows, 5);
  EXPECT_THROW(ifsm::Filter::named("nothing"), ifsm::Error);
}

TEST(Cpp, ReadsEveryPartOfAModel) {
  const ifsm::Model model = wavy_model();
  const auto info = model.describe();
  EXPECT_EQ(info.samples, 129);
  EXPECT_EQ(model.filter().describe().control_points, 3);
  EXPECT_EQ(model.points(info.levels), model.samples());
  EXPECT_EQ(model.points(0), model.control_points());
  EXPECT_EQ(model.evaluate(model.parameters()), model.samples());
  EXPECT_EQ(model.evaluate({}), std::vector<double>());
  EXPECT_EQ(model.address(0.75, 2), (std::vector<std::int32_t>{1, 1}));
  EXPECT_EQ(model.interval({1, 1}), (std::pair<double, double>(0.75, 1.0)));
  EXPECT_EQ(model.details(1).size(), 2u * 2 * 2);
  EXPECT_EQ(model.significance(1).size(), 2u * 2);
}

TEST(Cpp, DeformsAndUndoes) {
  const ifsm::Model model = wavy_model();
  ifsm::Deformer deformer(model, ifsm::Turning::rotation);
  const auto before = deformer.samples();
  const int finest = deformer.describe().levels;
  ifsm::MoveOptions falls;
  falls.falloff = ifsm::Falloff::smooth;
  falls.radius = 2;
  deformer.keep_as("start").move(0, {1}, {1, 2}).move(2, {3}, {0.5, 0.5}, falls).pin(2, {5});
  ifsm::RestyleOptions turned;
  turned.angle = 0.1;
  deformer.restyle(0, 1, 1.5, turned).texture(finest - 1, finest - 1);
  auto place = deformer.evaluate({0.4});
  place[0] += 0.25;
  deformer.drag(2, {0.4}, place, ifsm::Lead::details);
  EXPECT_NEAR(deformer.evaluate({0.4})[0], place[0], 1e-9);
  EXPECT_EQ(deformer.describe().undoable, 6);
  EXPECT_EQ(deformer.snapshot().samples().size(), before.size());
  EXPECT_GT(deformer.changed(finest).number, 0);
  EXPECT_EQ(deformer.points(2, 5, 1), (deformer.undo().redo(), deformer.points(2, 5, 1)));
  EXPECT_EQ(deformer.go_to("start").samples(), before);
  EXPECT_THROW(deformer.redo(), ifsm::Error);
}

TEST(Cpp, DeformsInTimeAndKeepsTheEdits) {
  const ifsm::Model model = wavy_model();
  ifsm::Deformer deformer(model);
  deformer.time(1, 3, ifsm::Easing::linear).move(0, {1}, {4, 2}).time(3, 3).restyle(0, 1, 0.5);
  EXPECT_EQ(deformer.at_time(1).samples(), ifsm::Deformer(model).samples());
  EXPECT_EQ(deformer.at_time(3).samples(), deformer.samples());
  const auto from = ifsm::Deformer(model).points(0, 1, 1), half = deformer.at_time(2).points(0, 1, 1);
  EXPECT_NEAR(half[0], from[0] + 2, 1e-12);
  EXPECT_NEAR(half[1], from[1] + 1, 1e-12);
  ifsm::Deformer again(model);
  EXPECT_EQ(again.replay(deformer.save(ifsm::Format::json)).samples(), deformer.samples());
  for (const ifsm::Crossing& crossing : again.crossings()) EXPECT_LT(crossing.first_p, crossing.first_q);
}

TEST(Cpp, AsksEveryQuestion) {
  const ifsm::Model model = wavy_model();
  EXPECT_GT(model.length(), 10);
  EXPECT_NEAR(model.length(0, 0.5) + model.length(0.5, 1), model.length(), 1e-12);
  EXPECT_EQ(model.spaced(7).size(), 7u);
  EXPECT_EQ(model.spaced_by(model.length() / 4).size(), 5u);
  const auto nearest = model.nearest({0, 0, 5, 3});
  ASSERT_EQ(nearest.size(), 2u);
  EXPECT_NEAR(std::hypot(nearest[1].point[0] - 5, nearest[1].point[1] - 3), nearest[1].distance, 1e-12);
  EXPECT_EQ(model.curvature({0.25, 0.5}, 1).size(), 2u);
  EXPECT_TRUE(model.crossings().empty());
  const auto dimension = model.dimension(ifsm::Count::divider, 5);
  EXPECT_EQ(dimension.counts.size(), 5u);
  EXPECT_EQ(dimension.report.scales, 5);
  const auto spectrum = model.spectrum();
  EXPECT_EQ(static_cast<int>(spectrum.rms.size()), spectrum.report.levels);
  ifsm::RefineOptions finer;
  finer.levels = 2;
  EXPECT_EQ(model.refine(finer).describe().levels, model.describe().levels + 2);
  const ifsm::Filter filter = model.filter();
  const std::vector<double> points{0, 0, 2, 2, 2, 0, 0, 2};
  const auto eight = ifsm::Model(filter, {points, 2, true}).crossings();
  ASSERT_EQ(eight.size(), 1u);
  EXPECT_NEAR(eight[0].x, 1, 1e-12);
}

TEST(Cpp, MakesOtherModels) {
  const ifsm::Model model = wavy_model();
  auto polygon = model.control_points();
  polygon[2] += 1;
  EXPECT_NE(model.with_control_points(polygon).samples(), model.samples());
  EXPECT_EQ(model.with_details(1, model.details(1)).samples(), model.samples());
  EXPECT_EQ(model.with_filter(model.filter()).samples(), model.samples());
  EXPECT_EQ(model.keep(ifsm::most_significant(7)).describe().details_kept, 7);
  EXPECT_EQ(model.keep(ifsm::first_levels(1)).describe().details_kept, 2);
  EXPECT_EQ(model.keep(ifsm::above(1e300)).describe().details_kept, 0);
  EXPECT_LE(model.keep(ifsm::most_significant(7).resolved()).describe().details_kept, 7);
  EXPECT_LE(model.distance(model.keep(ifsm::within(0.05, ifsm::Distance::hausdorff))).hausdorff, 0.05);
  EXPECT_LE(model.distance(model.keep(ifsm::levels_within(0.05, ifsm::Distance::largest))).largest, 0.05);
  EXPECT_EQ(ifsm::Model::from_polygon(model.filter(), {polygon, 2}, 3).describe().samples, 17);
}

TEST(Cpp, ReadsWhatItWrites) {
  const ifsm::Model model = wavy_model();
  for (const auto format : {ifsm::Format::json, ifsm::Format::cbor})
    EXPECT_EQ(ifsm::Model::load(model.save(format)).samples(), model.samples());
}

TEST(Cpp, FitsCurves) {
  auto options = quick();
  options.budgets = {6, 12};
  const auto start = ifsm::Filter::named("casteljau", ifsm::Topology::joined, 3);
  options.start = &start;
  const ifsm::Fit fit = ifsm::fit_sparse({{samples, 2}}, options);
  EXPECT_EQ(fit.describe().budgets, 2);
  EXPECT_EQ(fit.describe_budget(0, 1).details, 9);
  EXPECT_LE(fit.sketch(0, 1).describe().details_kept, 9);
  EXPECT_EQ(fit.model(0).describe().samples, 129);
  EXPECT_THROW(fit.model(1), ifsm::Error);
}

TEST(Cpp, TrainsAFilter) {
  ifsm::TrainOptions options;
  options.control_points = 3;
  options.rounds = options.iterations = 2;
  options.budgets = {12};
  options.hold_out = 2;
  const ifsm::Trained trained = ifsm::train({{samples, 2}, {samples, 2}}, options);
  EXPECT_EQ(trained.filter.describe().control_points, 3);
  EXPECT_EQ(trained.report.trained, 1);
  EXPECT_EQ(trained.report.held_out, 1);
  EXPECT_LE(trained.report.ratio, 1);
  options.progress = [](double, const std::string&) { return true; };
  EXPECT_THROW(ifsm::train({{samples, 2}}, options), ifsm::Cancelled);
}

TEST(Cpp, FitsACurveAndAFilterAlone) {
  ifsm::FitCurveOptions options;
  options.control_points = 4;
  options.iterations = 5;
  options.parameters = ifsm::Parameters::chord;
  options.loss = ifsm::Loss::huber;
  options.loss_scale = 2;
  options.samples.emplace_back().through(0.5, {60, 1}).along(0, {1, 0});
  options.samples[0].fixed_ends = true;
  const ifsm::Fit curve = ifsm::fit_curve({{samples, 2}}, options);
  EXPECT_EQ(curve.describe().stage, IFSM_STAGE_CURVE);
  const auto at = curve.sketch(0, 0).evaluate({0, 0.5});
  EXPECT_NEAR(at[0], samples[0], 1e-10);
  EXPECT_NEAR(at[2], 60, 1e-10);
  EXPECT_NEAR(at[3], 1, 1e-10);
  EXPECT_EQ(curve.parameters(0).size(), 129U);
  EXPECT_EQ(curve.covariance(0).size(), 64U);
  EXPECT_EQ(curve.filter_covariance().size(), 784U);
  EXPECT_EQ(curve.curve_covariance(0, {0.1, 0.9}).size(), 8U);
  options.samples.emplace_back();
  EXPECT_THROW(ifsm::fit_curve({{samples, 2}}, options), ifsm::Error);

  ifsm::FitFilterOptions levels;
  levels.control_points = 3;
  levels.kept_levels = 2;
  const ifsm::Fit filter = ifsm::fit_filter({{samples, 2}}, levels);
  EXPECT_EQ(filter.describe_budget(0, 0).details, 6);
  EXPECT_LE(filter.describe_budget(0, 0).rms, filter.describe_budget(0, 0).start_rms);
  EXPECT_EQ(filter.filter_covariance().size(), 100U);
  EXPECT_THROW(filter.covariance(0), ifsm::Error);
}

TEST(Cpp, CarriesWhatACallbackThrowsAroundTheLibrary) {
  auto options = quick();
  options.progress = [](double, const std::string&) -> bool { throw std::domain_error("mine"); };
  EXPECT_THROW(ifsm::fit_sparse({{samples, 2}}, options), std::domain_error);
}

TEST(Cpp, IsCancelledByACallbackOrAToken) {
  auto options = quick();
  options.progress = [](double, const std::string&) { return true; };
  EXPECT_THROW(ifsm::fit_sparse({{samples, 2}}, options), ifsm::Cancelled);
  const ifsm::Cancel token;
  EXPECT_FALSE(token.requested());
  token.request();
  EXPECT_TRUE(token.requested());
  EXPECT_THROW(wavy_model().keep(ifsm::most_significant(3).cancelled_by(token)), ifsm::Cancelled);
  const auto stop = [](double, const std::string&) { return true; };
  EXPECT_THROW(wavy_model().keep(ifsm::within(0.05).telling(stop)), ifsm::Cancelled);
  const auto fail = [](double, const std::string&) -> bool { throw std::domain_error("mine"); };
  EXPECT_THROW(wavy_model().keep(ifsm::within(0.05).telling(fail)), std::domain_error) << "comes out unchanged";
}

TEST(Cpp, MakesAsksAndSavesSystems) {
  const ifsm::System gasket(2, {.5, 0, 0, 0, .5, 0, .5, 0, .5, 0, .5, 0, .5, 0, 0, 0, .5, .5});
  EXPECT_EQ(gasket.describe().contractive, 1);
  EXPECT_NEAR(gasket.similarity_dimension(), std::log2(3.), 1e-14);
  EXPECT_EQ(gasket.point({1}), (std::vector<double>{1, 0}));
  EXPECT_EQ(gasket.addresses({.5, 0}, 1), (std::vector<std::int32_t>{0, 1}));
  EXPECT_EQ(gasket.word({1}), (std::vector<double>{.5, 0, .5, 0, .5, 0}));
  EXPECT_NEAR(gasket.diameter(), std::sqrt(2.), 1e-8);
  EXPECT_NEAR(gasket.moments(1)[1], 1. / 3, 1e-14);
  EXPECT_TRUE(gasket.witness().empty());
  EXPECT_EQ(ifsm::System::load(gasket.save(ifsm::Format::cbor)).maps(), gasket.maps());
  const auto text = gasket.save(ifsm::Format::fractint, "mine");
  EXPECT_EQ(ifsm::system_names(text), std::vector<std::string>{"mine"});
  EXPECT_EQ(ifsm::System::load(text, "mine").probabilities(), gasket.probabilities());
  const ifsm::System again = ifsm::System::from_parameters(2, gasket.parameters(), gasket.probabilities());
  EXPECT_EQ(again.fixed_points(), gasket.fixed_points());
  const ifsm::Model model = gasket.model(ifsm::Topology::square, 3);
  EXPECT_NEAR(ifsm::System::from_model(model).box()[2], 1, 1e-8);
  EXPECT_EQ(gasket.box_dimension(6).counts.size(), 6U);
  EXPECT_GT(ifsm::system_catalog().size(), 30U);
}

TEST(Cpp, DrawsSystems) {
  const ifsm::System fern = ifsm::System::named("fern");
  ifsm::PictureOptions options;
  options.width = 20, options.height = 10, options.points = 5000, options.seed = 3;
  double told = 0;
  options.progress = [&](double fraction, const std::string&) {
    told = fraction;
    return false;
  };
  const auto counts = fern.histogram(options);
  EXPECT_EQ(counts.report.inside, 5000);
  EXPECT_EQ(told, 1);
  std::int64_t sum = 0;
  for (const std::uint32_t count : counts.values) sum += count;
  EXPECT_EQ(sum, 5000);
  EXPECT_EQ(ifsm::tone_map(counts.values).size(), 800U);
  EXPECT_EQ(fern.render(options).values.size(), 800U);
  EXPECT_EQ(fern.set(options).values.size(), 200U);
  EXPECT_EQ(fern.distances(options).values.size(), 200U);
  EXPECT_EQ(fern.sample(options).size(), 10000U);
  EXPECT_EQ(fern.sample_addresses(2, options).size(), 10000U);
  options.progress = [](double, const std::string&) -> bool { throw std::out_of_range("mine"); };
  EXPECT_THROW(fern.render(options), std::out_of_range);
  options.progress = {};
  options.colour = ifsm::Colour::symbol, options.stops = {1, 2, 3};
  const auto symbols = fern.render(options).values;
  // Greys all over: nearly black, fainter where points are few. The usual colours have none.
  for (std::size_t pixel = 0; pixel < symbols.size(); pixel += 4) {
    EXPECT_LE(std::abs(symbols[pixel] - symbols[pixel + 1]), 4);
    EXPECT_LE(std::abs(symbols[pixel] - symbols[pixel + 2]), 4);
  }
  options.stops = {1, 2};
  EXPECT_THROW(fern.render(options), ifsm::Error);
}

TEST(Cpp, RefusesPointsThatAreNotWhole) {
  const std::vector<double> odd{1, 2, 3};
  EXPECT_THROW(ifsm::Curve(odd, 2), std::invalid_argument);
}

TEST(Cpp, SetsThreads) {
  ifsm::set_threads(2);
  EXPECT_EQ(ifsm::threads(), 2);
  ifsm::set_threads(0);
  EXPECT_THROW(ifsm::set_threads(-1), ifsm::Error);
  EXPECT_EQ(ifsm::version(), ifsm_version_text());
}

}  // namespace
