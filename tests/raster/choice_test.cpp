#include "raster/choice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/random.h"

using namespace ifsm::core;

namespace {

// The probability of each map, exactly: by the length of what chooses it.
std::vector<double> chosen(const Choice& choice, std::size_t maps) {
  std::vector<double> shares(maps, 0.0);
  for (std::size_t slot = 0; slot < choice.slots(); ++slot) {
    const bool whole = choice.other()[slot] == static_cast<std::int32_t>(slot);
    const double own = whole ? 1 : choice.share()[slot] * 0x1p-31;
    if (own > 0) shares.at(slot) += own;
    if (own < 1) shares.at(static_cast<std::size_t>(choice.other()[slot])) += 1 - own;
  }
  for (double& share : shares) share /= static_cast<double>(choice.slots());
  return shares;
}

TEST(Choice, MeetsProbabilitiesWithinThirtyOneBits) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int k = 0; k < 500; ++k) {
    std::vector<double> p(1 + random() % 256);
    double sum = 0;
    for (double& each : p) sum += each = random() % 4 == 0 ? 0 : std::pow(uniform(random), 6);
    if (sum == 0) sum = p[0] = 1;
    for (double& each : p) each /= sum;
    const auto found = chosen(Choice(p), p.size());
    for (std::size_t i = 0; i < p.size(); ++i) {
      EXPECT_NEAR(found[i], p[i], 0x1p-31) << "map " << i << " of " << p.size();
      EXPECT_TRUE(p[i] > 0 || found[i] == 0) << "a map that is not active is never taken";
    }
  }
}

TEST(Choice, TakesEachMapAsOftenAsItsProbabilitySays) {
  const std::vector<double> p = {.85, .07, .07, .01};
  const Choice choice(p);
  std::vector<double> counts(4, 0);
  constexpr int draws = 1 << 22;
  for (std::uint32_t k = 0; k < draws; ++k)
    ++counts.at(static_cast<std::size_t>(choice(philox({k, 0, 0, 0}, {1, 0})[0])));
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(counts[i], draws * p[i], 5 * std::sqrt(draws * p[i] * (1 - p[i])));
}

TEST(Choice, OfOneMapIsThatMap) {
  const Choice choice({1.0});
  for (const std::uint32_t random : {0u, 1u, 0x7FFFFFFFu, 0x80000000u, 0xFFFFFFFFu}) EXPECT_EQ(choice(random), 0);
}

}  // namespace
