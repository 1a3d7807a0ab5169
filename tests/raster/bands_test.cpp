#include "raster/bands.h"

#include <gtest/gtest.h>

#include <random>

using namespace ifsm::core;

namespace {

constexpr std::uint32_t full = std::numeric_limits<std::uint32_t>::max();

TEST(Bands, AddWhatWasSortedInAnySlotsOverAndOver) {
  // The last band is a part of one; the last pixel is met too.
  constexpr std::int64_t pixels = (3 << 16) + 77;
  std::mt19937 random(1);
  std::uniform_int_distribution<std::int32_t> any(0, pixels - 1);
  std::vector<std::uint32_t> expected(pixels), counts(pixels);
  Bands bands(counts, 4, 2);
  ASSERT_EQ(bands.groups(), 2);
  ASSERT_EQ(bands.slots(), 4);
  Watch watch;
  for (int round = 0; round < 3; ++round) {
    for (const std::int64_t slot : {3, 0, 1}) {
      const std::int64_t group = slot % 2;
      const auto room = bands.room(group);
      const std::size_t count = round == 1 ? Bands::piece : 1000 * static_cast<std::size_t>(slot);
      for (std::size_t k = 0; k < count; ++k) {
        room[k] = k == 0 ? pixels - 1 : any(random);
        ++expected[static_cast<std::size_t>(room[k])];
      }
      bands.sort(room.first(count), group, slot);
    }
    bands.add(watch);
  }
  bands.add(watch);  // nothing twice
  EXPECT_EQ(counts, expected);
}

TEST(Bands, SaturateAndNeverTurnOver) {
  std::vector<std::uint32_t> counts{full - 3, full, full - 2, 5};
  Bands bands(counts, 1, 1);
  const auto room = bands.room(0);
  for (std::size_t k = 0; k < 12; ++k) room[k] = static_cast<std::int32_t>(k % 4);
  bands.sort(room.first(12), 0, 0);
  Watch watch;
  bands.add(watch);
  EXPECT_EQ(counts, (std::vector<std::uint32_t>{full, full, full, 8}));
}

TEST(Bands, TakeAQuarterOfTheCountsMemoryBesideThem) {
  constexpr std::int64_t many = 1 << 20, piece_bytes = Bands::piece * 2;
  for (const std::int64_t pixels : {std::int64_t{1} << 24, std::int64_t{3} << 24}) {
    for (const std::int64_t groups : {2, 64}) {
      std::vector<std::uint32_t> counts(static_cast<std::size_t>(pixels));
      const Bands bands(counts, many, groups);
      // Of a slot its piece and where bands start, of a group the pixels and what they are sorted into.
      const std::int64_t bytes =
          bands.slots() * (piece_bytes + 4 * (pixels >> 16)) + bands.groups() * (3 * piece_bytes);
      EXPECT_LE(bytes, pixels) << groups;
      EXPECT_GT(bytes, pixels - pixels / 8) << groups << ": memory that is not used";
      EXPECT_GE(bands.groups(), std::min(groups, 3 * pixels >> 24)) << pixels;
      EXPECT_GE(bands.slots(), 2 * bands.groups());
    }
  }
}

}  // namespace
