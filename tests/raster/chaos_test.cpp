#include "raster/chaos.h"

#include <hwy/targets.h>

#include <cmath>
#include <random>

#include "base/error.h"
#include "support.h"
#include "system/moments.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

constexpr std::int64_t million = 1 << 20;

std::int64_t sum(const Counts& counts) {
  std::int64_t all = 0;
  for (const std::uint32_t count : counts.pixels) all += count;
  return all;
}

// How many points are in other pixels.
std::int64_t moved(const Counts& a, const Counts& b) {
  std::int64_t differences = std::abs(a.inside - b.inside);
  for (std::size_t k = 0; k < a.pixels.size(); ++k)
    differences += std::abs(static_cast<std::int64_t>(a.pixels[k]) - static_cast<std::int64_t>(b.pixels[k]));
  return differences / 2;
}

// Another chaos game, with another generator and another choice: one orbit in double precision, as in every textbook.
Counts textbook(const System& system, const Window& window, std::int64_t points) {
  std::mt19937_64 random(7);
  std::discrete_distribution<std::size_t> choice(system.probabilities().begin(), system.probabilities().end());
  Counts counts;
  counts.pixels.resize(static_cast<std::size_t>(window.pixels()));
  Vector3 x = fixed_point(system.maps()[0]);
  for (std::int64_t k = -200; k < points; ++k) {
    x = system.maps()[choice(random)](x);
    const std::int64_t pixel = Grid(window).pixel(x(0), x(1));
    if (k < 0 || pixel == window.pixels()) continue;
    ++counts.pixels[static_cast<std::size_t>(pixel)];
    ++counts.inside;
  }
  return counts;
}

// Of two histograms of n and m points of one distribution: chi² over its degrees of freedom, in standard deviations.
// Pixels of few points are put together.
double chi_square(const Counts& a, double n, const Counts& b, double m) {
  double square = 0, bins = -1, in_a = 0, in_b = 0;
  const auto close = [&] {
    const double expected = (in_a + in_b) / (n + m);
    square += std::pow(in_a - n * expected, 2) / (n * expected) + std::pow(in_b - m * expected, 2) / (m * expected);
    ++bins;
    in_a = in_b = 0;
  };
  for (std::size_t k = 0; k < a.pixels.size(); ++k) {
    in_a += a.pixels[k], in_b += b.pixels[k];
    if (in_a + in_b >= 40) close();
  }
  in_a += n - static_cast<double>(a.inside), in_b += m - static_cast<double>(b.inside);
  if (in_a + in_b > 0) close();
  return (square - bins) / std::sqrt(2 * bins);
}

TEST(ChaosGame, FollowsTheOrbitsOfDoublePrecisionButForPointsAtPixelsEdges) {
  // Orbits of single precision are within some 2^-22 of the attractor's size: of a pixel, 2^-12. So about one point in
  // a thousand may be seen in a neighbouring pixel.
  for (const char* name : {"fern", "gasket", "twin_dragon", "maple_leaf", "koch", "carpet", "tree_type1_with_dummy",
                           "fern_cyclosorus", "spiral", "minkowski_sausage"}) {
    const auto system = named_system(name);
    const Window window = around(*system, 512, 512);
    ASSERT_TRUE(single_precision_suffices(*system, window) || std::string(name) == "fern_cyclosorus") << name;
    const Counts fast = counted(*system, window, 1, 2 * million + 77),
                 plain = plain::chaos_counts(*system, window, 1, 2 * million + 77);
    EXPECT_EQ(sum(fast), fast.inside) << name;
    EXPECT_EQ(sum(plain), plain.inside) << name;
    EXPECT_LE(moved(fast, plain), 2 * million / 1000) << name;
  }
}

