#include "measure/curvature.h"

#include "support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

double at(const Polyline& polyline, double parameter, double scale) {
  return curvature(polyline, {&parameter, 1}, scale)[0];
}

// What the definition makes of a circle: projections of sine and cosine on Legendre's polynomials.
double seen_of_circle(double radius, double scale) {
  const double w = scale / radius;
  const double j1 = std::sin(w) / (w * w) - std::cos(w) / w;
  const double j2 = (3 / (w * w * w) - 1 / w) * std::sin(w) - 3 * std::cos(w) / (w * w);
  return 5.0 / 3 * j2 / (j1 * j1) / radius;
}

TEST(Curvature, OfACircleIsOneOverItsRadiusAsTheWindowShrinksAndTheClosedFormBeforeThat) {
  constexpr Index n = 20000;
  for (const double radius : {0.01, 1.0, 250.0})
    for (const double of_radius : {0.05, 0.3, 1.0, 2.0}) {
      const Polyline ring(circle(n, radius), true);
      for (const double t : {0.0, 0.123, 0.5, 0.99999, 7.3}) {
        const double found = at(ring, t, of_radius * radius);
        // The ring's corners, 2 pi / n apart, are told from the circle by (2 pi / n)² of what the window sees.
        const double corners = std::pow(2 * M_PI / n / of_radius, 2);
        EXPECT_NEAR(found * radius, seen_of_circle(1, of_radius), 4 * corners + 1e-9);
        EXPECT_NEAR(found * radius, 1, 0.2 * of_radius * of_radius + 4 * corners);
      }
    }
}

TEST(Curvature, HasASignInThePlaneLeftPositive) {
  Points turned = circle(1000, 2);
  turned.matrix().col(1) *= -1;  // clockwise
  EXPECT_NEAR(at(Polyline(turned, true), 0.3, 0.1), -0.5, 1e-3);
  EXPECT_NEAR(at(Polyline(circle(1000, 2), true), 0.3, 0.1), 0.5, 1e-3);
}

TEST(Curvature, OfALineIsZeroAtTheEndsAsWell) {
  Random random(1);
  for (const Index dimension : {2, 3, 4}) {
    const Points points = random_curve(random, 50, dimension, Kind::collinear);
    Points line = points;
    std::ranges::sort(line.plane(0));  // without turning back
    for (Index axis = 1; axis < dimension; ++axis) line.matrix().col(axis) = 0.3 * line.matrix().col(0);
    const Polyline polyline(line, false);
    const double scale = diagonal(line) / 5;
    for (const double t : {0.0, 0.01, 0.4, 1.0})
      // In units of the window: sums of a few hundred roundings.
      EXPECT_NEAR(at(polyline, t, scale) * scale, 0, 1000 * epsilon) << "at " << t;
  }
}

TEST(Curvature, OfAnEllipseIsTheFormulas) {
  constexpr Index n = 200000;
  constexpr double a = 3, b = 1, scale = 0.02;
  Points ellipse = circle(n, 1);
  ellipse.matrix().col(0) *= a;
  ellipse.matrix().col(1) *= b;
  const Polyline ring(ellipse, true);
  for (const Index k : {0, 1000, 12345, 50000, 77777}) {
    const double angle = 2 * M_PI * static_cast<double>(k) / n;
    const double wanted = a * b / std::pow(std::pow(a * std::sin(angle), 2) + std::pow(b * std::cos(angle), 2), 1.5);
    // The window sees the curvature's own second derivative, at most 100 here, times scale²; and the corners.
    EXPECT_NEAR(at(ring, ring.parameter(k, 0), scale), wanted, 100 * scale * scale * wanted);
  }
}

TEST(Curvature, OfAHelixInSpaceAndOfATiltedCircleInFourDimensionsHaveNoSign) {
  Points helix(3, 40001);
  for (Index k = 0; k < helix.count(); ++k) {
    const double t = 20 * static_cast<double>(k) / 40000;
    helix.matrix().row(k) << 2 * std::cos(t), -2 * std::sin(t), 0.5 * t;
  }
  EXPECT_NEAR(at(Polyline(helix, false), 0.5, 0.05), 2 / (4 + 0.25), 1e-3);
  EXPECT_NEAR(at(Polyline(helix, false), 0.0, 0.05), 2 / (4 + 0.25), 1e-2);  // one-sided: first order in the scale
  Points tilted(4, 10000);
  tilted.matrix().leftCols(2) = circle(10000, 1).matrix() * 0.6;
  tilted.matrix().rightCols(2) = circle(10000, 1).matrix() * 0.8;
  EXPECT_NEAR(at(Polyline(tilted, true), 0.2, 0.05), 1, 1e-3);
}

TEST(Curvature, ScalesWithTheCurveAndTurnsWithIt) {
  Random random(2);
  const Points curve = random_curve(random, 200, 2, Kind::walk);
  const double scale = 5, t = 0.37;
  const double seen = at(Polyline(curve, false), t, scale);
  for (const double size : {1e-100, 0.125, 3e7}) {
    Points other = curve;
    other.matrix() *= size;
    EXPECT_NEAR(at(Polyline(other, false), t, scale * size) * size, seen, 1e-10 * std::abs(seen));
  }
  Points back = curve;
  back.matrix() = curve.matrix().colwise().reverse().eval();
  EXPECT_NEAR(at(Polyline(back, false), 1 - t, scale), -seen, 1e-9 * std::abs(seen));
}

TEST(Curvature, DoesNotDependOnHowDenselyAStraightPieceIsSampled) {
  const Points corner = points_of({{0, 0}, {1, 0}, {1, 1}});
  const Points same = points_of({{0, 0}, {0.1, 0}, {0.2, 0}, {0.7, 0}, {1, 0}, {1, 0}, {1, 1}});
  EXPECT_NEAR(at(Polyline(corner, false), 0.5, 0.6), at(Polyline(same, false), 4.0 / 6, 0.6), 100 * epsilon);
}

TEST(Curvature, IsRefusedWhereItMeansNothing) {
  const Polyline ring(circle(100, 1), true);
  for (const double scale : {0.0, -1.0, 4.0}) {
    const Error error = refusal([&] { at(ring, 0, scale); });
    EXPECT_EQ(error.status(), Status::range);
    EXPECT_EQ(error.argument(), "scale");
  }
  EXPECT_EQ(refusal([&] { at(ring, 0, std::nan("")); }).status(), Status::not_finite);
  EXPECT_EQ(refusal([&] { at(Polyline(points_of({{1}, {2}}), false), 0, 1); }).status(), Status::shape);
  // There and back: seen as a whole it goes nowhere.
  const Polyline back(points_of({{0, 0}, {1, 0}, {0, 0}}), false);
  const double parameters[] = {0.1, 0.5};
  const Error error = refusal([&] { curvature(back, parameters, 1); });
  EXPECT_EQ(error.status(), Status::numerical);
  EXPECT_EQ(error.index(), 1);
  EXPECT_EQ(refusal([&] { at(Polyline(points_of({{1, 1}}), false), 0, 1); }).status(), Status::numerical);
}

}  // namespace
