#include "curves.h"

#include <algorithm>
#include <cmath>

#include "csv.h"
#include "failure.h"
#include "files.h"

namespace cli {
namespace {

constexpr std::size_t most_dimensions = 4;

bool ends_meet(const std::vector<double>& points, std::size_t dimension) {
  return std::equal(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(dimension),
                    points.end() - static_cast<std::ptrdiff_t>(dimension));
}

void check_shape(const Table& table, const std::string& source) {
  if (table.columns > most_dimensions)
    throw Failure(Exit::Input, source + " has " + std::to_string(table.columns) +
                                   " columns; a curve has 1 to 4: choose them with --columns, by name or number.");
  if (table.rows() < 2) throw Failure(Exit::Input, source + " holds one point; a curve needs at least 2.");
}

}  // namespace

Samples read_samples(const std::string& path, const std::vector<std::string>& columns, bool closed) {
  const auto source = input_name(path);
  auto table = parse_csv(read_file(path), source, columns);
  check_shape(table, source);
  Samples samples{std::move(table.values), static_cast<int>(table.columns), closed, {}};
  if (!ends_meet(samples.points, table.columns)) return samples;
  if (!closed) {
    samples.notes.push_back(source + ": the last point repeats the first; if this is a ring, add --closed.");
  } else if (samples.points.size() > 2 * table.columns) {
    samples.points.resize(samples.points.size() - table.columns);
    samples.notes.push_back(source +
                            ": the last point repeats the first and was dropped, as --closed closes the ring.");
  }
  return samples;
}

ifsm::Model load_model(const std::string& path) {
  const auto bytes = read_file(path);
  if (bytes.empty()) throw Failure(Exit::Input, input_name(path) + " is empty; expected a model written by ifsm fit.");
  try {
    return ifsm::Model::load({bytes.begin(), bytes.end()});
  } catch (const ifsm::Error& error) {
    const bool its_fault = error.status != IFSM_ERROR_MEMORY && error.status != IFSM_ERROR_INTERNAL;
    throw Failure(its_fault ? Exit::Input : Exit::Computing, input_name(path) + ": " + error.what());
  }
}

std::size_t save_model(const ifsm::Model& model, ifsm::Format format, const std::string& path) {
  const auto bytes = model.save(format);
  write_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  return bytes.size();
}

namespace {

// A name has neither a point nor a slash in it.
bool is_path(const std::string& filter) { return filter.find_first_of("./") != std::string::npos; }

ifsm::Filter filter_of_file(const std::string& path, int control_points, int maps) {
  ifsm::Filter filter = load_model(path).filter();
  const auto info = filter.describe();
  const auto check = [&](const char* option, int asked, int has) {
    if (asked != 0 && asked != has)
      throw Failure(Exit::Usage, std::string(option) + " " + std::to_string(asked) + ", but the filter of " + path +
                                     " has " + std::to_string(has) + "; leave the option away.");
  };
  check("--control-points", control_points, info.control_points);
  check("--maps", maps, info.maps);
  return filter;
}

// As a fit starts: coast where it has that shape.
ifsm::Filter default_filter(int control_points, int maps) {
  try {
    return ifsm::Filter::named("coast", ifsm::Topology::joined, control_points, maps);
  } catch (const ifsm::Error&) {
    return ifsm::Filter::named("casteljau", ifsm::Topology::joined, control_points, maps);
  }
}

}  // namespace

ifsm::Filter start_filter(const std::string& name, int control_points, int maps) {
  if (is_path(name)) return filter_of_file(name, control_points, maps);
  if (name.empty()) return default_filter(control_points, maps);
  try {
    return ifsm::Filter::named(name, ifsm::Topology::joined, control_points, maps);
  } catch (const ifsm::Error&) {
  }
  try {
    return ifsm::Filter::named(name, ifsm::Topology::square, control_points, maps);
  } catch (const ifsm::Error& error) {
    throw Failure(Exit::Usage, std::string("--filter: ") + error.what());
  }
}

void require_joined(const ifsm::Filter& filter, const std::string& name) {
  if (filter.describe().topology != IFSM_TOPOLOGY_JOINED)
    throw Failure(Exit::Usage, "--filter: '" + name +
                                   "' is a square filter, and a fit starts from a joined one; use "
                                   "casteljau, or fit with --no-fit to use the filter as it is.");
}

Distance distance(const std::vector<double>& a, const std::vector<double>& b, int dimension) {
  const auto d = static_cast<std::size_t>(dimension);
  double sum = 0, largest = 0;
  for (std::size_t k = 0; k < a.size(); k += d) {
    double square = 0;
    for (std::size_t i = k; i < k + d; ++i) square += (a[i] - b[i]) * (a[i] - b[i]);
    sum += square;
    largest = std::max(largest, square);
  }
  return {std::sqrt(sum * dimension / static_cast<double>(a.size())), std::sqrt(largest)};
}

std::vector<std::string> coordinate_names(int dimension) {
  const std::vector<std::string> names{"x", "y", "z", "w"};
  return {names.begin(), names.begin() + dimension};
}

}  // namespace cli
