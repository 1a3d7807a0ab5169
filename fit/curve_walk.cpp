#include "fit/curve_walk.h"

#include <algorithm>
#include <cmath>

namespace ifsm::core {

std::vector<Position> positions_of(const Shape& shape, int levels, std::span<const double> parameters) {
  constexpr double epsilon = 2.220446049250313e-16;
  const Index legs = shape.line_length(levels) - 1;
  const auto length = static_cast<double>(legs);
  std::vector<Position> positions;
  positions.reserve(parameters.size());
  for (const double parameter : parameters) {
    const double place = parameter * length, nearest = std::round(place);
    // place / length * length is off by at most one rounding of each of the two operations.
    const double found = std::abs(place - nearest) <= 2 * epsilon * length ? nearest : place;
    const Index leg = std::clamp<Index>(static_cast<Index>(found), 0, legs - 1);
    positions.push_back({leg, found - static_cast<double>(leg)});
  }
  return positions;
}

CurveWalk::CurveWalk(const Shape& shape, int levels, const RowMatrix& matrix, const Watch& watch)
    : shape_(shape),
      levels_(levels),
      maps_(matrix.topRows(shape.control_points()).transpose()),
      watch_(watch),
      entries_(free_entries(shape, Part::maps)) {}

void CurveWalk::basis(std::span<const Position> positions, const TakeBasis& take) {
  take_ = [&take](Index k, const double* basis, const double*) { take(k, basis); };
  start(positions, 0);
}

void CurveWalk::tangents(std::span<const Position> positions, const Lanes& control, const TakeTangent& take) {
  take_ = take;
  control_ = &control;
  start(positions, control.cols() * static_cast<Index>(entries_.size()));
}

void CurveWalk::start(std::span<const Position> positions, Index lanes) {
  const int n = shape_.control_points();
  positions_ = positions;
  buffers_.clear();
  for (int level = 0; level < levels_; ++level)
    buffers_.push_back({Lanes(shape_.rows(), n), Lanes(shape_.rows(), lanes)});
  basis_.setZero(n);
  tangent_.setZero(lanes);
  visit(0, 0, 0, static_cast<Index>(positions.size()), Lanes::Identity(n, n), Lanes::Zero(n, lanes));
}

// Positions first … last - 1 lie in the node. A polygon's basis: a point a row, in terms of the control points.
void CurveWalk::visit(int level, Index node, Index first, Index last, const Eigen::Ref<const Lanes>& basis,
                      const Eigen::Ref<const Lanes>& tangent) {
  if (first == last) return;
  if (level == levels_) return hand_out(node, first, last, basis, tangent);
  watch_.poll();
  const int n = shape_.control_points(), step = shape_.polygon_step();
  Buffers& b = buffers_[static_cast<std::size_t>(level)];
  b.basis.noalias() = maps_ * basis;
  if (b.tangent.cols() > 0) {
    if (level == 0)
      b.tangent.setZero();
    else
      b.tangent.noalias() = maps_ * tangent;
    add_own_tangent(basis, b.tangent);
  }
  const Index legs = (shape_.line_length(levels_) - 1) / shape_.nodes(level + 1);
  for (int c = 0; c < shape_.maps(); ++c) {
    const Index child = node * shape_.maps() + c;
    const auto beyond = std::partition_point(positions_.begin() + first, positions_.begin() + last,
                                             [&](const Position& p) { return p.leg < (child + 1) * legs; });
    const Index end = c + 1 == shape_.maps() ? last : beyond - positions_.begin();
    visit(level + 1, child, first, end, b.basis.middleRows(c * step, n), b.tangent.middleRows(c * step, n));
    first = end;
  }
}

// dx/dC[a, c] at this node: its polygon's point a less the opposite one, at place c.
void CurveWalk::add_own_tangent(const Eigen::Ref<const Lanes>& basis, Lanes& tangent) const {
  const Lanes polygon = basis * *control_;
  const auto count = static_cast<Index>(entries_.size());
  for (Index axis = 0; axis < polygon.cols(); ++axis)
    for (Index p = 0; p < count; ++p) {
      const FreeEntry& entry = entries_[static_cast<std::size_t>(p)];
      tangent(entry.column, axis * count + p) += polygon(entry.row, axis) - polygon(entry.opposite, axis);
    }
}

void CurveWalk::hand_out(Index node, Index first, Index last, const Eigen::Ref<const Lanes>& basis,
                         const Eigen::Ref<const Lanes>& tangent) {
  for (Index k = first; k < last; ++k) {
    const Position& at = positions_[static_cast<std::size_t>(k)];
    const Index leg = at.leg - node * shape_.polygon_step();
    basis_ = (1 - at.fraction) * basis.row(leg) + at.fraction * basis.row(leg + 1);
    tangent_ = (1 - at.fraction) * tangent.row(leg) + at.fraction * tangent.row(leg + 1);
    take_(k, basis_.data(), tangent_.data());
  }
}

}  // namespace ifsm::core
