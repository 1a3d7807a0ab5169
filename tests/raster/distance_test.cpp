#include "raster/distance.h"

#include "base/error.h"
#include "support.h"
#include "system/address.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

constexpr double tolerance = 1. / 8;

std::vector<double> far(const System& system, const Window& window, double tolerance = ::tolerance) {
  Watch watch;
  return distances(system, window, tolerance, watch);
}

double wide(const Window& w) { return (w.right - w.left) / static_cast<double>(w.width); }
double high(const Window& w) { return (w.top - w.bottom) / static_cast<double>(w.height); }

Vector3 middle(const Window& w, std::size_t pixel) {
  const auto columns = static_cast<std::size_t>(w.width);
  return {w.left + (static_cast<double>(pixel % columns) + .5) * wide(w),
          w.top - (static_cast<double>(pixel / columns) + .5) * high(w), 0};
}

// Around the box, as much air again on all sides, in steps that are not the shape's.
Window roomy(const System& system, std::int64_t width, std::int64_t height) {
  const Box box = bounding_box(system, 1e-6 * system.enclosure().axes.norm());
  const Vector3 air = .51371 * (box.high - box.low) + Vector3(.01, .01, 0);
  return {box.low(0) - air(0), box.low(1) - air(1), box.high(0) + air(0), box.high(1) + air(1), width, height};
}

// Points of the attractor, within `apart` of each of which all points of its piece lie; every piece has one.
std::vector<Vector3> points_within(const System& system, double apart) {
  const Vector3 fixed = fixed_point(system.maps()[static_cast<std::size_t>(system.active()[0])]);
  const double across = 2 * stretch(system.enclosure().axes);
  std::vector<Vector3> points;
  std::vector<Affine> open{Affine::identity(2)};
  while (!open.empty()) {
    const Affine piece = open.back();
    open.pop_back();
    if (stretch(piece.linear) * across <= apart) {
      points.push_back(piece(fixed));
      continue;
    }
    for (const int i : system.active()) open.push_back(piece * system.maps()[static_cast<std::size_t>(i)]);
  }
  return points;
}

double least(const std::vector<Vector3>& points, const Vector3& from) {
  double square = std::numeric_limits<double>::infinity();
  for (const Vector3& x : points) square = std::min(square, (x - from).squaredNorm());
  return std::sqrt(square);
}

// Above the distance by at most the tolerance, and not below: the nearest of many points is above it by at most `share`
// of the window's size.
void expect_brute_force(const System& system, const Window& window, double share, const std::string& name) {
  const double size = system.enclosure().axes.norm(), apart = share * size;
  const auto points = points_within(system, apart);
  const auto found = far(system, window);
  const double slack = tolerance * std::max(wide(window), high(window)), rounding = 256 * epsilon * size;
  ASSERT_EQ(found.size(), static_cast<std::size_t>(window.pixels()));
  for (std::size_t p = 0; p < found.size(); ++p) {
    const double brute = least(points, middle(window, p));
    ASSERT_LE(found[p], brute + slack + rounding) << name << " " << p;
    ASSERT_GE(found[p], brute - apart - rounding) << name << " " << p;
  }
}

TEST(Distances, AreThoseOfComparingWithManyPoints) {
  for (const char* name : {"gasket", "koch", "carpet", "twin_dragon", "cantor_dust", "heighway_dragon", "levy"})
    expect_brute_force(*named_system(name), roomy(*named_system(name), 21, 17), .02, name);
  expect_brute_force(*named_system("fern"), roomy(*named_system("fern"), 13, 22), .01, "fern");
  expect_brute_force(*named_system("fern"), {-.3, 4, 1.2, 5, 20, 9}, .005, "part of the fern");
}

TEST(Distances, OfRandomSystemsAreThoseOfComparingWithManyPoints) {
  Random random(3);
  for (int k = 0; k < 20; ++k) {
    const System system = random_system(random, 2, .55);
    expect_brute_force(system, roomy(system, uniform(random, 1, 30), uniform(random, 1, 30)), .02,
                       "random " + std::to_string(k));
  }
}

// By another way, and sharply: there is a point as near as that, and none that is nearer by more than the tolerance.
TEST(Distances, AreProvenByAddresses) {
  for (const char* name : {"fern", "koch", "twin_dragon"}) {
    const auto system = named_system(name);
    const Window window = roomy(*system, 12, 14);
    const double size = system->enclosure().axes.norm();
    for (const double within : {1. / 8, 1e-3}) {
      const auto found = far(*system, window, within);
      const double slack = within * std::max(wide(window), high(window));
      for (std::size_t p = 0; p < found.size(); ++p) {
        const auto any_within = [&](double distance) {
          return !addresses_of(*system, middle(window, p), 1, distance, 1000).empty();
        };
        EXPECT_TRUE(any_within(found[p] + 1e-9 * size)) << name << " " << p;
        // `addresses_of` may tell words twice as far away as it was asked for.
        if (found[p] > 2 * slack) {
          EXPECT_FALSE(any_within((found[p] - slack) / 2.001)) << name << " " << p;
        }
      }
    }
  }
}

