#include "raster/view.h"

#include <Eigen/Geometry>
#include <numbers>

#include "support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

const Ball ball{{1, -2, 3}, 2.5};

Vector3 at(const View::Seen& seen) { return {seen.x, seen.y, seen.nearness}; }

// Where the eye is.
Vector3 toward(const Direction& d) {
  return {std::cos(d.elevation) * std::cos(d.azimuth), std::cos(d.elevation) * std::sin(d.azimuth),
          std::sin(d.elevation)};
}

std::vector<Direction> directions(double field) {
  std::vector<Direction> all;
  for (const double azimuth : {0.0, .7, 2.0, -3.0})
    for (const double elevation : {0.0, .4, -1.2, std::numbers::pi / 2}) all.push_back({azimuth, elevation, field});
  return all;
}

Vector3 on_ball(Random& random) {
  return ball.centre + ball.radius * Vector3(random_matrix(random, 3, 1)).normalized();
}

TEST(View, IsRightUpAndTowardsTheEye) {
  // From the x axis, y is to the right and z is up; from above, with azimuth 0, the x axis points down.
  const View side({0, 0, 0}, {Vector3::Zero(), 1});
  EXPECT_EQ(at(side(0, 1, 0)), Vector3(1, 0, .5));
  EXPECT_EQ(at(side(0, 0, 1)), Vector3(0, 1, .5));
  EXPECT_EQ(at(side(1, 0, 0)), Vector3(0, 0, 1));
  const View above({0, std::numbers::pi / 2, 0}, {Vector3::Zero(), 1});
  EXPECT_LE((at(above(1, 0, 0)) - Vector3(0, -1, .5)).norm(), 4 * epsilon);
  EXPECT_LE((at(above(0, 1, 0)) - Vector3(1, 0, .5)).norm(), 4 * epsilon);
}

TEST(View, FromFarAwayTurnsSpaceAndNothingElse) {
  Random random(1);
  for (const Direction& direction : directions(0)) {
    const View view(direction, ball);
    for (int k = 0; k < 20; ++k) {
      const Vector3 a = on_ball(random), b = on_ball(random);
      // Nearness runs over the ball's diameter; with it, lengths and angles are those of space.
      const auto turned = [&](const Vector3& x) -> Vector3 {
        const Vector3 seen = at(view(x(0), x(1), x(2)));
        return {seen(0), seen(1), 2 * ball.radius * seen(2) - ball.radius};
      };
      EXPECT_NEAR((turned(a) - turned(b)).norm(), (a - b).norm(), 32 * epsilon * ball.radius);
      EXPECT_NEAR(turned(a).dot(turned(b)), (a - ball.centre).dot(b - ball.centre), 64 * epsilon * 6.25);
      EXPECT_TRUE(view(a(0), a(1), a(2)).visible);
    }
    EXPECT_LE(at(view(ball.centre(0), ball.centre(1), ball.centre(2))).head<2>().norm(), 8 * epsilon);
    // Not mirrored: right, up and toward the eye are turned like x, y and z.
    const auto far = view(ball.centre(0), ball.centre(1), ball.centre(2) + 1);
    if (std::abs(direction.elevation) < 1.5) {
      EXPECT_GT(far.y, 0) << direction.elevation;
    }
    EXPECT_NEAR(far.x, 0, 8 * epsilon);
    EXPECT_EQ(view.reach(), ball.radius);
  }
}

// Points where rays of the eye touch the ball lie on a circle; it is seen as the circle of radius `reach`.
TEST(View, FromAnEyeFillsItsFieldWithTheBall) {
  Random random(2);
  for (const double field : {.3, 1.0, 2.0, 3.0})
    for (const Direction& direction : directions(field)) {
      const View view(direction, ball);
      // tan(field/2) at the eye's distance r / sin(field/2).
      EXPECT_NEAR(view.reach(), ball.radius / std::sin(field / 2) * std::tan(field / 2), 8 * epsilon * view.reach());
      const Vector3 eye = toward(direction);
      double most = 0;
      for (int k = 0; k < 200; ++k) {
        const Vector3 x = on_ball(random);
        const auto seen = view(x(0), x(1), x(2));
        EXPECT_TRUE(seen.visible);
        most = std::max(most, std::hypot(seen.x, seen.y));
        // Where the ray meets the circle of contact.
        const Vector3 aside = eye.cross(x - ball.centre).normalized();
        const Vector3 touch = ball.centre + ball.radius * (std::sin(field / 2) * eye + std::cos(field / 2) * aside);
        const auto edge = view(touch(0), touch(1), touch(2));
        EXPECT_NEAR(std::hypot(edge.x, edge.y), view.reach(), 64 * epsilon * view.reach() / std::cos(field / 2));
      }
      EXPECT_LE(most, view.reach() * (1 + 64 * epsilon / std::cos(field / 2)));
    }
}

