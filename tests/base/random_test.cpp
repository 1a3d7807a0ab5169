#include "base/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

using ifsm::core::normal_numbers;
using ifsm::core::normal_pair;
using ifsm::core::philox;

namespace {

using Words = std::array<std::uint32_t, 4>;

TEST(Philox, GivesTheKnownAnswersOfItsAuthors) {  // Random123's kat_vectors, philox4x32 10
  EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}), (Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  constexpr std::uint32_t ones = 0xffffffff;
  EXPECT_EQ(philox({ones, ones, ones, ones}, {ones, ones}), (Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(NormalPairs, AreTheSameBitsOnEveryMachine) {
  // Hexadecimal, so that nothing is rounded on the way into this file.
  EXPECT_EQ(normal_pair(0, 0, 0)[0], -0x1.497243147e87fp-1);
  EXPECT_EQ(normal_pair(0, 0, 0)[1], 0x1.809b321e61337p+0);
  EXPECT_EQ(normal_pair(42, 7, 1ULL << 40)[0], 0x1.e2ba843442161p+0);
}

TEST(NormalNumbers, AreThePairsOneAfterTheOther) {
  for (const std::size_t count : {0, 1, 2, 63, 64, 65, 1001}) {
    std::vector<double> numbers(count, -100);
    normal_numbers(7, 3, numbers);
    for (std::size_t k = 0; k < count; ++k)
      ASSERT_EQ(numbers[k], normal_pair(7, 3, k / 2)[k % 2]) << count << ", " << k;
  }
}

// The polar method told plainly, with the platform's logarithm: ours is good to a few roundings, whatever the radius.
TEST(NormalPairs, AreThoseOfThePolarMethod) {
  const auto symmetric = [](std::uint64_t high, std::uint64_t low) {
    return std::ldexp(static_cast<double>((high << 32 | low) >> 11), -52) - 1;
  };
  constexpr std::uint64_t seed = 0x123456789abcdef0;
  double nearest = 1, farthest = 0;  // of the squares met
  for (std::uint64_t index = 0; index < 200000; ++index) {
    double x = 0, y = 0, square = 0;
    for (std::uint32_t attempt = 0; square == 0 || square >= 1; ++attempt) {
      const auto words = philox({static_cast<std::uint32_t>(index), 0, 9, attempt}, {0x9abcdef0, 0x12345678});
      x = symmetric(words[0], words[1]), y = symmetric(words[2], words[3]);
      square = x * x + y * y;
    }
    nearest = std::min(nearest, square), farthest = std::max(farthest, square);
    const double radius = std::sqrt(-2 * std::log(square) / square);
    const auto pair = normal_pair(seed, 9, index);
    // Near 1 both logarithms are good to some of their own last places; the root halves what is left.
    ASSERT_NEAR(pair[0], x * radius, 8 * 2.3e-16 * std::abs(x * radius)) << index;
    ASSERT_NEAR(pair[1], y * radius, 8 * 2.3e-16 * std::abs(y * radius)) << index;
  }
  EXPECT_LT(nearest, 1e-4);
  EXPECT_GT(farthest, 1 - 1e-4);
}

TEST(NormalPairs, DifferBySeedStreamAndIndex) {
  std::set<double> values;
  for (const std::uint64_t seed : {0ULL, 1ULL, 1ULL << 32})
    for (const std::uint32_t stream : {0U, 1U})
      for (const std::uint64_t index : {0ULL, 1ULL, 1ULL << 32})
        for (const double value : normal_pair(seed, stream, index)) values.insert(value);
  EXPECT_EQ(values.size(), 3U * 2 * 3 * 2);
}

TEST(NormalPairs, HaveTheMomentsAndTheDistributionOfNormalNumbers) {
  constexpr int count = 200000;  // pairs
  std::vector<double> all;
  double mean = 0, square = 0, fourth = 0, product = 0;
  for (int k = 0; k < count; ++k) {
    const auto [x, y] = normal_pair(1, 2, static_cast<std::uint64_t>(k));
    product += x * y;
    for (const double value : {x, y}) {
      all.push_back(value);
      mean += value, square += value * value, fourth += std::pow(value, 4);
    }
  }
  const double n = 2.0 * count;
  // Five standard errors: of the mean 1, of the square sqrt(2), of the fourth power sqrt(96), of a product 1.
  EXPECT_NEAR(mean / n, 0, 5 / std::sqrt(n));
  EXPECT_NEAR(square / n, 1, 5 * std::sqrt(2 / n));
  EXPECT_NEAR(fourth / n, 3, 5 * std::sqrt(96 / n));
  EXPECT_NEAR(product / count, 0, 5 / std::sqrt(static_cast<double>(count)));
  // Kolmogorov and Smirnov: beyond 2 / sqrt(n) once in 1500.
  std::sort(all.begin(), all.end());
  double farthest = 0;
  for (std::size_t k = 0; k < all.size(); ++k)
    farthest = std::max(farthest, std::abs(0.5 * std::erfc(-all[k] / std::sqrt(2.0)) - static_cast<double>(k) / n));
  EXPECT_LT(farthest, 2 / std::sqrt(n));
}

}  // namespace
