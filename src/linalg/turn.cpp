#include "linalg/turn.h"

#include <cmath>

#include "linalg/spectrum.h"

namespace ifsm::core {
namespace {

constexpr double epsilon = 2.220446049250313e-16;

using Small = SmallMatrix;
using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;
using Row = Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, 4>;

// A polygon from its mean, in units of its largest difference. Differences from the first point come first: they are
// exact where points are near each other, and 0 where they coincide, which differences from a rounded mean are not.
class Centred {
 public:
  explicit Centred(const PolygonView& polygon) : polygon_(polygon), first_(polygon.row(0)) {
    const double largest = polygon.cwiseAbs().maxCoeff();
    unit_ = (polygon.rowwise() - first_).cwiseAbs().maxCoeff();
    // A coordinate was rounded as a sum of as many products as the polygon has points; 8: a few levels of them.
    noise_ = 8 * static_cast<double>(polygon.rows()) * epsilon * (largest / unit_);
    if (!(unit_ > 0)) return;
    mean_ = Row::Zero(polygon.cols());
    for (Eigen::Index j = 0; j < polygon.rows(); ++j) mean_ += (polygon.row(j) - first_) / unit_;
    mean_ /= static_cast<double>(polygon.rows());
  }

  bool is_point() const { return !(unit_ > 0) || noise_ >= 1; }  // as far as rounding lets one tell
  double noise() const { return noise_; }
  double unit() const { return unit_; }
  Row point(Eigen::Index j) const { return (polygon_.row(j) - first_) / unit_ - mean_; }

 private:
  const PolygonView& polygon_;
  Row first_, mean_;
  double unit_, noise_;
};

// The nearest rotation, full rank or one less. When it mirrors, the least of the singular directions is turned over;
// where several are least, the one that lets the others turn least: I - 2 w w^T, w^T V^T U w smallest.
Small nearest_rotation(const SingularValues& m, double rounding) {
  const Matrix whole = m.u * m.v.transpose();
  if (determinant(whole) > 0) return whole;
  const auto last = m.values.size() - 1;
  Eigen::Index least = 1;
  while (least <= last && m.values(last - least) <= m.values(last) + rounding) ++least;
  const Matrix cross = m.v.rightCols(least).transpose() * m.u.rightCols(least);
  const Vector w = symmetric_eigenvectors(cross + cross.transpose()).col(0);
  return whole - 2 * (m.u.rightCols(least) * w) * (m.v.rightCols(least) * w).transpose();
}

// Of all rotations that take range V_r to range U_r as told, the one of largest trace: the free blocks are joined by
// the nearest rotation to what the identity asks for there.
Small complete(const SingularValues& m, Eigen::Index rank) {
  const auto free = m.u.rows() - rank;
  const Matrix told = m.u.leftCols(rank) * m.v.leftCols(rank).transpose();
  SingularValues wanted = svd(m.u.rightCols(free).transpose() * m.v.rightCols(free));
  const auto whole = [&]() -> Matrix {
    return told + m.u.rightCols(free) * (wanted.u * wanted.v.transpose()) * m.v.rightCols(free).transpose();
  };
  if (determinant(whole()) < 0) wanted.u.col(free - 1) *= -1;
  return whole();
}

// P'^T pinv(P^T) over centred points, V_r V_r^T being the projector onto what P spans.
Small linear(const PolygonView& from, const PolygonView& to, const Small& similarity) {
  const Centred before(from), after(to);
  if (before.is_point()) return similarity;
  const auto d = from.cols();
  Matrix p(from.rows(), d), target = Matrix::Zero(from.rows(), d);
  for (Eigen::Index j = 0; j < from.rows(); ++j) {
    p.row(j) = before.point(j);
    if (!after.is_point()) target.row(j) = after.point(j) * (after.unit() / before.unit());
  }
  const SingularValues parts = svd(p);
  const double rounding = static_cast<double>(from.rows()) * (before.noise() + epsilon);
  Small result = similarity;
  for (Eigen::Index r = 0; r < parts.values.size() && parts.values(r) > rounding; ++r) {
    const Vector v = parts.v.col(r);
    const Vector image = target.transpose() * parts.u.col(r) / parts.values(r);
    result += (image - similarity * v) * v.transpose();
  }
  return result;
}

}  // namespace

double polygon_size(const PolygonView& polygon) {
  const Centred centred(polygon);
  if (centred.is_point()) return 0;
  double sum = 0;
  for (Eigen::Index j = 0; j < polygon.rows(); ++j) sum += centred.point(j).squaredNorm();
  return centred.unit() * std::sqrt(sum / static_cast<double>(polygon.rows()));
}

SmallMatrix least_rotation(const PolygonView& from, const PolygonView& to) {
  const auto d = from.cols();
  if (d == 1 || from == to) return Small::Identity(d, d);
  const Centred before(from), after(to);
  if (before.is_point() || after.is_point()) return Small::Identity(d, d);
  Small m = Small::Zero(d, d);
  for (Eigen::Index j = 0; j < from.rows(); ++j) m.noalias() += after.point(j).transpose() * before.point(j);
  // What the sum is known to: both factors are of size 1.
  const double rounding = static_cast<double>(from.rows()) * (before.noise() + after.noise());
  if (d == 2) {  // closed form: the argument of sum (conj p) p'
    const double c = m(0, 0) + m(1, 1), s = m(1, 0) - m(0, 1);
    const double h = std::hypot(c, s);
    Small q = Small::Identity(2, 2);
    if (h > rounding) q << c / h, -s / h, s / h, c / h;
    return q;
  }
  const SingularValues parts = svd(m);
  Eigen::Index rank = 0;
  while (rank < d && parts.values(rank) > rounding) ++rank;
  return rank >= d - 1 ? nearest_rotation(parts, rounding) : complete(parts, rank);
}

SmallMatrix turn(const PolygonView& from, const PolygonView& to) {
  if (from == to) return Small::Identity(from.cols(), from.cols());
  const double before = polygon_size(from), after = polygon_size(to);
  const double scale = before > 0 && after > 0 ? after / before : 1.0;
  return scale * least_rotation(from, to);
}

SmallMatrix turn(const PolygonView& from, const PolygonView& to, Turning how) {
  if (how == Turning::rotation) return least_rotation(from, to);
  const Small similarity = turn(from, to);
  return how == Turning::linear && from != to ? linear(from, to, similarity) : similarity;
}

bool maps_onto(const SmallMatrix& matrix, const PolygonView& from, const PolygonView& to, double rounding) {
  const auto centred = [](const PolygonView& p) { return Eigen::MatrixXd(p.rowwise() - p.colwise().mean()); };
  return (centred(from) * matrix.transpose() - centred(to)).cwiseAbs().maxCoeff() <= rounding;
}

}  // namespace ifsm::core
