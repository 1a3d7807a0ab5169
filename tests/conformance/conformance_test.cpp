// The conformance file says what this library does. It is made here, and run by every language's binding.
//
//     IFSM_WRITE_CONFORMANCE=1 build/release/tests/conformance/test_conformance    writes it anew

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <set>

#include "script.h"

namespace {

using conformance::Json;

const std::vector<Json>& made() {
  static const std::vector<Json> steps = [] {
    conformance::Script script;
    conformance::add_library(script);
    conformance::add_filters(script);
    conformance::add_models(script);
    conformance::add_questions(script);
    conformance::add_fits(script);
    conformance::add_deformers(script);
    conformance::add_systems(script);
    conformance::add_pictures(script);
    return script.steps();
  }();
  return steps;
}

// One step a line, so that differences can be read.
void write(const std::vector<Json>& steps) {
  std::ofstream file(IFSM_CONFORMANCE_FILE);
  file << "{\"version\": 1, \"steps\": [";
  for (std::size_t i = 0; i < steps.size(); ++i) file << (i == 0 ? "\n" : ",\n") << steps[i].dump();
  file << "\n]}\n";
  file.close();
  ASSERT_TRUE(file) << IFSM_CONFORMANCE_FILE;
}

bool is_real(const Json& value) {
  if (!value.is_string()) return false;
  const auto text = value.get<std::string>();
  return text.starts_with("0x") || text.starts_with("-0x") || text == "nan" || text == "inf" || text == "-inf";
}

// Equal, but for doubles of results that went through another libm. Those differ in their last bits at first; a fit's
// iterations make that more.
bool agree(const Json& here, const Json& there, bool libm) {
  constexpr double tolerance = 1e-6;
  if (!libm || here.type() != there.type()) return here == there;
  if (is_real(here) && is_real(there)) {
    const double a = conformance::real_of(here), b = conformance::real_of(there);
    return here == there || std::abs(a - b) <= tolerance * std::max({1.0, std::abs(a), std::abs(b)});
  }
  if (!here.is_structured() || here.size() != there.size()) return here == there;
  return std::equal(here.begin(), here.end(), there.begin(),
                    [](const Json& a, const Json& b) { return agree(a, b, true); });
}

TEST(ConformanceFile, SaysWhatTheLibraryDoes) {
  const std::vector<Json>& steps = made();
  if (const char* asked = std::getenv("IFSM_WRITE_CONFORMANCE"); asked != nullptr && std::string(asked) == "1")
    write(steps);
  std::ifstream file(IFSM_CONFORMANCE_FILE);
  ASSERT_TRUE(file) << IFSM_CONFORMANCE_FILE;
  const Json expected = Json::parse(file).at("steps");
  for (std::size_t i = 0; i < std::min(steps.size(), expected.size()); ++i)
    ASSERT_TRUE(agree(steps[i], expected[i], steps[i].contains("libm")))
        << "step " << i << " is\n  " << steps[i] << "\nand the file says\n  " << expected[i]
        << "\nIf that is meant: IFSM_WRITE_CONFORMANCE=1";
  EXPECT_EQ(steps.size(), expected.size());
}

TEST(ConformanceFile, CallsEveryFunctionRightlyAndWrongly) {
  std::set<std::string> right, wrong;
  for (const Json& step : made())
    if (step.contains("call")) (step.contains("error") ? wrong : right).insert(step.at("call").get<std::string>());
  const std::set<std::string> never_fail = {"ifsm_status_name", "ifsm_version",       "ifsm_version_text",
                                            "ifsm_threads",     "ifsm_cancel_create", "ifsm_set_log"};
  for (const conformance::Function& function : conformance::functions()) {
    EXPECT_TRUE(right.contains(function.name)) << function.name;
    EXPECT_NE(wrong.contains(function.name), never_fail.contains(function.name)) << function.name;
  }
}

TEST(ConformanceFile, HoldsDoublesThatComeBackBitForBit) {
  for (const double number : {0.0, -0.0, 1.0, 0.1, -5e-324, 1.7976931348623157e308}) {
    const double back = conformance::real_of(conformance::json_of(number));
    EXPECT_EQ(back, number);
    EXPECT_EQ(std::signbit(back), std::signbit(number));
  }
  EXPECT_TRUE(std::isnan(conformance::real_of(conformance::json_of(std::nan("")))));
}

}  // namespace
