#include "base/parallel.h"
#include "support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

TEST(ChaosGame, GivesTheSameBitsOnAnyNumberOfThreads) {
  const auto fern = named_system("fern");
  const Window window = around(*fern, 200, 200);
  std::vector<std::uint32_t> one;
  for (const int threads : {1, 2, 3, 7}) {
    const Threads most(threads);
    const Counts counts = counted(*fern, window, 1, (5 << 20) + 3);
    if (threads == 1) one = counts.pixels;
    EXPECT_EQ(counts.pixels, one) << threads;
  }
}

TEST(ChaosGame, IsCancelledAndTellsProgressThatGrows) {
  const auto fern = named_system("fern");
  double last = 0;
  Watch watch(nullptr, [&](double fraction, const char*) {
    EXPECT_GE(fraction, last);
    last = fraction;
    return fraction > .5;
  });
  EXPECT_THROW(chaos_counts(*fern, around(*fern, 64, 64), 1, 20 << 20, watch), Cancelled);
  EXPECT_GT(last, .5);
}

}  // namespace
