#include "curve/model.h"

#include <ifsm.h>

#include <span>

#include "base/cancel.h"
#include "capi/arguments.h"
#include "capi/curves.h"
#include "capi/guarded.h"
#include "capi/nouns.h"
#include "capi/options.h"
#include "curve/evaluate.h"
#include "curve/frames.h"
#include "curve/keep.h"
#include "curve/significance.h"
#include "fit/within.h"
#include "io/model_reader.h"
#include "io/model_writer.h"

using namespace ifsm::core;

namespace {

constexpr int64_t longest_address = 1024;

Frame frame_of(int32_t frame) { return choice(frame, Frame::node, "frame"); }

int level_of_details(const Model& model, int32_t level) {
  if (model.levels() == 0)
    throw Error(Status::range, "level", "The model has no levels, hence no details; give it more levels.");
  return static_cast<int>(in_range(level, 0, model.levels() - 1, "level"));
}

Kept kept_details(const Model& model, const ifsm_keep_options& options) {
  switch (options.rule) {
    case IFSM_KEEP_LEVELS: return first_levels(model, options.count);
    case IFSM_KEEP_COUNT: return most_significant(model, options.count);
    default: require_finite(options.threshold, "threshold"); return above(model, options.threshold);
  }
}

void require_whole_levels(Resolve how) {
  if (how == Resolve::choice)
    throw Error(Status::range, "resolve",
                "resolve is IFSM_RESOLVE_CHOICE, which would break up the levels that IFSM_KEEP_LEVELS_WITHIN keeps; "
                "give IFSM_RESOLVE_VALUES, or the rule IFSM_KEEP_WITHIN.")
        .with(IFSM_RESOLVE_CHOICE);
}

ModelPtr kept_model(const Model& model, const ifsm_keep_options& options, Watch& watch) {
  in_range(options.rule, IFSM_KEEP_LEVELS, IFSM_KEEP_LEVELS_WITHIN, "rule");
  const auto how = choice(options.resolve, Resolve::choice, "resolve");
  const auto by = choice(options.distance, Distance::hausdorff, "distance");
  if (options.rule == IFSM_KEEP_WITHIN) return keep_within(model, options.threshold, how, by, watch);
  if (options.rule == IFSM_KEEP_LEVELS_WITHIN) {
    require_whole_levels(how);
    return keep_levels_within(model, options.threshold, how, by, watch);
  }
  return resolved(model, kept_details(model, options), how, by, watch);
}

}  // namespace

ifsm_status ifsm_model_options_init(ifsm_model_options* options, uint32_t size) {
  return guarded(__func__, [&] { init_options(options, size); });
}

ifsm_status ifsm_model_create(ifsm_filter filter_handle, const ifsm_curve* curve, const ifsm_model_options* options,
                              ifsm_model* model) {
  return guarded(__func__, [&] {
    const auto filter = borrow(filter_handle);
    const Points samples = samples_of(required(curve, "curve"));
    const int levels = read_options(options).levels;
    required(model, "model");
    issue(analyze(filter, samples, is_closed(*curve), levels), *model);
  });
}

ifsm_status ifsm_model_from_polygon(ifsm_filter filter_handle, const ifsm_curve* polygon, int32_t levels,
                                    ifsm_model* model) {
  return guarded(__func__, [&] {
    const auto filter = borrow(filter_handle);
    const Points points = polygon_of(required(polygon, "polygon"));
    required(model, "model");
    issue(from_polygon(filter, points, is_closed(*polygon), levels), *model);
  });
}

ifsm_status ifsm_model_describe(ifsm_model handle, ifsm_model_info* info) {
  return guarded(__func__, [&] {
    const auto model = borrow(handle);
    ifsm_model_info told{};
    told.dimension = static_cast<int32_t>(model->dimension());
    told.closed = model->closed() ? 1 : 0;
    told.levels = model->levels();
    told.control_points = model->shape().control_points();
    told.maps = model->shape().maps();
    told.topology = static_cast<int32_t>(model->shape().topology());
    told.details_per_node = model->shape().details_per_node();
    told.samples = model->placement().samples();
    told.places = model->placement().places();
    told.details = model->details_total();
    told.details_kept = model->details_kept();
    told.diagonal = model->parts().diagonal;
    const auto& parts = model->parts();
    told.largest_polygon = parts.diagonal > 0 ? parts.largest_polygon / parts.diagonal : 0.0;
    Report(info, "info").write(told);
  });
}

