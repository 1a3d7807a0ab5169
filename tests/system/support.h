// Systems for all tests that need some.
#pragma once

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "../linalg/support.h"
#include "system/system.h"

namespace ifsm::core::testing {

// x' = a x + b y + e, y' = c x + d y + f.
inline Affine plane(double a, double b, double c, double d, double e, double f) {
  Affine map;
  map.linear.topLeftCorner<2, 2>() << a, b, c, d;
  map.shift << e, f, 0;
  return map;
}

// z → λ z + t.
inline Affine similar(double real, double imaginary, double e, double f) {
  return plane(real, -imaginary, imaginary, real, e, f);
}

// Of maps of random linear parts of norms up to `most`.
inline System random_system(Random& random, int dimension, double most) {
  std::vector<Affine> maps;
  std::vector<double> weights;
  const auto count = uniform(random, 2, 5);
  std::uniform_real_distribution<double> part(.05, 1);
  for (Eigen::Index i = 0; i < count; ++i) {
    Affine map;
    map.linear.topLeftCorner(dimension, dimension) = random_matrix(random, dimension, dimension);
    map.linear *= most * part(random) / stretch(map.linear);
    map.shift.head(dimension) = random_matrix(random, dimension, 1);
    maps.push_back(map);
    weights.push_back(part(random));
  }
  return {dimension, maps, weights};
}

// The same in space, where it lies in the plane z = 0.
inline System embedded(const System& flat) { return {3, flat.maps(), flat.probabilities()}; }

// Points of the attractor: all words of some length, applied to a fixed point.
inline std::vector<Vector3> points_of(const System& system, int length) {
  std::vector<Vector3> points{fixed_point(system.maps()[static_cast<std::size_t>(system.active()[0])])};
  for (int k = 0; k < length; ++k) {
    std::vector<Vector3> next;
    for (const int i : system.active())
      for (const Vector3& x : points) next.push_back(system.maps()[static_cast<std::size_t>(i)](x));
    points = next;
  }
  return points;
}

}  // namespace ifsm::core::testing
