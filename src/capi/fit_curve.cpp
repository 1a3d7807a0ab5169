#include "capi/fit_options.h"
#include "capi/guarded.h"
#include "capi/nouns.h"
#include "fit/curve_stage.h"

using namespace ifsm::core;

namespace {

constexpr int64_t most_constraints = 1024;
constexpr int32_t most_rounds = 10000;

std::vector<double> copied(const double* values, int64_t count, const std::string& argument,
                           const std::string& count_argument) {
  const auto given = input(values, count, argument.c_str(), count_argument.c_str());
  return {given.begin(), given.end()};
}

std::vector<Constraint> constraints_of(const ifsm_fit_samples& given, int64_t dimension, const std::string& prefix) {
  const int64_t count = in_range(given.constraint_count, 0, most_constraints, (prefix + "constraint_count").c_str());
  if (count == 0) return {};
  required(given.constraint_kinds, (prefix + "constraint_kinds").c_str());
  required(given.constraint_parameters, (prefix + "constraint_parameters").c_str());
  required(given.constraint_values, (prefix + "constraint_values").c_str());
  std::vector<Constraint> constraints;
  for (int64_t i = 0; i < count; ++i) {
    const int32_t kind = given.constraint_kinds[i];
    if (kind != IFSM_CONSTRAINT_POINT && kind != IFSM_CONSTRAINT_TANGENT)
      throw Error(Status::range, prefix + "constraint_kinds",
                  prefix + "constraint_kinds[" + std::to_string(i) + "] is " + std::to_string(kind) +
                      "; give IFSM_CONSTRAINT_POINT or IFSM_CONSTRAINT_TANGENT.")
          .at(i)
          .with(kind);
    const double* value = given.constraint_values + i * dimension;
    constraints.push_back(
        {static_cast<ConstraintKind>(kind), given.constraint_parameters[i], {value, value + dimension}});
  }
  return constraints;
}

FitSamples samples_of(const ifsm_fit_samples& given, int64_t dimension, const std::string& prefix) {
  FitSamples samples;
  samples.parameters =
      copied(given.parameters, given.parameter_count, prefix + "parameters", prefix + "parameter_count");
  samples.weights = copied(given.weights, given.weight_count, prefix + "weights", prefix + "weight_count");
  samples.covariances =
      copied(given.covariances, given.covariance_count, prefix + "covariances", prefix + "covariance_count");
  samples.constraints = constraints_of(given, dimension, prefix);
  samples.fixed_ends = in_range(given.fixed_ends, 0, 1, (prefix + "fixed_ends").c_str()) == 1;
  in_range(given.reserved, 0, 0, (prefix + "reserved").c_str());
  return samples;
}

Loss loss_of(const ifsm_fit_curve_options& given) {
  const auto kind = choice(given.loss, LossKind::tukey, "loss");
  require_finite(given.loss_scale, "loss_scale");
  return {kind, kind == LossKind::squares ? 1 : given.loss_scale};
}

CurveOptions options_of(const ifsm_fit_curve_options& given) {
  in_range(given.reserved, 0, 0, "reserved");
  CurveOptions options;
  options.start = borrow_if_any(given.start, "start");
  options.control_points = count_or(given.control_points, 16, options.control_points, "control_points");
  options.maps = count_or(given.maps, 8, options.maps, "maps");
  options.fixed_filter = in_range(given.fixed_filter, 0, 1, "fixed_filter") == 1;
  options.parameters = choice(given.parameters, ParameterRule::given, "parameters");
  options.reparameterise = count_or(given.reparameterise, most_rounds, 0, "reparameterise");
  options.loss = loss_of(given);
  options.levels = count_or(given.levels, 39, 0, "levels");
  options.starts = count_or(given.starts, 3, options.starts, "starts");
  options.iterations = count_or(given.iterations, 1000, options.iterations, "iterations");
  options.tolerance = positive_or(given.tolerance, options.tolerance, "tolerance");
  in_range(given.sample_count, 0, most_curves, "sample_count");
  if (given.sample_count > 0) required(given.samples, "samples");
  return options;
}

}  // namespace

ifsm_status ifsm_fit_curve_options_init(ifsm_fit_curve_options* options, uint32_t size) {
  return guarded(__func__, [&] { init_options(options, size); });
}

ifsm_status ifsm_fit_curve(const ifsm_curve* curves, int64_t curve_count, const ifsm_fit_curve_options* given,
                           ifsm_fit* fit) {
  return guarded(__func__, [&] {
    required(fit, "fit");
    const ifsm_fit_curve_options read = read_options(given);
    CurveOptions options = options_of(read);
    const Threads threads(threads_of(read.threads));
    const auto token = borrow_if_any(read.cancel, "cancel");
    const auto copies = curves_of(curves, curve_count);
    for (int64_t c = 0; c < read.sample_count; ++c)
      options.samples.push_back(
          samples_of(read.samples[c], copies.front().samples.dimension(), "samples[" + std::to_string(c) + "]."));
    Watch watch(token.get(), progress_of(read));
    auto result = std::make_shared<FitResult>(fit_curve(copies, options, watch));
    log_summary("ifsm_fit_curve", *result);
    issue(std::move(result), *fit);
  });
}
