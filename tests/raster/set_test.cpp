#include "raster/set.h"

#include <hwy/targets.h>

#include <cmath>
#include <numbers>
#include <random>

#include "base/error.h"
#include "support.h"
#include "system/address.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

constexpr double tolerance = 1. / 64;

std::vector<Meets> set_of(const System& system, const Window& window, double tolerance = ::tolerance) {
  Watch watch;
  return set_pixels(system, window, tolerance, watch);
}

std::int64_t count(const std::vector<Meets>& states, Meets wanted) {
  return std::count(states.begin(), states.end(), wanted);
}

// A window around the box, with some air, whose pixels do not lie in step with the shapes of the classics.
Window odd(const System& system, std::int64_t size) {
  const Box box = bounding_box(system, 1e-9 * system.enclosure().axes.norm());
  const double wide = 1.0137 * (box.high(0) - box.low(0)) + .01, high = 1.0219 * (box.high(1) - box.low(1)) + .01;
  return {box.low(0) - .0071, box.low(1) - .00531, box.low(0) - .0071 + wide, box.low(1) - .00531 + high, size, size};
}

TEST(SetPixels, HoldEveryPointOfTheChaosGame) {
  for (const char* name : {"fern", "gasket", "twin_dragon", "koch", "carpet", "maple_leaf", "cantor_set", "tree_type2",
                           "fern_cyclosorus", "levy", "vicsek", "gosper_island"}) {
    const auto system = named_system(name);
    const Window window = odd(*system, 200);
    const auto states = set_of(*system, window);
    const Counts counts = plain::chaos_counts(*system, window, 1, 1 << 21);
    ASSERT_EQ(counts.inside, 1 << 21) << name;
    std::int64_t hit = 0;
    for (std::size_t k = 0; k < states.size(); ++k) {
      if (counts.pixels[k] == 0) continue;
      ++hit;
      EXPECT_NE(states[k], Meets::no) << name << " " << k;
    }
    // Not much more: pixels that are met by little measure are missed by chance.
    EXPECT_GE(count(states, Meets::yes), hit - count(states, Meets::undecided)) << name;
    EXPECT_LE(count(states, Meets::undecided), count(states, Meets::yes) / 20 + 2) << name;
  }
}

// By another way: every pixel that is said to be met has a point of the attractor, found by its address.
TEST(SetPixels, AreMetWhereTheySaySo) {
  for (const char* name : {"fern", "gasket", "koch", "heighway_dragon", "tree_type1"}) {
    const auto system = named_system(name);
    const Window window = odd(*system, 40);
    const auto states = set_of(*system, window);
    const Grid grid(window);
    const double wide = 1 / grid.columns_per_unit, high = 1 / grid.rows_per_unit;
    for (std::size_t k = 0; k < states.size(); ++k) {
      const Vector3 middle(window.left + (static_cast<double>(k % 40) + .5) * wide,
                           window.top - (static_cast<double>(k / 40) + .5) * high, 0);
      const double around = std::hypot(wide, high) / 2;
      // Within the pixel's circle there is a point if it is met, and none of its inner circle if it is not.
      const auto has_point_within = [&](double distance) {
        return !addresses_of(*system, middle, 1, distance, 1000).empty();
      };
      EXPECT_TRUE(states[k] != Meets::yes || has_point_within(around)) << name << " " << k;
      EXPECT_TRUE(states[k] != Meets::no || !has_point_within(std::min(wide, high) / 4.1)) << name << " " << k;
    }
  }
}

TEST(SetPixels, FillASquareAndNothingBesideIt) {
  std::vector<Affine> quarters;
  for (const double e : {0.0, .5})
    for (const double f : {0.0, .5}) quarters.push_back(plane(.5, 0, 0, .5, e, f));
  const System square(2, quarters);
  // Pixels of .1, from -.25: the square takes from the middle of the third to the middle of the thirteenth.
  const auto states = set_of(square, {-.25, -.25, 1.25, 1.25, 15, 15});
  for (std::size_t k = 0; k < states.size(); ++k) {
    const std::size_t column = k % 15, row = k / 15;
    const bool inside = column >= 2 && column <= 12 && row >= 2 && row <= 12;
    EXPECT_EQ(states[k], inside ? Meets::yes : Meets::no) << column << " " << row;
  }
}

