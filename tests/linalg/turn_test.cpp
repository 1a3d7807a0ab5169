#include "linalg/turn.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <cmath>

#include "linalg/spectrum.h"
#include "support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// A point a row: p ↦ scale · rotation · p + shift.
MatrixXd moved(const MatrixXd& polygon, double scale, const MatrixXd& rotation, const VectorXd& shift) {
  return (scale * polygon * rotation.transpose()).rowwise() + shift.transpose();
}

double squared_distance(const MatrixXd& q, const MatrixXd& from, const MatrixXd& to) {
  const MatrixXd a = from.rowwise() - from.colwise().mean(), b = to.rowwise() - to.colwise().mean();
  return (a * q.transpose() - b).squaredNorm();
}

void expect_rotation(const MatrixXd& q, const std::string& what) {
  ASSERT_TRUE(q.allFinite()) << what;
  const double off = (q.transpose() * q - MatrixXd::Identity(q.rows(), q.cols())).norm();
  EXPECT_LE(off, 64 * epsilon) << what;  // an SVD of 4 × 4 and two products
  EXPECT_NEAR(determinant(q), 1.0, 64 * epsilon) << what;
}

MatrixXd axis_turn(Eigen::Index d, double angle, Eigen::Index i, Eigen::Index j) {
  MatrixXd q = MatrixXd::Identity(d, d);
  q(i, i) = q(j, j) = std::cos(angle);
  q(j, i) = std::sin(angle);
  q(i, j) = -q(j, i);
  return q;
}

TEST(LeastRotation, IsTheIdentityBitForBitWhenThePolygonStays) {
  Random random(1);
  for (Eigen::Index d = 1; d <= 4; ++d)
    for (Eigen::Index n = 1; n <= 16; ++n) {
      MatrixXd polygon = random_matrix(random, n, d);
      if (n % 3 == 0) polygon.rightCols(d - 1).setZero();
      if (n % 5 == 0) polygon.rowwise() = polygon.row(0).eval();
      EXPECT_EQ(MatrixXd(least_rotation(polygon, polygon)), MatrixXd::Identity(d, d)) << d << " " << n;
      EXPECT_EQ(MatrixXd(turn(polygon, polygon)), MatrixXd::Identity(d, d)) << d << " " << n;
    }
}

TEST(Turn, OfTheLinearKindIsTheMapWherePointsSpanAndTheSimilarityElsewhere) {
  Random random(21);
  for (Eigen::Index d = 1; d <= 4; ++d) {
    const MatrixXd polygon = random_matrix(random, 7, d), map = random_matrix(random, d, d);
    const MatrixXd to = (polygon * map.transpose()).rowwise() + random_matrix(random, 1, d).row(0);
    EXPECT_LE((MatrixXd(turn(polygon, to, Turning::linear)) - map).norm(), 1e-12 * (1 + map.norm()));  // cond < 100
    EXPECT_EQ(MatrixXd(turn(polygon, to, Turning::rotation)), MatrixXd(least_rotation(polygon, to)));
    EXPECT_EQ(MatrixXd(turn(polygon, to, Turning::similarity)), MatrixXd(turn(polygon, to)));
    MatrixXd flat = polygon;
    flat.rightCols(d - 1).setZero();  // along the first axis, and three times as long
    EXPECT_LE((MatrixXd(turn(flat, 3 * flat, Turning::linear)) - 3 * MatrixXd::Identity(d, d)).norm(), 1e-13);
    EXPECT_EQ(MatrixXd(turn(flat, flat, Turning::linear)), MatrixXd::Identity(d, d));
  }
}

TEST(LeastRotation, IsUmeyamasWherePointsDetermineIt) {
  Random random(2);
  std::uniform_real_distribution<double> noise(0, 0.3);
  for (Eigen::Index d = 2; d <= 4; ++d)
    for (int trial = 0; trial < 200; ++trial) {
      const Eigen::Index n = d + 1 + trial % 8;
      const MatrixXd from = random_matrix(random, n, d);
      const MatrixXd to = moved(from, 2.0, random_rotation(random, d), random_matrix(random, d, 1)) +
                          noise(random) * random_matrix(random, n, d);
      const MatrixXd umeyama = Eigen::umeyama(MatrixXd(from.transpose()), MatrixXd(to.transpose()), false);
      const MatrixXd q = least_rotation(from, to);
      expect_rotation(q, "random polygon");
      EXPECT_LE(std::abs(squared_distance(q, from, to) - squared_distance(umeyama.topLeftCorner(d, d), from, to)),
                1e-12 * to.squaredNorm());
      EXPECT_LE((q - umeyama.topLeftCorner(d, d)).norm(), 1e-10) << d << " " << n;  // eps over the gap of σ's
    }
}

