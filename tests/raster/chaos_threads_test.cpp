#include <chrono>
#include <thread>

#include "base/parallel.h"
#include "raster/points.h"
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

TEST(ChaosGame, GivesTheSameBitsInLargeWindowsOnAnyNumberOfThreads) {
  const auto fern = named_system("fern");
  const Window window = around(*fern, 4100, 4100);
  Counts one;
  for (const int threads : {1, 2, 3}) {
    const Threads most(threads);
    Counts counts = counted(*fern, window, 1, (9 << 20) + 3);
    if (threads == 1) one = std::move(counts);
    if (threads == 1) continue;
    EXPECT_TRUE(counts.pixels == one.pixels) << threads;
    EXPECT_EQ(counts.inside, one.inside) << threads;
  }
}

TEST(ChaosPoints, AreTheSameBitsOnAnyNumberOfThreads) {
  const auto fern = named_system("fern_3d");
  ChaosPoints one;
  for (const int threads : {1, 2, 3, 7}) {
    const Threads most(threads);
    Watch watch;
    const ChaosPoints told = chaos_points(*fern, 1, (2 << 20) + 3, 5, watch);
    if (threads == 1) one = told;
    EXPECT_EQ(told.points, one.points) << threads;
    EXPECT_EQ(told.letters, one.letters) << threads;
  }
}

TEST(ChaosPoints, AreCancelledAlsoWithinAChunk) {
  const auto fern = named_system("fern");
  // A single chunk, which has some 100 ms to do: 256 MB of letters.
  CancelToken token;
  Watch watch(&token, {});
  std::thread other([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    token.request();
  });
  EXPECT_THROW(chaos_points(*fern, 1, 1 << 12, most_letters, watch), Cancelled);
  other.join();
}

TEST(ChaosGame, IsCancelledAndTellsProgressThatGrows) {
  const auto fern = named_system("fern");
  for (const std::int64_t side : {64, 3000}) {
    double last = 0;
    Watch watch(nullptr, [&](double fraction, const char*) {
      EXPECT_GE(fraction, last);
      last = fraction;
      return fraction > .5;
    });
    EXPECT_THROW(chaos_counts(*fern, around(*fern, side, side), 1, 40 << 20, watch), Cancelled);
    EXPECT_GT(last, .5);
    EXPECT_LT(last, 1) << side;
  }
}

}  // namespace
