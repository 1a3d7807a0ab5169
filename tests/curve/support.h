// Shapes, filters and curves for the tests of src/curve: grids of all shapes, and seeded random ones.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "../linalg/support.h"
#include "curve/complement.h"
#include "curve/evaluate.h"
#include "curve/frames.h"
#include "curve/keep.h"
#include "curve/model.h"
#include "curve/named.h"
#include "curve/placement.h"
#include "curve/resolve.h"
#include "curve/significance.h"
#include "curve/transform.h"
#include "curve/tree_solver.h"

namespace ifsm::core {

inline std::ostream& operator<<(std::ostream& out, const Shape& s) {
  return out << (s.joined() ? "joined" : "square") << " n=" << s.control_points() << " N=" << s.maps()
             << " stride=" << s.stride();
}

}  // namespace ifsm::core

namespace ifsm::core::testing {

// Every topology, n and N; square with its natural stride.
std::vector<Shape> all_shapes(int most_points = 16, int most_maps = 8);

// n = 1: the only T there is.
RowMatrix casteljau_maps(const Shape& shape);
FilterPtr casteljau(const Shape& shape);

// De Casteljau's maps with every free column moved by vectors of sum zero, and the complement mixed: U ← M U.
FilterPtr random_filter(const Shape& shape, Random& random, double size = 0.1);

enum class Kind { walk, smooth, noise, constant, repeated, collinear, offset, tiny, huge };
constexpr Kind all_kinds[] = {Kind::walk,      Kind::smooth, Kind::noise, Kind::constant, Kind::repeated,
                              Kind::collinear, Kind::offset, Kind::tiny,  Kind::huge};

Points random_curve(Random& random, Index count, Index dimension, Kind kind);
Points points_from(const Matrix& rows);

// The largest distance between points of the same number.
double distance(const Points& a, const Points& b);
double largest(const Points& points);
double squared(const Points& a, const Points& b);

Kept random_choice(const Model& model, Random& random, double share);

}  // namespace ifsm::core::testing
