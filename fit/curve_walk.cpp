#include "fit/curve_walk.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ifsm::core {
namespace {

std::vector<int> all_columns(const Shape& shape) {
  std::vector<int> columns(static_cast<std::size_t>(shape.rows()));
  std::iota(columns.begin(), columns.end(), 0);
  return columns;
}

}  // namespace

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
      maps_(matrix.topRows(shape.control_points()), all_columns(shape)),
      watch_(watch),
      entries_(free_entries(shape, Part::maps)) {}

void CurveWalk::basis(std::span<const Position> positions, const TakeBasis& take) {
  take_ = [&take](Index k, const double* basis, const double*) { take(k, basis); };
  control_ = nullptr;
  start(positions, 0);
}

void CurveWalk::tangents(std::span<const Position> positions, const Lanes& control, const TakeTangent& take) {
  take_ = take;
  control_ = &control;
  start(positions, control.cols() * static_cast<Index>(entries_.size()));
}

void CurveWalk::start(std::span<const Position> positions, Index tangents) {
  const Index n = shape_.control_points(), lanes = n + tangents;
  positions_ = positions;
  buffers_.assign(static_cast<std::size_t>(levels_),
                  std::vector<double>(static_cast<std::size_t>(lanes * shape_.rows())));
  point_.assign(static_cast<std::size_t>(lanes), 0.0);
  polygon_.assign(static_cast<std::size_t>(n), 0.0);
  std::vector<double> root(static_cast<std::size_t>(lanes * n), 0.0);
  for (Index i = 0; i < n; ++i) root[static_cast<std::size_t>(i * n + i)] = 1;
  visit(0, 0, 0, static_cast<Index>(positions.size()), {root.data(), n});
}

// Positions first … last - 1 lie in the node.
void CurveWalk::visit(int level, Index node, Index first, Index last, const Lines& lines) {
  if (first == last) return;
  if (level == levels_) return hand_out(node, first, last, lines);
  watch_.poll();
  double* const fine = buffers_[static_cast<std::size_t>(level)].data();
  const Index rows = shape_.rows();
  maps_(static_cast<Index>(point_.size()), {lines.data, shape_.control_points(), static_cast<int>(lines.step)},
        {nullptr, 0, 0}, fine, nullptr);
  if (control_ != nullptr) add_own_tangent(lines, fine);
  const Index legs = (shape_.line_length(levels_) - 1) / shape_.nodes(level + 1);
  for (int c = 0; c < shape_.maps(); ++c) {
    const Index child = node * shape_.maps() + c;
    const auto beyond = std::partition_point(positions_.begin() + first, positions_.begin() + last,
                                             [&](const Position& p) { return p.leg < (child + 1) * legs; });
    const Index end = c + 1 == shape_.maps() ? last : beyond - positions_.begin();
    visit(level + 1, child, first, end, {fine + c * shape_.polygon_step(), rows});
    first = end;
  }
}

// dx/dC[a, c] at this node: its polygon's point a less the opposite one, at place c.
void CurveWalk::add_own_tangent(const Lines& lines, double* fine) {
  const Index n = shape_.control_points(), rows = shape_.rows();
  double* lane = fine + n * rows;
  for (Index axis = 0; axis < control_->cols(); ++axis) {
    for (Index i = 0; i < n; ++i) {
      double sum = 0;
      for (Index j = 0; j < n; ++j) sum += lines.data[j * lines.step + i] * (*control_)(j, axis);
      polygon_[static_cast<std::size_t>(i)] = sum;
    }
    for (const FreeEntry& entry : entries_) {
      lane[entry.column] +=
          polygon_[static_cast<std::size_t>(entry.row)] - polygon_[static_cast<std::size_t>(entry.opposite)];
      lane += rows;
    }
  }
}

void CurveWalk::hand_out(Index node, Index first, Index last, const Lines& lines) {
  for (Index k = first; k < last; ++k) {
    const Position& at = positions_[static_cast<std::size_t>(k)];
    const double* from = lines.data + (at.leg - node * shape_.polygon_step());
    const double f = at.fraction;
    for (double& value : point_) {
      value = f == 0 ? from[0] : (1 - f) * from[0] + f * from[1];
      from += lines.step;
    }
    take_(k, point_.data(), point_.data() + shape_.control_points());
  }
}

}  // namespace ifsm::core