ifsm_status ifsm_model_filter(ifsm_model handle, ifsm_filter* filter) {
  return guarded(__func__, [&] {
    const auto model = borrow(handle);
    issue(model->parts().filter, required(filter, "filter"));
  });
}

ifsm_status ifsm_model_destroy(ifsm_model model) {
  return guarded(__func__, [&] { destroy(model); });
}

ifsm_status ifsm_model_samples(ifsm_model handle, double* points, int64_t capacity, int64_t* count) {
  return guarded(__func__, [&] {
    const auto model = borrow(handle);
    deliver(model->placement().samples() * model->dimension(), output(points, capacity, "points"),
            required(count, "count"), [&] { return samples(*model); });
  });
}

ifsm_status ifsm_model_points(ifsm_model handle, int32_t level, double* points, int64_t capacity, int64_t* count) {
  return guarded(__func__, [&] {
    const auto model = borrow(handle);
    in_range(level, 0, model->levels(), "level");
    // Joined and closed: the first point is told again at the end, which places() does not count.
    const bool repeated = model->closed() && model->shape().joined();
    const int64_t told = model->shape().places(level, model->closed()) + (repeated ? 1 : 0);
    deliver(told * model->dimension(), output(points, capacity, "points"), required(count, "count"),
            [&] { return ifsm::core::points(*model, level); });
  });
}

ifsm_status ifsm_model_evaluate(ifsm_model handle, int32_t curve, const double* parameters, int64_t parameter_count,
                                double* points, int64_t capacity, int64_t* count) {
  return guarded(__func__, [&] {
    const auto model = borrow(handle);
    const Curve followed = choice(curve, Curve::limit, "curve");
    const auto given = input(parameters, parameter_count, "parameters", "parameter_count");
    deliver(checked_product(given.count, model->dimension(), "parameter_count"), output(points, capacity, "points"),
            required(count, "count"), [&] {
              return evaluate(*model, followed, {given.begin(), given.end()});
            });
  });
}

ifsm_status ifsm_model_parameters(ifsm_model handle, double* parameters, int64_t capacity, int64_t* count) {
  return guarded(__func__, [&] {
    const auto model = borrow(handle);
    const Placement& placement = model->placement();
    deliver(placement.samples(), output(parameters, capacity, "parameters"), required(count, "count"), [&] {
      std::vector<double> told(static_cast<std::size_t>(placement.samples()));
      for (std::size_t k = 0; k < told.size(); ++k) told[k] = placement.parameter(static_cast<Index>(k));
      return told;
    });
  });
}

ifsm_status ifsm_model_address(ifsm_model handle, double parameter, int32_t length, int32_t* symbols, int64_t capacity,
                               int64_t* count) {
  return guarded(__func__, [&] {
    const auto model = borrow(handle);
    in_range(length, 1, longest_address, "length");
    require_finite(parameter, "parameter");
    if (!model->closed() && !(parameter >= 0 && parameter <= 1))
      throw Error(Status::range, "parameter",
                  "parameter is " + text_of(parameter) + "; an open curve's run from 0 to 1.")
          .with(parameter);
    deliver(length, output(symbols, capacity, "symbols"), required(count, "count"),
            [&] { return address(*model, parameter, length); });
  });
}

ifsm_status ifsm_model_interval(ifsm_model handle, const int32_t* symbols, int64_t symbol_count, double* first,
                                double* last) {
  return guarded(__func__, [&] {
    const auto model = borrow(handle);
    in_range(symbol_count, 0, longest_address, "symbol_count");
    const auto given = input(symbols, symbol_count, "symbols", "symbol_count");
    required(first, "first");
    required(last, "last");
    const Interval covered = interval(*model, {given.begin(), given.end()});
    *first = covered.first;
    *last = covered.last;
  });
}

