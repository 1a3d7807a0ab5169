#include "measure/polyline.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace ifsm::core {
namespace {

double power_of_two_below(double value) { return value > 0 ? std::ldexp(1.0, std::ilogb(value)) : 1.0; }

}  // namespace

Points places(const Model& model) {
  const Points all = points(model, model.levels());
  const Index places = model.placement().places();
  if (all.count() == places) return all;
  Points once(all.dimension(), places);
  once.matrix() = all.matrix().topRows(places);
  return once;
}

Polyline::Polyline(const Model& model) : Polyline(places(model), model.closed()) {}

Polyline::Polyline(const Points& points, bool closed)
    : dimension_(points.dimension()),
      closed_(closed),
      count_(points.count()),
      segments_(count_ < 2 ? 0
                : closed   ? count_
                           : count_ - 1),
      unit_(power_of_two_below(points.matrix().cwiseAbs().maxCoeff())),
      values_(static_cast<std::size_t>(points.size())),
      placement_(count_, count_, closed) {
  points.interleave(values_.data());
  for (double& value : values_) value /= unit_;
  const Eigen::Map<const Eigen::MatrixXd> rows(values_.data(), dimension_, count_);
  diagonal_ = (rows.rowwise().maxCoeff() - rows.rowwise().minCoeff()).stableNorm();
}

double Polyline::parameter(Index segment, double within) const {
  if (segments_ == 0) return 0;
  const double found = (static_cast<double>(segment) + within) / static_cast<double>(segments_);
  return closed_ && found >= 1 ? 0.0 : found;
}

double Polyline::length(Index segment) const {
  const double *a = start(segment), *b = end(segment);
  double square = 0;
  for (Index axis = 0; axis < dimension_; ++axis) square += (b[axis] - a[axis]) * (b[axis] - a[axis]);
  return std::sqrt(square);
}

void require_parameters(bool closed, const double* parameters, Index count, const char* argument) {
  require_finite(parameters, count, argument);
  if (closed) return;
  for (Index i = 0; i < count; ++i)
    if (!(parameters[i] >= 0 && parameters[i] <= 1))
      throw Error(Status::range, argument,
                  std::string(argument) + "[" + std::to_string(i) + "] is " + text_of(parameters[i]) +
                      "; an open curve's parameters run from 0 to 1.")
          .at(i)
          .with(parameters[i]);
}

double in_samples_units(double value, double unit, const char* what) {
  const double scaled = value * unit;
  if (std::isfinite(scaled)) return scaled;
  throw Error(Status::numerical, "model",
              std::string(what) + " leaves the range of doubles; scale the curve down before asking.");
}

}  // namespace ifsm::core
