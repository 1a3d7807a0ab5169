#include "fit/curve_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/parallel.h"
#include "linalg/spectrum.h"

namespace ifsm::core {
namespace {

// Control points are solved for to some condition number times eps, and the value to eps over the part of it that is
// left: within these bounds (the product of the traces is at most the unknowns squared times the condition number) both
// are below 1e-11.
constexpr double well_conditioned = 1e5;
constexpr double little_left = 1e-4;

double slope_of(const CurveTerm& term, Index k) {
  return term.slopes.empty() ? 1.0 : term.slopes[static_cast<std::size_t>(k)];
}

// Of plain weights: what a residual is multiplied by.
double root_weight(const CurveTerm& term, Index k) {
  const auto& weights = term.target->weights;
  return std::sqrt(slope_of(term, k) * (weights.empty() ? 1.0 : weights[static_cast<std::size_t>(k)]));
}

// With a covariance: the rows of W, and the slope.
Lanes whitening_at(const CurveTerm& term, Index k) {
  const Index d = term.target->dimension;
  return std::sqrt(slope_of(term, k)) * term.target->whitening.middleRows(k * d, d);
}

bool plain(const CurveTerm& term) { return term.target->whitening.rows() == 0; }

// Calls body(groups, group, sum) for groups of a term's samples, and adds their sums.
template <class Body>
void gather_groups(const CurveTerm& term, Normal& normal, const Body& body) {
  const SampleGroups groups(term.positions);
  std::vector<Normal> each(static_cast<std::size_t>(groups.count()), Normal(normal.parameters()));
  parallel_for(groups.count(), 0, [&](Index group) { body(groups, group, each[static_cast<std::size_t>(group)]); });
  for (Normal& one : each) normal += one;
}

}  // namespace

CurveError::CurveError(const Shape& shape, int levels, std::vector<CurveTerm> terms, const Watch& watch)
    : shape_(shape), levels_(levels), terms_(std::move(terms)), watch_(watch) {}

double CurveError::value(const RowMatrix& matrix) {
  const auto fits = solved(matrix);
  if (!fits) return std::numeric_limits<double>::infinity();
  double sum = 0;
  for (const ControlFit& fit : *fits) sum += fit.value;
  return sum;
}

void CurveError::gather(const RowMatrix& matrix, Normal& normal) {
  const auto fits = solved(matrix);
  if (!fits) throw Error(Status::internal, "", "A step was taken to where constraints contradict each other.");
  for (std::size_t t = 0; t < terms_.size(); ++t) normal.add(eliminated(terms_[t], matrix, (*fits)[t].control).product);
}

std::optional<std::vector<ControlFit>> CurveError::solved(const RowMatrix& matrix) {
  if (matrix.size() == last_matrix_.size() && matrix == last_matrix_) return last_;
  std::vector<ControlFit> fits;
  for (const CurveTerm& term : terms_) {
    auto fit = solved_term(term, matrix);
    if (!fit) return std::nullopt;
    fits.push_back(std::move(*fit));
  }
  RowMatrix copy = matrix;
  last_matrix_.swap(copy);
  last_ = std::move(fits);
  return last_;
}

Held CurveError::held(const CurveTerm& term, const RowMatrix& matrix) const {
  const Index unknowns = shape_.control_points() * term.target->dimension;
  if (term.constraints.empty()) return {Eigen::MatrixXd(0, unknowns), Eigen::VectorXd(0), 1};
  const Equations equations = term.constraints.equations(matrix, watch_);
  return {equations.left, equations.right, term.target->diagonal + equations.right.cwiseAbs().maxCoeff()};
}

std::optional<ControlFit> CurveError::solved_term(const CurveTerm& term, const RowMatrix& matrix) const {
  const Held held = this->held(term, matrix);
  if (held.conflict() >= 0) return std::nullopt;
  Eigen::VectorXd control = held.nearest(stacked(term.reference));
  double value = 0;
  Eigen::MatrixXd inverse;
  bool enough = false;
  for (int round = 0; round < 2 && !enough; ++round) {
    const Quadratic now = quadratic(term, matrix, unstacked(control, term.target->dimension), round == 0);
    if (round == 0) {
      const Eigen::MatrixXd form = held.free().transpose() * now.form * held.free();
      inverse = known_inverse(form, form.diagonal());
      enough = form.trace() * inverse.trace() < well_conditioned;
    }
    const Eigen::VectorXd gradient = held.free().transpose() * now.gradient;
    const Eigen::VectorXd step = inverse * gradient;
    control = held.nearest(control - held.free() * step);
    value = now.value - gradient.dot(step);
    // Else again: the second time it solves for what rounding left over.
    enough = enough && value > little_left * now.value;
  }
  return ControlFit{unstacked(control, term.target->dimension), term.offset + std::max(value, 0.0)};
}

// Half the second derivative by the control points, half the first, and the value.
CurveError::Quadratic CurveError::quadratic(const CurveTerm& term, const RowMatrix& matrix, const Lanes& control,
                                            bool with_form) const {
  if (plain(term)) return plain_quadratic(term, matrix, control, with_form);
  const int n = shape_.control_points();
  const Index d = term.target->dimension, unknowns = n * d;
  Normal normal(static_cast<int>(unknowns));  // W (b ⊗ 1 | e)
  gather_groups(term, normal, [&](const SampleGroups& groups, Index group, Normal& sum) {
    Eigen::RowVectorXd error(d);
    CurveWalk(shape_, levels_, matrix, watch_).basis(groups.positions(group), [&](Index at, const double* basis) {
      const Index k = groups.first(group) + at;
      error.noalias() = Eigen::Map<const Eigen::RowVectorXd>(basis, n) * control;
      error -= term.target->samples.row(k);
      const Lanes whitening = whitening_at(term, k);
      for (Index a = 0; a < d; ++a) {
        Eigen::Map<Eigen::RowVectorXd> row(sum.row(), unknowns + 1);
        for (int i = 0; i < n; ++i) row.segment(i * d, d) = basis[i] * whitening.row(a);
        row(unknowns) = whitening.row(a).dot(error);
      }
    });
  });
  const Eigen::MatrixXd whole = normal.product().selfadjointView<Eigen::Lower>();
  return {whole.topLeftCorner(unknowns, unknowns), whole.row(unknowns).head(unknowns), whole(unknowns, unknowns)};
}

// The same for weights, which keep coordinates apart: one form of n control points does for all.
CurveError::Quadratic CurveError::plain_quadratic(const CurveTerm& term, const RowMatrix& matrix, const Lanes& control,
                                                  bool with_form) const {
  const Index n = shape_.control_points(), d = term.target->dimension;
  const SampleGroups groups(term.positions);
  const Quadratic none{Eigen::MatrixXd::Zero(n, n), Eigen::VectorXd::Zero(n * d), 0};
  std::vector<Quadratic> each(static_cast<std::size_t>(groups.count()), none);  // the form of one coordinate
  parallel_for(groups.count(), 0, [&](Index group) {
    Quadratic sum = none;
    CurveWalk(shape_, levels_, matrix, watch_).basis(groups.positions(group), [&](Index at, const double* basis) {
      const Index k = groups.first(group) + at;
      const double root = root_weight(term, k), weight = root * root;
      for (Index a = 0; a < d; ++a) {
        double error = -term.target->samples(k, a);
        for (Index i = 0; i < n; ++i) error += basis[i] * control(i, a);
        sum.value += weight * error * error;
        for (Index i = 0; i < n; ++i) sum.gradient(i * d + a) += weight * error * basis[i];
      }
      for (Index i = 0; with_form && i < n; ++i)
        for (Index j = 0; j <= i; ++j) sum.form(i, j) += weight * basis[i] * basis[j];
    });
    each[static_cast<std::size_t>(group)] = std::move(sum);
  });
  Quadratic result{Eigen::MatrixXd::Zero(n * d, n * d), Eigen::VectorXd::Zero(n * d), 0};
  Eigen::MatrixXd form = Eigen::MatrixXd::Zero(n, n);
  for (const Quadratic& one : each) {
    form += one.form;
    result.gradient += one.gradient;
    result.value += one.value;
  }
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j)
      for (Index a = 0; a < d; ++a) result.form(i * d + a, j * d + a) = form(std::max(i, j), std::min(i, j));
  return result;
}

