#include "raster/known_pixels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <vector>

using namespace ifsm::core;

namespace {

constexpr std::size_t side = KnownPixels::side;

// By looking at each pixel; those beyond the tile are known.
bool all(const std::vector<bool>& known, std::size_t column, std::size_t row, std::size_t columns, std::size_t rows) {
  for (std::size_t r = row; r < std::min(side, row + rows); ++r)
    for (std::size_t c = column; c < std::min(side, column + columns); ++c)
      if (!known[r * side + c]) return false;
  return true;
}

TEST(KnownPixels, CountSquaresAndRunsAndFindWhatIsNotKnown) {
  std::mt19937_64 random(3);
  const auto pixels = std::make_unique<KnownPixels>();
  for (const bool same : {true, false}) {
    constexpr std::size_t width = 101, height = 77, stride = 120;
    std::vector<std::uint8_t> states(stride * height);
    for (std::uint8_t& state : states) state = random() % 40 == 0 ? (same ? 0 : 1) : (same ? 2 : 0);
    pixels->begin(states.data(), stride, width, height, same ? 2 : 1, same);
    std::vector<bool> known(side * side, true);
    for (std::size_t row = 0; row < height; ++row)
      for (std::size_t column = 0; column < width; ++column)
        known[row * side + column] = (states[row * stride + column] == (same ? 2 : 1)) == same;

    for (std::size_t row = 0; row < side; ++row)
      for (std::size_t column = 0; column < side; ++column) {
        std::size_t square = 0, run = 0;
        while (square < KnownPixels::most && all(known, column, row, square + 1, square + 1)) ++square;
        while (run < KnownPixels::most && all(known, column, row, 1, run + 1)) ++run;
        const std::uint8_t byte = pixels->bytes()[row * KnownPixels::stride + column];
        ASSERT_EQ(byte % KnownPixels::run_unit, square) << column << " " << row;
        ASSERT_EQ(byte / KnownPixels::run_unit, run) << column << " " << row;
        ASSERT_EQ(pixels->is_known(column, row), known[row * side + column]);
      }
    for (int turn = 0; turn < 2000; ++turn) {
      const std::size_t c0 = random() % side, r0 = random() % side;
      const std::size_t c1 = std::min(side - 1, c0 + random() % 12), r1 = std::min(side - 1, r0 + random() % 12);
      ASSERT_EQ(pixels->are_known(c0, c1, r0, r1), all(known, c0, r0, c1 - c0 + 1, r1 - r0 + 1));
    }
    // Pixels that are added: never too large.
    for (int turn = 0; turn < 300; ++turn) {
      const std::size_t c = random() % side, r = random() % side;
      pixels->add(c, r);
      known[r * side + c] = true;
    }
    for (std::size_t row = 0; row < side; ++row)
      for (std::size_t column = 0; column < side; ++column) {
        const std::uint8_t byte = pixels->bytes()[row * KnownPixels::stride + column];
        const std::size_t square = byte % KnownPixels::run_unit, run = byte / KnownPixels::run_unit;
        ASSERT_TRUE(all(known, column, row, square, square) && all(known, column, row, 1, run)) << column << " " << row;
      }
  }
}

}  // namespace
