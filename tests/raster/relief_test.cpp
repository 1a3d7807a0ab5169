#include "raster/relief.h"

#include <random>

#include "../linalg/support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

Picture some_picture(Random& random, std::size_t pixels, int covered_of_four) {
  Picture picture(pixels);
  const auto byte = [&] { return static_cast<std::uint8_t>(uniform(random, 0, 255)); };
  for (Rgba& each : picture)
    if (uniform(random, 1, 4) <= covered_of_four) each = {{byte(), byte(), byte()}, 255};
  return picture;
}

// By the definition, sums taken plainly.
Picture plainly_shaded(Picture picture, const std::vector<float>& nearness, std::int64_t width, std::int64_t height,
                       bool fog) {
  const Picture before = picture;
  const std::int64_t radius = std::max<std::int64_t>(width / 60, 1);
  for (std::int64_t y = 0; y < height; ++y)
    for (std::int64_t x = 0; x < width; ++x) {
      double sum = 0;
      int count = 0;
      for (std::int64_t v = std::max<std::int64_t>(y - radius, 0); v <= std::min(y + radius, height - 1); ++v)
        for (std::int64_t u = std::max<std::int64_t>(x - radius, 0); u <= std::min(x + radius, width - 1); ++u) {
          const auto at = static_cast<std::size_t>(v * width + u);
          if (before[at].alpha == 0) continue;
          sum += static_cast<double>(nearness[at]);
          ++count;
        }
      const auto p = static_cast<std::size_t>(y * width + x);
      if (before[p].alpha == 0) continue;
      const auto near = static_cast<double>(nearness[p]);
      double light = std::clamp(1 + 5 * (near - sum / count), .45, 1.35);
      if (fog) light *= .4 + .6 * near;
      auto amounts = light_of(before[p].colour);
      for (double& amount : amounts) amount *= light;
      picture[p].colour = colour_of(amounts);
    }
  return picture;
}

TEST(Relief, IsThatOfPlainSums) {
  Random random(1);
  std::uniform_real_distribution<float> anywhere(0, 1);
  for (const auto& [width, height] : {std::pair{1, 1}, {7, 5}, {61, 40}, {130, 90}, {1, 50}, {200, 2}})
    for (const bool fog : {false, true}) {
      const auto pixels = static_cast<std::size_t>(width * height);
      const Picture picture = some_picture(random, pixels, 3);
      std::vector<float> nearness(pixels);
      for (std::size_t p = 0; p < pixels; ++p) nearness[p] = picture[p].alpha > 0 ? anywhere(random) : 0.0F;
      Picture shaded = picture;
      shade(shaded, nearness, width, height, fog);
      const Picture expected = plainly_shaded(picture, nearness, width, height, fog);
      for (std::size_t p = 0; p < pixels; ++p) {
        // Sums in single precision: a byte may be rounded the other way.
        EXPECT_EQ(shaded[p].alpha, expected[p].alpha);
        EXPECT_NEAR(shaded[p].colour.red, expected[p].colour.red, 1) << width << " " << height << " " << p;
        EXPECT_NEAR(shaded[p].colour.green, expected[p].colour.green, 1);
        EXPECT_NEAR(shaded[p].colour.blue, expected[p].colour.blue, 1);
      }
    }
}

TEST(Relief, LeavesWhatIsFlatAsItIsAndFogDarkensWhatIsFar) {
  Random random(2);
  for (const float depth : {0.0F, .3F, 1.0F}) {
    const Picture picture = some_picture(random, 120 * 50, 3);
    std::vector<float> nearness(picture.size(), 0);
    for (std::size_t p = 0; p < picture.size(); ++p) nearness[p] = picture[p].alpha > 0 ? depth : 0.0F;
    Picture flat = picture, foggy = picture;
    shade(flat, nearness, 120, 50, false);
    EXPECT_EQ(flat, picture) << depth;
    shade(foggy, nearness, 120, 50, true);
    for (std::size_t p = 0; p < picture.size(); ++p) {
      auto light = light_of(picture[p].colour);
      for (double& amount : light) amount *= .4 + .6 * static_cast<double>(depth);
      const Rgb expected = picture[p].alpha > 0 ? colour_of(light) : picture[p].colour;
      EXPECT_NEAR(foggy[p].colour.red, expected.red, 1);
      EXPECT_NEAR(foggy[p].colour.blue, expected.blue, 1);
    }
  }
}

TEST(Relief, DarkensWhatLiesBehindAnEdgeAndLightensWhatIsBeforeIt) {
  // Left half far, right half near.
  constexpr std::int64_t width = 120, height = 20, radius = 2;
  Picture picture(width * height, Rgba{{120, 120, 120}, 255});
  std::vector<float> nearness(picture.size());
  for (std::size_t p = 0; p < picture.size(); ++p) nearness[p] = p % width < width / 2 ? .2F : .3F;
  shade(picture, nearness, width, height, false);
  for (std::int64_t x = 0; x < width; ++x) {
    const Rgb seen = picture[static_cast<std::size_t>(10 * width + x)].colour;
    if (x < width / 2 - radius || x >= width / 2 + radius) {
      EXPECT_EQ(seen.red, 120) << x;
    } else if (x < width / 2) {
      EXPECT_LT(seen.red, 118) << x;
    } else {
      EXPECT_GT(seen.red, 122) << x;
    }
  }
}

}  // namespace