// Of Cantor's set in [0, 1]: by its own similarity.
double from_cantor(double x) {
  if (x <= 0) return -x;
  if (x >= 1) return x - 1;
  if (x > 1. / 3 && x < 2. / 3) return std::min(x - 1. / 3, 2. / 3 - x);
  double scale = 1;
  for (int k = 0; k < 40; ++k) {
    x = x < .5 ? 3 * x : 3 * x - 2;
    scale /= 3;
    if (x <= 0) return -x * scale;
    if (x >= 1) return (x - 1) * scale;
    if (x > 1. / 3 && x < 2. / 3) return scale * std::min(x - 1. / 3, 2. / 3 - x);
  }
  return 0;
}

TEST(Distances, FromCantorsSetOnALineAreExact) {
  // Flat maps, and maps that shrink across the line as well: the same set.
  for (const double across : {0.0, .3})
    for (const Window& window :
         {Window{-.713, -.4, 1.7, .9, 61, 23}, Window{.2, -.01, .4, .013, 70, 5}, Window{-5, 1, 5, 20, 13, 40}}) {
      const System cantor(2, {plane(1. / 3, 0, 0, across, 0, 0), plane(1. / 3, 0, 0, across, 2. / 3, 0)});
      for (const double within : {1.0, 1. / 8, 1e-6}) {
        const auto found = far(cantor, window, within);
        const double slack = within * std::max(wide(window), high(window));
        for (std::size_t p = 0; p < found.size(); ++p) {
          const Vector3 from = middle(window, p);
          const double exact = std::hypot(from_cantor(from(0)), from(1));
          ASSERT_GE(found[p], exact - 1e-13) << p;
          ASSERT_LE(found[p], exact + slack + 1e-13) << p;
        }
      }
    }
}

TEST(Distances, FromAPointAndFromASquareAreExact) {
  const Window window{-2, -3, 4, 5, 30, 17};
  for (const System& point : {System(2, {plane(.5, .1, -.2, .4, .5, 1)}), System(2, {plane(0, 0, 0, 0, 1, 2)})}) {
    const Vector3 place = fixed_point(point.maps()[0]);
    const auto found = far(point, window, 1e-6);
    for (std::size_t p = 0; p < found.size(); ++p)
      EXPECT_NEAR(found[p], (middle(window, p) - place).norm(), 1e-6 * high(window)) << p;
  }
  std::vector<Affine> quarters;
  for (const double e : {0.0, .5})
    for (const double f : {0.0, .5}) quarters.push_back(plane(.5, 0, 0, .5, e, f));
  const auto found = far(System(2, quarters), window, 1e-2);
  for (std::size_t p = 0; p < found.size(); ++p) {
    const Vector3 x = middle(window, p);
    const double exact = std::hypot(std::max({-x(0), x(0) - 1, 0.0}), std::max({-x(1), x(1) - 1, 0.0}));
    EXPECT_GE(found[p], exact - 1e-14) << p;
    EXPECT_LE(found[p], exact + 1e-2 * high(window)) << p;
  }
}

// Also of probability 0 maps, whose pieces are not there.
TEST(Distances, DoNotSeeMapsThatTakeNoPart) {
  const std::vector<Affine> maps = {plane(.5, 0, 0, .5, 0, 0), plane(.5, 0, 0, .5, 9, 9), plane(.5, 0, 0, .5, .5, .2)};
  const System dummy(2, maps, {1, 0, 1}), without(2, {maps[0], maps[2]}, {1, 1});
  const Window window = roomy(without, 20, 20);
  EXPECT_EQ(far(dummy, window), far(without, window));
}

TEST(Distances, ChangeByNoMoreThanOnesSteps) {
  for (const char* name : {"fern", "gasket"}) {
    const auto system = named_system(name);
    const Window window = roomy(*system, 70, 40);
    const auto found = far(*system, window);
    const double slack = tolerance * std::max(wide(window), high(window)) * (1 + 1e-9);
    for (std::size_t p = 0; p < found.size(); ++p) {
      if (p % 70 != 0) {
        EXPECT_LE(std::abs(found[p] - found[p - 1]), wide(window) + slack) << p;
      }
      if (p >= 70) {
        EXPECT_LE(std::abs(found[p] - found[p - 70]), high(window) + slack) << p;
      }
    }
  }
}

