#include "raster/portrait.h"

#include "base/error.h"
#include "raster/points.h"
#include "raster/relief.h"
#include "support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

constexpr std::uint64_t seed = 5;

Portrait portrait(const System& system, const Window& window, const Look& look, std::int64_t points) {
  Watch watch;
  return plane_portrait(system, window, look, seed, points, watch);
}

Portrait portrait(const System& system, const View& view, const Window& window, const Look& look, std::int64_t points) {
  Watch watch;
  return space_portrait(system, view, window, look, seed, points, watch);
}

ChaosPoints told(const System& system, std::int64_t count, std::int64_t length) {
  Watch watch;
  return chaos_points(system, seed, count, length, watch);
}

// Pictures of doubles beside pictures of integers: a byte may be rounded the other way.
void expect_alike(const Picture& a, const Picture& b, const std::string& what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  for (std::size_t p = 0; p < a.size(); ++p) {
    ASSERT_EQ(a[p].alpha, b[p].alpha) << what << " " << p;
    ASSERT_NEAR(a[p].colour.red, b[p].colour.red, 1) << what << " " << p;
    ASSERT_NEAR(a[p].colour.green, b[p].colour.green, 1) << what << " " << p;
    ASSERT_NEAR(a[p].colour.blue, b[p].colour.blue, 1) << what << " " << p;
  }
}

// The share of the measure that has smaller addresses than a word: P_i1 + p_i1 (P_i2 + …), the middle of its piece
// where it ends.
double share(const System& system, const std::int32_t* letters, std::size_t length) {
  double low = 0, part = 1;
  for (std::size_t k = 0; k < length; ++k) {
    for (std::int32_t i = 0; i < letters[k]; ++i) low += part * system.probabilities()[static_cast<std::size_t>(i)];
    part *= system.probabilities()[static_cast<std::size_t>(letters[k])];
  }
  return low + part / 2;
}

Rgb colour_for(const System& system, const Look& look, const std::int32_t* letters, std::size_t length) {
  if (look.colouring == Colouring::letter) return letter_colour(letters[0]);
  return look.palette->at(share(system, letters, look.letters == 0 ? length : static_cast<std::size_t>(look.letters)));
}

// As the header says it, from the points of the chaos game.
Picture plain_plane(const System& system, const Window& window, const Look& look, std::int64_t points,
                    std::int64_t& inside) {
  constexpr std::size_t length = 40;
  const ChaosPoints all = told(system, points, length);
  const auto pixels = static_cast<std::size_t>(window.pixels());
  std::vector<std::uint32_t> counts(pixels);
  std::vector<std::array<double, 3>> light(pixels);
  inside = 0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(points); ++k) {
    const auto pixel = static_cast<std::size_t>(Grid(window).pixel(all.points[2 * k], all.points[2 * k + 1]));
    if (pixel == pixels) continue;
    ++inside;
    ++counts[pixel];
    const auto each = light_of(colour_for(system, look, &all.letters[k * length], length));
    for (std::size_t c = 0; c < 3; ++c) light[pixel][c] += each[c];
  }
  const Density density(counts);
  Picture picture(pixels);
  for (std::size_t p = 0; p < pixels; ++p) {
    if (counts[p] == 0) continue;
    for (double& amount : light[p]) amount = 1 - (.6 + .4 * density(counts[p])) * (1 - amount / counts[p]);
    picture[p] = {colour_of(light[p]), 255};
  }
  return picture;
}

std::int64_t covered(const Picture& picture) {
  return std::count_if(picture.begin(), picture.end(), [](const Rgba& each) { return each.alpha == 255; });
}

TEST(PlanePortrait, IsThatOfThePointsOfTheChaosGameAndTheirAddresses) {
  constexpr std::int64_t points = 40'000;
  for (const char* name : {"fern", "gasket", "twin_dragon", "tree_type1_with_dummy", "maple_leaf"}) {
    const auto system = named_system(name);
    Window window = around(*system, 70, 50);
    window.left += .2 * (window.right - window.left);  // a part of it
    for (const Look& look :
         {Look{Colouring::letter, 0, nullptr}, Look{Colouring::address, 0, &palette(PaletteName::dusk)},
          Look{Colouring::address, 1, &palette(PaletteName::sea)},
          Look{Colouring::address, 2, &palette(PaletteName::ember)},
          Look{Colouring::address, 16, &palette(PaletteName::fern)}}) {
      std::int64_t inside = 0;
      const Picture expected = plain_plane(*system, window, look, points, inside);
      const Portrait made = portrait(*system, window, look, points);
      expect_alike(made.pixels, expected, name + std::to_string(look.letters));
      EXPECT_EQ(made.inside, inside) << name;
      EXPECT_EQ(made.met, covered(expected)) << name;
      EXPECT_GT(made.inside, points / 2) << name;
      EXPECT_LT(made.inside, points) << name;
    }
  }
}