void CurveError::rows(const CurveTerm& term, const RowMatrix& matrix, const Lanes& control, RowSink& sink) const {
  rows(term, term.positions, 0, matrix, control, sink);
}

void CurveError::rows(const CurveTerm& term, std::span<const Position> positions, Index first, const RowMatrix& matrix,
                      const Lanes& control, RowSink& sink) const {
  const int n = shape_.control_points(), count = free_count(shape_, Part::maps);
  const Index d = term.target->dimension, unknowns = n * d;
  Eigen::RowVectorXd error(d);
  CurveWalk(shape_, levels_, matrix, watch_)
      .tangents(positions, control, [&](Index at, const double* values, const double* moved) {
        const Index k = first + at;
        const Eigen::Map<const Eigen::RowVectorXd> basis(values, n);
        const Eigen::Map<const Lanes> tangent(moved, d, count);
        error.noalias() = basis * control;
        error -= term.target->samples.row(k);
        const Lanes whitening =
            plain(term) ? Lanes(root_weight(term, k) * Lanes::Identity(d, d)) : whitening_at(term, k);
        for (Index a = 0; a < d; ++a) {
          Eigen::Map<Eigen::RowVectorXd> row(sink.row(), unknowns + count + 1);
          for (int i = 0; i < n; ++i) row.segment(i * d, d) = basis(i) * whitening.row(a);
          row.segment(unknowns, count).noalias() = whitening.row(a) * tangent;
          row(unknowns + count) = whitening.row(a).dot(error);
        }
      });
}