TEST(Distances, OfAPartAreThoseOfTheWholeWithinTheTolerance) {
  const auto fern = named_system("fern");
  const auto all = far(*fern, {-3, -1, 3, 11, 60, 120}), some = far(*fern, {-1.5, 3, 0, 8, 15, 50});
  for (std::size_t row = 0; row < 50; ++row)
    for (std::size_t column = 0; column < 15; ++column)
      EXPECT_NEAR(some[row * 15 + column], all[(row + 30) * 60 + column + 15], tolerance * .1 * (1 + 1e-9));
}

TEST(Distances, FarAwayAreThoseOfItsBox) {
  const auto gasket = named_system("gasket");
  constexpr double apart = 1e-2;
  const auto points = points_within(*gasket, apart);
  for (const Window& window : {Window{1e4, -3e4, 1e4 + 10, -3e4 + 5, 10, 10}, Window{-1e9, -1e9, 1e9, 1e9, 9, 7},
                               Window{1e9, 1e9, 1e9 + 16, 1e9 + 16, 16, 16}, Window{1e12, 0, 1e12 + 1024, 512, 4, 4}}) {
    const auto found = far(*gasket, window);
    const double pixel = std::max(wide(window), high(window));
    for (std::size_t p = 0; p < found.size(); ++p) {
      const double brute = least(points, middle(window, p));
      EXPECT_LE(found[p], brute + tolerance * pixel + 16 * epsilon * brute) << window.left << " " << p;
      EXPECT_GE(found[p], brute - apart - 16 * epsilon * brute) << window.left << " " << p;
    }
  }
}

// So far away that rounding may pass an eighth of a pixel, or a pixel, which no tolerance helps.
TEST(Distances, AreRefusedWhereTheWindowIsSoFarAwayThatRoundingPassesTheTolerance) {
  const auto gasket = named_system("gasket");
  for (const double place : {1e13, 1e15})
    for (const Window& window : {Window{place, 0, place + 16, 16, 16, 16}, Window{0, -place - 16, 16, -place, 16, 16}})
      EXPECT_EQ(refusal([&] { far(*gasket, window); }).argument(), place < 1e14 ? "tolerance" : "window") << place;
}

TEST(Distances, RefuseTolerancesByName) {
  const auto fern = named_system("fern");
  for (const double bad : {0.0, -1.0, 1.5, double(NAN), 1e-15}) {
    const Error error = refusal([&] { far(*fern, {-3, -1, 3, 11, 100, 100}, bad); });
    EXPECT_EQ(error.argument(), "tolerance") << bad;
    EXPECT_EQ(error.status(), Status::range) << bad;
  }
  EXPECT_EQ(refusal([] { far(*named_system("sponge"), {0, 0, 1, 1, 2, 2}); }).status(), Status::shape);
  EXPECT_EQ(refusal([] { far(System(2, {plane(2, 0, 0, 2, 0, 0)}), {0, 0, 1, 1, 2, 2}); }).argument(), "system");
  EXPECT_EQ(refusal([&] { far(*fern, {0, 0, 1, -1, 2, 2}); }).argument(), "window");
}

// Its words of a thousand letters are as large as nine tenths of it.
System slowly_turning() {
  const double c = .9999 * std::cos(.1), s = .9999 * std::sin(.1);
  Affine turning, half;
  turning.linear.topLeftCorner<2, 2>() << c, -s, s, c;
  turning.shift(0) = 1;
  half.linear.topLeftCorner<2, 2>() << .5, 0, 0, .5;
  return {2, {turning, half}};
}

TEST(Distances, AreCancelledWithinABlock) {
  const System slow = slowly_turning();
  const double size = slow.enclosure().axes.norm();
  int asked = 0;
  Watch watch(nullptr, [&](double, const char*) { return ++asked > 1; });
  EXPECT_THROW(distances(slow, {-size, -size, size, size, 512, 512}, 1. / 8, watch), Cancelled);
}

// A turn that hardly shrinks: neither the stack nor the caller's patience is endless.
TEST(Distances, EndWhenWordsBecomeTooLong) {
  const System slow = slowly_turning();
  const double side = slow.enclosure().axes.norm() / 1000;
  const Vector3 middle = slow.enclosure().centre;
  const Window window{middle(0) - side, middle(1) - side, middle(0) + side, middle(1) + side, 4, 4};
  Watch watch;
  const Error error = refusal([&] { distances(slow, window, 1. / 64, watch); });
  EXPECT_EQ(error.status(), Status::limit);
  EXPECT_EQ(error.argument(), "tolerance");
}

}  // namespace
