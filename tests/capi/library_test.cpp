// Versions, names, threads, and the error record as a caller sees it.
#include "support.h"

#include <cstring>
#include <set>
#include <string>
#include <thread>

namespace {

TEST(Library, TellsOneVersionInTwoWays) {
  const int32_t version = ifsm_version();
  const auto text =
      std::to_string(version / 10000) + "." + std::to_string(version / 100 % 100) + "." + std::to_string(version % 100);
  EXPECT_EQ(ifsm_version_text(), text);
  EXPECT_GE(version, 100);
}

TEST(Library, NamesEveryStatusDifferently) {
  std::set<std::string> names;
  for (ifsm_status status = IFSM_OK; status <= IFSM_ERROR_INTERNAL; ++status) names.insert(ifsm_status_name(status));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(IFSM_ERROR_INTERNAL) + 1);
  EXPECT_EQ(names.count("unknown status"), 0u);
  EXPECT_STREQ(ifsm_status_name(IFSM_ERROR_INTERNAL), "IFSM_ERROR_INTERNAL");
  EXPECT_STREQ(ifsm_status_name(IFSM_ERROR_INTERNAL + 1), "unknown status");
  EXPECT_STREQ(ifsm_status_name(-1), "unknown status");
}

TEST(Library, KeepsTheNumberOfThreads) {
  int32_t threads = -1;
  WORKS(ifsm_set_threads(3));
  WORKS(ifsm_threads(&threads));
  EXPECT_EQ(threads, 3);
  WORKS(ifsm_set_threads(0));
  WORKS(ifsm_threads(&threads));
  EXPECT_EQ(threads, 0);
}

TEST(Library, RefusesImpossibleNumbersOfThreads) {
  for (const int32_t threads : {-1, 1025}) {
    FAILS(ifsm_set_threads(threads), IFSM_ERROR_RANGE, "threads");
    EXPECT_EQ(last_error().value, threads);
  }
  int32_t kept = -1;
  WORKS(ifsm_threads(&kept));
  EXPECT_EQ(kept, 0);
  FAILS(ifsm_threads(nullptr), IFSM_ERROR_NULL, "threads");
}

TEST(LastError, IsOkOnAThreadThatHasNotFailed) {
  std::thread([] {
    const ifsm_error error = last_error();
    EXPECT_EQ(error.status, IFSM_OK);
    EXPECT_STREQ(error.function, "");
    EXPECT_STREQ(error.argument, "");
    EXPECT_NE(error.message, nullptr);
  }).join();
}

TEST(LastError, IsNotClearedBySuccess) {
  ASSERT_EQ(ifsm_set_threads(-7), IFSM_ERROR_RANGE);
  WORKS(ifsm_set_threads(0));
  EXPECT_EQ(last_error().status, IFSM_ERROR_RANGE);
  EXPECT_EQ(last_error().value, -7);
}

TEST(LastError, IsNotChangedByAskingWrongly) {
  ASSERT_EQ(ifsm_set_threads(-7), IFSM_ERROR_RANGE);
  ifsm_error sizeless{};
  EXPECT_EQ(ifsm_last_error(nullptr), IFSM_ERROR_NULL);
  EXPECT_EQ(ifsm_last_error(&sizeless), IFSM_ERROR_OPTIONS);
  EXPECT_STREQ(last_error().function, "ifsm_set_threads");
}

TEST(LastError, FillsNoMoreThanAnOlderHeaderKnows) {
  ASSERT_EQ(ifsm_set_threads(-7), IFSM_ERROR_RANGE);
  ifsm_error error;
  std::memset(&error, 0x55, sizeof error);
  error.struct_size = offsetof(ifsm_error, argument);
  WORKS(ifsm_last_error(&error));
  EXPECT_STREQ(error.function, "ifsm_set_threads");
  EXPECT_EQ(error.index, 0x5555555555555555);
}

}  // namespace