ifsm_status ifsm_model_control_points(ifsm_model handle, double* points, int64_t capacity, int64_t* count) {
  return guarded(__func__, [&] {
    const auto model = borrow(handle);
    deliver(model->shape().control_points() * model->dimension(), output(points, capacity, "points"),
            required(count, "count"), [&] { return control_points(*model); });
  });
}

ifsm_status ifsm_model_details(ifsm_model handle, int32_t level, int32_t frame, double* vectors, int64_t capacity,
                               int64_t* count) {
  return guarded(__func__, [&] {
    const auto model = borrow(handle);
    const int of = level_of_details(*model, level);
    const Frame told = frame_of(frame);
    deliver(model->details(of).size(), output(vectors, capacity, "vectors"), required(count, "count"),
            [&] { return details(*model, of, told); });
  });
}

ifsm_status ifsm_model_significance(ifsm_model handle, int32_t level, double* values, int64_t capacity,
                                    int64_t* count) {
  return guarded(__func__, [&] {
    const auto model = borrow(handle);
    const int of = level_of_details(*model, level);
    deliver(model->details(of).count(), output(values, capacity, "values"), required(count, "count"),
            [&] { return significance(*model, of); });
  });
}

ifsm_status ifsm_model_with_control_points(ifsm_model handle, int32_t frame, const double* points, int64_t count,
                                           ifsm_model* changed) {
  return guarded(__func__, [&] {
    const auto model = borrow(handle);
    const Frame told = frame_of(frame);
    const Points polygon = points_of(points, count, model->shape().control_points(), model->dimension(), "points");
    required(changed, "changed");
    issue(with_control_points(*model, polygon, told), *changed);
  });
}

ifsm_status ifsm_model_with_details(ifsm_model handle, int32_t level, int32_t frame, const double* vectors,
                                    int64_t count, ifsm_model* changed) {
  return guarded(__func__, [&] {
    const auto model = borrow(handle);
    const int of = level_of_details(*model, level);
    const Frame told = frame_of(frame);
    Points details = points_of(vectors, count, model->details(of).count(), model->dimension(), "vectors");
    required(changed, "changed");
    issue(with_details(*model, of, std::move(details), told), *changed);
  });
}

ifsm_status ifsm_model_with_filter(ifsm_model handle, ifsm_filter filter_handle, ifsm_model* changed) {
  return guarded(__func__, [&] {
    const auto model = borrow(handle);
    const auto filter = borrow(filter_handle);
    required(changed, "changed");
    issue(with_filter(*model, filter), *changed);
  });
}

ifsm_status ifsm_keep_options_init(ifsm_keep_options* options, uint32_t size) {
  return guarded(__func__, [&] { init_options(options, size); });
}

ifsm_status ifsm_model_keep(ifsm_model handle, const ifsm_keep_options* given, ifsm_model* kept) {
  return guarded(__func__, [&] {
    const auto model = borrow(handle);
    const ifsm_keep_options options = read_options(&required(given, "options"));
    const auto token = borrow_if_any(options.cancel, "cancel");
    required(kept, "kept");
    Watch watch(token.get(), progress_of(options));
    watch.poll();
    ModelPtr sketch = kept_model(*model, options, watch);
    watch.finish();
    issue(std::move(sketch), *kept);
  });
}

ifsm_status ifsm_model_save(ifsm_model handle, int32_t format, uint8_t* bytes, int64_t capacity, int64_t* count) {
  return guarded(__func__, [&] {
    const auto model = borrow(handle);
    const auto file = write_model(*model, choice(format, Format::cbor, "format"));
    deliver(
        static_cast<int64_t>(file.size()), output(bytes, capacity, "bytes"),
        required(count, "count"), [&]() -> const auto& { return file; });
  });
}

ifsm_status ifsm_model_load(const uint8_t* bytes, int64_t count, ifsm_model* model) {
  return guarded(__func__, [&] {
    const auto file = input(bytes, count, "bytes", "count");
    required(model, "model");
    issue(read_model({file.begin(), file.end()}), *model);
  });
}
