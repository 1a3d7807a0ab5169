#include "raster/histogram.h"

#include <gtest/gtest.h>

using namespace ifsm::core;

namespace {

constexpr std::uint32_t full = std::numeric_limits<std::uint32_t>::max();

TEST(Histogram, CountsBeyondAByte) {
  Histogram histogram(3);
  for (int k = 0; k < 1000; ++k) histogram.tally().count(1);
  histogram.tally().count(2);
  EXPECT_EQ(histogram.take(), (std::vector<std::uint32_t>{0, 1000, 1}));
}

TEST(Histogram, SaturatesAndNeverTurnsOver) {
  Histogram histogram(1);
  const Tally tally = histogram.tally();
  for (const std::uint32_t near : {full - 255, full - 256, full - 257, full}) {
    *tally.high = near;
    *tally.low = 255;
    tally.count(0);
    EXPECT_EQ(*tally.high, near >= full - 256 ? full : near + 256);
    EXPECT_EQ(*tally.low, 0);
  }
  *tally.high = full - 3;
  *tally.low = 200;
  Histogram other(1);
  for (int k = 0; k < 300; ++k) other.tally().count(0);
  histogram.add(other);
  EXPECT_EQ(histogram.take(), (std::vector<std::uint32_t>{full}));
}

TEST(Histogram, AddsAnother) {
  Histogram a(2), b(2);
  for (int k = 0; k < 700; ++k) a.tally().count(0), b.tally().count(k % 2);
  a.add(b);
  EXPECT_EQ(a.take(), (std::vector<std::uint32_t>{1050, 350}));
}

TEST(Histogram, TellsWhatLiesOutsideOnce) {
  Histogram histogram(4);
  for (int k = 0; k < 513; ++k) histogram.tally().count(4);
  EXPECT_EQ(histogram.take_outside(), 513);
  EXPECT_EQ(histogram.take_outside(), 0);
  EXPECT_EQ(histogram.take(), std::vector<std::uint32_t>(4, 0));
}

}  // namespace
