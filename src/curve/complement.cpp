#include "curve/complement.h"

#include <Eigen/QR>
#include <cmath>

#include "linalg/spectrum.h"

namespace ifsm::core {
namespace {

struct Complement {
  Eigen::MatrixXd basis;  // orthonormal rows
  double scale;           // geometric mean of the extreme singular values of what it complements
};

Complement orthogonal_complement(const Eigen::MatrixXd& rows) {
  const Index given = rows.rows(), columns = rows.cols(), wanted = columns - given;
  if (given == 0) return {Eigen::MatrixXd::Identity(columns, columns), 1.0};
  const Eigen::VectorXd squares = symmetric_eigenvalues(rows * rows.transpose());
  const double least = squares(0), most = squares(given - 1);
  if (!(least > 1e-26 * most))
    throw Error(
        Status::singular, "matrix",
        "The rows of T depend on each other, so no U makes R invertible; use fewer control points or other maps.");
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> span(rows.transpose());
  const Eigen::MatrixXd q = span.householderQ() * Eigen::MatrixXd::Identity(columns, given);
  const Eigen::MatrixXd projector = Eigen::MatrixXd::Identity(columns, columns) - q * q.transpose();
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> pivoted(projector);
  Eigen::MatrixXd basis = (pivoted.householderQ() * Eigen::MatrixXd::Identity(columns, wanted)).transpose();
  for (Index k = 0; k < wanted; ++k)
    if (pivoted.matrixR()(k, k) < 0) basis.row(k) *= -1;
  return {basis, std::pow(least * most, 0.25)};
}

}  // namespace

RowMatrix with_complement(const Shape& shape, const RowMatrix& maps) {
  const int n = shape.control_points(), rows = shape.rows();
  RowMatrix r = RowMatrix::Zero(rows, rows);
  r.topRows(n) = maps;
  const int border = shape.joined() ? 1 : 0;  // rows and columns at either end that belong to the joints
  const Complement u = orthogonal_complement(maps.block(border, border, n - 2 * border, rows - 2 * border));
  r.block(n, border, rows - n, rows - 2 * border) = u.scale * u.basis;
  return r;
}

}  // namespace ifsm::core
