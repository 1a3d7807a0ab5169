// Affine maps x → M x + t of the plane and of space. Those of the plane have zeros in their third row and column, so
// one type of fixed size serves both; nothing that is asked of them here sees the difference.
#pragma once

#include <Eigen/Core>

namespace ifsm::core {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;

struct Affine {
  Matrix3 linear = Matrix3::Zero();
  Vector3 shift = Vector3::Zero();

  static Affine identity(int dimension);

  Vector3 operator()(const Vector3& x) const { return linear * x + shift; }
  // x → a(b(x)).
  friend Affine operator*(const Affine& a, const Affine& b) { return {a.linear * b.linear, a(b.shift)}; }
  friend bool operator==(const Affine& a, const Affine& b) { return a.linear == b.linear && a.shift == b.shift; }
};

// Singular values, falling.
Vector3 singular_values(const Matrix3& linear);

// Largest singular value: by how much it stretches at most.
double stretch(const Matrix3& linear);

// Of the first `dimension` rows and columns.
double determinant(const Affine& map, int dimension);

// x with map(x) = x. Where I - M is singular: not finite.
Vector3 fixed_point(const Affine& map);

// What a linear map makes of the unit ball, about a centre.
struct Ellipsoid {
  Vector3 centre = Vector3::Zero();
  Matrix3 axes = Matrix3::Zero();

  // The largest v·x of its points.
  double reach(const Vector3& v) const { return v.dot(centre) + (axes.transpose() * v).norm(); }
  friend Ellipsoid operator*(const Affine& map, const Ellipsoid& e) { return {map(e.centre), map.linear * e.axes}; }
};

}  // namespace ifsm::core