TEST(Turn, FindsASimilarityExactly) {
  Random random(3);
  for (Eigen::Index d = 1; d <= 4; ++d)
    for (const double scale : {1e-6, 0.5, 1.0, 3e7}) {
      const MatrixXd from = random_matrix(random, d + 3, d);
      const MatrixXd q = random_rotation(random, d);
      const MatrixXd found = turn(from, moved(from, scale, q, scale * random_matrix(random, d, 1)));
      // Rounding of a handful of points, over the least spread that a random polygon has.
      EXPECT_LE((found - scale * q).norm(), 1e-12 * scale) << d << " " << scale;
    }
}

TEST(LeastRotation, IsEquivariantUnderRotationsAndShifts) {
  Random random(4);
  for (Eigen::Index d = 2; d <= 4; ++d)
    for (int trial = 0; trial < 100; ++trial) {
      const MatrixXd from = random_matrix(random, 6, d), to = from + 0.2 * random_matrix(random, 6, d);
      const MatrixXd r = random_rotation(random, d);
      const VectorXd shift = random_matrix(random, d, 1);
      const MatrixXd q = least_rotation(from, to);
      const MatrixXd turned = least_rotation(moved(from, 3, r, shift), moved(to, 3, r, shift));
      EXPECT_LE((turned - r * q * r.transpose()).norm(), 1e-12);
    }
}

TEST(LeastRotation, OfCoincidentPointsIsTheIdentityWhateverRoundingTheirMeanHas) {
  Random random(5);
  for (Eigen::Index d = 1; d <= 4; ++d)
    for (Eigen::Index n = 1; n <= 16; ++n) {
      MatrixXd point(n, d), other(n, d);
      point.rowwise() = random_matrix(random, 1, d).row(0).eval();
      other.rowwise() = random_matrix(random, 1, d).row(0).eval();
      const MatrixXd spread = random_matrix(random, n, d);
      for (const auto& [from, to] : {std::pair{point, other}, {point, spread}, {spread, point}}) {
        EXPECT_EQ(MatrixXd(least_rotation(from, to)), MatrixXd::Identity(d, d)) << d << " " << n;
        EXPECT_EQ(MatrixXd(turn(from, to)), MatrixXd::Identity(d, d)) << d << " " << n;
      }
      EXPECT_EQ(polygon_size(point), 0.0);
    }
}

// The rotation of least angle that takes one direction to another: in their plane, nothing outside it.
MatrixXd from_direction_to_direction(const VectorXd& from, const VectorXd& to) {
  const VectorXd a = from.normalized(), b = to.normalized();
  const double c = a.dot(b);
  const auto d = a.size();
  const MatrixXd k = b * a.transpose() - a * b.transpose();
  return MatrixXd::Identity(d, d) + k + k * k / (1 + c);
}

TEST(LeastRotation, OfCollinearPointsTurnsInThePlaneOfBothLinesOnly) {
  Random random(6);
  for (Eigen::Index d = 2; d <= 4; ++d)
    for (int trial = 0; trial < 200; ++trial) {
      const Eigen::Index n = 2 + trial % 8;
      const VectorXd a = random_matrix(random, d, 1), b = random_matrix(random, d, 1);
      if (a.normalized().dot(b.normalized()) < -0.95) continue;  // the closed form's own condition
      VectorXd along = random_matrix(random, n, 1);
      const VectorXd shift = random_matrix(random, d, 1);
      const MatrixXd from = along * a.transpose(), to = (along * b.transpose()).rowwise() + shift.transpose();
      const MatrixXd q = least_rotation(from, to);
      expect_rotation(q, "collinear");
      // Coordinates of size 1 are rounded; directions are known to eps times size / spread.
      EXPECT_LE((q - from_direction_to_direction(a, b)).norm(), 1e-12) << d << " " << n;
    }
}

TEST(LeastRotation, OfCollinearPointsFarFromTheOriginStillTurnsTheLineOnly) {
  Random random(7);
  for (Eigen::Index d = 3; d <= 4; ++d)
    for (const double far : {1.0, 1e3, 1e6})
      for (int trial = 0; trial < 50; ++trial) {
        const VectorXd a = random_matrix(random, d, 1), b = a + random_matrix(random, d, 1) * 0.5;
        const VectorXd along = VectorXd::LinSpaced(5, 0, 1);
        const VectorXd shift = far * random_matrix(random, d, 1);
        const MatrixXd from = (along * a.transpose()).rowwise() + shift.transpose();
        const MatrixXd to = (along * b.transpose()).rowwise() + shift.transpose();
        const MatrixXd q = least_rotation(from, to);
        expect_rotation(q, "far");
        // Coordinates of size `far` carry eps · far of rounding each; 50: points, sums, and directions shorter than 1.
        EXPECT_LE((q - from_direction_to_direction(a, b)).norm(), 50 * epsilon * (1 + 3 * far) / a.norm() + 1e-13)
            << far;
      }
}

