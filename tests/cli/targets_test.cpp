// Names of several models: told apart, never by accident the same, fit for any file system.
#include "targets.h"

#include <filesystem>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "failure.h"

namespace cli {
namespace {

using Names = std::vector<std::string>;

Names paths(const std::string& output, const Names& curves) {
  return target_paths(output, "isles", ".ifsm", curves).paths;
}

std::string refusal(const std::string& output, const Names& curves) {
  try {
    paths(output, curves);
    return "accepted";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code, Exit::Usage);
    return failure.what();
  }
}

TEST(Targets, OfOneCurveIsTheNameItself) {
  for (const std::string name : {"a.ifsm", "-", "100%.ifsm", "%x", "%03", "%"}) {
    EXPECT_EQ(paths(name, {"Island"}), Names{name});
    EXPECT_FALSE(target_paths(name, "isles", ".ifsm", {""}).made_up);
  }
  EXPECT_EQ(paths("100%%.ifsm", {""}), Names{"100%.ifsm"});
}

TEST(Targets, OfPatternsHaveNumbersAndNames) {
  EXPECT_EQ(paths("a-%d.ifsm", {"", ""}), (Names{"a-1.ifsm", "a-2.ifsm"}));
  EXPECT_EQ(paths("%03d%%%s", {"Big Isle", ""}), (Names{"001%Big_Isle", "002%2"}));
  EXPECT_TRUE(target_paths("a-%d", "isles", ".ifsm", {""}).made_up);
}

TEST(Targets, InAFolderAreCalledAfterTheInput) {
  EXPECT_EQ(paths("there/", {"Big Isle"}), Names{"there/isles.ifsm"});
  const Names ten(10, "");
  EXPECT_EQ(paths("there/", ten).front(), "there/isles-01.ifsm");
  EXPECT_EQ(paths("there/", {"Big Isle", "Big Isle"}),
            (Names{"there/isles-1-Big_Isle.ifsm", "there/isles-2-Big_Isle.ifsm"}));
  EXPECT_EQ(paths(std::filesystem::temp_directory_path().string(), {""}),
            Names{(std::filesystem::temp_directory_path() / "isles.ifsm").string()});
}

TEST(Targets, ThatWouldBeSharedAreRefusedWithTheWayOut) {
  EXPECT_EQ(refusal("a.ifsm", {"", "", ""}),
            "-o a.ifsm names one file for 3 curves, and each becomes a model of its own; put %d into the name "
            "(isles-%d.ifsm), or name a folder that exists.");
  EXPECT_EQ(refusal("%s.ifsm", {"A", "B", "A"}),
            "-o %s.ifsm: curves 1 and 3 would both go to A.ifsm; add %d, which stands for a curve's number.");
  EXPECT_EQ(refusal("-", {"", ""}).substr(0, 5), "-o - ");
}

TEST(Targets, CurvesWithStrangeNamesGetPlainFiles) {
  EXPECT_EQ(file_name_of("Grímsey"), "Grímsey");
  EXPECT_EQ(file_name_of("../../etc/passwd"), "etc_passwd");
  EXPECT_EQ(file_name_of(" a\tb\x1b[31m "), "a_b_31m");
  EXPECT_EQ(file_name_of("-.~"), "");
  EXPECT_EQ(file_name_of(std::string(59, 'a') + "í").size(), 59u);  // characters are not cut in two
}

RC_GTEST_PROP(Targets, NoNameLeavesItsFolder, (const std::string& name)) {
  const auto file = file_name_of(name);
  RC_ASSERT(file.find('/') == file.npos);
  RC_ASSERT(file.find('\0') == file.npos);
  RC_ASSERT(file.size() <= 60u);
  if (!file.empty()) RC_ASSERT(file.front() != '.' && file.front() != '-');
}

}  // namespace
}  // namespace cli
