#include "system/system.h"

#include <ifsm.h>

#include <limits>
#include <string>
#include <vector>

#include "capi/arguments.h"
#include "capi/curves.h"
#include "capi/guarded.h"
#include "capi/nouns.h"
#include "capi/systems.h"
#include "curve/attractor.h"
#include "system/named.h"
#include "system/parameters.h"

using namespace ifsm::core;

namespace {

// How many maps there are.
int64_t maps_in(int64_t count, int64_t per_map, const char* argument) {
  if (count > per_map * System::most_maps)
    throw Error(Status::range, argument,
                std::string(argument) + " holds " + std::to_string(count) + " doubles, more than " +
                    std::to_string(System::most_maps) + " maps of " + std::to_string(per_map) +
                    "; a system has no more: leave some out.")
        .with(static_cast<double>(count));
  if (count >= per_map && count % per_map == 0) return count / per_map;
  throw Error(Status::shape, argument,
              std::string(argument) + " holds " + std::to_string(count) + " doubles; give " + std::to_string(per_map) +
                  " for each map, one map at least.")
      .with(static_cast<double>(count));
}

std::vector<double> weights_of(const double* probabilities, int64_t count) {
  const auto given = input(probabilities, count, "probabilities", "probability_count");
  return {given.begin(), given.end()};
}

constexpr int numbers_of(int dimension) { return dimension == 2 ? 6 : 12; }

Parameters parameters_from(const double* values, int dimension) {
  Parameters p;
  if (dimension == 2) {
    p.rotation(2) = values[0];
    p.scale.head(2) << values[1], values[2];
    p.shear(0) = values[3];
    p.shift.head(2) << values[4], values[5];
    return p;
  }
  for (Vector3* each : {&p.rotation, &p.scale, &p.shear, &p.shift})
    *each = Eigen::Map<const Vector3>(values), values += 3;
  return p;
}

void append_parameters(const Parameters& p, int dimension, std::vector<double>& values) {
  if (dimension == 2) {
    values.insert(values.end(), {p.rotation(2), p.scale(0), p.scale(1), p.shear(0), p.shift(0), p.shift(1)});
    return;
  }
  for (const Vector3* each : {&p.rotation, &p.scale, &p.shear, &p.shift})
    values.insert(values.end(), each->data(), each->data() + 3);
}

// What both ways of telling maps have in common: `read` makes one of its numbers.
template <class Read>
SystemPtr system_from(int32_t dimension, const double* values, int64_t count, const char* argument,
                      const double* probabilities, int64_t probability_count, const Read& read) {
  in_range(dimension, 2, 3, "dimension");
  const auto given = input(values, count, argument, "count");
  const int64_t per_map = numbers_of(dimension), maps = maps_in(given.count, per_map, argument);
  require_finite(given.data, given.count, argument);
  std::vector<Affine> affine;
  for (int64_t i = 0; i < maps; ++i) affine.push_back(read(given.data + i * per_map));
  return std::make_shared<System>(dimension, std::move(affine), weights_of(probabilities, probability_count));
}

}  // namespace

ifsm_status ifsm_system_create(int32_t dimension, const double* maps, int64_t count, const double* probabilities,
                               int64_t probability_count, ifsm_system* system) {
  return guarded(__func__, [&] {
    required(system, "system");
    issue(system_from(dimension, maps, count, "maps", probabilities, probability_count,
                      [&](const double* rows) { return map_from(rows, dimension); }),
          *system);
  });
}

ifsm_status ifsm_system_from_parameters(int32_t dimension, const double* parameters, int64_t count,
                                        const double* probabilities, int64_t probability_count, ifsm_system* system) {
  return guarded(__func__, [&] {
    required(system, "system");
    issue(system_from(dimension, parameters, count, "parameters", probabilities, probability_count,
                      [&](const double* values) { return map_of(parameters_from(values, dimension), dimension); }),
          *system);
  });
}

ifsm_status ifsm_system_named(const char* name, ifsm_system* system) {
  return guarded(__func__, [&] {
    required(name, "name");
    required(system, "system");
    issue(named_system(name), *system);
  });
}