TEST(LeastRotation, OfOppositeDirectionsIsAHalfTurn) {
  for (Eigen::Index d = 2; d <= 4; ++d) {
    MatrixXd from = MatrixXd::Zero(3, d), to = from;
    from.col(0) << 0, 1, 2;
    to.col(0) << 0, -1, -2;
    const MatrixXd q = least_rotation(from, to);
    expect_rotation(q, "half turn");
    EXPECT_NEAR(q(0, 0), -1.0, 8 * epsilon);
    EXPECT_NEAR(q.trace(), static_cast<double>(d) - 4, 64 * epsilon);  // one more direction turns, the rest stay
  }
}

// Among rotations as near as q, none has a larger trace: 4-D, points that span a plane leave the orthogonal one open.
TEST(LeastRotation, OfPlanarPointsInFourDimensionsHasTheLargestTrace) {
  Random random(8);
  for (int trial = 0; trial < 100; ++trial) {
    const MatrixXd plane = random_rotation(random, 4).leftCols(2), other = random_rotation(random, 4).leftCols(2);
    const MatrixXd flat = random_matrix(random, 5, 2);
    const MatrixXd from = flat * plane.transpose(), to = (flat * other.transpose());
    const MatrixXd q = least_rotation(from, to);
    expect_rotation(q, "planar");
    EXPECT_LE((from * q.transpose() - to).norm(), 1e-13);
    // All others: q times a rotation that keeps `plane` fixed.
    const MatrixXd frame = orthonormal(plane);
    for (int k = 1; k < 360; ++k) {
      const MatrixXd spin = frame * axis_turn(4, k * M_PI / 180, 2, 3) * frame.transpose();
      EXPECT_LE((q * spin).trace(), q.trace() + 1e-12) << k;
    }
  }
}

// A mirrored regular figure: the best rotation is not unique although points span the space.
TEST(LeastRotation, OfMirroredRegularFiguresIsTheIdentity) {
  for (Eigen::Index d = 2; d <= 4; ++d)
    for (Eigen::Index mirrored = 0; mirrored < d; ++mirrored) {
      MatrixXd from(2 * d, d);
      from << MatrixXd::Identity(d, d), -MatrixXd::Identity(d, d);
      MatrixXd to = from;
      to.col(mirrored) *= -1;
      const MatrixXd q = least_rotation(from, to);
      expect_rotation(q, "mirrored");
      // The identity is as near as any rotation: d - 2 of d axes agree.
      EXPECT_LE(squared_distance(q, from, to), squared_distance(MatrixXd::Identity(d, d), from, to) + 1e-12);
      EXPECT_LE((q - MatrixXd::Identity(d, d)).norm(), 1e-12) << d << " " << mirrored;
    }
}

TEST(LeastRotation, IsFiniteForTinyAndHugePolygons) {
  Random random(9);
  for (Eigen::Index d = 2; d <= 4; ++d)
    for (const double scale : {1e-300, 1e-150, 1e140, 1e153}) {
      const MatrixXd from = random_matrix(random, 5, d), r = random_rotation(random, d);
      const MatrixXd to = moved(from, 1, r, VectorXd::Zero(d));
      const MatrixXd q = least_rotation(scale * from, scale * to);
      expect_rotation(q, "scaled");
      EXPECT_LE((q - r).norm(), 1e-12) << d << " " << scale;
      EXPECT_NEAR(polygon_size(scale * from) / scale / polygon_size(from), 1.0, 64 * epsilon) << scale;
    }
}

TEST(LeastRotation, OfNearlyCollinearPointsIsARotation) {
  Random random(10);
  for (Eigen::Index d = 2; d <= 4; ++d)
    for (double flatness = 1e-17; flatness < 1; flatness *= 7) {
      MatrixXd from = random_matrix(random, 5, d), to = random_matrix(random, 5, d);
      from.rightCols(d - 1) *= flatness;
      to.leftCols(d - 1) *= flatness;
      expect_rotation(least_rotation(from, to), std::to_string(flatness));
    }
}

TEST(Turn, CountsAPolygonThatIsOnePointAsOfTheOthersSize) {
  MatrixXd point = MatrixXd::Constant(4, 2, 0.1), square(4, 2);
  square << 0, 0, 1, 0, 1, 1, 0, 1;
  EXPECT_EQ(MatrixXd(turn(point, square)), MatrixXd::Identity(2, 2));
  EXPECT_EQ(MatrixXd(turn(square, point)), MatrixXd::Identity(2, 2));
}

}  // namespace
