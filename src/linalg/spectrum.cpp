#include "linalg/spectrum.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <limits>

namespace ifsm::core {
namespace {

using Jacobi = Eigen::JacobiSVD<Eigen::MatrixXd>;

}  // namespace

SingularValues svd(const MatrixView& matrix) {
  const Jacobi parts(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {parts.matrixU(), parts.singularValues(), parts.matrixV()};
}

double condition_number(const MatrixView& matrix) {
  const Eigen::VectorXd values = Jacobi(matrix).singularValues();
  const double least = values(values.size() - 1);
  return least > 0 ? values(0) / least : std::numeric_limits<double>::infinity();
}

double norm(const MatrixView& matrix) { return Jacobi(matrix).singularValues()(0); }

double spectral_radius(const MatrixView& matrix) {
  return Eigen::EigenSolver<Eigen::MatrixXd>(matrix, false).eigenvalues().cwiseAbs().maxCoeff();
}

Eigen::MatrixXd inverse(const MatrixView& matrix) { return Eigen::PartialPivLU<Eigen::MatrixXd>(matrix).inverse(); }

double determinant(const MatrixView& matrix) { return Eigen::PartialPivLU<Eigen::MatrixXd>(matrix).determinant(); }

Eigen::MatrixXd known_inverse(const MatrixView& matrix, const Eigen::VectorXd& full) {
  const Eigen::Index size = matrix.rows();
  constexpr double least = 1e-12;  // condition numbers beyond it leave no digit worth having
  const Eigen::VectorXd unit = (full.array() > 0).select(full.cwiseSqrt().cwiseInverse(), 0.0);
  const Eigen::MatrixXd scaled = unit.asDiagonal() * matrix * unit.asDiagonal();
  const Eigen::LLT<Eigen::MatrixXd> factor(scaled);
  if (factor.info() == Eigen::Success && factor.matrixLLT().diagonal().cwiseAbs2().minCoeff() > least) {
    const Eigen::MatrixXd inverse = factor.solve(Eigen::MatrixXd::Identity(size, size));
    return unit.asDiagonal() * inverse * unit.asDiagonal();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scaled);
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(size, size);
  for (Eigen::Index k = 0; k < size; ++k)
    if (eigen.eigenvalues()(k) > least)
      inverse += eigen.eigenvectors().col(k) * eigen.eigenvectors().col(k).transpose() / eigen.eigenvalues()(k);
  return unit.asDiagonal() * inverse * unit.asDiagonal();
}

Eigen::MatrixXd square_root(const MatrixView& matrix) {
  const Eigen::LLT<Eigen::MatrixXd> factor(matrix);
  if (factor.info() == Eigen::Success) return factor.matrixU();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(matrix);
  return eigen.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal() * eigen.eigenvectors().transpose();
}

Eigen::MatrixXd cholesky(const MatrixView& matrix) {
  const Eigen::LLT<Eigen::MatrixXd> factor(matrix);
  if (factor.info() != Eigen::Success) return {};
  return factor.matrixU();
}

Eigen::VectorXd symmetric_eigenvalues(const MatrixView& matrix) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
}

Eigen::MatrixXd symmetric_eigenvectors(const MatrixView& matrix) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvectors();
}

}  // namespace ifsm::core
