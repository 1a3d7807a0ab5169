#include "fit/target.h"

#include <cmath>

#include "linalg/spectrum.h"

namespace ifsm::core {
namespace {

[[noreturn]] void refuse(Status status, const std::string& argument, Index index, double value,
                         const std::string& what) {
  throw Error(status, argument, argument + "[" + std::to_string(index) + "] is " + text_of(value) + "; " + what)
      .at(index)
      .with(value);
}

void require_length(const std::vector<double>& values, Index needed, const std::string& argument,
                    const std::string& unit) {
  const auto count = static_cast<Index>(values.size());
  if (count == needed) return;
  throw Error(
      Status::shape, argument,
      argument + " holds " + std::to_string(count) + " numbers; give " + std::to_string(needed) + ": " + unit + ".")
      .with(static_cast<double>(count))
      .needs(needed);
}

void require_parameters(const Target& target, const std::vector<double>& given, const std::string& argument) {
  require_length(given, target.count(), argument, "one a sample");
  require_finite(given.data(), target.count(), argument.c_str());
  for (std::size_t k = 0; k < given.size(); ++k) {
    if (!(given[k] >= 0 && given[k] <= 1) || (target.closed && given[k] == 1))
      refuse(Status::range, argument, static_cast<Index>(k), given[k],
             target.closed ? "a ring's parameters lie from 0 to below 1: scale them."
                           : "parameters lie from 0 to 1: scale them.");
    if (k > 0 && !(given[k] > given[k - 1]))
      refuse(Status::range, argument, static_cast<Index>(k), given[k],
             "it must be above the one before, " + text_of(given[k - 1]) + ": order the samples by parameter.");
  }
}

// Lengths between samples to a power: 1, or 1/2 (centripetal: long jumps count less).
std::vector<double> by_length(const Target& target, double power) {
  const Index m = target.count();
  std::vector<double> along(static_cast<std::size_t>(m), 0.0);
  const auto length = [&](Index a, Index b) {
    return std::pow((target.samples.row(a) - target.samples.row(b)).norm(), power);
  };
  for (Index k = 1; k < m; ++k)
    along[static_cast<std::size_t>(k)] = along[static_cast<std::size_t>(k - 1)] + length(k, k - 1);
  const double whole = along.back() + (target.closed ? length(m - 1, 0) : 0.0);
  if (!(whole > 0)) return {};
  for (double& at : along) at = std::min(at / whole, 1.0);
  return along;
}

std::vector<double> by_index(const Model& model) {
  std::vector<double> parameters;
  for (Index k = 0; k < model.placement().samples(); ++k) parameters.push_back(model.placement().parameter(k));
  return parameters;
}

void require_weights(const Target& target, const std::vector<double>& weights, const std::string& argument) {
  require_length(weights, target.count(), argument, "one a sample");
  require_finite(weights.data(), target.count(), argument.c_str());
  for (std::size_t k = 0; k < weights.size(); ++k)
    if (!(weights[k] > 0))
      refuse(Status::range, argument, static_cast<Index>(k), weights[k],
             "weights are above 0: leave a sample out that is not to count.");
}

Lanes whitened(const Target& target, const std::vector<double>& covariances, const std::string& argument) {
  const Index d = target.dimension;
  require_length(covariances, target.count() * d * d, argument, "dimension × dimension a sample");
  require_finite(covariances.data(), target.count() * d * d, argument.c_str());
  Lanes whitening(target.count() * d, d);
  for (Index k = 0; k < target.count(); ++k) {
    const Eigen::Map<const RowMatrix> given(covariances.data() + k * d * d, d, d);
    const double scale = given.cwiseAbs().maxCoeff();
    // Symmetric up to what a caller's own arithmetic may have done to it: some hundred roundings.
    const bool symmetric = (given - given.transpose()).cwiseAbs().maxCoeff() <= 1e-13 * scale;
    const Eigen::MatrixXd upper = symmetric ? cholesky(given) : Eigen::MatrixXd();
    if (upper.size() == 0 || !(upper.diagonal().minCoeff() > 1e-8 * std::sqrt(scale)))  // condition beyond 1e16
      throw Error(Status::range, argument,
                  argument + ": matrix " + std::to_string(k) +
                      " is not symmetric and positive definite; give the covariance of that sample's error, or a "
                      "weight instead.")
          .at(k * d * d)
          .with(covariances[static_cast<std::size_t>(k * d * d)]);
    whitening.middleRows(k * d, d) = inverse(upper).transpose();  // Σ = UᵀU, W = U^-T
  }
  return whitening;
}

void require_constraint(const Target& target, const Constraint& constraint, Index index, const std::string& prefix) {
  const std::string kinds = prefix + "constraint_kinds", parameters = prefix + "constraint_parameters",
                    values = prefix + "constraint_values";
  const auto d = static_cast<Index>(constraint.value.size());
  if (d != target.dimension) require_length(constraint.value, target.dimension, values, "one a coordinate");
  for (Index axis = 0; axis < d; ++axis)
    if (const double value = constraint.value[static_cast<std::size_t>(axis)]; !std::isfinite(value))
      refuse(Status::not_finite, values, index * d + axis, value, "every value must be finite: replace it.");
  if (!(constraint.parameter >= 0 && constraint.parameter <= 1))
    refuse(std::isfinite(constraint.parameter) ? Status::range : Status::not_finite, parameters, index,
           constraint.parameter, "constraints lie at parameters from 0 to 1.");
  if (constraint.kind != ConstraintKind::tangent) return;
  if (constraint.parameter != 0 && constraint.parameter != 1)
    refuse(Status::range, parameters, index, constraint.parameter,
           "tangents can be given at the ends, 0 and 1; give points to pass through elsewhere.");
  if (d == 1)
    refuse(Status::range, kinds, index, static_cast<double>(constraint.kind),
           "a curve of one dimension has no direction; give points to pass through.");
  for (const double value : constraint.value)
    if (value != 0) return;
  refuse(Status::range, values, index * d, 0, "a tangent needs a direction: give a vector that is not zero.");
}

}  // namespace

double Target::squared(Index k, const Eigen::Ref<const Eigen::RowVectorXd>& error) const {
  if (whitening.rows() > 0) return (whitening.middleRows(k * dimension, dimension) * error.transpose()).squaredNorm();
  return error.squaredNorm() * (weights.empty() ? 1.0 : weights[static_cast<std::size_t>(k)]);
}

Target make_target(const FitCurve& curve, const FitSamples& given, ParameterRule rule, const Model& model,
                   const std::string& prefix) {
  Target target;
  target.dimension = curve.samples.dimension();
  target.closed = curve.closed;
  target.center = model.parts().center;
  target.diagonal = model.parts().diagonal;
  target.samples = to_center(curve.samples, target.center).matrix();
  if (rule == ParameterRule::given)
    require_parameters(target, given.parameters, prefix + "parameters");
  else if (!given.parameters.empty())
    throw Error(Status::range, prefix + "parameters",
                "Parameters are given, and the rule says to compute them; set the rule to given parameters, or leave "
                "them out.");
  if (rule == ParameterRule::given) target.parameters = given.parameters;
  if (rule == ParameterRule::chord) target.parameters = by_length(target, 1);
  if (rule == ParameterRule::centripetal) target.parameters = by_length(target, 0.5);
  if (target.parameters.empty()) target.parameters = by_index(model);  // or all samples are one point

  if (!given.weights.empty() && !given.covariances.empty())
    throw Error(Status::range, prefix + "covariances",
                "Weights and covariances are given; a covariance says what a weight says: give one of them.");
  if (!given.weights.empty()) require_weights(target, given.weights, prefix + "weights");
  target.weights = given.weights;
  if (!given.covariances.empty()) target.whitening = whitened(target, given.covariances, prefix + "covariances");

  target.constraints = given.constraints;
  target.fixed_ends = given.fixed_ends;
  for (std::size_t i = 0; i < target.constraints.size(); ++i) {
    Constraint& constraint = target.constraints[i];
    require_constraint(target, constraint, static_cast<Index>(i), prefix);
    if (constraint.kind != ConstraintKind::point) continue;
    for (std::size_t axis = 0; axis < constraint.value.size(); ++axis) constraint.value[axis] -= target.center[axis];
  }
  return target;
}

}  // namespace ifsm::core