// A square whose sides lie beside the pixels' edges, by so little that rounding must be reckoned with.
TEST(SetPixels, NeverMistakeWhatLiesHardByAnEdge) {
  std::vector<Affine> ninths;
  for (const double e : {0., 1., 2.})
    for (const double f : {0., 1., 2.}) ninths.push_back(plane(1. / 3, 0, 0, 1. / 3, e / 3, f / 3));
  const System square(2, ninths);
  constexpr std::int64_t before = 5, across = 437, size = across + 2 * before;
  constexpr double pixel = 1. / across;
  std::int64_t decided = 0, all = 0;
  for (double off = .05; off > 1e-8; off /= 1.7)
    for (const double by : {off, -off})
      for (const double tolerance : {1. / 16, 1. / 64, 1e-3}) {
        const double low = (by - before) * pixel, high = low + size * pixel;
        const auto states = set_of(square, {low, low, high, high, size, size}, tolerance);
        // Those from 5 - by to 442 - by; rows are counted from above.
        const auto is_met = [&](std::int64_t place) {
          return place >= (by > 0 ? before - 1 : before) && place < before + across + (by > 0 ? 0 : 1);
        };
        for (std::int64_t k = 0; k < size * size; ++k) {
          const Meets state = states[static_cast<std::size_t>(k)];
          const bool met = is_met(k % size) && is_met(size - 1 - k / size);
          ASSERT_NE(state, met ? Meets::no : Meets::yes) << k << ", " << by << " of a pixel, to " << tolerance;
          decided += state != Meets::undecided;
        }
        all += size * size;
      }
  EXPECT_GT(decided, .98 * static_cast<double>(all)) << "more than the pixels along the sides are undecided";
}

TEST(SetPixels, LeaveOpenWhatOnlyTouches) {
  // In step with the window: what lies beside the square's edge is touched, and no point is inside.
  std::vector<Affine> quarters;
  for (const double e : {0.0, .5})
    for (const double f : {0.0, .5}) quarters.push_back(plane(.5, 0, 0, .5, e, f));
  const auto states = set_of(System(2, quarters), {-.5, -.5, 1.5, 1.5, 8, 8});
  for (std::size_t k = 0; k < states.size(); ++k) {
    const auto beside = [](std::size_t place) {
      return place >= 2 && place <= 5 ? 0 : place == 1 || place == 6 ? 1 : 2;
    };
    const int away = std::max(beside(k % 8), beside(k / 8));
    EXPECT_TRUE(away != 0 || states[k] == Meets::yes) << k;
    EXPECT_TRUE(away != 2 || states[k] == Meets::no) << k;
  }
}

// Copies of the twin dragon, moved by a lattice, tile the plane: a pixel that no other copy meets is full. So its area,
// 17/8, the lattice's, lies between that of full pixels and that of pixels not proven to be empty.
TEST(SetPixels, HoldTheTwinDragonsAreaBetweenFullPixelsAndPixelsThatAreNotEmpty) {
  const auto dragon = named_system("twin_dragon");
  const Vector3 first(.75, 1.25, 0), second(-.5, 2, 0);  // M^-1 (t_1 - t_0), and M^-1 of that
  double gap = 100;
  for (const std::int64_t size : {64, 128, 256, 512}) {
    const Window window = odd(*dragon, size);
    const double pixel = (window.right - window.left) * (window.top - window.bottom) / static_cast<double>(size * size);
    const auto states = set_of(*dragon, window);
    std::vector<bool> full(states.size());
    for (std::size_t k = 0; k < states.size(); ++k) full[k] = states[k] == Meets::yes;
    for (int a = -3; a <= 3; ++a)
      for (int b = -3; b <= 3; ++b) {
        if (a == 0 && b == 0) continue;
        const Vector3 moved = a * first + b * second;
        const auto other = set_of(*dragon, {window.left - moved(0), window.bottom - moved(1), window.right - moved(0),
                                            window.top - moved(1), size, size});
        for (std::size_t k = 0; k < states.size(); ++k) full[k] = full[k] && other[k] == Meets::no;
      }
    const double inside = pixel * static_cast<double>(std::count(full.begin(), full.end(), true));
    const double outside = pixel * static_cast<double>(count(states, Meets::yes) + count(states, Meets::undecided));
    EXPECT_LE(inside, 17. / 8) << size;
    EXPECT_GE(outside, 17. / 8) << size;
    EXPECT_LT(outside - inside, .8 * gap) << size;  // a border of dimension 1.52
    gap = outside - inside;
  }
  EXPECT_LT(gap, .7);
}