TEST(ChaosGame, GivesTheSameBitsOnEveryVectorTarget) {
  const auto system = named_system("fern");
  const Window window = around(*system, 300, 200);
  Random random(8);
  std::vector<Affine> many;
  for (int k = 0; k < 37; ++k) many.push_back(similar(.1, .05 * (k % 5), .03 * k, .01 * k * k));
  const System large(2, many), middle(2, {many.begin(), many.begin() + 13});
  const Counts best = counted(*system, window, 3, million),
               of_large = counted(large, around(large, 99, 99), 3, million),
               of_middle = counted(middle, around(middle, 99, 99), 3, million);
  int targets = 0;
  for (std::int64_t every = hwy::SupportedTargets(), lowest = 0; every != 0; every &= every - 1) {
    lowest = every & -every;
    hwy::SetSupportedTargetsForTest(lowest);
    ++targets;
    EXPECT_EQ(counted(*system, window, 3, million).pixels, best.pixels) << hwy::TargetName(lowest);
    EXPECT_EQ(counted(middle, around(middle, 99, 99), 3, million).pixels, of_middle.pixels) << hwy::TargetName(lowest);
    EXPECT_EQ(counted(large, around(large, 99, 99), 3, million).pixels, of_large.pixels) << hwy::TargetName(lowest);
  }
  hwy::SetSupportedTargetsForTest(0);
  EXPECT_GE(targets, 2) << "nothing was compared";
}

TEST(ChaosGame, IsDistributedAsATextbooksAlsoWhereTheStemLiesOnPixelsEdges) {
  struct Case {
    const char* name;
    Window window;
  };
  for (const auto& [name, window] :
       {Case{"fern", around(*named_system("fern"), 128, 128)}, Case{"fern", {-2.5, 0, 2.5, 10, 100, 100}},
        Case{"fern", {-2.56, 0, 2.56, 10.24, 64, 64}}, Case{"fern", {-3, -1, 3, 11, 77, 91}},
        Case{"gasket_right", {0, 0, 1, 1, 64, 64}}, Case{"carpet", {0, 0, 1, 1, 81, 81}},
        Case{"cantor_set", {-1, -1, 2, 1, 90, 90}}, Case{"fern", {-.5, 1, .5, 2, 64, 64}}}) {
    const auto system = named_system(name);
    const Counts fast = counted(*system, window, 5, 4 * million), other = textbook(*system, window, 4 * million);
    const double deviations = chi_square(fast, 4 * million, other, 4 * million);
    EXPECT_LT(std::abs(deviations), 5) << name << " " << window.left << " " << window.width;
  }
}

TEST(ChaosGame, PutsTheStemIntoOneColumn) {
  // x = 0, on the edge between columns 49 and 50: a pixel owns its left edge.
  const Window window{-2.5, -1, 2.5, 9, 100, 100};
  const System stem(2, {named_system("fern")->maps()[3], plane(.3, .4, -.4, .3, 2, 5)}, {.9, .1});
  const Counts fast = counted(stem, window, 1, million), plain = plain::chaos_counts(stem, window, 1, million);
  const auto column = [&](const Counts& counts, std::size_t x) {
    std::int64_t points = 0;
    for (std::size_t y = 0; y < 100; ++y) points += counts.pixels[100 * y + x];
    return points;
  };
  EXPECT_GT(column(fast, 50), .89 * million);
  EXPECT_EQ(column(fast, 50), column(plain, 50));
  EXPECT_EQ(column(fast, 49), column(plain, 49));
}

