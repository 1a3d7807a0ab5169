// Curves for the tests of the fit.
#pragma once

#include <random>

#include "curve/named.h"
#include "fit/sparse.h"

namespace ifsm::core {

// A random walk: rough at all scales, as a coast is.
inline Points walk(Index count, Index dimension, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> step(-1, 1);
  Points points(dimension, count);
  for (Index k = 1; k < count; ++k)
    for (Index axis = 0; axis < dimension; ++axis)
      points.matrix()(k, axis) = points.matrix()(k - 1, axis) + step(random);
  return points;
}

// A walk that comes home: the straight line between its ends taken out.
inline Points loop(Index count, Index dimension, unsigned seed) {
  Points points = walk(count, dimension, seed);
  const Eigen::RowVectorXd gap = points.matrix().row(count - 1) - points.matrix().row(0);
  for (Index k = 0; k < count; ++k) points.matrix().row(k) -= gap * static_cast<double>(k) / static_cast<double>(count);
  return points;
}

// Every so many of the points, that many in all.
inline Points resampled(const Points& points, Index count) {
  Points fewer(points.dimension(), count);
  for (Index k = 0; k < count; ++k) fewer.matrix().row(k) = points.matrix().row(k * (points.count() - 1) / (count - 1));
  return fewer;
}

// The Koch curve's own samples: a joined model of its filter without details.
inline Points koch_samples(int levels) {
  const FilterPtr filter = named_filter("koch", Topology::joined, 0, 0);
  const double triangle[] = {0, 0, 0.5, 0.28867513459481287, 1, 0};
  return samples(*from_polygon(filter, Points::from_interleaved(triangle, 3, 2), false, levels));
}

}  // namespace ifsm::core
