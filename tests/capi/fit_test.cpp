// Fits through the C ABI: what goes in, what comes out, and how they stop.
#include <array>
#include <chrono>
#include <cmath>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "shapes.h"
#include "support.h"

namespace {

ifsm_fit_options fit_options() {
  ifsm_fit_options options;
  EXPECT_EQ(ifsm_fit_options_init(&options, sizeof options), IFSM_OK);
  options.control_points = 3;
  options.iterations = 5;
  options.rounds = 1;
  return options;
}

class Fit : public testing::Test {
 protected:
  void TearDown() override { WORKS(ifsm_fit_destroy(fit)); }
  const std::vector<double> first = wavy(129), second = wavy(65);
  const std::vector<ifsm_curve> curves{curve_of(first), curve_of(second)};
  ifsm_fit fit{};
};

TEST_F(Fit, GivesOneFilterForAllCurvesAndReportsOnEachBudget) {
  auto options = fit_options();
  const int64_t budgets[] = {8, 16};
  options.budgets = budgets, options.budget_count = 2;
  WORKS(ifsm_fit_sparse(curves.data(), 2, &options, &fit));

  ifsm_fit_report report{};
  report.struct_size = sizeof report;
  WORKS(ifsm_fit_describe(fit, &report));
  EXPECT_EQ(report.curves, 2);
  EXPECT_EQ(report.budgets, 2);
  EXPECT_LE(report.final_cost, report.start_cost);

  for (int64_t curve = 0; curve < 2; ++curve)
    for (int64_t budget = 0; budget < 2; ++budget) {
      ifsm_fit_budget row{};
      row.struct_size = sizeof row;
      WORKS(ifsm_fit_describe_budget(fit, curve, budget, &row));
      EXPECT_EQ(row.budget, budgets[budget]);
      EXPECT_EQ(row.details, budgets[budget] - 3);
      EXPECT_LE(row.rms, row.max);
      EXPECT_LE(row.rms, row.start_rms);
    }
}

TEST_F(Fit, LeavesModelsThatOutliveIt) {
  const auto options = fit_options();
  WORKS(ifsm_fit_sparse(curves.data(), 2, &options, &fit));
  ifsm_model model{};
  WORKS(ifsm_fit_model(fit, 1, &model));
  FAILS(ifsm_fit_model(fit, 2, &model), IFSM_ERROR_RANGE, "curve");
  WORKS(ifsm_fit_destroy(std::exchange(fit, {})));
  std::vector<double> points(second.size());
  int64_t count = 0;
  WORKS(ifsm_model_samples(model, points.data(), static_cast<int64_t>(points.size()), &count));
  for (std::size_t i = 0; i < points.size(); ++i) ASSERT_NEAR(points[i], second[i], 1e-11);
  WORKS(ifsm_model_destroy(model));
}

TEST_F(Fit, GivesTheSketchThatItReportsOn) {
  auto options = fit_options();
  const int64_t budget = 16;
  options.budgets = &budget, options.budget_count = 1;
  WORKS(ifsm_fit_sparse(curves.data(), 1, &options, &fit));
  ifsm_fit_budget row{};
  row.struct_size = sizeof row;
  WORKS(ifsm_fit_describe_budget(fit, 0, 0, &row));
  ifsm_model sketch{};
  WORKS(ifsm_fit_sketch(fit, 0, 0, &sketch));
  ifsm_model_info info{};
  info.struct_size = sizeof info;
  WORKS(ifsm_model_describe(sketch, &info));
  EXPECT_LE(info.details_kept, 13);
  std::vector<double> points(first.size());
  int64_t count = 0;
  WORKS(ifsm_model_samples(sketch, points.data(), static_cast<int64_t>(points.size()), &count));
  double squares = 0;
  for (std::size_t i = 0; i < points.size(); ++i) squares += (points[i] - first[i]) * (points[i] - first[i]);
  EXPECT_NEAR(std::sqrt(squares / 129), row.rms, 1e-12);
  WORKS(ifsm_model_destroy(sketch));
}

TEST_F(Fit, KeepsTheBoundThatItIsGiven) {
  for (const int32_t distance : {IFSM_DISTANCE_RMS, IFSM_DISTANCE_LARGEST, IFSM_DISTANCE_HAUSDORFF}) {
    auto options = fit_options();
    options.within = 0.05, options.distance = distance;
    WORKS(ifsm_fit_sparse(curves.data(), 2, &options, &fit));
    for (const int64_t curve : {0, 1}) {
      ifsm_model model{}, sketch{};
      WORKS(ifsm_fit_model(fit, curve, &model));
      WORKS(ifsm_fit_sketch(fit, curve, 0, &sketch));
      ifsm_distances apart{};
      apart.struct_size = sizeof apart;
      WORKS(ifsm_model_distance(model, sketch, &apart));
      EXPECT_LE((std::array{apart.rms, apart.largest, apart.hausdorff})[static_cast<std::size_t>(distance)], 0.05);
      ifsm_fit_budget row{};
      row.struct_size = sizeof row;
      WORKS(ifsm_fit_describe_budget(fit, curve, 0, &row));
      EXPECT_EQ(row.details + options.control_points, row.budget);
      EXPECT_GT(row.start_details, 0);
      WORKS(ifsm_model_destroy(model));
      WORKS(ifsm_model_destroy(sketch));
    }
    WORKS(ifsm_fit_destroy(std::exchange(fit, {})));
  }
}

TEST_F(Fit, StartsFromTheFilterThatItIsGiven) {
  auto options = fit_options();
  WORKS(ifsm_filter_named("casteljau", IFSM_TOPOLOGY_JOINED, 4, 2, &options.start));
  WORKS(ifsm_fit_sparse(curves.data(), 1, &options, &fit));
  WORKS(ifsm_filter_destroy(options.start));
  ifsm_model model{};
  WORKS(ifsm_fit_model(fit, 0, &model));
  ifsm_model_info info{};
  info.struct_size = sizeof info;
  WORKS(ifsm_model_describe(model, &info));
  EXPECT_EQ(info.control_points, 4);
  WORKS(ifsm_model_destroy(model));
  ifsm_fit none{};
  FAILS(ifsm_fit_sparse(curves.data(), 1, &options, &none), IFSM_ERROR_INVALID_HANDLE, "start");
}

TEST_F(Fit, SumsUpInTheLog) {
  std::string logged;
  WORKS(ifsm_set_log([](void* user, int32_t, const char* text) { *static_cast<std::string*>(user) += text; }, &logged));
  const auto options = fit_options();
  WORKS(ifsm_fit_sparse(curves.data(), 1, &options, &fit));
  WORKS(ifsm_set_log(nullptr, nullptr));
  EXPECT_EQ(logged.rfind("ifsm_fit_sparse: ", 0), 0u) << logged;
}

TEST_F(Fit, WorksWithDefaultsAlone) {
  WORKS(ifsm_fit_sparse(curves.data(), 1, nullptr, &fit));
  ifsm_fit_budget row{};
  row.struct_size = sizeof row;
  WORKS(ifsm_fit_describe_budget(fit, 0, 0, &row));
  ifsm_model sketch{};
  FAILS(ifsm_fit_sketch(fit, 0, 1, &sketch), IFSM_ERROR_RANGE, "budget");
  FAILS(ifsm_fit_sketch(fit, -1, 0, &sketch), IFSM_ERROR_RANGE, "curve");
  FAILS(ifsm_fit_describe_budget(fit, 1, 0, &row), IFSM_ERROR_RANGE, "curve");
  FAILS(ifsm_fit_describe_budget(fit, 0, 1, &row), IFSM_ERROR_RANGE, "budget");
}

TEST_F(Fit, NamesTheCurveThatIsWrong) {
  auto wrong = curves;
  wrong[1].count = 1;
  ASSERT_EQ(ifsm_fit_sparse(wrong.data(), 2, nullptr, &fit), IFSM_ERROR_RANGE);
  EXPECT_STREQ(last_error().argument, "curves[1].count");
  wrong[1] = curves[1], wrong[1].points = nullptr;
  FAILS(ifsm_fit_sparse(wrong.data(), 2, nullptr, &fit), IFSM_ERROR_NULL, "curves[1].points");
  wrong[1] = curves[1], wrong[1].dimension = 1;
  FAILS(ifsm_fit_sparse(wrong.data(), 2, nullptr, &fit), IFSM_ERROR_SHAPE, "curves");
  EXPECT_EQ(last_error().index, 1);
  FAILS(ifsm_fit_sparse(nullptr, 2, nullptr, &fit), IFSM_ERROR_NULL, "curves");
  FAILS(ifsm_fit_sparse(curves.data(), 0, nullptr, &fit), IFSM_ERROR_RANGE, "curve_count");
  FAILS(ifsm_fit_sparse(curves.data(), 2, nullptr, nullptr), IFSM_ERROR_NULL, "fit");
  EXPECT_EQ(fit.id, 0u);
}

TEST_F(Fit, NamesTheOptionThatIsWrong) {
  const auto refuse = [&](const char* field, auto change) {
    auto options = fit_options();
    change(options);
    FAILS(ifsm_fit_sparse(curves.data(), 2, &options, &fit), IFSM_ERROR_RANGE, field);
  };
  const int64_t budgets[] = {8, 0};
  refuse("threads", [](auto& o) { o.threads = -1; });
  refuse("control_points", [](auto& o) { o.control_points = 17; });
  refuse("control_points", [](auto& o) { o.control_points = -2; });
  refuse("maps", [](auto& o) { o.maps = 9; });
  refuse("budget_count", [](auto& o) { o.budget_count = 65; });
  refuse("budgets", [&](auto& o) { o.budgets = budgets, o.budget_count = 2; });
  refuse("iterations", [](auto& o) { o.iterations = 1001; });
  refuse("rounds", [](auto& o) { o.rounds = -2; });
  refuse("polish", [](auto& o) { o.polish = 101; });
  refuse("distance", [](auto& o) { o.distance = 3; });
  refuse("within", [](auto& o) { o.within = -1; });
  refuse("within", [](auto& o) { o.within = 1e-300; });
  refuse("within", [](auto& o) {
    static const int64_t budget = 20;
    o.within = 1, o.budgets = &budget, o.budget_count = 1;
  });
  refuse("control_points", [](auto& o) { o.within = 1, o.control_points = -1; });
  EXPECT_EQ(fit.id, 0u);
}

TEST_F(Fit, StopsWhenItsProgressCallbackSaysSo) {
  auto options = fit_options();
  options.progress = [](void*, double, const char*) -> int32_t { return 1; };
  FAILS(ifsm_fit_sparse(curves.data(), 2, &options, &fit), IFSM_ERROR_CANCELLED, "");
  EXPECT_EQ(fit.id, 0u);
}

struct Seen {
  std::thread::id thread = std::this_thread::get_id();
  double fraction = 0;
  int calls = 0, elsewhere = 0, backwards = 0;
};

TEST_F(Fit, TellsItsProgressOnThisThreadAndForwards) {
  Seen seen;
  auto options = fit_options();
  options.user = &seen;
  options.progress = [](void* user, double fraction, const char* stage) -> int32_t {
    auto& so_far = *static_cast<Seen*>(user);
    ++so_far.calls;
    so_far.elsewhere += std::this_thread::get_id() == so_far.thread ? 0 : 1;
    so_far.backwards += fraction >= so_far.fraction && fraction <= 1 ? 0 : 1;
    so_far.fraction = fraction;
    EXPECT_NE(std::string(stage), "");
    return 0;
  };
  WORKS(ifsm_fit_sparse(curves.data(), 2, &options, &fit));
  EXPECT_GT(seen.calls, 0);
  EXPECT_EQ(seen.elsewhere, 0);
  EXPECT_EQ(seen.backwards, 0);
}

TEST_F(Fit, KeepsItsOwnRecordWhenACallbackFailedInside) {
  auto options = fit_options();
  options.progress = [](void*, double, const char*) -> int32_t {
    EXPECT_EQ(ifsm_set_threads(-1), IFSM_ERROR_RANGE);
    return 1;
  };
  FAILS(ifsm_fit_sparse(curves.data(), 2, &options, &fit), IFSM_ERROR_CANCELLED, "");
}

TEST_F(Fit, StopsWithin100MillisecondsOfItsTokensRequest) {
  const std::vector<double> long_curve = wavy(8193);
  const ifsm_curve curve = curve_of(long_curve);
  auto options = fit_options();
  options.iterations = 1000, options.rounds = 100, options.control_points = 5;
  WORKS(ifsm_cancel_create(&options.cancel));
  std::chrono::steady_clock::time_point asked;
  std::thread canceller([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(150));
    asked = std::chrono::steady_clock::now();
    EXPECT_EQ(ifsm_cancel_request(options.cancel), IFSM_OK);
  });
  const ifsm_status status = ifsm_fit_sparse(&curve, 1, &options, &fit);
  [[maybe_unused]] const auto answered = std::chrono::steady_clock::now();
  canceller.join();
  EXPECT_EQ(status, IFSM_ERROR_CANCELLED);
#if defined(NDEBUG) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  EXPECT_LT(std::chrono::duration<double>(answered - asked).count(), 0.1);
#endif
  WORKS(ifsm_cancel_destroy(options.cancel));
}

}  // namespace