TEST(View, FromAnEyeMakesNearThingsLarger) {
  const Direction direction{.7, .4, 1};
  const View view(direction, ball);
  const Vector3 eye = toward(direction), right(-std::sin(.7), std::cos(.7), 0);
  double before = 0, nearness = -1;
  for (const double depth : {-2.0, -1.0, 0.0, 1.0, 2.0}) {
    const Vector3 x = ball.centre + depth * eye + right;
    const auto seen = view(x(0), x(1), x(2));
    EXPECT_GT(seen.x, before);
    EXPECT_GT(seen.nearness, nearness);
    EXPECT_NEAR(seen.nearness, (depth + 2.5) / 5, 8 * epsilon);
    if (depth == 0) {
      EXPECT_NEAR(seen.x, 1, 8 * epsilon);
    }
    before = seen.x, nearness = seen.nearness;
  }
  // The eye is 2.5 / sin(1/2) away: it does not see what is behind it.
  const double away = 2.5 / std::sin(.5);
  const Vector3 before_eye = ball.centre + .999 * away * eye, behind = ball.centre + 1.001 * away * eye;
  EXPECT_TRUE(view(before_eye(0), before_eye(1), before_eye(2)).visible);
  EXPECT_FALSE(view(behind(0), behind(1), behind(2)).visible);
}

TEST(View, OfASinglePointIsFinite) {
  const View view({.1, .2, 1}, {{1, 2, 3}, 0});
  const auto seen = view(1, 2, 3);
  EXPECT_EQ(seen.x, 0);
  EXPECT_EQ(seen.y, 0);
  EXPECT_EQ(seen.nearness, .5);
  EXPECT_TRUE(seen.visible);
}

TEST(WindowAround, KeepsSquaresAndAMarginAndTheMiddle) {
  struct Case {
    Box box;
    std::int64_t width, height;
  };
  for (const Case& c : {Case{{{0, 0, 0}, {1, 1, 0}}, 100, 100}, Case{{{-3, 1, 0}, {5, 2, 0}}, 64, 64},
                        Case{{{-3, 1, 0}, {5, 2, 0}}, 300, 20}, Case{{{0, -7, 0}, {.1, 9, 0}}, 1000, 3},
                        Case{{{1e6, 1e6, 0}, {1e6 + 1, 1e6 + 2, 0}}, 40, 30}}) {
    const Window window = window_around(c.box, c.width, c.height);
    EXPECT_EQ(window.width, c.width);
    EXPECT_EQ(window.height, c.height);
    const double wide = window.right - window.left, high = window.top - window.bottom;
    const double size = std::max(std::abs(window.right), std::abs(window.top)) + wide + high;
    const double pixel = wide / static_cast<double>(c.width);
    EXPECT_NEAR(pixel, high / static_cast<double>(c.height), 8 * epsilon * size);
    EXPECT_NEAR(window.left + window.right, c.box.low(0) + c.box.high(0), 8 * epsilon * size);
    EXPECT_NEAR(window.bottom + window.top, c.box.low(1) + c.box.high(1), 8 * epsilon * size);
    // 4 in a hundred more than the side that is the tighter one.
    const double tight = std::max((c.box.high(0) - c.box.low(0)) / wide, (c.box.high(1) - c.box.low(1)) / high);
    EXPECT_NEAR(tight, 1 / 1.04, 16 * epsilon * size / std::min(wide, high));
    EXPECT_NO_THROW(require_window(window));
  }
}

TEST(WindowAround, APointOrALineIsOneThatCanBeDrawn) {
  const Window point = window_around({{3, 4, 0}, {3, 4, 0}}, 50, 25);
  EXPECT_EQ(point.left, 2.5);
  EXPECT_EQ(point.right, 3.5);
  EXPECT_EQ(point.bottom, 3.75);
  EXPECT_EQ(point.top, 4.25);
  const Window line = window_around({{0, 4, 0}, {1, 4, 0}}, 50, 50);
  EXPECT_DOUBLE_EQ(line.top - line.bottom, 1.04);
  EXPECT_NO_THROW(require_window(window_around({{1e9, 0, 0}, {1e9 + 1e-9, 1e-9, 0}}, 1000, 1000)));
}

}  // namespace
