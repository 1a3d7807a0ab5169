#include "raster/tone.h"

#include <limits>
#include <random>

#include "../linalg/support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

using Counted = std::vector<std::uint32_t>;

std::vector<std::uint32_t> some_counts(Random& random, std::size_t number) {
  std::geometric_distribution<std::uint32_t> each(.02);
  Counted counts(number);
  for (std::uint32_t& count : counts) count = each(random) * static_cast<std::uint32_t>(uniform(random, 0, 2));
  return counts;
}

Rgba any_pixel(Random& random) {
  const auto byte = [&] { return static_cast<std::uint8_t>(uniform(random, 0, 255)); };
  return {{byte(), byte(), byte()}, byte()};
}

TEST(Density, IsTheLogarithmOverThatOfTheBrightest) {
  // Mean 4 of those that were hit; the brightest is 8.
  const Counted counts = {0, 2, 0, 2, 4, 4, 8};
  const Density density(counts);
  for (const double c : {0.0, 1.0, 2.0, 4.0, 8.0})
    EXPECT_DOUBLE_EQ(density(c), std::log1p(8 * c / 4) / std::log1p(16.0)) << c;
  EXPECT_EQ(density(0), 0);
  EXPECT_EQ(density(8), 1);
  EXPECT_EQ(density(1e9), 1);
}

TEST(Density, IsThatOfMorePointsAndOfMorePixelsAlike) {
  Random random(1);
  const Counted counts = some_counts(random, 1500);
  Counted more = counts, twice = counts;
  for (std::uint32_t& count : more) count *= 1000;
  twice.insert(twice.end(), counts.begin(), counts.end());
  twice.resize(twice.size() + 5000);  // pixels that nothing hits
  const Density one(counts), thousand(more), both(twice);
  for (int c = 0; c < 400; ++c) {
    EXPECT_NEAR(one(c), thousand(1000. * c), 8 * epsilon) << c;  // a quotient, two logarithms, and theirs
    EXPECT_NEAR(one(c), both(c), 8 * epsilon) << c;
  }
}

TEST(Density, GrowsWithTheCountAndEndsWithOneInTwoHundred) {
  Random random(2);
  Counted counts(4000);
  for (std::uint32_t& count : counts) count = static_cast<std::uint32_t>(uniform(random, 1, 1'000'000));
  const Density density(counts);
  std::sort(counts.begin(), counts.end());
  for (std::size_t k = 1; k < counts.size(); ++k) ASSERT_GE(density(counts[k]), density(counts[k - 1]));
  const auto brightest = std::count_if(counts.begin(), counts.end(), [&](std::uint32_t c) { return density(c) == 1; });
  EXPECT_GE(brightest, 20);
  EXPECT_LE(brightest, 22);
}

TEST(Density, HoldsTheLargestCountsAndNoneAtAll) {
  constexpr std::uint32_t full = std::numeric_limits<std::uint32_t>::max();
  EXPECT_EQ(Density(Counted(100, full))(full), 1);
  const Counted nothing(10, 0);
  EXPECT_EQ(Density(nothing)(0), 0);
  EXPECT_EQ(Density(std::span<const std::uint32_t>())(0), 0);
  EXPECT_TRUE(std::isfinite(Density(nothing)(7)));
}

TEST(DensityPicture, ShowsNothingWhereNothingWasHit) {
  const Palette& ink = palette(PaletteName::ink);
  const Picture picture = density_picture(Counted{0, 2, 0, 2, 4, 4, 8}, ink);
  ASSERT_EQ(picture.size(), 7U);
  EXPECT_EQ(picture[0], (Rgba{{0, 0, 0}, 0}));
  EXPECT_EQ(picture[2], picture[0]);
  EXPECT_EQ(picture[6], (Rgba{ink.at(1), 255}));
  EXPECT_EQ(picture[4], (Rgba{ink.at(std::log1p(8) / std::log1p(16)), 255}));
}

TEST(SetPicture, IsDarkWhereItIsMetAndHalfSoWhereItIsUndecided) {
  const Palette& sea = palette(PaletteName::sea);
  const Picture picture = set_picture(std::vector{Meets::no, Meets::undecided, Meets::yes}, sea);
  EXPECT_EQ(picture, (Picture{{{0, 0, 0}, 0}, {sea.at(1), 128}, {sea.at(1), 255}}));
}

