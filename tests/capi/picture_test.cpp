// Pictures of systems through the C ABI: exact pixels where there are some, reports, defaults, refusals.
#include <cmath>
#include <cstring>
#include <limits>

#include "systems.h"

namespace {

using Bytes = std::vector<uint8_t>;

ifsm_picture_options defaults() {
  ifsm_picture_options options{};
  EXPECT_EQ(ifsm_picture_options_init(&options, sizeof options), IFSM_OK);
  return options;
}

ifsm_picture_options window(double left, double bottom, double right, double top, int32_t width, int32_t height) {
  ifsm_picture_options options = defaults();
  options.left = left, options.bottom = bottom, options.right = right, options.top = top;
  options.width = width, options.height = height;
  return options;
}

ifsm_picture_report blank() {
  ifsm_picture_report report{};
  std::memset(static_cast<void*>(&report), 0x5a, sizeof report);
  report.struct_size = sizeof report;
  return report;
}

// In sRGB, as doubles.
double light_of(uint8_t value) {
  const double v = value / 255.0;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

class Pictures : public WithSystems {
 protected:
  std::vector<uint32_t> histogram(ifsm_system system, const ifsm_picture_options& options) {
    report = blank();
    return all_of<uint32_t>([&](uint32_t* to, int64_t room, int64_t* told) {
      return ifsm_system_histogram(system, &options, &report, to, room, told);
    });
  }
  Bytes set(ifsm_system system, const ifsm_picture_options& options) {
    report = blank();
    return all_of<uint8_t>([&](uint8_t* to, int64_t room, int64_t* told) {
      return ifsm_system_set(system, &options, &report, to, room, told);
    });
  }
  std::vector<double> distances(ifsm_system system, const ifsm_picture_options& options) {
    report = blank();
    return all_of<double>([&](double* to, int64_t room, int64_t* told) {
      return ifsm_system_distances(system, &options, &report, to, room, told);
    });
  }
  Bytes render(ifsm_system system, const ifsm_picture_options& options) {
    report = blank();
    return all_of<uint8_t>([&](uint8_t* to, int64_t room, int64_t* told) {
      return ifsm_system_render(system, &options, &report, to, room, told);
    });
  }
  static Bytes toned(const std::vector<uint32_t>& counts, const ifsm_picture_options& options) {
    return all_of<uint8_t>([&](uint8_t* to, int64_t room, int64_t* told) {
      return ifsm_tone_map(counts.data(), static_cast<int64_t>(counts.size()), &options, to, room, told);
    });
  }
  void expect_report(const ifsm_picture_options& options, int64_t points, int64_t inside, int64_t met,
                     int64_t undecided) const {
    EXPECT_EQ(report.struct_size, sizeof report);
    EXPECT_EQ(report.width, options.width);
    EXPECT_EQ(report.height, options.height);
    EXPECT_EQ(report.reserved, 0);
    EXPECT_EQ(report.left, options.left);
    EXPECT_EQ(report.bottom, options.bottom);
    EXPECT_EQ(report.right, options.right);
    EXPECT_EQ(report.top, options.top);
    EXPECT_EQ(report.points, points);
    EXPECT_EQ(report.inside, inside);
    EXPECT_EQ(report.met, met);
    EXPECT_EQ(report.undecided, undecided);
  }

  ifsm_picture_report report{};
};

TEST_F(Pictures, HaveOptionsThatAreAllZeroByDefault) {
  ifsm_picture_options options;
  std::memset(static_cast<void*>(&options), 0x5a, sizeof options);
  WORKS(ifsm_picture_options_init(&options, sizeof options));
  ifsm_picture_options zero{};
  zero.struct_size = sizeof zero;
  EXPECT_EQ(std::memcmp(&options, &zero, sizeof zero), 0);
  FAILS(ifsm_picture_options_init(&options, 3), IFSM_ERROR_OPTIONS, "size");
  FAILS(ifsm_picture_options_init(nullptr, sizeof options), IFSM_ERROR_NULL, "options");
}

// The one point of the attractor is where four pixels meet: it is that one's whose left and upper edge it lies on.
TEST_F(Pictures, CountAPointInThePixelThatOwnsItsEdge) {
  ifsm_picture_options options = window(-1, -1, 1, 1, 2, 2);
  options.points = 1000;
  EXPECT_EQ(histogram(origin(), options), (std::vector<uint32_t>{0, 0, 0, 1000}));
  expect_report(options, 1000, 1000, 1, 0);
  // A window whose right and lower edges it lies on is missed.
  options = window(-1, 0, 0, 1, 3, 2);
  options.points = 77;
  EXPECT_EQ(histogram(origin(), options), (std::vector<uint32_t>(6)));
  expect_report(options, 77, 0, 0, 0);
}

TEST_F(Pictures, CountThePointsThatTheSampleTells) {
  ifsm_picture_options options = window(-.25, -.5, 1.1, 1.2, 31, 17);
  options.points = 20'000, options.seed = 9;
  const ifsm_system system = gasket();
  const auto counts = histogram(system, options);
  const auto points = all_of<double>(
      [&](double* to, int64_t room, int64_t* told) { return ifsm_system_sample(system, &options, to, room, told); });
  ASSERT_EQ(points.size(), 40'000U);
  std::vector<int64_t> expected(31 * 17);
  int64_t inside = 0;
  for (std::size_t k = 0; k < points.size(); k += 2) {
    const double column = std::floor((points[k] + .25) / 1.35 * 31), row = std::floor((1.2 - points[k + 1]) / 1.7 * 17);
    if (column < 0 || column >= 31 || row < 0 || row >= 17) continue;
    ++expected[static_cast<std::size_t>(row * 31 + column)];
    ++inside;
  }
  int64_t met = 0, differences = 0;
  for (std::size_t p = 0; p < counts.size(); ++p) {
    met += counts[p] > 0 ? 1 : 0;
    differences += std::abs(expected[p] - static_cast<int64_t>(counts[p]));
  }
  EXPECT_LE(differences, 20) << "points at pixels' edges, of single precision";
  EXPECT_EQ(inside, 20'000);
  expect_report(options, 20'000, 20'000, met, 0);
}

TEST_F(Pictures, DrawNothingWhenTheCountAloneIsAskedForAndTellTheWindow) {
  // By default 1024 pixels a side, around the attractor, four in a hundred larger.
  const ifsm_system system = square();
  report = blank();
  WORKS(ifsm_system_histogram(system, nullptr, &report, nullptr, 0, &count));
  EXPECT_EQ(count, 1024 * 1024);
  EXPECT_EQ(report.width, 1024);
  EXPECT_EQ(report.height, 1024);
  EXPECT_NEAR(report.left, -.02, 1e-5);
  EXPECT_NEAR(report.bottom, -.02, 1e-5);
  EXPECT_NEAR(report.right, 1.02, 1e-5);
  EXPECT_NEAR(report.top, 1.02, 1e-5);
  for (const int64_t each : {report.points, report.inside, report.met, report.undecided}) EXPECT_EQ(each, 0);

  ifsm_picture_options options = defaults();
  options.width = 30, options.height = 10;
  report = blank();
  WORKS(ifsm_system_render(system, &options, &report, nullptr, 0, &count));
  EXPECT_EQ(count, 4 * 300);
  EXPECT_NEAR(report.right - report.left, 3.12, 1e-4);
  EXPECT_NEAR(report.top - report.bottom, 1.04, 1e-4);
  options.height = 0;  // as wide
  WORKS(ifsm_system_set(system, &options, &report, nullptr, 0, &count));
  EXPECT_EQ(count, 900);
  EXPECT_EQ(report.height, 30);
  WORKS(ifsm_system_distances(system, &options, &report, nullptr, 0, &count));
  EXPECT_EQ(count, 900);
  options.width = 32768;  // 16 GB and more, were it drawn
  for (const int32_t colour : {0, 1, 2, 3, 4}) {
    options.colour = colour;
    WORKS(ifsm_system_render(system, &options, &report, nullptr, 0, &count));
    EXPECT_EQ(count, int64_t{4} << 30);
  }
  WORKS(ifsm_system_sample(system, nullptr, nullptr, 0, &count));
  EXPECT_EQ(count, 2 * 65536);
  options.points = int64_t{1} << 50;
  WORKS(ifsm_system_sample(named("sponge"), &options, nullptr, 0, &count));
  EXPECT_EQ(count, int64_t{3} << 50);
  WORKS(ifsm_system_sample_addresses(system, &options, 5, nullptr, 0, &count));
  EXPECT_EQ(count, int64_t{5} << 50);
  const uint32_t counts[] = {1, 2};
  WORKS(ifsm_tone_map(counts, 2, nullptr, nullptr, 0, &count));
  EXPECT_EQ(count, 8);
}

TEST_F(Pictures, ThatMissTheAttractorAreEmptyAndNoError) {
  ifsm_picture_options options = window(100, 100, 101, 102, 9, 7);
  options.points = 500, options.oversample = 1;
  const ifsm_system system = named("fern");
  EXPECT_EQ(histogram(system, options), (std::vector<uint32_t>(63)));
  expect_report(options, 500, 0, 0, 0);
  EXPECT_EQ(set(system, options), Bytes(63, IFSM_PIXEL_EMPTY));
  expect_report(options, 0, 0, 0, 0);
  for (const int32_t colour : {IFSM_COLOUR_TONE, IFSM_COLOUR_SYMBOL, IFSM_COLOUR_ADDRESS}) {
    options.colour = colour;
    EXPECT_EQ(render(system, options), Bytes(4 * 63)) << colour;
    expect_report(options, 500, 0, 0, 0);
  }
  options.colour = IFSM_COLOUR_SET;
  EXPECT_EQ(render(system, options), Bytes(4 * 63));
  expect_report(options, 0, 0, 0, 0);
  // Distances are told all the same: of its tip, near (.2, 10), and beyond.
  for (const double each : distances(system, options)) EXPECT_TRUE(each > 130 && each < 140) << each;
  options.colour = IFSM_COLOUR_TONE;
  EXPECT_EQ(render(named("sponge"), options), Bytes(4 * 63));
  expect_report(options, 500, 0, 0, 0);
}

TEST_F(Pictures, OfASetAreProofs) {
  // Pixels of .1, from -.25: the square takes from the middle of the third to that of the thirteenth.
  const ifsm_picture_options options = window(-.25, -.25, 1.25, 1.25, 15, 15);
  const Bytes pixels = set(square(), options);
  for (std::size_t k = 0; k < pixels.size(); ++k) {
    const bool inside = k % 15 >= 2 && k % 15 <= 12 && k / 15 >= 2 && k / 15 <= 12;
    EXPECT_EQ(pixels[k], inside ? IFSM_PIXEL_MET : IFSM_PIXEL_EMPTY) << k;
  }
  expect_report(options, 0, 0, 121, 0);
  // Drawn: in the palette's darkest colour, or in that of one's own.
  ifsm_picture_options drawn = options;
  drawn.colour = IFSM_COLOUR_SET, drawn.oversample = 1, drawn.palette = IFSM_PALETTE_INK;
  const Bytes rgba = render(square(), drawn);
  expect_report(options, 0, 0, 121, 0);
  for (std::size_t k = 0; k < pixels.size(); ++k)
    EXPECT_EQ(
        Bytes(rgba.begin() + static_cast<std::ptrdiff_t>(4 * k), rgba.begin() + static_cast<std::ptrdiff_t>(4 * k + 4)),
        pixels[k] == IFSM_PIXEL_MET ? (Bytes{0x14, 0x16, 0x1c, 255}) : Bytes(4));
}

TEST_F(Pictures, OfDistancesAreExact) {
  ifsm_picture_options options = window(-2, -3, 4, 5, 12, 8);
  options.tolerance = 1e-3;
  const auto found = distances(square(), options);
  for (std::size_t k = 0; k < found.size(); ++k) {
    const double x = -2 + .5 * (static_cast<double>(k % 12) + .5), y = 5 - (static_cast<double>(k / 12) + .5);
    const double exact = std::hypot(std::max({-x, x - 1, 0.0}), std::max({-y, y - 1, 0.0}));
    EXPECT_GE(found[k], exact - 1e-14) << k;
    EXPECT_LE(found[k], exact + 1e-3) << k;
  }
  expect_report(options, 0, 0, 0, 0);
  // From dark, near, to light, far.
  options.colour = IFSM_COLOUR_DISTANCE, options.palette = IFSM_PALETTE_INK;
  const Bytes rgba = render(square(), options);
  const auto farthest = static_cast<std::size_t>(std::max_element(found.begin(), found.end()) - found.begin());
  const auto nearest = static_cast<std::size_t>(std::min_element(found.begin(), found.end()) - found.begin());
  EXPECT_EQ(rgba[4 * farthest], 0xc4);
  EXPECT_EQ(rgba[4 * farthest + 2], 0xcf);
  EXPECT_LE(std::abs(rgba[4 * nearest] - 0x14), 1);
  EXPECT_EQ(std::count(rgba.begin(), rgba.end(), 255), 96);  // all of it is opaque
}

TEST_F(Pictures, OfADensityAreTheToneMapOfTheHistogram) {
  ifsm_picture_options options = window(-.1, -.1, 1.1, 1.1, 40, 30);
  options.points = 5000, options.oversample = 1, options.palette = IFSM_PALETTE_SEA;
  const ifsm_system system = gasket();
  const auto counts = histogram(system, options);
  const int64_t met = report.met;
  const Bytes rgba = render(system, options);
  expect_report(options, 5000, 5000, met, 0);
  EXPECT_EQ(rgba, toned(counts, options));
  // Over a background, which is seen where nothing was hit.
  options.background = 0x0102037f;
  const Bytes over = render(system, options);
  EXPECT_EQ(over, toned(counts, options));
  for (std::size_t p = 0; p < counts.size(); ++p) {
    const auto pixel = over.begin() + static_cast<std::ptrdiff_t>(4 * p);
    if (counts[p] == 0) {
      EXPECT_EQ(Bytes(pixel, pixel + 4), (Bytes{1, 2, 3, 0x7f}));
    } else {
      EXPECT_TRUE(std::equal(pixel, pixel + 4, rgba.begin() + static_cast<std::ptrdiff_t>(4 * p)));
    }
  }
}

TEST_F(Pictures, ToneMapTheCountsOfAnySource) {
  const std::vector<uint32_t> counts = {0, 1, 3, std::numeric_limits<uint32_t>::max()};
  ifsm_picture_options options = defaults();
  const uint8_t stops[] = {10, 20, 30, 200, 210, 220};
  options.stops = stops, options.stop_count = 6;
  const Bytes two = toned(counts, options);
  EXPECT_EQ(Bytes(two.begin(), two.begin() + 4), Bytes(4));
  EXPECT_EQ(Bytes(two.end() - 4, two.end()), (Bytes{200, 210, 220, 255}));
  EXPECT_EQ(two[7], 255);
  options.stop_count = 3;  // one colour
  EXPECT_EQ(toned(counts, options), (Bytes{0, 0, 0, 0, 10, 20, 30, 255, 10, 20, 30, 255, 10, 20, 30, 255}));
  EXPECT_TRUE(toned({}, options).empty());
  EXPECT_EQ(toned(counts, defaults()).size(), 16U);
  uint8_t rgba[16];
  FAILS(ifsm_tone_map(counts.data(), 4, nullptr, rgba, 15, &count), IFSM_ERROR_CAPACITY, "rgba");
  EXPECT_EQ(last_error().required, 16);
  FAILS(ifsm_tone_map(nullptr, 4, nullptr, rgba, 16, &count), IFSM_ERROR_NULL, "counts");
  FAILS(ifsm_tone_map(counts.data(), -1, nullptr, rgba, 16, &count), IFSM_ERROR_RANGE, "number");
}

TEST_F(Pictures, OfSymbolsAndAddressesHaveTheColoursThatTheyPromise) {
  // One map, all points in one pixel, so the densest: the letter's colour, and the palette's middle one.
  ifsm_picture_options options = window(-1, -1, 1, 1, 2, 2);
  options.points = 100, options.oversample = 1, options.colour = IFSM_COLOUR_SYMBOL;
  Bytes wanted(16);
  wanted[13] = 0x72, wanted[14] = 0xb2, wanted[15] = 255;
  EXPECT_EQ(render(origin(), options), wanted);
  expect_report(options, 100, 100, 1, 0);
  options.colour = IFSM_COLOUR_ADDRESS, options.symbols = 1;
  const uint8_t stops[] = {0, 0, 0, 90, 80, 70, 255, 255, 255};  // the middle of 0 … 1 is that of its only piece
  options.stops = stops, options.stop_count = 9;
  const Bytes middle = render(origin(), options);
  EXPECT_NEAR(middle[12], 90, 1);
  EXPECT_NEAR(middle[13], 80, 1);
  EXPECT_NEAR(middle[14], 70, 1);
}

// Own colours, in turn, instead of the letters': two of them for three maps.
TEST_F(Pictures, OfSymbolsTakeOnesOwnColoursInTurn) {
  const uint8_t stops[] = {10, 20, 30, 200, 100, 0};
  ifsm_picture_options options = defaults();
  options.points = 100, options.oversample = 1, options.colour = IFSM_COLOUR_SYMBOL;
  options.stops = stops, options.stop_count = 6;
  // Each map's fixed point in a window of its own: all of one letter, and of one pixel, which is the densest.
  const ifsm_system system = of({0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 2, 0, 0, 0}, {1, 1, 1});
  for (std::size_t map = 0; map < 3; ++map) {
    const double left = static_cast<double>(map) - .5;
    options.left = left, options.bottom = -.5, options.right = left + 1, options.top = .5;
    options.width = options.height = 1;
    const uint8_t* own = stops + 3 * (map % 2);
    EXPECT_EQ(render(system, options), (Bytes{own[0], own[1], own[2], 255})) << map;
  }
}

TEST_F(Pictures, AreOversampledAsTheDefaultsSay) {
  const ifsm_system system = gasket();
  ifsm_picture_options options = window(-.1, -.1, 1.1, 1.1, 12, 12);
  for (const int32_t colour : {IFSM_COLOUR_TONE, IFSM_COLOUR_SYMBOL, IFSM_COLOUR_ADDRESS, IFSM_COLOUR_SET}) {
    options.colour = colour, options.oversample = 0;
    const Bytes usual = render(system, options);
    const ifsm_picture_report told = report;
    options.oversample = 2;
    EXPECT_EQ(render(system, options), usual) << colour;
    EXPECT_EQ(report.met, told.met);
    EXPECT_EQ(told.points, colour == IFSM_COLOUR_SET ? 0 : 16 * 24 * 24) << "16 a pixel that is computed";
  }
  options.colour = IFSM_COLOUR_DISTANCE, options.oversample = 0;
  const Bytes usual = render(system, options);
  options.oversample = 1;
  EXPECT_EQ(render(system, options), usual);
  // The mean of four pixels' light, by alpha.
  options.colour = IFSM_COLOUR_SET, options.oversample = 2;
  const Bytes small = render(system, options);
  ifsm_picture_options fine = options;
  fine.width = fine.height = 24, fine.oversample = 1;
  const Bytes large = render(system, fine);
  for (std::size_t p = 0; p < 144; ++p) {
    int alpha = 0;
    for (const std::size_t at : {0, 1, 24, 25}) alpha += large[4 * (p / 12 * 48 + p % 12 * 2 + at) + 3];
    EXPECT_EQ(small[4 * p + 3], std::lround(alpha / 4.)) << p;
  }
  // Counts are of pixels that are counted: the histogram does not look at it.
  const auto counts = histogram(system, options);
  EXPECT_EQ(counts.size(), 144U);
  EXPECT_EQ(report.points, 16 * 144);
}

TEST_F(Pictures, OfSpaceLookAtTheMiddleOfItsBall) {
  const ifsm_system system = named("tetrahedron");  // about the origin, its corners at sqrt(3)
  ifsm_picture_options options = defaults();
  options.width = 40, options.oversample = 1, options.points = 20'000;
  const Bytes usual = render(system, options);  // in perspective: the ball fills the field of .5
  EXPECT_NEAR(report.right, 1.04 * std::sqrt(3.) / std::cos(.25), 1e-3);
  options.azimuth = .6, options.elevation = .45, options.field = .5;
  EXPECT_EQ(render(system, options), usual);
  options.azimuth = 2 * std::acos(-1.0), options.elevation = options.field = 0;  // along the x axis
  const Bytes flat = render(system, options);
  EXPECT_NEAR(report.right, 1.04 * std::sqrt(3.), 1e-3);
  EXPECT_NEAR(report.left, -report.right, 1e-12);
  EXPECT_EQ(report.points, 20'000);
  EXPECT_EQ(report.inside, 20'000);
  EXPECT_EQ(report.met, std::count_if(flat.begin(), flat.end(),
                                      [k = 0](uint8_t byte) mutable { return k++ % 4 == 3 && byte == 255; }));
  // With an angle of view, the ball is tangent to it: r / cos(field / 2).
  options.field = 1;
  render(system, options);
  EXPECT_NEAR(report.right, 1.04 * std::sqrt(3.) / std::cos(.5), 1e-3);
  options.points = 0, options.width = 10;
  const Bytes one = render(system, options);
  EXPECT_EQ(report.points, 32 * 100);
  options.azimuth = .8, options.elevation = .4;
  EXPECT_NE(render(system, options), one);
  // One point: in the middle of the picture, its colour neither darker nor lighter.
  ifsm_picture_options point = defaults();
  point.width = 3, point.oversample = 1, point.points = 10, point.palette = IFSM_PALETTE_INK;
  for (const double place : {0., 3.})
    for (const double field : {0., 3.}) {
      point.field = field;
      const Bytes dot = render(of({.5, 0, 0, place, 0, .5, 0, 2 * place, 0, 0, .5, place}, {}, 3), point);
      EXPECT_EQ(report.inside, 10);
      EXPECT_EQ(report.met, 1);
      Bytes wanted(36);
      wanted[16] = dot[16], wanted[17] = dot[17], wanted[18] = dot[18], wanted[19] = 255;
      EXPECT_EQ(dot, wanted) << place << " " << field;
    }
  // Of the origin alone, which has no size, in pixels as fine as any.
  point.width = 1001, point.height = 1;
  const Bytes dot = render(of({.5, 0, 0, 0, 0, .5, 0, 0, 0, 0, .5, 0}, {}, 3), point);
  EXPECT_EQ(report.inside, 10);
  EXPECT_EQ(dot[4 * 500 + 3], 255);
}

TEST_F(Pictures, OfSpaceAreNoSetsNoDistancesNoHistograms) {
  const ifsm_system system = named("sponge");
  ifsm_picture_options options = defaults();
  options.width = 8;
  report = blank();
  uint8_t bytes[256];
  uint32_t counts[64];
  double values[64];
  FAILS(ifsm_system_histogram(system, &options, &report, counts, 64, &count), IFSM_ERROR_SHAPE, "system");
  FAILS(ifsm_system_set(system, &options, &report, bytes, 64, &count), IFSM_ERROR_SHAPE, "system");
  FAILS(ifsm_system_distances(system, &options, &report, values, 64, &count), IFSM_ERROR_SHAPE, "system");
  for (const int32_t colour : {IFSM_COLOUR_SET, IFSM_COLOUR_DISTANCE}) {
    options.colour = colour;
    FAILS(ifsm_system_render(system, &options, &report, bytes, 256, &count), IFSM_ERROR_SHAPE, "system");
    FAILS(ifsm_system_render(system, &options, &report, nullptr, 0, &count), IFSM_ERROR_SHAPE, "system");
  }
}

TEST_F(Pictures, SampleTheFirstPointsOfAllAndTheirAddresses) {
  const ifsm_system system = named("fern_3d");
  ifsm_picture_options options = defaults();
  options.seed = 3;
  const auto sample = [&](int64_t points) {
    options.points = points;
    return all_of<double>(
        [&](double* to, int64_t room, int64_t* told) { return ifsm_system_sample(system, &options, to, room, told); });
  };
  const auto few = sample(100), many = sample(1000);
  ASSERT_EQ(few.size(), 300U);
  EXPECT_TRUE(std::equal(few.begin(), few.end(), many.begin()));
  options.threads = 1;
  EXPECT_EQ(sample(1000), many);
  constexpr std::size_t length = 200;
  options.points = 100;
  const auto symbols = all_of<int32_t>([&](int32_t* to, int64_t room, int64_t* told) {
    return ifsm_system_sample_addresses(system, &options, length, to, room, told);
  });
  ASSERT_EQ(symbols.size(), 100 * length);
  for (std::size_t k = 0; k < 100; k += 9) {
    double point[3];
    WORKS(ifsm_system_point(system, &symbols[k * length], length, 1, point, 3, &count));
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(point[i], few[3 * k + i], 1e-12) << k;
  }
  options.seed = 4;
  EXPECT_NE(sample(100), few);
}

TEST_F(Pictures, AreTheSameBitsOnAnyNumberOfThreads) {
  const ifsm_system system = named("fern");
  ifsm_picture_options options = defaults();
  options.width = 80, options.points = 3 << 20;
  for (const int32_t colour : {IFSM_COLOUR_TONE, IFSM_COLOUR_ADDRESS, IFSM_COLOUR_DISTANCE}) {
    options.colour = colour, options.symbols = 2;
    options.threads = 1;
    const Bytes one = render(system, options);
    options.threads = 3;
    EXPECT_EQ(render(system, options), one) << colour;
  }
}

// A system without an attractor is refused by the word that grows, also where the count alone is asked for.
TEST_F(Pictures, OfSystemsWithoutAnAttractorAreRefusedWithTheWord) {
  const ifsm_system system = growing();
  ifsm_picture_options options = window(0, 0, 1, 1, 4, 4);
  report = blank();
  const auto names_the_word = [] {
    const std::string message = last_error().message;
    EXPECT_TRUE(message.find("word 0 2") != std::string::npos || message.find("word 2 0") != std::string::npos)
        << message;
  };
  uint8_t bytes[64];
  uint32_t counts[16];
  double values[32];
  int32_t symbols[64];
  options.points = 4;
  FAILS(ifsm_system_histogram(system, &options, &report, counts, 16, &count), IFSM_ERROR_RANGE, "system");
  names_the_word();
  FAILS(ifsm_system_set(system, &options, &report, bytes, 16, &count), IFSM_ERROR_RANGE, "system");
  names_the_word();
  FAILS(ifsm_system_distances(system, &options, &report, values, 16, &count), IFSM_ERROR_RANGE, "system");
  names_the_word();
  for (const int32_t colour : {0, 1, 2, 3, 4}) {
    options.colour = colour;
    FAILS(ifsm_system_render(system, &options, &report, bytes, 64, &count), IFSM_ERROR_RANGE, "system");
    names_the_word();
  }
  FAILS(ifsm_system_sample(system, &options, values, 8, &count), IFSM_ERROR_RANGE, "system");
  names_the_word();
  FAILS(ifsm_system_sample(system, &options, nullptr, 0, &count), IFSM_ERROR_RANGE, "system");
  names_the_word();
  FAILS(ifsm_system_sample_addresses(system, &options, 2, symbols, 64, &count), IFSM_ERROR_RANGE, "system");
  names_the_word();
  FAILS(ifsm_system_histogram(system, nullptr, &report, nullptr, 0, &count), IFSM_ERROR_RANGE, "system");
  names_the_word();
}

TEST_F(Pictures, RefuseOptionsByTheirNames) {
  const ifsm_system system = gasket();
  report = blank();
  const ifsm_picture_options good = window(0, 0, 1, 1, 4, 4);
  uint8_t bytes[64];
  const auto blames = [&](const auto& change) {
    ifsm_picture_options options = good;
    change(options);
    EXPECT_NE(ifsm_system_render(system, &options, &report, bytes, 64, &count), IFSM_OK);
    return std::string(last_error().argument);
  };
  using Options = ifsm_picture_options;
  EXPECT_EQ(blames([](Options& o) { o.right = 0; }), "right");
  EXPECT_EQ(blames([](Options& o) { o.right = -1; }), "right");
  EXPECT_EQ(blames([](Options& o) { o.top = 0; }), "top");
  EXPECT_EQ(blames([](Options& o) { o.left = NAN; }), "left");
  EXPECT_EQ(last_error().status, IFSM_ERROR_NOT_FINITE);
  EXPECT_EQ(blames([](Options& o) { o.left = 1, o.right = 1 + 1e-16; }), "right");
  EXPECT_EQ(blames([](Options& o) { o.left = 1e16, o.right = 1e16 + 2; }), "window");
  EXPECT_EQ(blames([](Options& o) { o.width = -1; }), "width");
  EXPECT_EQ(blames([](Options& o) { o.height = 32769; }), "height");
  EXPECT_EQ(blames([](Options& o) { o.width = 32768, o.oversample = 2; }), "oversample");
  EXPECT_EQ(blames([](Options& o) { o.width = 16384, o.oversample = 3; }), "oversample");
  EXPECT_EQ(blames([](Options& o) { o.points = (int64_t{1} << 50) + 1; }), "points");
  EXPECT_EQ(blames([](Options& o) { o.tolerance = -1e-3; }), "tolerance");
  EXPECT_EQ(blames([](Options& o) { o.tolerance = 1.001; }), "tolerance");
  EXPECT_EQ(blames([](Options& o) { o.tolerance = INFINITY; }), "tolerance");
  EXPECT_EQ(blames([](Options& o) { o.colour = IFSM_COLOUR_SET, o.tolerance = 1e-14; }), "tolerance");
  EXPECT_EQ(blames([](Options& o) { o.colour = 5; }), "colour");
  EXPECT_EQ(blames([](Options& o) { o.palette = -1; }), "palette");
  EXPECT_EQ(blames([](Options& o) { o.stop_count = 3; }), "stops");
  EXPECT_EQ(last_error().status, IFSM_ERROR_NULL);
  static const uint8_t stops[771] = {};
  EXPECT_EQ(blames([](Options& o) { o.stops = stops, o.stop_count = 4; }), "stop_count");
  EXPECT_EQ(blames([](Options& o) { o.stops = stops, o.stop_count = 771; }), "stop_count");
  EXPECT_EQ(blames([](Options& o) { o.symbols = 17; }), "symbols");
  EXPECT_EQ(blames([](Options& o) { o.oversample = 9; }), "oversample");
  EXPECT_EQ(blames([](Options& o) { o.reserved = 1; }), "reserved");
  EXPECT_EQ(blames([](Options& o) { o.azimuth = INFINITY; }), "azimuth");
  EXPECT_EQ(blames([](Options& o) { o.elevation = NAN; }), "elevation");
  EXPECT_EQ(blames([](Options& o) { o.field = 3.01; }), "field");
  EXPECT_EQ(blames([](Options& o) { o.field = -1; }), "field");
  EXPECT_EQ(blames([](Options& o) { o.threads = 1025; }), "threads");
  EXPECT_EQ(blames([](Options& o) { o.cancel.id = 12345; }), "cancel");
}

TEST_F(Pictures, AreCancelledByTokenAndByCallback) {
  const ifsm_system system = gasket();
  ifsm_cancel cancel{};
  WORKS(ifsm_cancel_create(&cancel));
  WORKS(ifsm_cancel_request(cancel));
  ifsm_picture_options options = window(0, 0, 1, 1, 4, 4);
  std::vector<double> values(1 << 14);
  uint8_t bytes[64];
  uint32_t counts[16];
  std::vector<int32_t> symbols(1 << 14);
  options.points = 4000;
  const auto all_are_cancelled = [&] {
    report = blank();
    EXPECT_EQ(ifsm_system_histogram(system, &options, &report, counts, 16, &count), IFSM_ERROR_CANCELLED);
    EXPECT_EQ(ifsm_system_set(system, &options, &report, bytes, 16, &count), IFSM_ERROR_CANCELLED);
    EXPECT_EQ(ifsm_system_distances(system, &options, &report, values.data(), 16, &count), IFSM_ERROR_CANCELLED);
    for (const int32_t colour : {0, 1, 2, 3, 4}) {
      options.colour = colour;
      EXPECT_EQ(ifsm_system_render(system, &options, &report, bytes, 64, &count), IFSM_ERROR_CANCELLED) << colour;
    }
    EXPECT_EQ(report.width, blank().width) << "the report is written last";
    options.colour = 0;
    EXPECT_EQ(ifsm_system_sample(system, &options, values.data(), 8000, &count), IFSM_ERROR_CANCELLED);
    EXPECT_EQ(ifsm_system_sample_addresses(system, &options, 3, symbols.data(), 12000, &count), IFSM_ERROR_CANCELLED);
  };
  options.cancel = cancel;
  all_are_cancelled();
  options.cancel = {};
  options.progress = [](void*, double, const char*) -> int32_t { return 1; };
  all_are_cancelled();
  WORKS(ifsm_cancel_destroy(cancel));

  // It ends with 1, and the user's pointer comes along.
  double last = -1;
  options.progress = [](void* user, double fraction, const char*) -> int32_t {
    auto& before = *static_cast<double*>(user);
    EXPECT_GE(fraction, before);
    before = fraction;
    return 0;
  };
  options.user = &last;
  render(system, options);
  EXPECT_EQ(last, 1);
}

// Of symbols, light over all of a piece is the letter's, fainter where points are few.
TEST_F(Pictures, OfSymbolsShowPiecesInTheirOwnColours) {
  ifsm_picture_options options = window(0, 0, 1, 1, 16, 16);
  options.points = 50'000, options.colour = IFSM_COLOUR_SYMBOL, options.oversample = 1;
  const Bytes rgba = render(square(), options);
  const uint8_t colours[4][3] = {{0, 0x72, 0xb2}, {0xd5, 0x5e, 0}, {0, 0x9e, 0x73}, {0xcc, 0x79, 0xa7}};
  EXPECT_EQ(report.met, 256);
  EXPECT_EQ(report.inside, 50'000);
  for (std::size_t p = 0; p < 256; ++p) {
    const uint8_t* own = colours[(p / 16 < 8 ? 2 : 0) + (p % 16 < 8 ? 0 : 1)];
    double solid[3];
    for (std::size_t k = 0; k < 3; ++k) solid[k] = (1 - light_of(rgba[4 * p + k])) / (1 - light_of(own[k]));
    EXPECT_NEAR(solid[0], solid[1], .03) << p;
    EXPECT_NEAR(solid[0], solid[2], .03) << p;
    EXPECT_GT(solid[0], .9) << p;
    EXPECT_LT(solid[0], 1.01) << p;
  }
}

}  // namespace
