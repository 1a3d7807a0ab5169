#include "linalg/affine.h"

#include <Eigen/LU>
#include <Eigen/SVD>

namespace ifsm::core {

Affine Affine::identity(int dimension) {
  Affine map;
  map.linear.topLeftCorner(dimension, dimension).setIdentity();
  return map;
}

Vector3 singular_values(const Matrix3& linear) { return Eigen::JacobiSVD<Matrix3>(linear).singularValues(); }

double stretch(const Matrix3& linear) { return singular_values(linear)(0); }

double determinant(const Affine& map, int dimension) {
  return dimension == 2 ? map.linear.topLeftCorner<2, 2>().determinant() : map.linear.determinant();
}

Vector3 fixed_point(const Affine& map) { return (Matrix3::Identity() - map.linear).partialPivLu().solve(map.shift); }

}  // namespace ifsm::core
