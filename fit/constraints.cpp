#include "fit/constraints.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <map>

#include "fit/curve_walk.h"

namespace ifsm::core {
namespace {

// An equation whose new part is smaller than this, its own size being 1, follows from those before: what is left is
// rounding, or would be magnified beyond the promise of 1e-10.
constexpr double dependent = 1e-6;
// Two equations that depend on each other agree when they do up to this, relative to the curve.
constexpr double agreeing = 1e-9;

// Rows that complete a unit vector to an orthonormal basis.
Eigen::MatrixXd across(const Eigen::RowVectorXd& direction) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> factor(direction.transpose());
  const Eigen::MatrixXd basis = factor.householderQ() * Eigen::MatrixXd::Identity(direction.size(), direction.size());
  return basis.rightCols(direction.size() - 1).transpose();
}

}  // namespace

Eigen::VectorXd stacked(const Lanes& control) {
  return Eigen::Map<const Eigen::VectorXd>(control.data(), control.size());
}

Lanes unstacked(const Eigen::VectorXd& stacked, Index dimension) {
  return Eigen::Map<const Lanes>(stacked.data(), stacked.size() / dimension, dimension);
}

Held::Held(const Eigen::MatrixXd& equations, const Eigen::VectorXd& values, double scale) {
  const Index count = equations.rows(), unknowns = equations.cols();
  Eigen::MatrixXd rows(count, unknowns), mixing = Eigen::MatrixXd::Zero(count, count);
  Eigen::VectorXd right(count);
  Index rank = 0;
  for (Index e = 0; e < count; ++e) {
    const double size = equations.row(e).norm();
    Eigen::RowVectorXd row = equations.row(e), mix = Eigen::RowVectorXd::Unit(count, e);
    double value = values(e);
    for (int twice = 0; twice < 2; ++twice)  // the second time takes away what rounding left of the first
      for (Index r = 0; r < rank; ++r) {
        const double part = rows.row(r).dot(row);
        row -= part * rows.row(r);
        mix -= part * mixing.row(r);
        value -= part * right(r);
      }
    const double left = row.norm();
    if (left > dependent * size) {
      rows.row(rank) = row / left;
      mixing.row(rank) = mix / left;
      right(rank++) = value / left;
    } else if (conflict_ < 0 && !(std::abs(value) <= agreeing * scale * std::max(size, 1e-300))) {
      conflict_ = e;
    }
  }
  rows_ = rows.topRows(rank);
  mixing_ = mixing.topRows(rank);
  values_ = right.head(rank);
  if (rank == 0) {
    free_ = Eigen::MatrixXd::Identity(unknowns, unknowns);
    return;
  }
  const Eigen::HouseholderQR<Eigen::MatrixXd> factor(rows_.transpose());
  const Eigen::MatrixXd basis = factor.householderQ() * Eigen::MatrixXd::Identity(unknowns, unknowns);
  free_ = basis.rightCols(unknowns - rank);
}

Eigen::VectorXd Held::nearest(const Eigen::VectorXd& control) const {
  if (empty()) return control;
  return control - rows_.transpose() * (rows_ * control - values_);
}

Eigen::MatrixXd Held::follow(const Eigen::MatrixXd& moved) const { return -rows_.transpose() * (mixing_ * moved); }

ConstraintSet::ConstraintSet(const Target& target, const Shape& shape, int levels)
    : shape_(shape), levels_(levels), dimension_(target.dimension) {
  constexpr Index ring = -1, ends = -2;
  if (target.closed)
    for (Index axis = 0; axis < dimension_; ++axis)
      demands_.push_back({Eigen::RowVectorXd::Unit(dimension_, axis), 1, 0, 0, ring});
  if (target.fixed_ends) {
    demand_point(0, target.samples.row(0), ends);
    if (!target.closed) demand_point(1, target.samples.row(target.count() - 1), ends);
  }
  for (std::size_t i = 0; i < target.constraints.size(); ++i) {
    const Constraint& constraint = target.constraints[i];
    const Eigen::Map<const Eigen::RowVectorXd> value(constraint.value.data(), dimension_);
    if (constraint.kind == ConstraintKind::point)
      demand_point(constraint.parameter, value, static_cast<Index>(i));
    else
      demand_tangent(constraint.parameter, value.stableNormalized(), static_cast<Index>(i));
  }
}

void ConstraintSet::demand_point(double parameter, const Eigen::RowVectorXd& point, Index constraint) {
  for (Index axis = 0; axis < dimension_; ++axis)
    demands_.push_back({Eigen::RowVectorXd::Unit(dimension_, axis), parameter, none, point(axis), constraint});
}