TEST(SetPixels, GrowAsTheDimensionSays) {
  struct Known {
    const char* name;
    double dimension;
  };
  for (const auto& [name, dimension] :
       {Known{"gasket", std::log2(3)}, Known{"koch", std::log(4) / std::log(3)},
        Known{"carpet", std::log(8) / std::log(3)}, Known{"cantor_dust", std::log(4) / std::log(3)}}) {
    const auto system = named_system(name);
    const auto met = [&](std::int64_t size) {
      return static_cast<double>(count(set_of(*system, odd(*system, size)), Meets::yes));
    };
    EXPECT_NEAR(std::log2(met(729) / met(81)) / std::log2(9), dimension, .06) << name;
  }
}

TEST(SetPixels, OfAPartAreThoseOfTheWhole) {
  const auto fern = named_system("fern");
  const Window whole{-3, -1, 3, 11, 240, 480};
  const Window part{-3 + 100 * .025, 11 - 340 * .025, -3 + 180 * .025, 11 - 200 * .025, 80, 140};
  const auto all = set_of(*fern, whole), some = set_of(*fern, part);
  std::int64_t differences = 0;
  for (std::size_t row = 0; row < 140; ++row)
    for (std::size_t column = 0; column < 80; ++column) {
      const Meets a = some[row * 80 + column], b = all[(row + 200) * 240 + column + 100];
      EXPECT_FALSE((a == Meets::no && b == Meets::yes) || (a == Meets::yes && b == Meets::no));
      differences += a != b;
    }
  EXPECT_LE(differences, 20) << "what is found first decides some that are nearly undecided";
}

TEST(SetPixels, AreNoneWhereTheWindowMissesTheAttractor) {
  const auto states = set_of(*named_system("fern"), {100, 100, 101, 101, 10, 10});
  EXPECT_EQ(count(states, Meets::no), 100);
}

// Attractors of one point, which is a double exactly, beside windows whose edges are few or many of the last digits
// away.
TEST(SetPixels, NeverMistakeASmallAttractorFarFromTheOrigin) {
  std::mt19937_64 random(7);
  const auto between = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  std::int64_t decided = 0, refused = 0;
  for (int turn = 0; turn < 8000; ++turn) {
    const double x = between(-1, 1) * std::exp2(between(-4, 14)), y = between(-1, 1) * std::exp2(between(-4, 14));
    const double rest = std::exp2(-static_cast<double>(1 + random() % 6));  // (1 - M) c is exact
    const System system(2, {plane(1 - rest, 0, 0, 1 - rest, rest * x, rest * y)});
    const double size = std::exp2(between(-36, 0)), digit = std::nextafter(std::abs(x), 1e9) - std::abs(x);
    const double off = static_cast<double>(static_cast<int>(random() % 9) - 4) * std::exp2(std::floor(between(0, 30)));
    const double left = x + off * digit;
    try {
      const auto states =
          set_of(system, {left, y - size / 2, left + size, y + size / 2, 1, 1}, std::exp2(between(-8, 0)));
      const bool met = x >= left && x < left + size;
      ASSERT_NE(states[0], met ? Meets::no : Meets::yes) << x << " " << y << " " << left << " " << size;
      decided += states[0] != Meets::undecided;
    } catch (const Error& error) {
      ASSERT_EQ(error.status(), Status::range) << error.what();
      ++refused;
    }
  }
  EXPECT_GT(decided, 400);
  EXPECT_GT(refused, 400) << "no window was as fine as the digits";
  EXPECT_LT(refused, 6000);
}

