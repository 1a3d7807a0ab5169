// Questions asked of a model, and its refinement.
#include <ifsm.h>

#include <vector>

#include "capi/arguments.h"
#include "capi/curves.h"
#include "capi/guarded.h"
#include "capi/nouns.h"
#include "capi/rows.h"
#include "measure/crossings.h"
#include "measure/curvature.h"
#include "measure/dimension.h"
#include "measure/distance.h"
#include "measure/length.h"
#include "measure/nearest.h"
#include "measure/refine.h"
#include "measure/spectrum.h"

using namespace ifsm::core;

namespace {

constexpr int64_t most_points = int64_t{1} << 40;
constexpr int32_t most_levels = 40;

bool by_count(int64_t points, double spacing) {
  in_range(points, 0, most_points, "points");
  require_finite(spacing, "spacing");
  if ((points == 0) != (spacing == 0)) return points != 0;
  throw Error(Status::range, "spacing",
              "points is " + std::to_string(points) + " and spacing " + text_of(spacing) +
                  "; give one of them, and 0 for the other.")
      .with(spacing);
}

// Queries are told by doubles; how many points they are.
int64_t query_points(int64_t count, int64_t dimension) {
  if (count % dimension == 0) return count / dimension;
  throw Error(Status::range, "query_count",
              "query_count is " + std::to_string(count) + ", no multiple of the curve's dimension " +
                  std::to_string(dimension) + "; give whole points.")
      .with(static_cast<double>(count));
}

std::vector<double> rows_of(const Nearest& found) {
  std::vector<double> rows;
  const Index dimension = found.points.dimension();
  rows.reserve(found.parameters.size() * static_cast<std::size_t>(2 + dimension));
  for (std::size_t k = 0; k < found.parameters.size(); ++k) {
    rows.insert(rows.end(), {found.parameters[k], found.distances[k]});
    for (Index axis = 0; axis < dimension; ++axis) rows.push_back(found.points.plane(axis)[k]);
  }
  return rows;
}

ScaleRange range_of(const ifsm_dimension_options& options) {
  in_range(options.reserved, 0, 0, "reserved");
  ScaleRange range;
  if (in_range(options.scales, 0, 256, "scales") != 0) range.scales = options.scales;
  range.smallest = options.smallest;
  range.largest = options.largest;
  return range;
}

Refinement refinement_of(const ifsm_refine_options& options) {
  constexpr double none = -1;
  in_range(options.reserved, 0, 0, "reserved");
  Refinement asked;
  if (in_range(options.levels, 0, most_levels, "levels") != 0) asked.levels = options.levels;
  if (in_range(options.learned, 0, most_levels, "learned") != 0) asked.learned = options.learned;
  asked.seed = options.seed;
  if (options.roughness != 0) asked.roughness = options.roughness == none ? 0.0 : options.roughness;
  return asked;
}

}  // namespace

ifsm_status ifsm_model_length(ifsm_model handle, double from, double to, double* length) {
  return guarded(__func__, [&] {
    const auto model = borrow(handle);
    required(length, "length");
    *length = length_between(Polyline(*model), from, to);
  });
}

ifsm_status ifsm_model_spaced(ifsm_model handle, int64_t points, double spacing, double* parameters, int64_t capacity,
                              int64_t* count) {
  return guarded(__func__, [&] {
    const auto model = borrow(handle);
    const bool counted = by_count(points, spacing);
    const auto to = output(parameters, capacity, "parameters");
    required(count, "count");
    if (counted && parameters == nullptr) {
      *count = points;
      return;
    }
    const Polyline polyline(*model);
    deliver(counted ? points : spaced_count(polyline, spacing), to, *count,
            [&] { return counted ? equally_spaced(polyline, points) : spaced(polyline, spacing); });
  });
}

ifsm_status ifsm_model_nearest(ifsm_model handle, const double* queries, int64_t query_count, double* rows,
                               int64_t capacity, int64_t* count) {
  return guarded(__func__, [&] {
    const auto model = borrow(handle);
    const auto given = input(queries, query_count, "queries", "query_count");
    const Index points = query_points(given.count, model->dimension());
    require_finite(given.data, given.count, "queries");
    deliver(points * (2 + model->dimension()), output(rows, capacity, "rows"), required(count, "count"), [&] {
      return rows_of(nearest(Polyline(*model), Points::from_interleaved(given.data, points, model->dimension())));
    });
  });
}

