#include <ifsm.h>

#include <string>
#include <vector>

#include "base/cancel.h"
#include "base/parallel.h"
#include "capi/arguments.h"
#include "capi/fitting.h"
#include "capi/guarded.h"
#include "capi/log.h"
#include "capi/nouns.h"
#include "fit/sparse.h"

using namespace ifsm::core;

namespace {

FitOptions options_of(const ifsm_fit_options& given) {
  in_range(given.reserved, 0, 0, "reserved");
  FitOptions options;
  options.start = borrow_if_any(given.start, "start");
  options.control_points = count_or_none(given.control_points, 16, options.control_points, "control_points");
  options.maps = count_or_none(given.maps, 8, options.maps, "maps");
  options.budgets = budgets_of(given.budgets, given.budget_count);
  options.iterations = count_or(given.iterations, 1000, options.iterations, "iterations");
  options.sparse_rounds = count_or(given.rounds, 100, options.sparse_rounds, "rounds");
  options.polish_rounds = count_or_none(given.polish, 100, options.polish_rounds, "polish");
  return options;
}

void log_summary(const FitResult& fit) {
  log(LogLevel::info,
      ("ifsm_fit_sparse: " + std::to_string(fit.iterations) + " iterations, cost " + text_of(fit.start_cost) + " to " +
       text_of(fit.final_cost) + ", condition " + text_of(fit.start_condition) + " to " + text_of(fit.final_condition))
          .c_str());
}

std::size_t curve_in(const FitResult& fit, int64_t curve) {
  return static_cast<std::size_t>(in_range(curve, 0, static_cast<int64_t>(fit.models.size()) - 1, "curve"));
}

const FitBudget& budget_in(const FitResult& fit, int64_t curve, int64_t budget) {
  const auto& rows = fit.budgets[curve_in(fit, curve)];
  return rows[static_cast<std::size_t>(in_range(budget, 0, static_cast<int64_t>(rows.size()) - 1, "budget"))];
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
    const Threads threads(static_cast<int>(in_range(read.threads, 0, 1024, "threads")));
    const auto token = borrow_if_any(read.cancel, "cancel");
    const auto samples = curves_of(curves, curve_count);
    Watch watch(token.get(), progress_of(read.progress, read.user));
    auto result = std::make_shared<FitResult>(fit_sparse(samples, options, watch));
    log_summary(*result);
    issue(std::move(result), *fit);
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
    Report(row, "row").write(told);
  });
}

ifsm_status ifsm_fit_destroy(ifsm_fit fit) {
  return guarded(__func__, [&] { destroy(fit); });
}
