// Questions about a system's attractor and its measure.
#include <ifsm.h>

#include <vector>

#include "capi/arguments.h"
#include "capi/guarded.h"
#include "capi/nouns.h"
#include "capi/rows.h"
#include "capi/systems.h"
#include "system/address.h"
#include "system/box_count.h"
#include "system/dimension.h"
#include "system/moments.h"
#include "system/reach.h"

using namespace ifsm::core;

namespace {

constexpr int64_t longest_address = 1024, most_addresses = 65536;

std::vector<int64_t> word_of(const int32_t* symbols, int64_t count) {
  in_range(count, 0, longest_address, "symbol_count");
  const auto given = input(symbols, count, "symbols", "symbol_count");
  return {given.begin(), given.end()};
}

// d doubles; where they are optional, none at all are zeros.
Vector3 vector_of(const double* values, int64_t count, int dimension, const char* argument, const char* count_argument,
                  bool optional) {
  const auto given = input(values, count, argument, count_argument);
  Vector3 vector = Vector3::Zero();
  if (optional && given.count == 0) return vector;
  require_count(given.count, dimension, count_argument);
  require_finite(given.data, given.count, argument);
  std::copy_n(given.data, dimension, vector.data());
  return vector;
}

// A billionth of the attractor's size unless told.
double tolerance_of(const System& system, double given) {
  constexpr double share = 1e-9;
  require_finite(given, "tolerance");
  const double size = system.enclosure().axes.norm();
  if (given >= 0 && given <= size) return given == 0 ? share * size : given;
  throw Error(Status::range, "tolerance",
              "tolerance is " + text_of(given) + "; give one up to " + text_of(size) +
                  ", about the attractor's size, or 0 for a billionth of that.")
      .with(given);
}

}  // namespace

ifsm_status ifsm_system_word(ifsm_system handle, const int32_t* symbols, int64_t symbol_count, double* map,
                             int64_t capacity, int64_t* count) {
  return guarded(__func__, [&] {
    const auto system = borrow(handle);
    const std::vector<int64_t> word = word_of(symbols, symbol_count);
    std::vector<double> rows;
    append_rows(word_map(*system, word), system->dimension(), rows);
    deliver_rows(rows, output(map, capacity, "map"), required(count, "count"));
  });
}

ifsm_status ifsm_system_point(ifsm_system handle, const int32_t* symbols, int64_t symbol_count, int64_t period,
                              double* point, int64_t capacity, int64_t* count) {
  return guarded(__func__, [&] {
    const auto system = borrow(handle);
    const std::vector<int64_t> word = word_of(symbols, symbol_count);
    in_range(symbol_count, 1, longest_address, "symbol_count");
    std::vector<double> values;
    append_point(point_of(*system, word, period), system->dimension(), values);
    deliver_rows(values, output(point, capacity, "point"), required(count, "count"));
  });
}

ifsm_status ifsm_system_addresses(ifsm_system handle, const double* point, int64_t point_count, int32_t length,
                                  double tolerance, int32_t* symbols, int64_t capacity, int64_t* count) {
  return guarded(__func__, [&] {
    const auto system = borrow(handle);
    const Vector3 at = vector_of(point, point_count, system->dimension(), "point", "point_count", false);
    in_range(length, 1, longest_address, "length");
    const auto to = output(symbols, capacity, "symbols");
    required(count, "count");
    std::vector<int32_t> all;
    for (const auto& word : addresses_of(*system, at, length, tolerance_of(*system, tolerance), most_addresses))
      all.insert(all.end(), word.begin(), word.end());
    deliver(
        static_cast<int64_t>(all.size()), to, *count, [&]() -> const auto& { return all; });
  });
}

ifsm_status ifsm_system_box(ifsm_system handle, double tolerance, double* box, int64_t capacity, int64_t* count) {
  return guarded(__func__, [&] {
    const auto system = borrow(handle);
    const int d = system->dimension();
    const double within = tolerance_of(*system, tolerance);
    deliver(2 * d, output(box, capacity, "box"), required(count, "count"), [&] {
      const Box found = bounding_box(*system, within);
      std::vector<double> values;
      append_point(found.low, d, values);
      append_point(found.high, d, values);
      return values;
    });
  });
}

ifsm_status ifsm_system_ball(ifsm_system handle, double tolerance, double* ball, int64_t capacity, int64_t* count) {
  return guarded(__func__, [&] {
    const auto system = borrow(handle);
    const int d = system->dimension();
    const double within = tolerance_of(*system, tolerance);
    deliver(d + 1, output(ball, capacity, "ball"), required(count, "count"), [&] {
      const Ball found = enclosing_ball(*system, within);
      std::vector<double> values;
      append_point(found.centre, d, values);
      values.push_back(found.radius);
      return values;
    });
  });
}

ifsm_status ifsm_system_diameter(ifsm_system handle, double tolerance, double* across) {
  return guarded(__func__, [&] {
    const auto system = borrow(handle);
    const double within = tolerance_of(*system, tolerance);
    required(across, "diameter") = diameter(*system, within);
  });
}

ifsm_status ifsm_system_moments(ifsm_system handle, int32_t degree, const double* about, int64_t about_count,
                                double* values, int64_t capacity, int64_t* count) {
  return guarded(__func__, [&] {
    const auto system = borrow(handle);
    in_range(degree, 1, most_moment_degree, "degree");
    const Vector3 origin = vector_of(about, about_count, system->dimension(), "about", "about_count", true);
    const auto to = output(values, capacity, "moments");
    deliver_rows(moments(*system, degree, origin), to, required(count, "count"));
  });
}

ifsm_status ifsm_system_similarity_dimension(ifsm_system handle, double* dimension) {
  return guarded(__func__, [&] {
    const auto system = borrow(handle);
    required(dimension, "dimension") = similarity_dimension(*system);
  });
}

ifsm_status ifsm_system_box_dimension(ifsm_system handle, int32_t finest, ifsm_dimension_report* report, double* rows,
                                      int64_t capacity, int64_t* count) {
  return guarded(__func__, [&] {
    const auto system = borrow(handle);
    const int usual = system->dimension() == 2 ? 10 : 7;
    const Report to(report, "report");
    const auto array = output(rows, capacity, "rows");
    required(count, "count");
    Watch watch;
    const BoxCounts found = count_boxes(*system, finest == 0 ? usual : finest, watch);
    ifsm_dimension_report told{};
    told.scales = static_cast<int32_t>(found.sides.size());
    told.dimension = -found.line.slope;
    told.standard_error = found.line.standard_error;
    told.r_squared = found.line.r_squared;
    deliver_rows(rows_of(found.sides, found.counts), array, *count);
    to.write(told);
  });
}
