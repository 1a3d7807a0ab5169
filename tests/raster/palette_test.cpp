#include "raster/palette.h"

#include <array>
#include <random>

#include "../linalg/support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

constexpr std::array names = {PaletteName::dusk, PaletteName::sea, PaletteName::fern, PaletteName::ember,
                              PaletteName::ink};

Rgb hex(std::uint32_t code) {
  return {static_cast<std::uint8_t>(code >> 16), static_cast<std::uint8_t>(code >> 8), static_cast<std::uint8_t>(code)};
}

std::uint8_t byte(Random& random) { return static_cast<std::uint8_t>(uniform(random, 0, 255)); }
Rgb any_colour(Random& random) { return {byte(random), byte(random), byte(random)}; }

// The largest difference of the three.
int difference(Rgb a, Rgb b) {
  return std::max({std::abs(a.red - b.red), std::abs(a.green - b.green), std::abs(a.blue - b.blue)});
}

TEST(Light, ComesBackAsTheColourThatItIsOf) {
  for (int grey = 0; grey < 256; ++grey) {
    const auto v = static_cast<std::uint8_t>(grey);
    const auto light = light_of({v, v, v});
    EXPECT_EQ(light[0], light[1]);
    EXPECT_EQ(light[0], light[2]);
    EXPECT_EQ(colour_of(light), (Rgb{v, v, v})) << grey;
  }
  Random random(1);
  for (int k = 0; k < 20'000; ++k) {
    const Rgb colour = any_colour(random);
    ASSERT_EQ(colour_of(light_of(colour)), colour) << +colour.red << " " << +colour.green << " " << +colour.blue;
  }
}

// IEC 61966-2-1's curve: its ends, the join of its two parts, and half of the light.
TEST(Light, IsThatOfSrgb) {
  EXPECT_EQ(light_of({0, 10, 255}), (std::array{0.0, 10 / 255. / 12.92, 1.0}));
  EXPECT_NEAR(light_of({11, 0, 0})[0], std::pow((11 / 255. + .055) / 1.055, 2.4), 1e-16);
  EXPECT_EQ(colour_of({.5, .5, .5}), (Rgb{188, 188, 188}));
  for (int v = 1; v < 256; ++v)
    EXPECT_GT(light_of({static_cast<std::uint8_t>(v), 0, 0})[0], light_of({static_cast<std::uint8_t>(v - 1), 0, 0})[0]);
}

TEST(Light, BeyondItsEndsIsThatOfTheEnds) { EXPECT_EQ(colour_of({-1, 2, 1e300}), (Rgb{0, 255, 255})); }

TEST(Lightness, IsThatOfOklab) {
  // Ottosson's matrices leave white at 1 to the digits that he gives.
  EXPECT_NEAR(lightness({255, 255, 255}), 1, 1e-6);
  EXPECT_EQ(lightness({0, 0, 0}), 0);
  // Of greys the cube root of their light; of red, the first column of both his matrices.
  EXPECT_NEAR(lightness({188, 188, 188}), std::cbrt(light_of({188, 0, 0})[0]), 1e-6);
  EXPECT_NEAR(lightness({255, 0, 0}), .627955, 1e-6);
}

TEST(Palettes, GrowDarkerAllAlong) {
  for (const PaletteName name : names) {
    const Palette& all = palette(name);
    // Bytes are rounded, by up to half of one: 1/510 of lightness where that is about the root of the amount.
    constexpr int places = 64;
    for (int k = 1; k <= places; ++k)
      EXPECT_LT(lightness(all.at(1. * k / places)), lightness(all.at((k - 1.) / places)))
          << static_cast<int>(name) << " " << k;
    constexpr double rounding = 1. / 256;
    for (int k = 1; k <= 1023; ++k)
      EXPECT_LE(lightness(all.at(k / 1023.)), lightness(all.at((k - 1) / 1023.)) + rounding)
          << static_cast<int>(name) << " " << k;
    EXPECT_GT(lightness(all.at(0)), .78);
    EXPECT_LT(lightness(all.at(1)), .32);
  }
}

