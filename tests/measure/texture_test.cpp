#include "measure/texture.h"

#include "support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

std::vector<char> all_known(const Points& places) {
  return std::vector<char>(static_cast<std::size_t>(places.count()), 1);
}

TEST(Texture, IsTheSecondMomentsOfDisplacementsAlongAndAcrossTheirSegments) {
  Random random(1);
  for (const Index dimension : {2, 3, 4}) {
    constexpr int maps = 3;
    constexpr Index segments = 50;
    // Segments in all directions; inner places off by vectors that are told in the segment's frame.
    Points places(dimension, segments * maps + 1);
    const Points corners = random_curve(random, segments + 1, dimension, Kind::walk);
    Matrix along = Matrix::Zero(2, 2), across = Matrix::Zero(2, 2);
    for (Index s = 0; s < segments; ++s) {
      const Eigen::RowVectorXd a = corners.matrix().row(s), way = corners.matrix().row(s + 1) - a, e = way.normalized();
      Matrix off = Matrix::NullaryExpr(2, dimension, [&] { return normal(random); });
      const Eigen::VectorXd forward = off * e.transpose();
      along += forward * forward.transpose();
      across += (off - forward * e) * (off - forward * e).transpose() / static_cast<double>(dimension - 1);
      places.matrix().row(s * maps) = a;
      for (Index i = 1; i < maps; ++i)
        places.matrix().row(s * maps + i) = a + static_cast<double>(i) / maps * way + off.row(i - 1);
    }
    places.matrix().row(segments * maps) = corners.matrix().row(segments);
    const Texture texture = learn(places, all_known(places), maps, 1, 1);
    const double trace = along.trace() + static_cast<double>(dimension - 1) * across.trace();
    EXPECT_LE((texture.along - along / trace).norm(), 1e-12);
    EXPECT_LE((texture.across - across / trace).norm(), 1e-12);
    // One scale alone has no trend: a walk's is taken, and the next finer scale is one step of it.
    EXPECT_DOUBLE_EQ(texture.decay, 1.0 / maps);
    EXPECT_NEAR(texture.next, trace / segments / maps, 1e-12);
  }
}

TEST(Texture, GoesOnAsMidpointsWereDisplaced) {
  // Takagi's hats: at each scale all midpoints are 2^-l / 2 higher, so squares fall by exactly four.
  constexpr int levels = 9;
  Points takagi(1, (Index{1} << levels) + 1);
  for (Index k = 0; k < takagi.count(); ++k)
    for (int l = 0; l < levels; ++l) {
      const double x = std::ldexp(static_cast<double>(k), l - levels);
      takagi.matrix()(k, 0) += std::ldexp(std::abs(x - std::round(x)), -l);
    }
  const Texture texture = learn(takagi, all_known(takagi), 2, levels, 5);
  EXPECT_NEAR(texture.decay, 0.25, 1e-12);
  EXPECT_NEAR(texture.next, std::ldexp(0.25, -2 * levels), 1e-15);
  EXPECT_NEAR(texture.along(0, 0), 1, 1e-12);
}

TEST(Texture, LearnsNothingAtTheFinestScaleFromPlacesThatWereFilledIn) {
  const Points places = points_of({{0, 0}, {1, 1}, {2, 0}, {3, 0}, {4, 0}});
  EXPECT_NEAR(learn(places, {1, 1, 1, 0, 1}, 2, 1, 1).next * 2, 1, 1e-12);  // the first segment alone
  EXPECT_NEAR(learn(places, {1, 1, 1, 1, 1}, 2, 1, 1).next * 2, 0.5, 1e-12);
  EXPECT_EQ(learn(places, {1, 0, 1, 0, 1}, 2, 1, 1).next, 0);
}

TEST(Texture, OfAStraightLineIsNone) {
  Points line(2, 17);
  for (Index k = 0; k < 17; ++k) line.matrix().row(k) << static_cast<double>(k), 0;
  const Texture texture = learn(line, all_known(line), 2, 4, 4);
  EXPECT_EQ(texture.next, 0);
  EXPECT_EQ(texture.along.norm() + texture.across.norm(), 0);
}

}  // namespace