TEST(ChaosGame, HasTheExactMoments) {
  // Through pixels: their middles are within half a pixel of points, and the mean of many is that of the measure.
  for (const char* name : {"fern", "gasket", "twin_dragon"}) {
    const auto system = named_system(name);
    const Window window = around(*system, 1024, 1024);
    const std::int64_t points = 32 * million;
    const Counts counts = counted(*system, window, 9, points);
    double x = 0, y = 0, xx = 0, yy = 0;
    const double dx = (window.right - window.left) / 1024, dy = (window.top - window.bottom) / 1024;
    for (std::size_t k = 0; k < counts.pixels.size(); ++k) {
      const double n = counts.pixels[k], px = window.left + (static_cast<double>(k % 1024) + .5) * dx,
                   py = window.top - (static_cast<double>(k / 1024) + .5) * dy;
      x += n * px, y += n * py, xx += n * px * px, yy += n * py * py;
    }
    const auto all = static_cast<double>(counts.inside);
    x /= all, y /= all, xx /= all, yy /= all;
    const auto exact = moments(*system, 2, Vector3::Zero());
    // Points follow one another in orbits, so their mean is known less well than that of as many independent ones: the
    // sum of correlations is below 2 / (1 - .86). Squares in a pixel vary by dx²/12 more than the middle's.
    const double correlated = std::sqrt(2 / (1 - .86) / all);
    EXPECT_NEAR(x, exact[1], 5 * correlated * std::sqrt(exact[3] - exact[1] * exact[1]) + dx / 100) << name;
    EXPECT_NEAR(y, exact[2], 5 * correlated * std::sqrt(exact[5] - exact[2] * exact[2]) + dy / 100) << name;
    EXPECT_NEAR(xx, exact[3], 5 * correlated * exact[3] * 2 + dx * dx + dx / 50) << name;
    EXPECT_NEAR(yy, exact[5], 5 * correlated * exact[5] * 2 + dy * dy + dy / 10) << name;
  }
}

TEST(ChaosGame, TakesDoublesWherePixelsAreFiner) {
  const auto fern = named_system("fern");
  EXPECT_TRUE(single_precision_suffices(*fern, around(*fern, 1024, 1024)));
  EXPECT_FALSE(single_precision_suffices(*fern, around(*fern, 4096, 4096)));
  EXPECT_FALSE(single_precision_suffices(*fern, {0, 5, .01, 5.01, 1024, 1024})) << "a part, enlarged";
  EXPECT_FALSE(single_precision_suffices(*named_system("cantor_set"), {-1, -1, 2, 1, 100, 100})) << "all of it is flat";
  const Window part{0, 5, .01, 5.01, 64, 64};
  EXPECT_EQ(counted(*fern, part, 1, million).pixels, plain::chaos_counts(*fern, part, 1, million).pixels);
}

TEST(ChaosGame, CountsInDoublePrecisionAsThePlainLoopOnEveryVectorTarget) {
  Random random(9);
  std::vector<Affine> many;
  for (int k = 0; k < 37; ++k) many.push_back(similar(.1, .05 * (k % 5), .03 * k, .01 * k * k));
  // Tables of 2, 4, 8, 16 and 64 slots; windows around the attractor, a part of it, all on an edge, none of it.
  std::vector<System> systems;
  for (const std::ptrdiff_t maps : {2, 3, 7, 13, 37})
    systems.emplace_back(2, std::vector<Affine>(many.begin(), many.begin() + maps));
  systems.push_back(*named_system("fern"));
  systems.push_back(*named_system("cantor_set"));
  constexpr std::int64_t points = million / 4 + 77;
  std::vector<std::pair<const System*, Window>> cases;
  for (const System& system : systems) {
    const Window whole = around(system, 2500, 400);
    const double width = whole.right - whole.left, height = std::max(whole.top - whole.bottom, 1.0);
    const Window part{whole.left + .3 * width,
                      whole.bottom + .2 * height,
                      whole.left + .31 * width,
                      whole.bottom + .3 * height,
                      500,
                      400};
    for (const Window& window : {Window{whole.left, whole.bottom - 1e-3, whole.right, whole.top + 1e-3, 2500, 400},
                                 part, Window{-1, -1e9, 1e-9, 0, 1000, 1000},
                                 Window{whole.right + 1, whole.bottom, whole.right + 2, whole.bottom + 1, 3000, 10}})
      if (!single_precision_suffices(system, window)) cases.emplace_back(&system, window);
  }
  ASSERT_GE(cases.size(), 14);
  std::vector<Counts> plain;
  for (const auto& [system, window] : cases) plain.push_back(plain::chaos_counts(*system, window, 3, points));
  for (std::int64_t every = hwy::SupportedTargets(); every != 0; every &= every - 1) {
    hwy::SetSupportedTargetsForTest(every & -every);
    for (std::size_t k = 0; k < cases.size(); ++k) {
      const Counts fast = counted(*cases[k].first, cases[k].second, 3, points);
      EXPECT_EQ(fast.inside, plain[k].inside) << k << hwy::TargetName(every & -every);
      EXPECT_TRUE(fast.pixels == plain[k].pixels) << k << hwy::TargetName(every & -every);
    }
  }
  hwy::SetSupportedTargetsForTest(0);
}

