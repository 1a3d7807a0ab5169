// Curves for the tests of src/measure, beside those of src/curve.
#pragma once

#include "../curve/support.h"
#include "measure/nearest.h"
#include "measure/polyline.h"

namespace ifsm::core::testing {

inline Points points_of(const std::vector<std::vector<double>>& rows) {
  Points points(static_cast<Index>(rows[0].size()), static_cast<Index>(rows.size()));
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (std::size_t axis = 0; axis < rows[k].size(); ++axis) points.plane(static_cast<Index>(axis))[k] = rows[k][axis];
  return points;
}

// `count` points on the ring of that radius, counter-clockwise from (radius, 0).
inline Points circle(Index count, double radius) {
  Points points(2, count);
  for (Index k = 0; k < count; ++k) {
    const double angle = 2 * M_PI * static_cast<double>(k) / static_cast<double>(count);
    points.matrix()(k, 0) = radius * std::cos(angle);
    points.matrix()(k, 1) = radius * std::sin(angle);
  }
  return points;
}

// The snowflake's third, level by level: 4^levels + 1 points, exactly self-similar.
inline Points koch_curve(int levels) {
  Matrix rows(2, 2);
  rows << 0, 0, 1, 0;
  Eigen::Matrix2d third;
  third << 0.5, -std::sqrt(0.75), std::sqrt(0.75), 0.5;
  for (int level = 0; level < levels; ++level) {
    Matrix finer(4 * (rows.rows() - 1) + 1, 2);
    for (Index k = 0; k + 1 < rows.rows(); ++k) {
      const Eigen::Vector2d a = rows.row(k), step = (rows.row(k + 1) - rows.row(k)) / 3;
      finer.row(4 * k) = a;
      finer.row(4 * k + 1) = a + step;
      finer.row(4 * k + 2) = a + step + third * step;
      finer.row(4 * k + 3) = a + 2 * step;
    }
    finer.row(finer.rows() - 1) = rows.row(rows.rows() - 1);
    rows = finer;
  }
  return points_from(rows);
}

inline void expect_same(const Nearest& a, const Nearest& b) {
  EXPECT_EQ(a.parameters, b.parameters);
  EXPECT_EQ(a.distances, b.distances);
  EXPECT_EQ(a.points, b.points);
}

// Around the curve, on it, and far away.
inline Points queries_about(const Points& curve, Random& random, Index count) {
  const double size = diagonal(curve);
  Points queries(curve.dimension(), count);
  for (Index q = 0; q < count; ++q) {
    const double reach = q % 4 == 0 ? 0.0 : q % 4 == 1 ? 1e-3 * size : q % 4 == 2 ? size : 1e6 * size;
    for (Index axis = 0; axis < curve.dimension(); ++axis)
      queries.matrix()(q, axis) = curve.matrix()(uniform(random, 0, curve.count() - 1), axis) + reach * normal(random);
    if (q % 8 == 0) queries.matrix().row(q) = curve.matrix().row(q % curve.count());
  }
  return queries;
}

}  // namespace ifsm::core::testing
