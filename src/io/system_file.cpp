#include "io/system_file.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/objects.h"

namespace ifsm::core {
namespace {

constexpr FileKind kind{"ifsm-system", 1, "a system"};

struct MapEntry {
  std::vector<double> matrix, shift;
  double weight = -1;  // absent
};

struct SystemEntry {
  std::string format;
  Index version = 0, dimension = 0;
  std::vector<MapEntry> maps;
};

Members members_of(MapEntry& m) { return {{"matrix", &m.matrix}, {"shift", &m.shift}, {"weight", &m.weight, false}}; }

Members members_of(SystemEntry& s) {
  return {{"format", &s.format},
          {"version", &s.version},
          {"dimension", &s.dimension},
          {"maps", Objects{[&s] { return members_of(s.maps.emplace_back()); }, System::most_maps,
                           "is one map too many; a system has at most 256."}}};
}

void require_count(const std::vector<double>& numbers, Index needed, const std::string& entry) {
  const auto count = static_cast<Index>(numbers.size());
  if (count == needed) return;
  throw Error(Status::shape, entry,
              entry + " has " + std::to_string(count) + " numbers; this system's has " + std::to_string(needed) + ".")
      .with(static_cast<double>(count))
      .needs(needed);
}

Affine map_of(const MapEntry& entry, int dimension, const std::string& name) {
  require_count(entry.matrix, Index{dimension} * dimension, name + ".matrix");
  require_count(entry.shift, dimension, name + ".shift");
  Affine map;
  const double* next = entry.matrix.data();
  for (int row = 0; row < dimension; ++row)
    for (int column = 0; column < dimension; ++column) map.linear(row, column) = *next++;
  for (int axis = 0; axis < dimension; ++axis) map.shift(axis) = entry.shift[static_cast<std::size_t>(axis)];
  return map;
}

// All maps have a weight, or none.
std::vector<double> weights_of(const std::vector<MapEntry>& maps) {
  std::vector<double> weights;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const std::string entry = "maps[" + std::to_string(i) + "].weight";
    const bool given = maps[i].weight != -1;
    if (given && maps[i].weight < 0)
      throw Error(Status::format, entry, entry + " is " + text_of(maps[i].weight) + "; it cannot be negative.")
          .at(static_cast<Index>(i))
          .with(maps[i].weight);
    if (given != (maps[0].weight != -1))
      throw Error(Status::format, entry,
                  entry + (given ? " is there" : " is missing") + "; give all maps one, or none.")
          .at(static_cast<Index>(i));
    if (given) weights.push_back(maps[i].weight);
  }
  return weights;
}

}  // namespace

Bytes write_system(const System& system, Format format) {
  Bytes bytes;
  const auto out = make_emitter(format, bytes);
  const auto numbers = [&](std::string_view key, Index count, const auto& number) {
    out->key(key), out->array(count);
    for (Index k = 0; k < count; ++k) out->number(number(k));
    out->end();
  };
  const Index d = system.dimension();
  const bool weighted = !system.weights().empty();
  out->object(4);
  out->key("format"), out->text(kind.format);
  out->key("version"), out->integer(kind.version);
  out->key("dimension"), out->integer(d);
  out->key("maps"), out->array(static_cast<Index>(system.maps().size()));
  for (std::size_t i = 0; i < system.maps().size(); ++i) {
    const Affine& map = system.maps()[i];
    out->object(weighted ? 3 : 2);
    numbers("matrix", d * d, [&](Index k) { return map.linear(k / d, k % d); });
    numbers("shift", d, [&](Index k) { return map.shift(k); });
    if (weighted) out->key("weight"), out->number(system.weights()[i]);
    out->end();
  }
  out->end();
  out->end();
  return bytes;
}

SystemPtr read_system(std::span<const std::uint8_t> bytes) {
  SystemEntry file;
  read_object(bytes, kind, members_of(file));
  if (file.dimension != 2 && file.dimension != 3)
    throw Error(Status::format, "dimension", "dimension is " + std::to_string(file.dimension) + "; it must be 2 or 3.")
        .with(static_cast<double>(file.dimension));
  const auto dimension = static_cast<int>(file.dimension);
  std::vector<Affine> maps;
  for (std::size_t i = 0; i < file.maps.size(); ++i)
    maps.push_back(map_of(file.maps[i], dimension, "maps[" + std::to_string(i) + "]"));
  std::vector<double> weights = weights_of(file.maps);
  try {
    return std::make_shared<System>(dimension, std::move(maps), std::move(weights));
  } catch (const Error& error) {
    const std::string entry = error.argument() == "probabilities" ? "maps.weight" : error.argument();
    throw Error(error.status() == Status::range ? Status::format : error.status(), entry, error.what())
        .at(error.index())
        .with(error.value());
  }
}

}  // namespace ifsm::core
