#include "capi/fit_options.h"
#include "capi/guarded.h"
#include "capi/nouns.h"
#include "fit/filter_stage.h"

using namespace ifsm::core;

namespace {

FilterOptions options_of(const ifsm_fit_filter_options& given) {
  FilterOptions options;
  options.start = borrow_if_any(given.start, "start");
  options.control_points = count_or(given.control_points, 16, options.control_points, "control_points");
  options.maps = count_or(given.maps, 8, options.maps, "maps");
  options.kept_levels = count_or_none(given.kept_levels, 40, options.kept_levels, "kept_levels");
  options.iterations = count_or(given.iterations, 1000, options.iterations, "iterations");
  options.tolerance = positive_or(given.tolerance, options.tolerance, "tolerance");
  return options;
}

}  // namespace

ifsm_status ifsm_fit_filter_options_init(ifsm_fit_filter_options* options, uint32_t size) {
  return guarded(__func__, [&] { init_options(options, size); });
}

ifsm_status ifsm_fit_filter(const ifsm_curve* curves, int64_t curve_count, const ifsm_fit_filter_options* given,
                            ifsm_fit* fit) {
  return guarded(__func__, [&] {
    required(fit, "fit");
    const ifsm_fit_filter_options read = read_options(given);
    const FilterOptions options = options_of(read);
    const Threads threads(threads_of(read.threads));
    const auto token = borrow_if_any(read.cancel, "cancel");
    const auto copies = curves_of(curves, curve_count);
    Watch watch(token.get(), progress_of(read));
    auto result = std::make_shared<FitResult>(fit_filter(copies, options, watch));
    log_summary("ifsm_fit_filter", *result);
    issue(std::move(result), *fit);
  });
}
