#include "base/error.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

using namespace ifsm::core;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t largest = std::numeric_limits<std::int64_t>::max();

// The error that `call` throws; the test fails when it throws none.
template <typename Call>
Error error_of(Call call) {
  try {
    call();
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "nothing was thrown";
  return {Status::ok, "", ""};
}

TEST(Error, SaysNothingAboutIndexValueAndCountUnlessTold) {
  const Error error(Status::shape, "matrix", "Give more.");
  EXPECT_EQ(error.status(), Status::shape);
  EXPECT_EQ(error.argument(), "matrix");
  EXPECT_STREQ(error.what(), "Give more.");
  EXPECT_EQ(error.index(), -1);
  EXPECT_TRUE(std::isnan(error.value()));
  EXPECT_EQ(error.required(), -1);
}

TEST(Error, KeepsIndexValueAndCountWhenThrown) {
  const Error error = error_of([] { throw Error(Status::capacity, "points", "Small.").at(3).with(-0.5).needs(12); });
  EXPECT_EQ(error.index(), 3);
  EXPECT_EQ(error.value(), -0.5);
  EXPECT_EQ(error.required(), 12);
}

TEST(InRange, SaysWhatMayBeGiven) {
  const auto told = [](std::int64_t low, std::int64_t high) {
    return std::string(error_of([&] { in_range(9, low, high, "level"); }).what());
  };
  EXPECT_EQ(told(0, 3), "level is 9; give a value from 0 to 3.");
  EXPECT_EQ(told(0, 0), "level is 9; it must be 0.");
  EXPECT_EQ(told(0, -1), "level is 9; there are none to choose from here.");
}

TEST(RequireFinite, OfOneNumberTellsNoIndex) {
  EXPECT_NO_THROW(require_finite(-1e300, "scale"));
  for (const double bad : {nan, infinity, -infinity}) {
    const Error error = error_of([&] { require_finite(bad, "scale"); });
    EXPECT_EQ(error.status(), Status::not_finite);
    EXPECT_EQ(error.argument(), "scale");
    EXPECT_EQ(error.index(), -1);
    EXPECT_EQ(std::isnan(error.value()), std::isnan(bad));
  }
}

RC_GTEST_PROP(InRange, GivesTheValueBackInsideAndAnErrorThatNamesItOutside,
              (std::int64_t value, std::int64_t low, std::int64_t high)) {
  if (low <= value && value <= high) {
    RC_ASSERT(in_range(value, low, high, "level") == value);
  } else {
    const Error error = error_of([&] { in_range(value, low, high, "level"); });
    RC_ASSERT(error.status() == Status::range);
    RC_ASSERT(error.argument() == "level");
    RC_ASSERT(error.value() == static_cast<double>(value));
    RC_ASSERT(std::string(error.what()).find(std::to_string(value)) != std::string::npos);
  }
}

TEST(InRange, TakesBothEnds) {
  EXPECT_EQ(in_range(-1, -1, 1, "x"), -1);
  EXPECT_EQ(in_range(1, -1, 1, "x"), 1);
  EXPECT_EQ(error_of([] { in_range(2, -1, 1, "x"); }).status(), Status::range);
  EXPECT_EQ(error_of([] { in_range(-2, -1, 1, "x"); }).status(), Status::range);
}

RC_GTEST_PROP(RequireFinite, FindsTheFirstOneThatIsNot, (std::vector<double> values)) {
  values.push_back(1.0);
  const auto at = *rc::gen::inRange<std::size_t>(0, values.size());
  const auto later = *rc::gen::inRange<std::size_t>(at, values.size());
  values[later] = nan;
  values[at] = *rc::gen::element(infinity, -infinity);
  const auto count = static_cast<std::int64_t>(values.size());
  const Error error = error_of([&] { require_finite(values.data(), count, "samples"); });
  RC_ASSERT(error.status() == Status::not_finite);
  RC_ASSERT(error.argument() == "samples");
  RC_ASSERT(error.index() == static_cast<std::int64_t>(at));
  RC_ASSERT(std::isinf(error.value()));
}

TEST(RequireFinite, TakesTheLargestTheSmallestAndNothingAtAll) {
  const double values[] = {std::numeric_limits<double>::max(), std::numeric_limits<double>::denorm_min(), -0.0};
  EXPECT_NO_THROW(require_finite(values, 3, "x"));
  EXPECT_NO_THROW(require_finite(nullptr, 0, "x"));
}

RC_GTEST_PROP(CheckedProduct, IsTheProductOrALimitErrorAsTheExactOneSays, (std::int64_t a, std::int64_t b)) {
  const __int128 exact = static_cast<__int128>(a) * b;
  if (a >= 0 && b >= 0 && exact <= (__int128{1} << 62)) {
    RC_ASSERT(checked_product(a, b, "count") == static_cast<std::int64_t>(exact));
  } else {
    RC_ASSERT(error_of([&] { checked_product(a, b, "count"); }).status() == Status::limit);
  }
}

TEST(CheckedProduct, TakesZeroAndRefusesWhatWraps) {
  EXPECT_EQ(checked_product(0, largest, "x"), 0);
  EXPECT_EQ(checked_product(largest, 0, "x"), 0);
  for (const std::int64_t factor : {std::int64_t{2}, std::int64_t{1} << 32, largest})
    EXPECT_EQ(error_of([&] { checked_product(largest, factor, "x"); }).status(), Status::limit) << factor;
  EXPECT_EQ(error_of([] { checked_product(-1, -1, "x"); }).status(), Status::limit);
}

RC_GTEST_PROP(TextOf, ReadsBackAsTheSameDouble, (double value)) {
  const double back = std::stod(text_of(value));
  RC_ASSERT(back == value);
  RC_ASSERT(std::signbit(back) == std::signbit(value));
}

TEST(TextOf, IsShort) {
  EXPECT_EQ(text_of(0.1), "0.1");
  EXPECT_EQ(text_of(nan), "nan");
  EXPECT_EQ(text_of(-infinity), "-inf");
  EXPECT_LE(text_of(-std::numeric_limits<double>::denorm_min()).size(), 32U);
}

}  // namespace
