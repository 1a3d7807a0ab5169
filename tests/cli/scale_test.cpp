// Ticks stand at round values within their scale, and their labels can be told apart.
#include "plot/scale.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace plot {
namespace {

RC_GTEST_PROP(Scale, LinearTicksLieWithinAndReadDifferently, ()) {
  const double magnitude = std::pow(10, *rc::gen::inRange(-12, 13));
  const double low = *rc::gen::inRange(-5000, 5000) * magnitude;
  const Scale scale(Scale::Kind::Linear, low, low + *rc::gen::inRange(1, 1000) * magnitude);
  const auto ticks = scale.ticks(*rc::gen::inRange(1, 10));
  std::set<std::string> labels;
  for (const auto& tick : ticks) {
    RC_ASSERT(scale.share(tick.value) >= -1e-9 && scale.share(tick.value) <= 1 + 1e-9);
    RC_ASSERT(tick.label.size() <= 12u);
    labels.insert(tick.label);
  }
  RC_ASSERT(labels.size() == ticks.size());
  RC_ASSERT(ticks.size() <= 17u);
}

RC_GTEST_PROP(Scale, LogarithmicTicksAreFewOverAnyNumberOfDecades, ()) {
  const double low = std::pow(10, *rc::gen::inRange(-300, 300) / 10.0);
  const Scale scale(Scale::Kind::Logarithmic, low, low * std::pow(10, *rc::gen::inRange(10, 1000) / 10.0));
  const auto ticks = scale.ticks(6);
  RC_ASSERT(!ticks.empty());
  RC_ASSERT(ticks.size() <= 14u);
  for (const auto& tick : ticks) RC_ASSERT(tick.label.size() <= 7u);
}

TEST(Scale, LabelsAreAsPeopleWriteThem) {
  EXPECT_EQ(scientific(1.25e-7, 3), "1.25e-7");
  EXPECT_EQ(scientific(2e6, 0), "2e6");
  EXPECT_EQ(scientific(0, 3), "0");
  EXPECT_EQ(plain(-0.0, 1), "0");
  EXPECT_EQ(plain(0.5, 3), "0.5");
}

}  // namespace
}  // namespace plot