// The stem is the image of all of the fern under a flat map: of its pieces more lie in such a window than can be
// followed.
TEST(SetPixels, AreThoseOfTheFernsStemInAnEnlargementAMillionTimes) {
  const auto fern = named_system("fern");
  constexpr std::int64_t size = 256;
  const auto beside = set_of(*fern, {-4e-6, .5, 6e-6, .50001, size, size});
  const auto between = set_of(*fern, {-5e-6, .5, 5e-6, .50001, size, size});
  for (std::size_t k = 0; k < beside.size(); ++k) {
    const std::size_t column = k % size;
    ASSERT_EQ(beside[k], column == 102 ? Meets::yes : Meets::no) << k;                          // at .4 of 256 pixels
    ASSERT_EQ(between[k], column == 127 || column == 128 ? Meets::undecided : Meets::no) << k;  // on their edge
  }
}

// A window of so many pixels of that size, about a point, out of step with everything.
Window about(const Vector3& point, double pixel, std::int64_t width, std::int64_t height) {
  const double left = point(0) - .47 * pixel * static_cast<double>(width),
               bottom = point(1) - .53 * pixel * static_cast<double>(height);
  return {left,
          bottom,
          left + 1.07 * pixel * static_cast<double>(width),
          bottom + .97 * pixel * static_cast<double>(height),
          width,
          height};
}

// No pixel is met by one and missed by the other; and what the plain search decides, the fast one mostly does.
void expect_agreement(const System& system, const Window& window, const std::string& what, double tolerance = 1. / 16) {
  const auto fast = set_of(system, window, tolerance), plain = plain::set_pixels(system, window, tolerance);
  std::int64_t contradictions = 0;
  for (std::size_t k = 0; k < fast.size(); ++k)
    contradictions +=
        (fast[k] == Meets::no && plain[k] == Meets::yes) || (fast[k] == Meets::yes && plain[k] == Meets::no);
  EXPECT_EQ(contradictions, 0) << what;
  EXPECT_LE(count(fast, Meets::undecided), count(plain, Meets::undecided) + count(plain, Meets::yes) / 20 + 2) << what;
}

// A point of it, by a word of each map in turn.
Vector3 point_of(const System& system) {
  Vector3 x = fixed_point(system.maps()[static_cast<std::size_t>(system.active()[0])]);
  for (int k = 0; k < 40; ++k)
    x = system.maps()[static_cast<std::size_t>(
        system.active()[static_cast<std::size_t>(k * k) % system.active().size()])](x);
  return x;
}

TEST(SetPixels, NeverContradictThePlainSearch) {
  for (const NamedSystem& named : named_systems()) {
    if (named.dimension != 2) continue;
    const auto system = named_system(named.name);
    const std::string name(named.name);
    const double size = system->enclosure().axes.norm();
    const Vector3 point = point_of(*system);
    Window tall = odd(*system, 61);
    tall.height = 97;
    expect_agreement(*system, tall, name + ", whole");
    expect_agreement(*system, about(point, size / 400, 150, 140), name + ", over several tiles");
    expect_agreement(*system, about(point, size / 3e3, 40, 30), name + ", a part");
    expect_agreement(*system, about(point, size / 1e6, 30, 40), name + ", a small part");
    expect_agreement(*system, about(point + Vector3(3 * size, 0, 0), size / 50, 20, 20), name + ", beside it");
  }
}

TEST(SetPixels, NeverContradictThePlainSearchInOddSystems) {
  struct Case {
    const char* name;
    System system;
  };
  const Affine half = plane(.5, 0, 0, .5, 0, 0), turned = plane(.3, -.4, .4, .3, 1, 0);
  for (const auto& [name, system] :
       {Case{"one map", System(2, {plane(.5, .2, -.2, .5, 1, 3)})},
        Case{"one constant map", System(2, {plane(0, 0, 0, 0, 1, 3)})},
        Case{"maps not taken", System(2, {half, turned, plane(.9, 0, 0, .9, 5, 5)}, {1, 2, 0})},
        Case{"all flat", System(2, {plane(.5, .1, 0, 0, 0, 0), plane(0, 0, .3, .4, 1, 1)})},
        Case{"a line", System(2, {plane(.5, 0, 0, .5, 0, 0), plane(.5, 0, 0, .5, 1, 1)})},
        Case{"reflections", System(2, {plane(.6, .1, .1, -.6, 0, 1), plane(-.5, 0, .2, .5, 1, 0), turned})},
        Case{"one that grows by itself", System(2, {plane(0, 1.2, .3, 0, 0, 0), plane(0, .2, -.3, 0, 1, 1)})},
        Case{"slow", System(2, {plane(.95, -.2, .2, .95, 0, 0), plane(.1, 0, 0, .1, 1, 0)})}}) {
    const double size = std::max(system.enclosure().axes.norm(), .1);
    const Vector3 point = point_of(system);
    for (const double pixels : {30., 300., 1e5}) expect_agreement(system, about(point, size / pixels, 37, 33), name);
    const auto states = set_of(system, about(point, size / 300, 37, 33));
    const Grid grid(about(point, size / 300, 37, 33));
    EXPECT_NE(states[static_cast<std::size_t>(grid.pixel(point(0), point(1)))], Meets::no) << name;
  }
}

