#include "linalg/points.h"

namespace ifsm::core {

Points::Points(Index dimension, Index count)
    : dimension_(dimension), count_(count), values_(static_cast<std::size_t>(dimension * count)) {}

Points Points::from_interleaved(const double* values, Index count, Index dimension) {
  Points points(dimension, count);
  for (Index axis = 0; axis < dimension; ++axis) {
    const auto plane = points.plane(axis);
    for (Index i = 0; i < count; ++i) plane[static_cast<std::size_t>(i)] = values[i * dimension + axis];
  }
  return points;
}

void Points::interleave(double* values) const {
  for (Index axis = 0; axis < dimension_; ++axis) {
    const auto source = plane(axis);
    for (Index i = 0; i < count_; ++i) values[i * dimension_ + axis] = source[static_cast<std::size_t>(i)];
  }
}

double diagonal(const Points& points) {
  if (points.count() == 0) return 0;
  const auto extent = points.matrix().colwise().maxCoeff() - points.matrix().colwise().minCoeff();
  return extent.stableNorm();
}

}  // namespace ifsm::core
