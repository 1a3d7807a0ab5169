#include "fit/train.h"

#include <ifsm.h>

#include "capi/fit_options.h"
#include "capi/guarded.h"
#include "capi/nouns.h"
#include "curve/named.h"

using namespace ifsm::core;

namespace {

FilterPtr start_of(const ifsm_train_options& given) {
  if (auto start = borrow_if_any(given.start, "start")) return start;
  const auto n = static_cast<int>(in_range(given.control_points, 0, 16, "control_points"));
  const auto maps = static_cast<int>(in_range(given.maps, 0, 8, "maps"));
  return named_filter("casteljau", Topology::joined, n, maps);
}

TrainOptions options_of(const ifsm_train_options& given) {
  in_range(given.reserved, 0, 0, "reserved");
  TrainOptions options;
  options.start = start_of(given);
  options.budgets = budgets_of(given.budgets, given.budget_count);
  options.hold_out = given.hold_out;
  if (given.hold_out != 0) in_range(given.hold_out, 2, INT32_MAX, "hold_out");
  options.iterations = count_or(given.iterations, 1000, options.iterations, "iterations");
  options.rounds = count_or(given.rounds, 1000, options.rounds, "rounds");
  options.limits.condition = positive_or(given.condition, options.limits.condition, "condition");
  options.limits.reach = positive_or(given.reach, options.limits.reach, "reach");
  return options;
}

ifsm_train_report report_of(const TrainResult& result) {
  ifsm_train_report told{};
  told.reason = static_cast<int32_t>(result.reason);
  told.trained = result.trained;
  told.held_out = result.held_out;
  told.sketches = result.sketches;
  told.rounds = result.rounds;
  told.iterations = result.iterations;
  told.ratio = result.ratio;
  told.held_out_ratio = result.held_out_ratio;
  return told;
}

}  // namespace

ifsm_status ifsm_train_options_init(ifsm_train_options* options, uint32_t size) {
  return guarded(__func__, [&] { init_options(options, size); });
}

ifsm_status ifsm_train(const ifsm_curve* curves, int64_t curve_count, const ifsm_train_options* given,
                       ifsm_filter* filter, ifsm_train_report* report) {
  return guarded(__func__, [&] {
    required(filter, "filter");
    const Report told(report, "report");
    const ifsm_train_options read = read_options(given);
    const TrainOptions options = options_of(read);
    const auto token = borrow_if_any(read.cancel, "cancel");
    const Threads threads(threads_of(read.threads));
    Watch watch(token.get(), progress_of(read));
    const TrainResult result = train(curves_of(curves, curve_count), options, watch);
    issue(result.filter, *filter);
    told.write(report_of(result));
  });
}
