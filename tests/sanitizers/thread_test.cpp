// A planted race is reported; the same work without the race, over TBB, is not.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <thread>

#include "base/parallel.h"

namespace {

TEST(SanitizerDeathTest, ThreadReportsAPlantedRace) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_DEATH(
      {
        int shared = 0;
        std::thread other([&] {
          for (int k = 0; k < 1000; ++k) ++shared;
        });
        for (int k = 0; k < 1000; ++k) ++shared;
        other.join();
        std::exit(shared == 0);
      },
      "ThreadSanitizer: data race");
}

TEST(SanitizerDeathTest, ThreadReportsAPlantedRaceInsideParallelFor) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_DEATH(
      {
        double sum = 0;
        ifsm::core::parallel_for(10'000, 4, [&](std::int64_t chunk) { sum += static_cast<double>(chunk); });
        std::exit(sum < 0);
      },
      "ThreadSanitizer: data race");
}

TEST(Sanitizer, ThreadIsSilentAboutACorrectParallelFor) {
  std::atomic<std::int64_t> sum{0};
  ifsm::core::parallel_for(10'000, 4, [&](std::int64_t chunk) { sum += chunk; });
  EXPECT_EQ(sum.load(), 9'999 * 10'000 / 2);
}

}  // namespace
