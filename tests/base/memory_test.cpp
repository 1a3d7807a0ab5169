#include "base/memory.h"

#include <gtest/gtest.h>

#include <string>

#include "base/error.h"

using namespace ifsm::core;

namespace {

TEST(RequireMemory, TakesWhatFitsAndRefusesWhatDoesNotByName) {
  const std::int64_t doubles = physical_memory() / static_cast<std::int64_t>(sizeof(double));
  ASSERT_GT(doubles, 1 << 20) << "eight megabytes";
  EXPECT_NO_THROW(require_memory(doubles, "levels"));
  try {
    require_memory(doubles + 1, "levels");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::memory);
    EXPECT_EQ(error.argument(), "levels");
    EXPECT_EQ(error.required(), 8 * (doubles + 1));
    EXPECT_NE(std::string(error.what()).find("GiB"), std::string::npos);
  }
}

}  // namespace