TEST(ChaosGame, CountsLargeWindowsAsThePlainLoop) {
  const auto fern = named_system("fern");
  const Window whole = around(*fern, 1, 1);
  struct Case {
    std::int64_t width, height, points;
  };
  for (const auto& [width, height, points] : {Case{3000, 3000, 5},
                                              {3000, 3000, million / 2 + 5},
                                              {3000, 3000, 2 * million},
                                              {3000, 3000, 3 * million - 63},
                                              {32768, 300, million},
                                              {300, 32768, million},
                                              {4100, 4100, million}}) {
    for (const double from : {whole.left, whole.left + 1}) {
      const Window window{from, whole.bottom, whole.right, whole.top - 1, width, height};
      const Counts fast = counted(*fern, window, 2, points), plain = plain::chaos_counts(*fern, window, 2, points);
      EXPECT_EQ(fast.inside, plain.inside) << width << " " << points;
      EXPECT_TRUE(fast.pixels == plain.pixels) << width << " " << points;
    }
  }
}

TEST(ChaosGame, SaysThatAWindowMissesTheAttractor) {
  const Counts counts = counted(*named_system("fern"), {100, 100, 101, 101, 10, 10}, 1, 1000);
  EXPECT_EQ(counts.inside, 0);
  EXPECT_EQ(sum(counts), 0);
}

TEST(ChaosGame, CountsExactlyAsManyPointsAsAreAskedFor) {
  const auto gasket = named_system("gasket");
  for (const std::int64_t points :
       {std::int64_t{1}, std::int64_t{63}, std::int64_t{64}, std::int64_t{65}, million - 1, million, million + 1})
    EXPECT_EQ(counted(*gasket, {-1, -1, 2, 2, 10, 10}, 1, points).inside, points);
  EXPECT_NE(counted(*gasket, {-1, -1, 2, 2, 64, 64}, 1, 1000).pixels,
            counted(*gasket, {-1, -1, 2, 2, 64, 64}, 2, 1000).pixels);
}

TEST(ChaosGame, RefusesWindowsAndSystemsByName) {
  const auto argument = [](const System& system, const Window& window, std::int64_t points = 10) {
    try {
      counted(system, window, 1, points);
    } catch (const Error& error) {
      return error.argument();
    }
    return std::string("none");
  };
  const auto fern = named_system("fern");
  EXPECT_EQ(argument(*fern, {0, 0, 1, 1, 0, 10}), "width");
  EXPECT_EQ(argument(*fern, {0, 0, 1, 1, 10, 32769}), "height");
  EXPECT_EQ(argument(*fern, {1, 0, 1, 1, 10, 10}), "window");
  EXPECT_EQ(argument(*fern, {1, 0, 0, 1, 10, 10}), "window");
  EXPECT_EQ(argument(*fern, {0, NAN, 1, 1, 10, 10}), "window");
  EXPECT_EQ(argument(*fern, {-1e308, 0, 1e308, 1, 10, 10}), "window");
  EXPECT_EQ(argument(*fern, {1e10, 0, 1e10 + 1e-5, 1, 1000, 10}), "window");
  EXPECT_EQ(argument(*fern, {0, 0, 1, 1, 10, 10}, 0), "points");
  EXPECT_EQ(argument(*named_system("fern_3d"), {0, 0, 1, 1, 10, 10}), "system");
  EXPECT_EQ(argument(System(2, {plane(2, 0, 0, 2, 0, 0)}), {0, 0, 1, 1, 10, 10}), "system");
}

}  // namespace
