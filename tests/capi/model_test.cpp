// Models through the C ABI: each function's answer, and each kind of refusal.
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "shapes.h"
#include "support.h"

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// All that an output function gives, by its two-step call.
template <class T, class Call>
std::vector<T> all_of(const Call& call) {
  int64_t count = 0;
  EXPECT_EQ(call(nullptr, 0, &count), IFSM_OK) << last_error().message;
  std::vector<T> values(static_cast<std::size_t>(count));
  EXPECT_EQ(call(values.data(), count, &count), IFSM_OK) << last_error().message;
  EXPECT_EQ(count, static_cast<int64_t>(values.size()));
  return values;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  EXPECT_EQ(a.size(), b.size());
  double largest = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

std::vector<double> samples_of(ifsm_model model) {
  return all_of<double>([&](auto... to) { return ifsm_model_samples(model, to...); });
}

ifsm_model_info describe(ifsm_model model) {
  ifsm_model_info info{};
  info.struct_size = sizeof info;
  EXPECT_EQ(ifsm_model_describe(model, &info), IFSM_OK);
  return info;
}

class Model : public testing::Test {
 protected:
  void SetUp() override {
    WORKS(ifsm_filter_named("casteljau", IFSM_TOPOLOGY_JOINED, 4, 2, &filter));
    const ifsm_curve curve = curve_of(samples);
    WORKS(ifsm_model_create(filter, &curve, nullptr, &model));
  }
  void TearDown() override {
    WORKS(ifsm_model_destroy(made));
    WORKS(ifsm_model_destroy(model));
    WORKS(ifsm_filter_destroy(filter));
  }
  const std::vector<double> samples = wavy(193);  // as many as there are places: 3·2^6 + 1
  ifsm_filter filter{};
  ifsm_model model{};
  ifsm_model made{};
};

TEST_F(Model, TellsItsShape) {
  const ifsm_model_info info = describe(model);
  EXPECT_EQ(info.dimension, 2);
  EXPECT_EQ(info.closed, 0);
  EXPECT_EQ(info.levels, 6);
  EXPECT_EQ(info.control_points, 4);
  EXPECT_EQ(info.maps, 2);
  EXPECT_EQ(info.topology, IFSM_TOPOLOGY_JOINED);
  EXPECT_EQ(info.details_per_node, 3);
  EXPECT_EQ(info.samples, 193);
  EXPECT_EQ(info.places, 193);
  EXPECT_EQ(info.details, 3 * 63);
  EXPECT_GT(info.diagonal, 10);
  EXPECT_GT(info.largest_polygon, 0);
}

TEST_F(Model, GivesItsSamplesBack) { EXPECT_LT(largest_difference(samples_of(model), samples), 1e-12 * 11); }

TEST_F(Model, OutlivesItsFilter) {
  WORKS(ifsm_filter_destroy(std::exchange(filter, {})));
  EXPECT_LT(largest_difference(samples_of(model), samples), 1e-12 * 11);
  WORKS(ifsm_model_filter(model, &filter));
  ifsm_filter_info info{};
  info.struct_size = sizeof info;
  WORKS(ifsm_filter_describe(filter, &info));
  EXPECT_EQ(info.control_points, 4);
}

TEST_F(Model, LivesUntilTheCallEndsThatUsesItWhileItIsDestroyed) {
  const std::vector<double> expected = samples_of(model);
  std::atomic<int> wrong{0}, refused{0};
  std::vector<std::thread> readers;
  for (int t = 0; t < 3; ++t)
    readers.emplace_back([&] {
      std::vector<double> points(expected.size());
      int64_t count = 0;
      ifsm_status status = IFSM_OK;
      while ((status = ifsm_model_samples(model, points.data(), static_cast<int64_t>(points.size()), &count)) ==
             IFSM_OK)
        if (points != expected) ++wrong;
      if (status == IFSM_ERROR_INVALID_HANDLE) ++refused;
    });
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  WORKS(ifsm_model_destroy(std::exchange(model, {})));
  for (auto& reader : readers) reader.join();
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(refused, 3);
}

TEST_F(Model, HasItsControlPointsAtLevelZeroAndItsSamplesAtTheLast) {
  const auto level = [&](int32_t l) {
    return all_of<double>([&](auto... to) { return ifsm_model_points(model, l, to...); });
  };
  EXPECT_EQ(level(0), all_of<double>([&](auto... to) { return ifsm_model_control_points(model, to...); }));
  EXPECT_EQ(level(3).size(), (3 * 8 + 1) * 2u);
  EXPECT_EQ(level(6), samples_of(model));
  int64_t count = 0;
  FAILS(ifsm_model_points(model, 7, nullptr, 0, &count), IFSM_ERROR_RANGE, "level");
  FAILS(ifsm_model_points(model, -1, nullptr, 0, &count), IFSM_ERROR_RANGE, "level");
}

TEST_F(Model, RepeatsTheFirstPointOfAClosedJoinedCurve) {
  const ifsm_curve ring = curve_of(samples, 2, 1);
  WORKS(ifsm_model_create(filter, &ring, nullptr, &made));
  for (int32_t l = 0; l <= describe(made).levels; ++l) {
    const auto points = all_of<double>([&](auto... to) { return ifsm_model_points(made, l, to...); });
    EXPECT_EQ(points.size(), static_cast<std::size_t>(((3 << l) + 1) * 2));
    EXPECT_EQ(points[0], points[points.size() - 2]);
    EXPECT_EQ(points[1], points[points.size() - 1]);
  }
  EXPECT_LT(largest_difference(samples_of(made), samples), 1e-12 * 11);
}

TEST_F(Model, PassesThroughItsSamplesAtTheirParameters) {
  const auto parameters = all_of<double>([&](auto... to) { return ifsm_model_parameters(model, to...); });
  ASSERT_EQ(parameters.size(), 193u);
  EXPECT_EQ(parameters.front(), 0);
  EXPECT_EQ(parameters.back(), 1);
  EXPECT_TRUE(std::is_sorted(parameters.begin(), parameters.end()));
  const auto points = all_of<double>(
      [&](auto... to) { return ifsm_model_evaluate(model, IFSM_CURVE_POLYLINE, parameters.data(), 193, to...); });
  EXPECT_EQ(points, samples_of(model));
}

TEST_F(Model, RefusesParametersThatItCannotEvaluate) {
  double points[4] = {7, 7, 7, 7};
  int64_t count = 0;
  const double beyond[] = {0.5, 1.5}, undefined[] = {0.5, nan};
  FAILS(ifsm_model_evaluate(model, 0, beyond, 2, points, 4, &count), IFSM_ERROR_RANGE, "parameters");
  EXPECT_EQ(last_error().index, 1);
  EXPECT_EQ(last_error().value, 1.5);
  FAILS(ifsm_model_evaluate(model, 0, undefined, 2, points, 4, &count), IFSM_ERROR_NOT_FINITE, "parameters");
  FAILS(ifsm_model_evaluate(model, 2, beyond, 2, points, 4, &count), IFSM_ERROR_RANGE, "curve");
  FAILS(ifsm_model_evaluate(model, 0, nullptr, 2, points, 4, &count), IFSM_ERROR_NULL, "parameters");
  FAILS(ifsm_model_evaluate(model, 0, beyond, -1, points, 4, &count), IFSM_ERROR_RANGE, "parameter_count");
  EXPECT_EQ(points[0], 7);
}

TEST_F(Model, FindsTheNodeOfAnAddressWhereTheParameterIs) {
  const auto symbols = all_of<int32_t>([&](auto... to) { return ifsm_model_address(model, 0.7, 5, to...); });
  EXPECT_EQ(symbols, (std::vector<int32_t>{1, 0, 1, 1, 0}));
  double first = -1, last = -1;
  WORKS(ifsm_model_interval(model, symbols.data(), 5, &first, &last));
  EXPECT_EQ(first, 22.0 / 32);
  EXPECT_EQ(last, 23.0 / 32);
  WORKS(ifsm_model_interval(model, nullptr, 0, &first, &last));
  EXPECT_EQ(first, 0);
  EXPECT_EQ(last, 1);
}

TEST_F(Model, RefusesAddressesOutsideItsTree) {
  int64_t count = 0;
  double first = -1, last = -1;
  const int32_t symbols[] = {0, 2};
  FAILS(ifsm_model_address(model, 1.5, 5, nullptr, 0, &count), IFSM_ERROR_RANGE, "parameter");
  FAILS(ifsm_model_address(model, nan, 5, nullptr, 0, &count), IFSM_ERROR_NOT_FINITE, "parameter");
  FAILS(ifsm_model_address(model, 0.5, 0, nullptr, 0, &count), IFSM_ERROR_RANGE, "length");
  FAILS(ifsm_model_interval(model, symbols, 2, &first, &last), IFSM_ERROR_RANGE, "symbols");
  EXPECT_EQ(last_error().index, 1);
  FAILS(ifsm_model_interval(model, symbols, 1025, &first, &last), IFSM_ERROR_RANGE, "symbol_count");
  FAILS(ifsm_model_interval(model, symbols, 1, nullptr, &last), IFSM_ERROR_NULL, "first");
  EXPECT_EQ(last, -1);
}

TEST_F(Model, ComesBackFromItsDetailsInEitherFrame) {
  for (const int32_t frame : {IFSM_FRAME_ABSOLUTE, IFSM_FRAME_NODE}) {
    const auto vectors = all_of<double>([&](auto... to) { return ifsm_model_details(model, 2, frame, to...); });
    ASSERT_EQ(vectors.size(), 4u * 3 * 2);
    WORKS(ifsm_model_with_details(model, 2, frame, vectors.data(), 24, &made));
    EXPECT_LT(largest_difference(samples_of(made), samples), 1e-12 * 11);
    WORKS(ifsm_model_destroy(std::exchange(made, {})));
  }
}

TEST_F(Model, WeighsEveryDetail) {
  const auto values = all_of<double>([&](auto... to) { return ifsm_model_significance(model, 2, to...); });
  ASSERT_EQ(values.size(), 4u * 3);
  EXPECT_GT(*std::max_element(values.begin(), values.end()), 0);
  EXPECT_GE(*std::min_element(values.begin(), values.end()), 0);
}

TEST_F(Model, RefusesDetailsThatDoNotFit) {
  int64_t count = 0;
  std::vector<double> vectors(24, 0.0);
  FAILS(ifsm_model_details(model, 6, 0, nullptr, 0, &count), IFSM_ERROR_RANGE, "level");
  FAILS(ifsm_model_details(model, 0, 2, nullptr, 0, &count), IFSM_ERROR_RANGE, "frame");
  FAILS(ifsm_model_significance(model, 6, nullptr, 0, &count), IFSM_ERROR_RANGE, "level");
  FAILS(ifsm_model_with_details(model, 2, 0, vectors.data(), 23, &made), IFSM_ERROR_SHAPE, "count");
  EXPECT_EQ(last_error().required, 24);
  vectors[5] = nan;
  FAILS(ifsm_model_with_details(model, 2, 0, vectors.data(), 24, &made), IFSM_ERROR_NOT_FINITE, "vectors");
  EXPECT_EQ(last_error().index, 5);
  EXPECT_EQ(made.id, 0u);
}

TEST_F(Model, MovesWithItsControlPoints) {
  auto points = all_of<double>([&](auto... to) { return ifsm_model_control_points(model, to...); });
  for (std::size_t i = 0; i < points.size(); i += 2) points[i] += 3, points[i + 1] -= 2;
  WORKS(ifsm_model_with_control_points(model, IFSM_FRAME_NODE, points.data(), 8, &made));
  auto moved = samples;
  for (std::size_t i = 0; i < moved.size(); i += 2) moved[i] += 3, moved[i + 1] -= 2;
  EXPECT_LT(largest_difference(samples_of(made), moved), 1e-11);
  EXPECT_LT(largest_difference(samples_of(model), samples), 1e-11);  // the old one stays
}

TEST_F(Model, RefusesControlPointsThatDoNotFit) {
  std::vector<double> points(8, 1.0);
  FAILS(ifsm_model_with_control_points(model, 1, points.data(), 7, &made), IFSM_ERROR_SHAPE, "count");
  FAILS(ifsm_model_with_control_points(model, 2, points.data(), 8, &made), IFSM_ERROR_RANGE, "frame");
  FAILS(ifsm_model_with_control_points(model, 1, nullptr, 8, &made), IFSM_ERROR_NULL, "points");
  FAILS(ifsm_model_with_control_points(model, 1, points.data(), 8, nullptr), IFSM_ERROR_NULL, "changed");
  points[3] = nan;
  FAILS(ifsm_model_with_control_points(model, 1, points.data(), 8, &made), IFSM_ERROR_NOT_FINITE, "points");
  EXPECT_EQ(last_error().index, 3);
}

TEST_F(Model, TakesAnotherFilterOfItsShapeOnly) {
  WORKS(ifsm_model_with_filter(model, filter, &made));
  EXPECT_EQ(samples_of(made), samples_of(model));
  ifsm_filter other{};
  WORKS(ifsm_filter_named("casteljau", IFSM_TOPOLOGY_JOINED, 5, 2, &other));
  ifsm_model none{};
  FAILS(ifsm_model_with_filter(model, other, &none), IFSM_ERROR_SHAPE, "filter");
  WORKS(ifsm_filter_destroy(other));
  FAILS(ifsm_model_with_filter(model, other, &none), IFSM_ERROR_INVALID_HANDLE, "filter");
  EXPECT_EQ(none.id, 0u);
}

ifsm_keep_options keep_options(int32_t rule, int64_t count) {
  ifsm_keep_options options;
  EXPECT_EQ(ifsm_keep_options_init(&options, sizeof options), IFSM_OK);
  options.rule = rule, options.count = count;
  return options;
}

TEST_F(Model, KeepsAsManyDetailsAsItIsTold) {
  auto options = keep_options(IFSM_KEEP_COUNT, 20);
  WORKS(ifsm_model_keep(model, &options, &made));
  EXPECT_EQ(describe(made).details_kept, 20);
  const double rough = largest_difference(samples_of(made), samples);
  WORKS(ifsm_model_destroy(std::exchange(made, {})));
  options.count = 60;
  WORKS(ifsm_model_keep(model, &options, &made));
  EXPECT_LT(largest_difference(samples_of(made), samples), rough);
  WORKS(ifsm_model_destroy(std::exchange(made, {})));
  options = keep_options(IFSM_KEEP_LEVELS, 2);
  WORKS(ifsm_model_keep(model, &options, &made));
  EXPECT_EQ(describe(made).details_kept, 9);
  WORKS(ifsm_model_destroy(std::exchange(made, {})));
  options = keep_options(IFSM_KEEP_THRESHOLD, 0);
  options.threshold = 1e300;
  WORKS(ifsm_model_keep(model, &options, &made));
  EXPECT_EQ(describe(made).details_kept, 0);
}

TEST_F(Model, ComesNearerToItsSamplesWhenItIsResolved) {
  const auto squares = [&](ifsm_model of) {
    const auto points = samples_of(of);
    double sum = 0;
    for (std::size_t i = 0; i < points.size(); ++i) sum += (points[i] - samples[i]) * (points[i] - samples[i]);
    return sum;
  };
  auto options = keep_options(IFSM_KEEP_COUNT, 12);
  ifsm_model kept{};
  WORKS(ifsm_model_keep(model, &options, &kept));
  double error = squares(kept);
  WORKS(ifsm_model_destroy(kept));
  for (const int32_t resolve : {IFSM_RESOLVE_VALUES, IFSM_RESOLVE_CHOICE}) {
    options.resolve = resolve;
    WORKS(ifsm_model_keep(model, &options, &made));
    EXPECT_LE(describe(made).details_kept, 12);
    EXPECT_LT(squares(made), error);
    error = squares(made);
    WORKS(ifsm_model_destroy(std::exchange(made, {})));
  }
}

TEST_F(Model, RefusesToKeepWithoutARule) {
  FAILS(ifsm_model_keep(model, nullptr, &made), IFSM_ERROR_NULL, "options");
  auto options = keep_options(0, 5);
  FAILS(ifsm_model_keep(model, &options, &made), IFSM_ERROR_RANGE, "rule");
  options = keep_options(IFSM_KEEP_COUNT, -1);
  FAILS(ifsm_model_keep(model, &options, &made), IFSM_ERROR_RANGE, "count");
  options = keep_options(IFSM_KEEP_THRESHOLD, 0);
  options.threshold = nan;
  FAILS(ifsm_model_keep(model, &options, &made), IFSM_ERROR_NOT_FINITE, "threshold");
  options = keep_options(IFSM_KEEP_COUNT, 5);
  options.resolve = 3;
  FAILS(ifsm_model_keep(model, &options, &made), IFSM_ERROR_RANGE, "resolve");
  options.resolve = 0, options.distance = 3;
  FAILS(ifsm_model_keep(model, &options, &made), IFSM_ERROR_RANGE, "distance");
  options = keep_options(IFSM_KEEP_WITHIN, 0);
  options.threshold = -1;
  FAILS(ifsm_model_keep(model, &options, &made), IFSM_ERROR_RANGE, "threshold");
  options = keep_options(IFSM_KEEP_LEVELS_WITHIN, 0);
  options.threshold = 1, options.resolve = IFSM_RESOLVE_CHOICE;
  FAILS(ifsm_model_keep(model, &options, &made), IFSM_ERROR_RANGE, "resolve");
  options.struct_size = 0;
  FAILS(ifsm_model_keep(model, &options, &made), IFSM_ERROR_OPTIONS, "options");
}

TEST_F(Model, KeepsWhatItsBoundNeeds) {
  ifsm_distances apart{};
  apart.struct_size = sizeof apart;
  WORKS(ifsm_model_distance(model, model, &apart));
  EXPECT_EQ(apart.hausdorff, 0);
  for (const int32_t rule : {IFSM_KEEP_WITHIN, IFSM_KEEP_LEVELS_WITHIN})
    for (const int32_t resolve : {IFSM_RESOLVE_NONE, IFSM_RESOLVE_VALUES, IFSM_RESOLVE_CHOICE})
      for (const int32_t distance : {IFSM_DISTANCE_RMS, IFSM_DISTANCE_LARGEST, IFSM_DISTANCE_HAUSDORFF}) {
        if (rule == IFSM_KEEP_LEVELS_WITHIN && resolve == IFSM_RESOLVE_CHOICE) continue;
        auto options = keep_options(rule, 0);
        options.threshold = 0.05, options.resolve = resolve, options.distance = distance;
        WORKS(ifsm_model_keep(model, &options, &made));
        WORKS(ifsm_model_distance(model, made, &apart));
        EXPECT_LE((std::array{apart.rms, apart.largest, apart.hausdorff})[static_cast<std::size_t>(distance)], 0.05);
        WORKS(ifsm_model_destroy(std::exchange(made, {})));
      }
}

TEST_F(Model, StopsKeepingWhenItsProgressCallbackSaysSo) {
  auto options = keep_options(IFSM_KEEP_WITHIN, 0);
  options.threshold = 0.05;
  options.progress = [](void*, double, const char* stage) -> int32_t { return std::string(stage) == "search" ? 1 : 0; };
  FAILS(ifsm_model_keep(model, &options, &made), IFSM_ERROR_CANCELLED, "");
  EXPECT_EQ(made.id, 0u);
}

TEST_F(Model, StopsKeepingWhenItsTokenSaysSo) {
  auto options = keep_options(IFSM_KEEP_COUNT, 5);
  WORKS(ifsm_cancel_create(&options.cancel));
  WORKS(ifsm_cancel_request(options.cancel));
  FAILS(ifsm_model_keep(model, &options, &made), IFSM_ERROR_CANCELLED, "");
  EXPECT_EQ(made.id, 0u);
  WORKS(ifsm_cancel_destroy(options.cancel));
  FAILS(ifsm_model_keep(model, &options, &made), IFSM_ERROR_INVALID_HANDLE, "cancel");
}

TEST_F(Model, ComesBackFromBothFormatsBitForBit) {
  for (const int32_t format : {IFSM_FORMAT_JSON, IFSM_FORMAT_CBOR}) {
    const auto bytes = all_of<uint8_t>([&](auto... to) { return ifsm_model_save(model, format, to...); });
    WORKS(ifsm_model_load(bytes.data(), static_cast<int64_t>(bytes.size()), &made));
    EXPECT_EQ(samples_of(made), samples_of(model));
    WORKS(ifsm_model_destroy(std::exchange(made, {})));
  }
}

TEST_F(Model, RefusesBytesThatAreNoModel) {
  const uint8_t bytes[] = {'{', '}', 0};
  FAILS(ifsm_model_load(nullptr, 3, &made), IFSM_ERROR_NULL, "bytes");
  FAILS(ifsm_model_load(bytes, -1, &made), IFSM_ERROR_RANGE, "count");
  ASSERT_EQ(ifsm_model_load(bytes, 2, &made), IFSM_ERROR_FORMAT);
  ASSERT_EQ(ifsm_model_load(bytes, 0, &made), IFSM_ERROR_FORMAT);
  EXPECT_EQ(made.id, 0u);
  int64_t count = 0;
  FAILS(ifsm_model_save(model, 2, nullptr, 0, &count), IFSM_ERROR_RANGE, "format");
}

TEST_F(Model, OfAPolygonIsTheCurveOfItsFilter) {
  const std::vector<double> polygon{0, 0, 1, 2, 2, -2, 3, 0};
  const ifsm_curve curve = curve_of(polygon);
  WORKS(ifsm_model_from_polygon(filter, &curve, 4, &made));
  EXPECT_EQ(describe(made).details_kept, 0);
  EXPECT_EQ(describe(made).samples, 3 * 16 + 1);
  const double half = 0.5;
  const auto middle =
      all_of<double>([&](auto... to) { return ifsm_model_evaluate(made, IFSM_CURVE_LIMIT, &half, 1, to...); });
  EXPECT_NEAR(middle[0], 1.5, 1e-14);  // a Bézier curve: (1 3 3 1) / 8
  EXPECT_NEAR(middle[1], 0, 1e-14);
  const ifsm_curve shorter{polygon.data(), 3, 2, 0};
  ifsm_model none{};
  FAILS(ifsm_model_from_polygon(filter, &shorter, 4, &none), IFSM_ERROR_SHAPE, "count");
}

TEST_F(Model, RefusesCurvesThatAreNone) {
  std::vector<double> points = samples;
  ifsm_curve curve = curve_of(points);
  FAILS(ifsm_model_create(filter, nullptr, nullptr, &made), IFSM_ERROR_NULL, "curve");
  FAILS(ifsm_model_create(filter, &curve, nullptr, nullptr), IFSM_ERROR_NULL, "model");
  FAILS(ifsm_model_create(ifsm_filter{}, &curve, nullptr, &made), IFSM_ERROR_INVALID_HANDLE, "filter");
  curve.count = 1;
  FAILS(ifsm_model_create(filter, &curve, nullptr, &made), IFSM_ERROR_RANGE, "count");
  curve.count = INT64_MAX;
  FAILS(ifsm_model_create(filter, &curve, nullptr, &made), IFSM_ERROR_RANGE, "count");
  curve = curve_of(points), curve.dimension = 5;
  FAILS(ifsm_model_create(filter, &curve, nullptr, &made), IFSM_ERROR_RANGE, "dimension");
  curve = curve_of(points), curve.closed = 2;
  FAILS(ifsm_model_create(filter, &curve, nullptr, &made), IFSM_ERROR_RANGE, "closed");
  curve = curve_of(points), curve.points = nullptr;
  FAILS(ifsm_model_create(filter, &curve, nullptr, &made), IFSM_ERROR_NULL, "points");
  points[7] = -std::numeric_limits<double>::infinity();
  curve = curve_of(points);
  FAILS(ifsm_model_create(filter, &curve, nullptr, &made), IFSM_ERROR_NOT_FINITE, "points");
  EXPECT_EQ(last_error().index, 7);
  EXPECT_EQ(made.id, 0u);
}

TEST_F(Model, TakesLevelsFromItsOptions) {
  const ifsm_curve curve = curve_of(samples);
  ifsm_model_options options;
  WORKS(ifsm_model_options_init(&options, sizeof options));
  options.levels = 8;
  WORKS(ifsm_model_create(filter, &curve, &options, &made));
  EXPECT_EQ(describe(made).levels, 8);
  EXPECT_LT(largest_difference(samples_of(made), samples), 1e-12 * 11);
  ifsm_model none{};
  options.levels = 5;
  FAILS(ifsm_model_create(filter, &curve, &options, &none), IFSM_ERROR_RANGE, "levels");
  options.levels = 100;
  FAILS(ifsm_model_create(filter, &curve, &options, &none), IFSM_ERROR_LIMIT, "levels");
  options.levels = -1;
  FAILS(ifsm_model_create(filter, &curve, &options, &none), IFSM_ERROR_RANGE, "levels");
  options.struct_size = 3;
  FAILS(ifsm_model_create(filter, &curve, &options, &none), IFSM_ERROR_OPTIONS, "options");
  EXPECT_EQ(none.id, 0u);
}

}  // namespace