ifsm_status ifsm_model_distance(ifsm_model handle, ifsm_model other_handle, ifsm_distances* told) {
  return guarded(__func__, [&] {
    const auto model = borrow(handle);
    const auto other = borrow(other_handle, "other");
    const Report report(told, "distances");
    const Distances found = distances(*model, *other);
    ifsm_distances values{};
    values.rms = found.rms;
    values.largest = found.largest;
    values.farthest = found.farthest;
    values.hausdorff = found.hausdorff;
    report.write(values);
  });
}

ifsm_status ifsm_model_curvature(ifsm_model handle, double scale, const double* parameters, int64_t parameter_count,
                                 double* curvatures, int64_t capacity, int64_t* count) {
  return guarded(__func__, [&] {
    const auto model = borrow(handle);
    require_finite(scale, "scale");
    const auto given = input(parameters, parameter_count, "parameters", "parameter_count");
    deliver(given.count, output(curvatures, capacity, "curvatures"), required(count, "count"), [&] {
      return curvature(Polyline(*model), {given.begin(), given.end()}, scale);
    });
  });
}

ifsm_status ifsm_model_crossings(ifsm_model handle, double* rows, int64_t capacity, int64_t* count) {
  return guarded(__func__, [&] {
    const auto model = borrow(handle);
    const auto to = output(rows, capacity, "rows");
    required(count, "count");
    deliver_rows(rows_of(crossings(Polyline(*model))), to, *count);
  });
}

ifsm_status ifsm_dimension_options_init(ifsm_dimension_options* options, uint32_t size) {
  return guarded(__func__, [&] { init_options(options, size); });
}

ifsm_status ifsm_model_dimension(ifsm_model handle, const ifsm_dimension_options* given, ifsm_dimension_report* report,
                                 double* rows, int64_t capacity, int64_t* count) {
  return guarded(__func__, [&] {
    const auto model = borrow(handle);
    const ifsm_dimension_options options = read_options(given);
    const auto method = choice(options.method, Counting::divider, "method");
    const ScaleRange range = range_of(options);
    const Report to(report, "report");
    const auto array = output(rows, capacity, "rows");
    required(count, "count");
    const Dimension found = measure_dimension(Polyline(*model), method, range);
    ifsm_dimension_report told{};
    told.scales = static_cast<int32_t>(found.scales.size());
    told.dimension = found.dimension;
    told.standard_error = found.standard_error;
    told.r_squared = found.r_squared;
    deliver_rows(rows_of(found.scales, found.counts), array, *count);
    to.write(told);
  });
}

ifsm_status ifsm_model_spectrum(ifsm_model handle, ifsm_spectrum_report* report, double* rows, int64_t capacity,
                                int64_t* count) {
  return guarded(__func__, [&] {
    const auto model = borrow(handle);
    const Report to(report, "report");
    const auto array = output(rows, capacity, "rows");
    required(count, "count");
    const Spectrum found = spectrum(*model);
    ifsm_spectrum_report told{};
    told.levels = model->levels();
    told.first = found.first;
    told.last = found.last;
    told.hurst = found.hurst;
    told.standard_error = found.standard_error;
    told.r_squared = found.r_squared;
    told.dimension = found.dimension;
    deliver_rows(rows_of(found.scales, found.rms), array, *count);
    to.write(told);
  });
}

ifsm_status ifsm_refine_options_init(ifsm_refine_options* options, uint32_t size) {
  return guarded(__func__, [&] { init_options(options, size); });
}

ifsm_status ifsm_model_refine(ifsm_model handle, const ifsm_refine_options* given, ifsm_model* refined) {
  return guarded(__func__, [&] {
    const auto model = borrow(handle);
    const Refinement asked = refinement_of(read_options(given));
    required(refined, "refined");
    issue(refine(*model, asked), *refined);
  });
}
