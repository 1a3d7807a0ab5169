// Points of R^d, kept coordinate by coordinate: plane(a) holds coordinate a of every point. Filters act on each
// coordinate alone, so a plane is what the transforms see.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace ifsm::core {

using Index = std::int64_t;

class Points {
 public:
  Points() = default;
  Points(Index dimension, Index count);  // zeros

  // From and to count × dimension doubles, point-major: x0 y0 x1 y1 …
  static Points from_interleaved(const double* values, Index count, Index dimension);
  void interleave(double* values) const;

  Index dimension() const { return dimension_; }
  Index count() const { return count_; }
  Index size() const { return dimension_ * count_; }

  std::span<double> plane(Index axis) { return {values_.data() + axis * count_, static_cast<std::size_t>(count_)}; }
  std::span<const double> plane(Index axis) const {
    return {values_.data() + axis * count_, static_cast<std::size_t>(count_)};
  }

  // count × dimension: a point a row.
  Eigen::Map<Eigen::MatrixXd> matrix() { return {values_.data(), count_, dimension_}; }
  Eigen::Map<const Eigen::MatrixXd> matrix() const { return {values_.data(), count_, dimension_}; }

  // The polygon of `length` points from `first` on, a point a row.
  auto polygon(Index first, Index length) const { return matrix().middleRows(first, length); }

  friend bool operator==(const Points&, const Points&) = default;

 private:
  Index dimension_ = 0;
  Index count_ = 0;
  std::vector<double> values_;
};

// Length of the diagonal of the points' bounding box.
double diagonal(const Points& points);

}  // namespace ifsm::core
