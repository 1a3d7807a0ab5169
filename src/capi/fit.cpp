#include <ifsm.h>

#include <optional>
#include <string>
#include <utility>

#include "capi/fit_options.h"
#include "capi/guarded.h"
#include "capi/nouns.h"
#include "fit/certainty.h"
#include "fit/sparse.h"
#include "fit/tolerance.h"

using namespace ifsm::core;

namespace {

FitOptions options_of(const ifsm_fit_options& given) {
  FitOptions options;
  options.start = borrow_if_any(given.start, "start");
  options.control_points = count_or_none(given.control_points, 16, options.control_points, "control_points");
  options.maps = count_or_none(given.maps, 8, options.maps, "maps");
  options.budgets = budgets_of(given.budgets, given.budget_count);
  options.iterations = count_or(given.iterations, 1000, options.iterations, "iterations");
  options.sparse_rounds = count_or_none(given.rounds, 100, options.sparse_rounds, "rounds");
  options.polish_rounds = count_or_none(given.polish, 100, options.polish_rounds, "polish");
  return options;
}

// None when no bound is given.
std::optional<Tolerance> tolerance_of(const ifsm_fit_options& given, const FitOptions& options) {
  const Tolerance tolerance{positive_or(given.within, 0, "within"),
                            choice(given.distance, Distance::hausdorff, "distance")};
  if (tolerance.bound == 0) return std::nullopt;
  if (!options.budgets.empty())
    throw Error(
        Status::range, "within",
        "within is " + text_of(given.within) + " and there are budgets; a fit is to a bound or to budgets: give one.")
        .with(given.within);
  for (const auto& [value, name] : {std::pair{options.control_points, "control_points"}, {options.maps, "maps"}})
    if (value == 0 && !options.start)
      throw Error(
          Status::range, name,
          std::string(name) + " is -1, which chooses a shape by its errors at budgets; with `within` give a number.")
          .with(-1);
  return tolerance;
}

std::size_t curve_in(const FitResult& fit, int64_t curve) {
  return static_cast<std::size_t>(in_range(curve, 0, static_cast<int64_t>(fit.models.size()) - 1, "curve"));
}

const FitBudget& budget_in(const FitResult& fit, int64_t curve, int64_t budget) {
  const auto& rows = fit.budgets[curve_in(fit, curve)];
  return rows[static_cast<std::size_t>(in_range(budget, 0, static_cast<int64_t>(rows.size()) - 1, "budget"))];
}

const Certainty& certainty_of(const FitResult& fit) {
  if (fit.certainty) return *fit.certainty;
  throw Error(Status::range, "fit", "A fit of stage sparse tells no covariance; ask one of stage curve or filter.");
}

const CurveCertainty& curve_certainty(const FitResult& fit, std::size_t curve) {
  const Certainty& certainty = certainty_of(fit);
  if (!certainty.curves.empty()) return certainty.curves[curve];
  throw Error(Status::range, "fit",
              "A fit of stage filter leaves the control points to analysis and tells no "
              "covariance of them or of the curve; ask one of stage curve.");
}

}  // namespace

ifsm_status ifsm_fit_options_init(ifsm_fit_options* options, uint32_t size) {
  return guarded(__func__, [&] { init_options(options, size); });
}

ifsm_status ifsm_fit_sparse(const ifsm_curve* curves, int64_t curve_count, const ifsm_fit_options* given,
                            ifsm_fit* fit) {
  return guarded(__func__, [&] {
    required(fit, "fit");
    const ifsm_fit_options read = read_options(given);
    const FitOptions options = options_of(read);
    const auto tolerance = tolerance_of(read, options);
    const Threads threads(threads_of(read.threads));
    const auto token = borrow_if_any(read.cancel, "cancel");
    const auto samples = curves_of(curves, curve_count);
    Watch watch(token.get(), progress_of(read));
    auto result = std::make_shared<FitResult>(tolerance ? fit_to_tolerance(samples, options, *tolerance, watch)
                                                        : fit_sparse(samples, options, watch));
    log_summary("ifsm_fit_sparse", *result);
    issue(std::move(result), *fit);
  });
}

