#include "system/parameters.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

namespace ifsm::core {
namespace {

Matrix3 turn(const Vector3& rotation) {
  const double angle = rotation.norm();
  return angle > 0 ? Eigen::AngleAxisd(angle, rotation / angle).toRotationMatrix() : Matrix3(Matrix3::Identity());
}

constexpr double rounding = 0x1p-48;  // of 16 operations on the largest entry

// M = q · upper, of rows of zeros where upper's diagonal is 0; q is a rotation.
struct Triangular {
  Matrix3 q, upper;
};

// Of a matrix whose largest entry is 1. Gram and Schmidt; a column that depends on those before it is given a direction
// that no column has.
Triangular triangular(const Matrix3& linear, int dimension) {
  Matrix3 q = Matrix3::Zero();
  const auto without = [&](Vector3 v) {
    for (int twice = 0; twice < 2; ++twice) v -= q * (q.transpose() * v);  // twice is enough
    return v;
  };
  for (int k = 0; k < dimension; ++k)
    if (const Vector3 left = without(linear.col(k)); left.norm() > rounding) q.col(k) = left.normalized();
  int free = dimension - 1;  // a column whose sign decides the least
  for (int k = 2; k >= 0; --k) {
    if (k < dimension && q.col(k).isZero(0)) free = k;
    for (int axis = k; q.col(k).isZero(0); axis = (axis + 1) % 3)
      if (const Vector3 left = without(Vector3::Unit(axis)); left.norm() > .5) q.col(k) = left.normalized();
  }
  if (q.determinant() < 0) q.col(free) *= -1;
  Matrix3 upper = q.transpose() * linear;
  return {q, (upper.array().abs() > rounding).select(upper, 0)};
}

}  // namespace

Affine map_of(const Parameters& p, int dimension) {
  Matrix3 shear = Matrix3::Identity();
  shear(0, 1) = p.shear(0);
  if (dimension == 3) shear(0, 2) = p.shear(1), shear(1, 2) = p.shear(2);
  Affine map{turn(p.rotation) * p.scale.asDiagonal() * shear, p.shift};
  if (dimension == 2) map.linear.row(2).setZero(), map.linear.col(2).setZero();
  return map;
}

Parameters parameters_of(const Affine& map, int dimension) {
  const double largest = map.linear.cwiseAbs().maxCoeff();
  const auto [q, unit] = triangular(largest > 0 ? Matrix3(map.linear / largest) : map.linear, dimension);
  const Matrix3 upper = largest * unit;
  Parameters p;
  const Eigen::AngleAxisd turned(q);
  p.rotation = turned.angle() * turned.axis();
  if (dimension == 2) p.rotation = {0, 0, std::atan2(q(1, 0), q(0, 0))};
  for (int k = 0; k < dimension; ++k) p.scale(k) = upper(k, k);
  const auto over = [](double value, double scale) { return scale != 0 ? value / scale : 0; };
  p.shear(0) = over(upper(0, 1), p.scale(0));
  if (dimension == 3) p.shear(1) = over(upper(0, 2), p.scale(0)), p.shear(2) = over(upper(1, 2), p.scale(1));
  p.shift = map.shift;
  return p;
}

}  // namespace ifsm::core