TEST(Palettes, AreNamedOnesOfTheirOwn) {
  for (std::size_t a = 0; a < names.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      EXPECT_GE(difference(palette(names[a]).at(.5), palette(names[b]).at(.5)), 8) << a << " " << b;
  EXPECT_EQ(palette(PaletteName::dusk).at(0), hex(0xfbd9a0));
  EXPECT_EQ(palette(PaletteName::ink).at(1), hex(0x14161c));
  EXPECT_EQ(&palette(PaletteName::sea), &palette(PaletteName::sea));
}

TEST(Palette, MeetsItsStops) {
  Random random(2);
  for (int k = 0; k < 50; ++k) {
    std::vector<Rgb> stops(static_cast<std::size_t>(uniform(random, 2, 12)));
    for (Rgb& stop : stops) stop = any_colour(random);
    const Palette made(stops);
    EXPECT_EQ(made.at(0), stops.front());
    EXPECT_EQ(made.at(1), stops.back());
    // 1023 steps from end to end: a stop is met to the bit where a step ends there.
    const std::size_t last = stops.size() - 1;
    for (std::size_t i = 0; i <= last && 1023 % last == 0; ++i)
      EXPECT_EQ(made.at(static_cast<double>(i) / static_cast<double>(last)), stops[i]) << last << " " << i;
  }
  // The others are met within half a step, which is less than two of 255 where stops are not far apart.
  const std::vector<Rgb> near = {{100, 120, 90}, {140, 100, 130}, {120, 160, 100}};
  EXPECT_LE(difference(Palette(near).at(.5), near[1]), 1);
}

TEST(Palette, IsEvenToTheEyeBetweenStops) {
  const std::vector<Rgb> stops = {{250, 230, 20}, {20, 30, 120}};
  const Palette made(stops);
  const double first = lightness(stops[0]), last = lightness(stops[1]);
  for (const double t : {.1, .25, .5, .75, .9})
    EXPECT_NEAR(lightness(made.at(t)), first + t * (last - first), 1. / 256) << t;
}

TEST(Palette, OfOneStopIsConstantAndBeyondItsEndsStays) {
  const Rgb one{17, 200, 3};
  const Palette constant(std::vector{one});
  for (const double t : {-1.0, 0.0, .3, 1.0, 7.0}) EXPECT_EQ(constant.at(t), one);
  const Palette& ember = palette(PaletteName::ember);
  EXPECT_EQ(ember.at(-1e300), ember.at(0));
  EXPECT_EQ(ember.at(1e300), ember.at(1));
}

TEST(Palette, OfNoStopsOrTooManyIsRefused) {
  EXPECT_EQ(refusal([] { Palette(std::vector<Rgb>{}); }).argument(), "stops");
  EXPECT_EQ(refusal([] { Palette(std::vector<Rgb>(257)); }).status(), Status::range);
  const Palette most(std::vector<Rgb>(256, Rgb{1, 2, 3}));
  EXPECT_EQ(most.at(.7), (Rgb{1, 2, 3}));
}

TEST(LetterColours, DifferPairwiseAmongTheFirstTwentyFour) {
  constexpr int count = 24, least = 20;  // of 255, in one of red, green and blue at least
  for (int a = 0; a < count; ++a)
    for (int b = 0; b < a; ++b) EXPECT_GE(difference(letter_colour(a), letter_colour(b)), least) << a << " " << b;
  // The same eight, lighter and darker; then all again.
  for (int a = 0; a < 8; ++a) {
    EXPECT_GT(lightness(letter_colour(a + 8)), lightness(letter_colour(a)) + .05) << a;
    EXPECT_LT(lightness(letter_colour(a + 16)), lightness(letter_colour(a)) - .05) << a;
    EXPECT_EQ(letter_colour(a + 24), letter_colour(a));
    EXPECT_EQ(letter_colour(a + 240), letter_colour(a));
  }
  EXPECT_EQ(letter_colour(0), hex(0x0072b2));
}

}  // namespace
