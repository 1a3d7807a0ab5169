// Training through the C ABI.
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "shapes.h"
#include "support.h"

namespace {

ifsm_train_options train_options() {
  ifsm_train_options options;
  EXPECT_EQ(ifsm_train_options_init(&options, sizeof options), IFSM_OK);
  options.control_points = 3;
  options.rounds = 2;
  return options;
}

ifsm_train_report empty_report() {
  ifsm_train_report report{};
  report.struct_size = sizeof report;
  return report;
}

class Train : public testing::Test {
 protected:
  void TearDown() override { WORKS(ifsm_filter_destroy(filter)); }
  static std::vector<double> matrix_of(ifsm_filter of) {
    std::vector<double> matrix(25);
    int64_t count = 0;
    EXPECT_EQ(ifsm_filter_matrix(of, matrix.data(), 25, &count), IFSM_OK);
    return matrix;
  }
  const std::vector<double> first = wavy(129), second = wavy(257), third = wavy(200);
  const std::vector<ifsm_curve> curves{curve_of(first), curve_of(second), curve_of(third)};
  ifsm_filter filter{};
};

TEST_F(Train, GivesAFilterAndTellsWhatItIsWorth) {
  auto options = train_options();
  options.hold_out = 3;
  auto report = empty_report();
  WORKS(ifsm_train(curves.data(), 3, &options, &filter, &report));
  EXPECT_EQ(report.trained, 2);
  EXPECT_EQ(report.held_out, 1);
  EXPECT_EQ(report.sketches, 3);  // 16 of the first; 16 and 32 of the second
  EXPECT_LT(report.ratio, 1);
  EXPECT_GT(report.held_out_ratio, 0);
  ifsm_filter_info info{};
  info.struct_size = sizeof info;
  WORKS(ifsm_filter_describe(filter, &info));
  EXPECT_EQ(info.control_points, 3);
  EXPECT_EQ(info.contractive, 1);
  EXPECT_LE(info.condition, 30);
}

TEST_F(Train, GivesTheSameBitsOnOneThreadAndOnTwo) {
  auto options = train_options();
  auto report = empty_report();
  options.threads = 1;
  WORKS(ifsm_train(curves.data(), 3, &options, &filter, &report));
  options.threads = 2;
  ifsm_filter again{};
  WORKS(ifsm_train(curves.data(), 3, &options, &again, &report));
  EXPECT_EQ(matrix_of(again), matrix_of(filter));
  WORKS(ifsm_filter_destroy(again));
}

TEST_F(Train, GoesOnFromAFilter) {
  auto options = train_options();
  auto report = empty_report();
  WORKS(ifsm_train(curves.data(), 3, &options, &filter, &report));
  options.start = filter;
  options.control_points = 0;
  ifsm_filter again{};
  WORKS(ifsm_train(curves.data(), 3, &options, &again, &report));
  EXPECT_LE(report.ratio, 1);
  EXPECT_GT(report.ratio, 0.9);  // there is little left to better
  WORKS(ifsm_filter_destroy(again));
}

TEST_F(Train, RefusesLimitsThatAreNone) {
  for (const double bad : {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    auto options = train_options();
    auto report = empty_report();
    options.condition = bad;
    FAILS(ifsm_train(curves.data(), 3, &options, &filter, &report),
          std::isfinite(bad) ? IFSM_ERROR_RANGE : IFSM_ERROR_NOT_FINITE, "condition");
  }
  auto options = train_options();
  auto report = empty_report();
  options.hold_out = 1;
  FAILS(ifsm_train(curves.data(), 3, &options, &filter, &report), IFSM_ERROR_RANGE, "hold_out");
}

TEST_F(Train, IsCancelledAndLeavesNothing) {
  auto options = train_options();
  auto report = empty_report();
  options.progress = [](void*, double, const char*) -> int32_t { return 1; };
  FAILS(ifsm_train(curves.data(), 3, &options, &filter, &report), IFSM_ERROR_CANCELLED, "");
  EXPECT_EQ(filter.id, 0u);
  EXPECT_EQ(report.trained, 0);
}

}  // namespace
