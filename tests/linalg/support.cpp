#include "support.h"

#include <Eigen/QR>

#include "linalg/spectrum.h"

namespace ifsm::core::testing {

double normal(Random& random) { return std::normal_distribution<double>()(random); }

Eigen::Index uniform(Random& random, Eigen::Index low, Eigen::Index high) {
  return std::uniform_int_distribution<Eigen::Index>(low, high)(random);
}

Matrix random_matrix(Random& random, Eigen::Index rows, Eigen::Index columns) {
  return Matrix::NullaryExpr(rows, columns, [&] { return normal(random); });
}

Matrix orthonormal(const Matrix& columns) { return columns.householderQr().householderQ(); }

Matrix random_rotation(Random& random, Eigen::Index d) {
  Matrix q = orthonormal(random_matrix(random, d, d));
  if (determinant(q) < 0) q.col(0) *= -1;
  return q;
}

Matrix least_squares(const Matrix& a, const Matrix& b) {
  return Eigen::CompleteOrthogonalDecomposition<Matrix>(a).solve(b);
}

Eigen::Index rank(const Matrix& a) { return Eigen::CompleteOrthogonalDecomposition<Matrix>(a).rank(); }

}  // namespace ifsm::core::testing
