#include "fit/normal.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace ifsm::core {
namespace {

constexpr int batch = 64;

}  // namespace

Normal::Normal(int parameters)
    : product_(Eigen::MatrixXd::Zero(parameters + 1, parameters + 1)), rows_(batch, parameters + 1) {}

double* Normal::row() {
  if (used_ == rows_.rows()) flush();
  return rows_.row(used_++).data();
}

void Normal::flush() {
  if (used_ == 0) return;  // Eigen divides by the number of rows
  product_.selfadjointView<Eigen::Lower>().rankUpdate(rows_.topRows(used_).transpose());
  used_ = 0;
}

const Eigen::MatrixXd& Normal::product() {
  flush();
  return product_;
}

Normal& Normal::operator-=(Normal& other) {
  flush();
  product_ -= other.product();
  return *this;
}

Normal& Normal::operator+=(Normal& other) {
  flush();
  product_ += other.product();
  return *this;
}

void Normal::add(const Eigen::MatrixXd& product) { product_ += product; }

Normal::Rows Normal::compressed() {
  flush();
  const int p = parameters();
  Eigen::VectorXd scale = product_.diagonal().head(p).cwiseSqrt();
  for (double& s : scale)
    if (!(s > 0)) s = 1;
  Eigen::MatrixXd gram = product_.topLeftCorner(p, p).selfadjointView<Eigen::Lower>();
  gram = (scale.cwiseInverse().asDiagonal() * gram * scale.cwiseInverse().asDiagonal()).eval();

  // PᵀLDLᵀP with pivots in falling order: those that are rounding belong to the gauge.
  const Eigen::LDLT<Eigen::MatrixXd> factor(gram);
  const Eigen::VectorXd pivots = factor.vectorD();
  const double least = 1e-12 * std::max(pivots(0), 0.0);
  const Eigen::VectorXd gradient = product_.row(p).head(p).transpose().cwiseQuotient(scale);
  Eigen::VectorXd solved = factor.transpositionsP() * gradient;
  factor.matrixL().solveInPlace(solved);

  Rows rows{RowMatrix::Zero(p + 1, p), Eigen::VectorXd::Zero(p + 1)};
  const Eigen::MatrixXd upper = factor.matrixU();
  for (int i = 0; i < p; ++i) {
    if (!(pivots(i) > least)) continue;
    rows.jacobian.row(i) = std::sqrt(pivots(i)) * upper.row(i);
    rows.residual(i) = solved(i) / std::sqrt(pivots(i));
  }
  const RowMatrix permutation = factor.transpositionsP() * RowMatrix::Identity(p, p);
  rows.jacobian = (rows.jacobian * permutation * scale.asDiagonal()).eval();
  rows.residual(p) = std::sqrt(std::max(0.0, product_(p, p) - rows.residual.squaredNorm()));
  return rows;
}

}  // namespace ifsm::core
