#include "base/parallel.h"
#include "raster/distance.h"
#include "raster/portrait.h"
#include "support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

constexpr std::int64_t points = (2 << 20) + 77;

TEST(PlanePortrait, IsTheSameBitsOnAnyNumberOfThreads) {
  const auto fern = named_system("fern");
  const Window window = around(*fern, 90, 130);
  for (const Colouring colouring : {Colouring::letter, Colouring::address}) {
    Portrait one;
    for (const int threads : {1, 2, 3, 7}) {
      const Threads most(threads);
      Watch watch;
      Portrait made = plane_portrait(*fern, window, {colouring, 3, &palette(PaletteName::dusk)}, 1, points, watch);
      if (threads == 1) one = made;
      EXPECT_TRUE(made.pixels == one.pixels) << threads;
      EXPECT_EQ(made.inside, one.inside) << threads;
      EXPECT_EQ(made.met, one.met) << threads;
    }
    EXPECT_GT(one.met, 1000);
  }
}

TEST(SpacePortrait, IsTheSameBitsOnAnyNumberOfThreads) {
  const auto fern = named_system("fern_3d");
  const Box box = bounding_box(*fern, 1e-6);
  const Vector3 middle = (box.low + box.high) / 2;
  const View view({.5, .3, 1}, {middle, farthest(*fern, middle, 1e-6)});
  const Window window{-view.reach(), -view.reach(), view.reach(), view.reach(), 100, 80};
  Portrait one;
  for (const int threads : {1, 2, 3, 7}) {
    const Threads most(threads);
    Watch watch;
    Portrait made = space_portrait(*fern, view, window, {Colouring::letter, 0, nullptr}, 1, points, watch);
    if (threads == 1) one = made;
    EXPECT_TRUE(made.pixels == one.pixels) << threads;
    EXPECT_EQ(made.inside, one.inside) << threads;
  }
  EXPECT_GT(one.met, 500);
}

TEST(Distances, AreTheSameBitsOnAnyNumberOfThreads) {
  const auto fern = named_system("fern");
  const Window window = around(*fern, 150, 130);  // six blocks
  std::vector<double> one;
  for (const int threads : {1, 2, 3, 7}) {
    const Threads most(threads);
    Watch watch;
    const auto made = distances(*fern, window, 1. / 8, watch);
    if (threads == 1) one = made;
    EXPECT_TRUE(made == one) << threads;
  }
}

TEST(Pictures, AreCancelledAndTellProgressThatGrows) {
  const auto fern = named_system("fern"), tree = named_system("fern_3d");
  const View view({.5, .3, 0}, {Vector3::Zero(), 10});
  const Window window{-5, -5, 5, 5, 150, 150};
  const Look look{Colouring::letter, 0, nullptr};
  for (int what = 0; what < 3; ++what) {
    double last = 0;
    Watch watch(nullptr, [&](double fraction, const char* stage) {
      EXPECT_GE(fraction, last);
      last = fraction;
      if (last > 0) {
        EXPECT_STREQ(stage, what == 2 ? "rows" : "points");
      }
      return fraction > .4;
    });
    EXPECT_THROW(
        {
          if (what == 0) plane_portrait(*fern, window, look, 1, 8 << 20, watch);
          if (what == 1) space_portrait(*tree, view, window, look, 1, 8 << 20, watch);
          if (what == 2) distances(*fern, window, 1. / 8, watch);
        },
        Cancelled);
    EXPECT_GT(last, .4) << what;
    CancelToken token;
    token.request();
    Watch cancelled(&token, {});
    EXPECT_THROW(distances(*fern, window, 1. / 8, cancelled), Cancelled);
    EXPECT_THROW(plane_portrait(*fern, window, look, 1, 1000, cancelled), Cancelled);
  }
}

}  // namespace