// Coarse ones are found with floats, fine ones with doubles.
TEST(SetPixels, OfCoarseTolerancesDoNotContradictThoseOfFineOnes) {
  for (const NamedSystem& named : named_systems()) {
    if (named.dimension != 2) continue;
    const auto system = named_system(named.name);
    const double size = system->enclosure().axes.norm();
    for (const Window& window : {odd(*system, 170), about(point_of(*system), size / 1e5, 60, 50)}) {
      const auto coarse = set_of(*system, window, 1. / 16), fine = set_of(*system, window, 1e-4);
      std::int64_t contradictions = 0, found = 0;
      for (std::size_t k = 0; k < fine.size(); ++k) {
        contradictions +=
            (coarse[k] == Meets::no && fine[k] == Meets::yes) || (coarse[k] == Meets::yes && fine[k] == Meets::no);
        found += coarse[k] == Meets::undecided && fine[k] != Meets::undecided;
      }
      EXPECT_EQ(contradictions, 0) << named.name;
      EXPECT_LE(count(fine, Meets::undecided), count(coarse, Meets::undecided) - found + count(fine, Meets::yes) / 1000)
          << named.name;
    }
  }
}

TEST(SetPixels, AreTheSameOnEveryVectorTarget) {
  for (const char* name : {"fern", "gasket_right", "fern_cyclosorus", "levy", "tree_type2"}) {
    const auto system = named_system(name);
    const Window whole = odd(*system, 140),
                 part = about(point_of(*system), system->enclosure().axes.norm() / 1e3, 70, 50);
    const auto best = set_of(*system, whole), best_of_part = set_of(*system, part);
    int targets = 0;
    for (std::int64_t every = hwy::SupportedTargets(), lowest = 0; every != 0; every &= every - 1) {
      lowest = every & -every;
      hwy::SetSupportedTargetsForTest(lowest);
      ++targets;
      EXPECT_EQ(set_of(*system, whole), best) << name << " " << hwy::TargetName(lowest);
      EXPECT_EQ(set_of(*system, part), best_of_part) << name << " " << hwy::TargetName(lowest);
    }
    hwy::SetSupportedTargetsForTest(0);
    EXPECT_GE(targets, 2) << "nothing was compared";
  }
}

// Five maps whose areas add up to more than the attractor's: of its pieces a million and more lie over one another
// here.
TEST(SetPixels, EndWhereMorePiecesLieOverOneAnotherThanCanBeFollowed) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "takes minutes with sanitizers";
#endif
  const System heap(
      2, {plane(0, .5, .5, .5, 1, .75), plane(.125, 0, 0, 1. / 3, 1, .25), plane(1. / 3, 1. / 3, 0, .5, 0, 0),
          plane(.25, 0, 0, .25, .25, .5), plane(0, .25, .5, .25, 1, 1)});
  try {
    set_of(heap, {2.034825336193697, 1.7594180097128711, 2.034826677048942, 1.7594192281081591, 29, 3}, .1);
    ADD_FAILURE() << "was decided";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::limit);
    EXPECT_EQ(error.argument(), "tolerance");
    EXPECT_EQ(error.value(), .1);
  }
}

TEST(SetPixels, RefuseTolerancesByName) {
  const auto fern = named_system("fern");
  for (const double bad : {0.0, -1.0, 1.5, double(NAN), 1e-12}) {
    try {
      set_of(*fern, {-3, -1, 3, 11, 100, 100}, bad);
      ADD_FAILURE() << bad;
    } catch (const Error& error) {
      EXPECT_EQ(error.argument(), "tolerance");
      EXPECT_EQ(error.status(), Status::range);
    }
  }
}

}  // namespace