ifsm_status ifsm_system_catalog(int64_t index, ifsm_system_entry* entry) {
  return guarded(__func__, [&] {
    const auto all = named_systems();
    const Report to(entry, "entry");
    in_range(index, 0, static_cast<int64_t>(all.size()) - 1, "index");
    const NamedSystem& named = all[static_cast<std::size_t>(index)];
    ifsm_system_entry told{};
    told.dimension = named.dimension;
    told.name = named.name.data();  // literals, which end with NUL
    told.source = named.source.data();
    to.write(told);
  });
}

ifsm_status ifsm_system_from_model(ifsm_model handle, ifsm_system* system) {
  return guarded(__func__, [&] {
    const auto model = borrow(handle);
    issue(system_of(*model), required(system, "system"));
  });
}

ifsm_status ifsm_model_from_system(ifsm_system handle, int32_t topology, const ifsm_curve* polygon, int32_t levels,
                                   ifsm_model* model) {
  return guarded(__func__, [&] {
    const auto system = borrow(handle);
    const Topology shape = choice(topology, Topology::square, "topology");
    const Points points = polygon == nullptr ? Points() : polygon_of(*polygon);
    if (polygon != nullptr) in_range(polygon->closed, 0, 0, "closed");  // a chain has two ends
    required(model, "model");
    issue(model_of(*system, shape, points, levels), *model);
  });
}

ifsm_status ifsm_system_describe(ifsm_system handle, ifsm_system_info* info) {
  return guarded(__func__, [&] {
    const auto system = borrow(handle);
    const Contraction& contraction = system->contraction();
    const bool refuted = contraction.answer == Contractivity::refuted;
    ifsm_system_info told{};
    told.dimension = system->dimension();
    told.maps = static_cast<int32_t>(system->maps().size());
    told.active = static_cast<int32_t>(system->active().size());
    told.contractive = static_cast<int32_t>(contraction.answer);
    told.word_length = contraction.length;
    told.radius = refuted ? contraction.radius : std::numeric_limits<double>::quiet_NaN();
    Report(info, "info").write(told);
  });
}

ifsm_status ifsm_system_maps(ifsm_system handle, double* maps, int64_t capacity, int64_t* count) {
  return guarded(__func__, [&] {
    const auto system = borrow(handle);
    deliver(static_cast<int64_t>(system->maps().size()) * numbers_of(system->dimension()),
            output(maps, capacity, "maps"), required(count, "count"), [&] {
              std::vector<double> rows;
              for (const Affine& map : system->maps()) append_rows(map, system->dimension(), rows);
              return rows;
            });
  });
}

ifsm_status ifsm_system_parameters(ifsm_system handle, double* parameters, int64_t capacity, int64_t* count) {
  return guarded(__func__, [&] {
    const auto system = borrow(handle);
    deliver(static_cast<int64_t>(system->maps().size()) * numbers_of(system->dimension()),
            output(parameters, capacity, "parameters"), required(count, "count"), [&] {
              std::vector<double> values;
              for (const Affine& map : system->maps())
                append_parameters(parameters_of(map, system->dimension()), system->dimension(), values);
              return values;
            });
  });
}

ifsm_status ifsm_system_probabilities(ifsm_system handle, double* probabilities, int64_t capacity, int64_t* count) {
  return guarded(__func__, [&] {
    const auto system = borrow(handle);
    deliver(
        static_cast<int64_t>(system->maps().size()), output(probabilities, capacity, "probabilities"),
        required(count, "count"), [&]() -> const auto& { return system->probabilities(); });
  });
}

ifsm_status ifsm_system_fixed_points(ifsm_system handle, double* points, int64_t capacity, int64_t* count) {
  return guarded(__func__, [&] {
    const auto system = borrow(handle);
    const int d = system->dimension();
    deliver(static_cast<int64_t>(system->maps().size()) * d, output(points, capacity, "points"),
            required(count, "count"), [&] {
              std::vector<double> values;
              for (const Affine& map : system->maps()) append_point(fixed_point(map), d, values);
              return values;
            });
  });
}

ifsm_status ifsm_system_witness(ifsm_system handle, int32_t* symbols, int64_t capacity, int64_t* count) {
  return guarded(__func__, [&] {
    const auto system = borrow(handle);
    const Word& word = system->contraction().word;
    deliver(
        static_cast<int64_t>(word.size()), output(symbols, capacity, "symbols"),
        required(count, "count"), [&]() -> const auto& { return word; });
  });
}

ifsm_status ifsm_system_destroy(ifsm_system system) {
  return guarded(__func__, [&] { destroy(system); });
}
