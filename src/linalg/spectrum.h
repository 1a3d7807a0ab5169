// Singular values, eigenvalues and inverses of small dense matrices: Eigen's decompositions, compiled once.
#pragma once

#include <Eigen/Core>

namespace ifsm::core {

using MatrixView = Eigen::Ref<const Eigen::MatrixXd>;

// matrix = u diag(values) vᵀ; u and v are square, values fall.
struct SingularValues {
  Eigen::MatrixXd u;
  Eigen::VectorXd values;
  Eigen::MatrixXd v;
};
SingularValues svd(const MatrixView& matrix);

// Largest over smallest singular value; infinite when singular.
double condition_number(const MatrixView& matrix);

// Largest singular value.
double norm(const MatrixView& matrix);

// Largest absolute value of an eigenvalue.
double spectral_radius(const MatrixView& matrix);

// Inverse of a square matrix, without checks.
Eigen::MatrixXd inverse(const MatrixView& matrix);

double determinant(const MatrixView& matrix);

// Inverse of a symmetric positive semi-definite matrix on what it determines. `full`: what its diagonal was before
// anything was subtracted from it; that sets the units, and with them what is rounding: zero in directions whose
// eigenvalue is below 1e-12 in these units.
Eigen::MatrixXd known_inverse(const MatrixView& matrix, const Eigen::VectorXd& full);

// A square root of a symmetric positive semi-definite matrix: RᵀR = matrix.
Eigen::MatrixXd square_root(const MatrixView& matrix);

// Upper triangular U with UᵀU = the symmetric positive definite matrix; empty when it is not.
Eigen::MatrixXd cholesky(const MatrixView& matrix);

// Eigenvalues of a symmetric matrix, growing; one vector of them a column.
Eigen::VectorXd symmetric_eigenvalues(const MatrixView& matrix);
Eigen::MatrixXd symmetric_eigenvectors(const MatrixView& matrix);

}  // namespace ifsm::core