ifsm_status ifsm_fit_parameters(ifsm_fit handle, int64_t curve, double* parameters, int64_t capacity, int64_t* count) {
  return guarded(__func__, [&] {
    const auto fit = borrow(handle);
    const std::size_t c = curve_in(*fit, curve);
    const Placement& placement = fit->models[c]->placement();
    const auto where = [&] {
      if (!fit->parameters.empty()) return fit->parameters[c];
      std::vector<double> places;
      for (Index k = 0; k < placement.samples(); ++k) places.push_back(placement.parameter(k));
      return places;
    };
    deliver(placement.samples(), output(parameters, capacity, "parameters"), required(count, "count"), where);
  });
}

ifsm_status ifsm_fit_covariance(ifsm_fit handle, int64_t curve, double* covariance, int64_t capacity, int64_t* count) {
  return guarded(__func__, [&] {
    const auto fit = borrow(handle);
    const std::size_t c = curve_in(*fit, curve);
    const CurveCertainty& own = curve_certainty(*fit, c);
    const Index size = own.control.size();
    deliver(size * size, output(covariance, capacity, "covariance"), required(count, "count"),
            [&] { return control_covariance(*fit->certainty, c); });
  });
}

ifsm_status ifsm_fit_filter_covariance(ifsm_fit handle, double* covariance, int64_t capacity, int64_t* count) {
  return guarded(__func__, [&] {
    const auto fit = borrow(handle);
    const Index size = covariance_size(certainty_of(*fit));
    deliver(size * size, output(covariance, capacity, "covariance"), required(count, "count"),
            [&] { return filter_covariance(*fit->certainty); });
  });
}

ifsm_status ifsm_fit_curve_covariance(ifsm_fit handle, int64_t curve, const double* parameters, int64_t parameter_count,
                                      double* covariance, int64_t capacity, int64_t* count) {
  return guarded(__func__, [&] {
    const auto fit = borrow(handle);
    const std::size_t c = curve_in(*fit, curve);
    const Index dimension = curve_certainty(*fit, c).control.cols();
    const auto at = input(parameters, parameter_count, "parameters", "parameter_count");
    const auto values = [&] {
      return curve_covariance(*fit->certainty, c, {at.data, static_cast<std::size_t>(at.count)}, Watch());
    };
    require_finite(at.data, at.count, "parameters");
    deliver(checked_product(at.count, dimension * dimension, "parameter_count"),
            output(covariance, capacity, "covariance"), required(count, "count"), values);
  });
}

ifsm_status ifsm_fit_model(ifsm_fit handle, int64_t curve, ifsm_model* model) {
  return guarded(__func__, [&] {
    const auto fit = borrow(handle);
    issue(fit->models[curve_in(*fit, curve)], required(model, "model"));
  });
}

ifsm_status ifsm_fit_sketch(ifsm_fit handle, int64_t curve, int64_t budget, ifsm_model* sketch) {
  return guarded(__func__, [&] {
    const auto fit = borrow(handle);
    issue(budget_in(*fit, curve, budget).fitted.model, required(sketch, "sketch"));
  });
}

ifsm_status ifsm_fit_describe(ifsm_fit handle, ifsm_fit_report* report) {
  return guarded(__func__, [&] {
    const auto fit = borrow(handle);
    ifsm_fit_report told{};
    told.reason = static_cast<int32_t>(fit->reason);
    told.curves = static_cast<int64_t>(fit->models.size());
    told.budgets = static_cast<int64_t>(fit->budgets.front().size());
    told.iterations = fit->iterations;
    told.start_cost = fit->start_cost;
    told.final_cost = fit->final_cost;
    told.start_condition = fit->start_condition;
    told.final_condition = fit->final_condition;
    told.stage = static_cast<int32_t>(fit->stage);
    if (fit->certainty) {
      told.freedom = fit->certainty->freedom;
      told.noise = fit->certainty->noise;
    }
    Report(report, "report").write(told);
  });
}

ifsm_status ifsm_fit_describe_budget(ifsm_fit handle, int64_t curve, int64_t budget, ifsm_fit_budget* row) {
  return guarded(__func__, [&] {
    const auto fit = borrow(handle);
    const FitBudget& asked = budget_in(*fit, curve, budget);
    ifsm_fit_budget told{};
    told.budget = asked.budget;
    told.details = asked.details;
    told.start_rms = asked.start.rms;
    told.start_max = asked.start.max;
    told.rms = asked.fitted.rms;
    told.max = asked.fitted.max;
    told.start_details = asked.start.model->details_kept();
    Report(row, "row").write(told);
  });
}

ifsm_status ifsm_fit_destroy(ifsm_fit fit) {
  return guarded(__func__, [&] { destroy(fit); });
}