TEST(DistancePicture, RunsFromDarkNearToLightFarByLogarithms) {
  const Palette& fern = palette(PaletteName::fern);
  const std::vector<double> distances = {0, 1, 3, 7};  // of pixels of half a unit: 0, 2, 6, 14
  const Picture picture = distance_picture(distances, .5, fern);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_EQ(picture[k], (Rgba{fern.at(1 - std::log1p(2 * distances[k]) / std::log1p(14)), 255})) << k;
  EXPECT_EQ(picture[0].colour, fern.at(1));
  EXPECT_EQ(picture[3].colour, fern.at(0));
  // Of other units, the same picture; of nothing but zeros, a dark one.
  EXPECT_EQ(distance_picture(std::vector<double>{0, 2e9, 6e9, 14e9}, 1e9, fern), picture);
  EXPECT_EQ(distance_picture(std::vector<double>{0, 0}, 1, fern), Picture(2, Rgba{fern.at(1), 255}));
  EXPECT_TRUE(distance_picture({}, 1, fern).empty());
}

// By the definition: amounts of light, each by its alpha; the mean alpha.
Rgba mean(const Picture& all) {
  double alpha = 0;
  std::array<double, 3> light{};
  for (const Rgba& each : all) {
    alpha += each.alpha / 255.;
    for (std::size_t k = 0; k < 3; ++k) light[k] += each.alpha / 255. * light_of(each.colour)[k];
  }
  if (alpha == 0) return {{0, 0, 0}, 0};
  for (double& amount : light) amount /= alpha;
  return {colour_of(light), static_cast<std::uint8_t>(std::lround(alpha / static_cast<double>(all.size()) * 255))};
}

TEST(Shrunk, IsTheMeanOfLightByAlpha) {
  Random random(3);
  for (const std::int64_t times : {1, 2, 3, 8}) {
    const std::int64_t columns = 5, rows = 3, width = columns * times, height = rows * times;
    Picture picture(static_cast<std::size_t>(width * height));
    for (Rgba& each : picture) each = any_pixel(random);
    const Picture small = shrunk(picture, width, height, times);
    ASSERT_EQ(small.size(), 15U);
    for (std::int64_t row = 0; row < rows; ++row)
      for (std::int64_t column = 0; column < columns; ++column) {
        Picture block;
        for (std::int64_t y = 0; y < times; ++y)
          for (std::int64_t x = 0; x < times; ++x)
            block.push_back(picture[static_cast<std::size_t>((row * times + y) * width + column * times + x)]);
        const Rgba expected = times == 1 ? block[0] : mean(block);
        EXPECT_EQ(small[static_cast<std::size_t>(row * columns + column)], expected) << times;
      }
  }
}

TEST(Shrunk, OfBlackAndWhiteIsHalfTheLightAndOfNothingIsNothing) {
  const Rgba black{{0, 0, 0}, 255}, white{{255, 255, 255}, 255}, nothing{{0, 0, 0}, 0};
  EXPECT_EQ(shrunk({black, white, white, black}, 2, 2, 2), (Picture{{{188, 188, 188}, 255}}));
  EXPECT_EQ(shrunk({nothing, white, nothing, nothing}, 2, 2, 2), (Picture{{{255, 255, 255}, 64}}));
  // What has no alpha has no colour, whatever it says.
  EXPECT_EQ(shrunk({{{9, 9, 9}, 0}, white, {{9, 9, 9}, 0}, white}, 2, 2, 2), (Picture{{{255, 255, 255}, 128}}));
  EXPECT_EQ(shrunk(Picture(4, {{9, 9, 9}, 0}), 2, 2, 2), Picture{nothing});
}

TEST(LayOver, IsExact) {
  const auto over = [](Rgba front, Rgba back) {
    Picture picture{front};
    lay_over(picture, back);
    return picture[0];
  };
  const Rgba red{{255, 0, 0}, 255}, green{{0, 255, 0}, 255}, nothing{{0, 0, 0}, 0};
  EXPECT_EQ(over(red, green), red);
  EXPECT_EQ(over(nothing, green), green);
  EXPECT_EQ(over(red, nothing), red);
  EXPECT_EQ(over(nothing, nothing), nothing);
  // 51 of 255 are a fifth; 153 three fifths.
  EXPECT_EQ(over({{255, 0, 0}, 51}, green), (Rgba{{51, 204, 0}, 255}));
  EXPECT_EQ(over({{200, 100, 0}, 51}, {{0, 100, 200}, 153}), (Rgba{{59, 100, 141}, 173}));  // 1/5 + 4/5 3/5 = .68
  EXPECT_EQ(over({{10, 20, 30}, 51}, {{1, 2, 3}, 0}), (Rgba{{10, 20, 30}, 51}));
}

}  // namespace