// The first or the last leg of the polyline; of a smooth curve, its tangent in the limit of many levels.
void ConstraintSet::demand_tangent(double parameter, const Eigen::RowVectorXd& direction, Index constraint) {
  const double leg = 1 / static_cast<double>(shape_.line_length(levels_) - 1);
  const Eigen::MatrixXd normals = across(direction);
  for (Index r = 0; r < normals.rows(); ++r)
    demands_.push_back({normals.row(r), parameter == 0 ? leg : 1.0, parameter == 0 ? 0.0 : 1 - leg, 0, constraint});
}

std::vector<double> ConstraintSet::sorted_parameters() const {
  std::vector<double> parameters;
  for (const Demand& demand : demands_) {
    parameters.push_back(demand.to);
    if (demand.from != none) parameters.push_back(demand.from);
  }
  std::ranges::sort(parameters);
  parameters.erase(std::unique(parameters.begin(), parameters.end()), parameters.end());
  return parameters;
}

Equations ConstraintSet::equations(const RowMatrix& matrix, const Watch& watch) const {
  const int n = shape_.control_points();
  const std::vector<double> parameters = sorted_parameters();
  std::map<double, Eigen::RowVectorXd> basis;
  CurveWalk(shape_, levels_, matrix, watch)
      .basis(positions_of(shape_, levels_, parameters), [&](Index k, const double* values) {
        basis[parameters[static_cast<std::size_t>(k)]] = Eigen::Map<const Eigen::RowVectorXd>(values, n);
      });
  const auto count = static_cast<Index>(demands_.size());
  Equations equations{Eigen::MatrixXd(count, n * dimension_), Eigen::VectorXd(count), {}};
  for (Index e = 0; e < count; ++e) {
    const Demand& demand = demands_[static_cast<std::size_t>(e)];
    Eigen::RowVectorXd along = basis[demand.to];
    if (demand.from != none) along -= basis[demand.from];
    for (int i = 0; i < n; ++i) equations.left.row(e).segment(i * dimension_, dimension_) = along(i) * demand.direction;
    equations.right(e) = demand.value;
    equations.constraint.push_back(demand.constraint);
  }
  return equations;
}

Eigen::MatrixXd ConstraintSet::tangents(const RowMatrix& matrix, const Lanes& control, const Watch& watch) const {
  const Index parameter_count = free_count(shape_, Part::maps);
  const std::vector<double> parameters = sorted_parameters();
  std::map<double, Lanes> moved;  // coordinate × parameter
  CurveWalk(shape_, levels_, matrix, watch)
      .tangents(positions_of(shape_, levels_, parameters), control, [&](Index k, const double*, const double* tangent) {
        moved[parameters[static_cast<std::size_t>(k)]] = Eigen::Map<const Lanes>(tangent, dimension_, parameter_count);
      });
  const auto count = static_cast<Index>(demands_.size());
  Eigen::MatrixXd tangents(count, parameter_count);
  for (Index e = 0; e < count; ++e) {
    const Demand& demand = demands_[static_cast<std::size_t>(e)];
    tangents.row(e) = demand.direction * moved[demand.to];
    if (demand.from != none) tangents.row(e) -= demand.direction * moved[demand.from];
  }
  return tangents;
}

void require_consistent(const Target& target, const ConstraintSet& constraints, const RowMatrix& matrix,
                        const std::string& prefix, const Watch& watch) {
  if (constraints.empty()) return;
  const Equations equations = constraints.equations(matrix, watch);
  const Held held(equations.left, equations.right, target.diagonal + equations.right.cwiseAbs().maxCoeff());
  if (held.conflict() < 0) return;
  const Index blamed = equations.constraint[static_cast<std::size_t>(held.conflict())];
  const Index unknowns = equations.left.cols();
  const std::string room = std::to_string(unknowns / target.dimension) + " control points have " +
                           std::to_string(unknowns) + " coordinates, and the constraints that agree hold " +
                           std::to_string(held.rank()) + " of them";
  if (blamed < 0)
    throw Error(Status::range, prefix + "fixed_ends",
                "The ends cannot be fixed: " + room + ". Use more control points, or leave the ends free.");
  throw Error(Status::range, prefix + "constraint_values",
              "Constraint " + std::to_string(blamed) + " contradicts those before it: " + room +
                  ". Take it away, give it another parameter, or use more control points.")
      .at(blamed * target.dimension)
      .with(target.constraints[static_cast<std::size_t>(blamed)].value.front());
}

}  // namespace ifsm::core
