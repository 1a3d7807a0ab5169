#include "base/parallel.h"
#include "raster/set.h"
#include "support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

TEST(SetPixels, AreTheSameOnAnyNumberOfThreads) {
  for (const char* name : {"fern", "twin_dragon", "fern_cyclosorus"}) {
    const auto system = named_system(name);
    const Window window = around(*system, 400, 300);
    std::vector<Meets> one;
    for (const int threads : {1, 2, 3, 7}) {
      const Threads most(threads);
      Watch watch;
      const auto states = set_pixels(*system, window, 1. / 64, watch);
      if (threads == 1) one = states;
      EXPECT_EQ(states, one) << name << " " << threads;
    }
  }
}

TEST(SetPixels, AreCancelled) {
  const auto fern = named_system("fern");
  CancelToken token;
  token.request();
  Watch watch(&token, nullptr);
  EXPECT_THROW(set_pixels(*fern, around(*fern, 64, 64), 1. / 64, watch), Cancelled);
}

TEST(SetPixels, TellProgressThatGrowsAndStopWhenItSaysSo) {
  const auto fern = named_system("fern");
  double last = 0;
  Watch watch(nullptr, [&](double fraction, const char*) {
    EXPECT_GE(fraction, last);
    last = fraction;
    return fraction > .3;
  });
  EXPECT_THROW(set_pixels(*fern, around(*fern, 3000, 3000), 1. / 64, watch), Cancelled);
  EXPECT_GT(last, .3);
}

}  // namespace