// 1 - light is that of the map's colour, times one number from .6 to 1, of red, green and blue alike.
TEST(PlanePortrait, HasThePiecesOwnColourWhereAPixelLiesInOnePieceAlone) {
  const System gasket(2, {plane(.5, 0, 0, .5, 0, 0), plane(.5, 0, 0, .5, .5, 0), plane(.5, 0, 0, .5, 0, .5)});
  // Pixels in step with the pieces, so that none holds two of them.
  const Portrait made = portrait(gasket, {0, 0, 1, 1, 32, 32}, {Colouring::letter, 0, nullptr}, 100'000);
  for (std::size_t p = 0; p < made.pixels.size(); ++p) {
    if (made.pixels[p].alpha == 0) continue;
    const std::size_t column = p % 32, row = p / 32;
    const auto own = light_of(letter_colour(row < 16 ? 2 : column >= 16 ? 1 : 0));
    const auto seen = light_of(made.pixels[p].colour);
    // Of the channel that tells most.
    const std::size_t c = own[0] < own[2] ? 0 : 2;
    const double solid = (1 - seen[c]) / (1 - own[c]);
    EXPECT_GE(solid, .6 - .01) << p;
    EXPECT_LE(solid, 1 + .01) << p;
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(1 - seen[k], solid * (1 - own[k]), .01) << p << " " << k;
  }
  // 3^5 of the 4^5 squares are met, and those that have a corner of the set alone.
  EXPECT_GE(made.met, 243);
  EXPECT_EQ(made.inside, 100'000) << "x + y = 1 is in the window, and x = 1, y = 1 are met by no random point";
}

// Of a system whose measure is the interval's length, the share of smaller addresses is the place itself.
TEST(PlanePortrait, HasTheShareOfSmallerAddressesAsItsColour) {
  const Palette grey(std::vector{Rgb{255, 255, 255}, Rgb{0, 0, 0}});
  for (const double p : {.5, .3, .8}) {
    const System interval(2, {plane(p, 0, 0, .5, 0, 0), plane(1 - p, 0, 0, .5, p, 0)}, {p, 1 - p});
    const Portrait made = portrait(interval, {0, -1, 1, 1, 64, 1}, {Colouring::address, 0, &grey}, 200'000);
    ASSERT_EQ(made.met, 64);
    for (std::size_t k = 0; k < 64; ++k) {
      // All pixels are alike dense, some 3 % of 3125 more or less, which is some hundredths of 1 - light.
      const double dark = 1 - light_of(grey.at((static_cast<double>(k) + .5) / 64))[0];
      EXPECT_NEAR(1 - light_of(made.pixels[k].colour)[0], dark, .03) << p << " " << k;
    }
  }
}

// In a picture of one pixel, the mean light is the palette's, place by place: with one white stop among black ones, the
// share of the points whose colour is near it.
TEST(PlanePortrait, ShowsEachShadeOfThePaletteAsOftenAsAnyOther) {
  constexpr std::int64_t points = 200'000;
  constexpr std::size_t stops = 9;
  for (const char* name : {"gasket", "fern", "twin_dragon"}) {
    const auto system = named_system(name);
    const Box box = bounding_box(*system, 1e-6);
    const Window all{box.low(0) - 1, box.low(1) - 1, box.high(0) + 1, box.high(1) + 1, 1, 1};
    for (std::size_t white = 0; white < stops; ++white) {
      std::vector<Rgb> colours(stops, Rgb{0, 0, 0});
      colours[white] = {255, 255, 255};
      const Palette tent(colours);
      double mean = 0;
      for (int k = 0; k < 1024; ++k) mean += light_of(tent.at(k / 1023.))[0] / 1024;
      const Portrait made = portrait(*system, all, {Colouring::address, 0, &tent}, points);
      const double seen = light_of(made.pixels[0].colour)[0];
      // Five standard errors of a share, and a byte of 255 there: as much as the curve has for it.
      const double error = 5 * std::sqrt(mean / points), byte = .01 * std::sqrt(mean);
      EXPECT_NEAR(seen, mean, error + byte) << name << " " << white;
      EXPECT_EQ(made.inside, points);
    }
  }
}

TEST(PlanePortrait, OfOneSymbolHasAColourForEachPiece) {
  const auto gasket = named_system("gasket");
  const Palette grey(std::vector{Rgb{200, 200, 200}, Rgb{20, 20, 20}});
  const Window window = around(*gasket, 60, 60);
  const Portrait shares = portrait(*gasket, window, {Colouring::address, 1, &grey}, 50'000);
  const Portrait letters = portrait(*gasket, window, {Colouring::letter, 0, nullptr}, 50'000);
  // The middles of the pieces' thirds, as far as pixels are of one piece: those are that have one letter's colour.
  std::array<int, 3> pixels{};
  for (std::size_t p = 0; p < shares.pixels.size(); ++p) {
    ASSERT_EQ(shares.pixels[p].alpha, letters.pixels[p].alpha);
    if (shares.pixels[p].alpha == 0) continue;
    for (int letter = 0; letter < 3; ++letter) {
      const auto own = light_of(letter_colour(letter)), seen = light_of(letters.pixels[p].colour);
      const std::size_t c = own[0] < own[2] ? 0 : 2;
      const double solid = (1 - seen[c]) / (1 - own[c]);
      bool alone = true;
      for (std::size_t k = 0; k < 3; ++k) alone &= std::abs(1 - seen[k] - solid * (1 - own[k])) < .005;
      if (!alone) continue;
      const double dark = 1 - light_of(grey.at((2 * letter + 1) / 6.))[0];
      EXPECT_NEAR(1 - light_of(shares.pixels[p].colour)[0], solid * dark, .015) << p;
      ++pixels[static_cast<std::size_t>(letter)];
    }
  }
  for (const int each : pixels) EXPECT_GT(each, 200);
}

TEST(PlanePortrait, OfDensityIsThatOfTheCounts) {
  const auto fern = named_system("fern");
  const Window window = around(*fern, 60, 80);
  const Palette& ink = palette(PaletteName::ink);
  const Portrait made = portrait(*fern, window, {Colouring::tone, 0, &ink}, 100'000);
  const Counts counts = counted(*fern, window, seed, 100'000);
  EXPECT_EQ(made.pixels, density_picture(counts.pixels, ink));
  EXPECT_EQ(made.inside, counts.inside);
  EXPECT_EQ(made.met, covered(made.pixels));
}

TEST(PlanePortrait, IsEmptyWhereTheWindowMissesTheAttractor) {
  const auto fern = named_system("fern");
  for (const Colouring colouring : {Colouring::tone, Colouring::letter, Colouring::address}) {
    const Portrait made =
        portrait(*fern, {100, 100, 101, 101, 9, 7}, {colouring, 0, &palette(PaletteName::dusk)}, 1000);
    EXPECT_EQ(made.pixels, Picture(63));
    EXPECT_EQ(made.inside, 0);
    EXPECT_EQ(made.met, 0);
  }
}

Ball ball_of(const System& system) {
  const Box box = bounding_box(system, 1e-6);
  const Vector3 middle = (box.low + box.high) / 2;
  return {middle, farthest(system, middle, 1e-6)};
}

TEST(SpacePortrait, ShowsTheNearestPointOfEachPixel) {
  constexpr std::int64_t points = 20'000;
  constexpr std::size_t length = 40;
  for (const char* name : {"tetrahedron", "fern_3d", "sponge"}) {
    const auto system = named_system(name);
    const Direction direction{.7, .4, name[0] == 't' ? 1.2 : 0};
    const View view(direction, ball_of(*system));
    const double reach = view.reach();
    const ChaosPoints all = told(*system, points, length);
    const Window window{-.7 * reach, -reach, reach, reach, 45, 40};
    for (const Look& look : {Look{Colouring::tone, 0, &palette(PaletteName::sea)}, Look{Colouring::letter, 0, nullptr},
                             Look{Colouring::address, 0, &palette(PaletteName::dusk)},
                             Look{Colouring::address, 2, &palette(PaletteName::fern)}}) {
      const auto pixels = static_cast<std::size_t>(window.pixels());
      std::vector<double> nearest(pixels, -1);
      Picture expected(pixels);
      std::int64_t inside = 0;
      for (std::size_t k = 0; k < static_cast<std::size_t>(points); ++k) {
        const auto seen = view(all.points[3 * k], all.points[3 * k + 1], all.points[3 * k + 2]);
        const auto pixel = static_cast<std::size_t>(Grid(window).pixel(seen.x, seen.y));
        if (pixel == pixels) continue;
        ++inside;
        if (seen.nearness <= nearest[pixel]) continue;
        nearest[pixel] = seen.nearness;
        expected[pixel] = {look.colouring == Colouring::tone
                               ? look.palette->at(1 - seen.nearness)
                               : colour_for(*system, look, &all.letters[k * length], length),
                           255};
      }
      std::vector<float> nearness(pixels);
      for (std::size_t p = 0; p < pixels; ++p) nearness[p] = static_cast<float>(std::max(nearest[p], 0.0));
      shade(expected, nearness, window.width, window.height, look.colouring != Colouring::tone);
      const Portrait made = portrait(*system, view, window, look, points);
      expect_alike(made.pixels, expected, name);
      EXPECT_EQ(made.inside, inside);
      EXPECT_EQ(made.met, covered(expected));
      EXPECT_LT(made.met, inside) << "nothing lay behind anything";
    }
  }
}

TEST(SpacePortrait, OfAPlaneSeenFromAboveHasThePlanesPixels) {
  const auto fern = named_system("fern");
  const System lifted = embedded(*fern);
  const Ball ball = ball_of(lifted);
  // The x axis points down then, and y to the right.
  const View above({0, std::acos(0.0), 0}, ball);
  const Window window{-6, -6, 6, 6, 60, 60};
  const Portrait made = portrait(lifted, above, window, {Colouring::letter, 0, nullptr}, 30'000);
  const ChaosPoints all = told(*fern, 30'000, 0);
  std::vector<bool> hit(3600);
  for (std::size_t k = 0; k < 30'000; ++k) {
    const auto pixel = Grid(window).pixel(all.points[2 * k + 1] - ball.centre(1), ball.centre(0) - all.points[2 * k]);
    if (pixel < 3600) hit[static_cast<std::size_t>(pixel)] = true;
  }
  std::int64_t differences = 0;
  for (std::size_t p = 0; p < 3600; ++p) differences += hit[p] != (made.pixels[p].alpha == 255);
  EXPECT_LE(differences, 3) << "points at pixels' edges";
  EXPECT_GT(made.met, 500);
}

TEST(Portraits, RefuseByName) {
  const auto fern = named_system("fern"), tree = named_system("fern_3d");
  const Look letters{Colouring::letter, 0, nullptr};
  const Window window{-3, -1, 3, 11, 10, 10};
  const View view({0, 0, 0}, {Vector3::Zero(), 1});
  EXPECT_EQ(refusal([&] { portrait(*tree, window, letters, 10); }).argument(), "system");
  EXPECT_EQ(refusal([&] { portrait(*fern, view, window, letters, 10); }).argument(), "system");
  EXPECT_EQ(refusal([&] { portrait(*fern, window, letters, 0); }).argument(), "points");
  EXPECT_EQ(refusal([&] { portrait(*tree, view, window, letters, -1); }).argument(), "points");
  for (const int wrong : {-1, 17})
    EXPECT_EQ(refusal([&] {
                portrait(*fern, window, {Colouring::address, wrong, &palette(PaletteName::sea)}, 10);
              }).argument(),
              "letters");
  EXPECT_EQ(refusal([&] { portrait(*fern, {0, 0, 0, 1, 10, 10}, letters, 10); }).argument(), "window");
  EXPECT_EQ(refusal([&] { portrait(*tree, view, {0, 0, 1, 1, 0, 10}, letters, 10); }).argument(), "width");
  EXPECT_EQ(refusal([&] { portrait(System(2, {plane(2, 0, 0, 2, 0, 0)}), window, letters, 10); }).argument(), "system");
}

TEST(PointsFor, AreSoManyThatThoseInTheWindowSuffice) {
  const auto gasket = named_system("gasket_right");
  Watch watch;
  const auto asked = [&](const Window& window) { return points_for(*gasket, window, 1, 16, watch); };
  constexpr std::int64_t all = 16 * 100 * 50;
  EXPECT_EQ(asked({-1, -1, 2, 2, 100, 50}), all);
  EXPECT_EQ(asked({5, 5, 6, 6, 100, 50}), 64 * all);  // a window that nothing falls into
  // A ninth of the measure: of 2^20 points within some thousandths.
  EXPECT_NEAR(static_cast<double>(asked({0, 0, .25, .25, 100, 50})), 9. * all, .1 * all);
}

}  // namespace