Eigen::MatrixXd CurveError::product(const CurveTerm& term, const RowMatrix& matrix, const Lanes& control) const {
  const int n = shape_.control_points(), count = free_count(shape_, Part::maps);
  const Index d = term.target->dimension, unknowns = n * d, size = unknowns + count + 1;
  if (!plain(term)) {
    Normal normal(static_cast<int>(size) - 1);
    gather_groups(term, normal, [&](const SampleGroups& groups, Index group, Normal& sum) {
      rows(term, groups.positions(group), groups.first(group), matrix, control, sum);
    });
    return normal.product().selfadjointView<Eigen::Lower>();
  }
  std::vector<Normal> normals;  // a coordinate each: (b | tangent | e)
  for (Index a = 0; a < d; ++a) normals.emplace_back(n + count);
  const SampleGroups groups(term.positions);
  std::vector<std::vector<Normal>> each(static_cast<std::size_t>(groups.count()), normals);
  parallel_for(groups.count(), 0, [&](Index group) {
    plain_rows(term, groups.positions(group), groups.first(group), matrix, control,
               each[static_cast<std::size_t>(group)]);
  });
  for (auto& one : each)
    for (std::size_t a = 0; a < normals.size(); ++a) normals[a] += one[a];
  Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(size, size);
  for (Index a = 0; a < d; ++a) {
    const Eigen::MatrixXd part = normals[static_cast<std::size_t>(a)].product().selfadjointView<Eigen::Lower>();
    whole.bottomRightCorner(count + 1, count + 1) += part.bottomRightCorner(count + 1, count + 1);
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) whole(i * d + a, j * d + a) = part(i, j);
      whole.row(i * d + a).tail(count + 1) = part.row(i).tail(count + 1);
      whole.col(i * d + a).tail(count + 1) = part.col(i).tail(count + 1);
    }
  }
  return whole;
}

void CurveError::plain_rows(const CurveTerm& term, std::span<const Position> positions, Index first,
                            const RowMatrix& matrix, const Lanes& control, std::vector<Normal>& normals) const {
  const Index n = shape_.control_points(), count = free_count(shape_, Part::maps);
  CurveWalk(shape_, levels_, matrix, watch_)
      .tangents(positions, control, [&](Index at, const double* basis, const double* moved) {
        const Index k = first + at;
        const double root = root_weight(term, k);
        for (Index a = 0; a < term.target->dimension; ++a) {
          double* const row = normals[static_cast<std::size_t>(a)].row();
          double error = -term.target->samples(k, a);
          for (Index i = 0; i < n; ++i) error += basis[i] * control(i, a);
          Eigen::Map<Eigen::RowVectorXd>(row, n) = root * Eigen::Map<const Eigen::RowVectorXd>(basis, n);
          Eigen::Map<Eigen::RowVectorXd>(row + n, count) =
              root * Eigen::Map<const Eigen::RowVectorXd>(moved + a * count, count);
          row[n + count] = root * error;
        }
      });
}

// With p = Z z + S C along the constraints: the product in (z, C, r), and its Schur complement.
Eliminated CurveError::eliminated(const CurveTerm& term, const RowMatrix& matrix, const Lanes& control) const {
  const int count = free_count(shape_, Part::maps);
  const Held held = this->held(term, matrix);
  const Eigen::MatrixXd whole = product(term, matrix, control);
  const Index unknowns = whole.rows() - count - 1, rest = count + 1;
  const Eigen::MatrixXd form = whole.topLeftCorner(unknowns, unknowns);
  Eigen::MatrixXd mixed = whole.topRightCorner(unknowns, rest);  // control points against C and the residual
  Eigen::MatrixXd below = whole.bottomRightCorner(rest, rest);
  Eigen::MatrixXd along = Eigen::MatrixXd::Zero(unknowns, rest);
  if (!held.empty()) {
    along.leftCols(count) = held.follow(term.constraints.tangents(matrix, control, watch_));
    below += mixed.transpose() * along + along.transpose() * mixed + along.transpose() * form * along;
    mixed += form * along;
  }
  const Eigen::MatrixXd free_form = held.free().transpose() * form * held.free();
  const Eigen::MatrixXd inverse = known_inverse(free_form, free_form.diagonal());
  const Eigen::MatrixXd free_mixed = held.free().transpose() * mixed;
  const Eigen::MatrixXd solved = inverse * free_mixed;
  Eliminated result;
  result.product = below - free_mixed.transpose() * solved;
  result.product(count, count) += term.offset;
  result.follow = (along - held.free() * solved).leftCols(count);
  result.spread = held.free() * inverse * held.free().transpose();
  result.rank = std::lround((inverse * free_form).trace());
  result.open = free_form.rows() - result.rank;
  return result;
}

}  // namespace ifsm::core
