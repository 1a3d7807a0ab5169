#include "io/model_reader.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "io/document.h"

namespace ifsm::core {
namespace {

Error contradiction(const std::string& argument, const std::string& says) {
  return {Status::format, argument, argument + " " + says};
}

Index within(Index value, Index low, Index high, const std::string& argument) {
  if (low <= value && value <= high) return value;
  throw contradiction(argument, "is " + std::to_string(value) + "; it must be from " + std::to_string(low) + " to " +
                                    std::to_string(high) + ".")
      .with(static_cast<double>(value));
}

double not_negative(double value, const std::string& argument) {
  if (value >= 0) return value;
  throw contradiction(argument, "is " + text_of(value) + "; it cannot be negative.").with(value);
}

void require_count(std::size_t count, Index needed, const std::string& argument) {
  if (static_cast<Index>(count) == needed) return;
  throw Error(Status::shape, argument,
              argument + " has " + std::to_string(count) + " numbers; this model needs " + std::to_string(needed) + ".")
      .with(static_cast<double>(count))
      .needs(needed);
}

// What the constructors of the filter say about their arguments, said about the file's entries.
template <class Make>
auto of_entry(const std::string& entry, const Make& make) {
  try {
    return make();
  } catch (const Error& error) {
    const Status status = error.status() == Status::range ? Status::format : error.status();
    throw Error(status, entry + error.argument(), entry + error.argument() + ": " + error.what())
        .at(error.index())
        .with(error.value())
        .needs(error.required());
  }
}

Topology topology_of(const std::string& name) {
  for (const Topology topology : {Topology::joined, Topology::square})
    if (name == topology_name(topology)) return topology;
  throw contradiction("filter.topology", "must be \"joined\" or \"square\".");
}

Shape shape_of(const FilterEntry& filter) {
  const Topology topology = topology_of(filter.topology);
  const int n = static_cast<int>(within(filter.control_points, 1, 16, "filter.control_points"));
  const int maps = static_cast<int>(within(filter.maps, 2, 8, "filter.maps"));
  const int stride = static_cast<int>(within(filter.stride, 1, n, "filter.stride"));
  const Shape shape = of_entry("filter.", [&] { return Shape(topology, n, maps, stride); });
  require_count(filter.matrix.size(), Index{shape.rows()} * shape.rows(), "filter.matrix");
  return shape;
}

// Counts alone: nothing of the tree's size is allocated or walked before they agree.
int checked_levels(const Document& file, const Shape& shape, std::size_t bytes) {
  const Index levels = within(file.levels, 0, 40, "levels");
  of_entry("", [&] { return shape.checked_levels(levels); });
  const auto checked = static_cast<int>(levels);
  const Index doubles = tree_doubles(shape, file.dimension, checked), most = most_tree_doubles(bytes);
  if (doubles > most)
    throw Error(Status::limit, "levels",
                "A tree of " + std::to_string(levels) + " levels has " + std::to_string(doubles) +
                    " doubles; a file of " + std::to_string(bytes) + " bytes may ask for " + std::to_string(most) + ".")
        .with(static_cast<double>(levels));
  if (static_cast<Index>(file.details.size()) != levels)
    throw Error(Status::shape, "details",
                "details has " + std::to_string(file.details.size()) + " entries; this model has " +
                    std::to_string(levels) + " levels, and needs one for each.")
        .with(static_cast<double>(file.details.size()))
        .needs(levels);
  within(file.samples, 1, shape.places(checked, file.closed), "samples");
  return checked;
}

// The two ends are solved for as one point, but rounded each on its own.
void require_closed_ends(const Document& file, const Shape& shape) {
  if (!file.closed || !shape.joined()) return;
  constexpr double tolerance = 0x1p-30;
  double largest = 0;
  for (const double value : file.control_points) largest = std::max(largest, std::abs(value));
  const Index last = static_cast<Index>(file.control_points.size()) - file.dimension;
  for (Index axis = 0; axis < file.dimension; ++axis) {
    const double begins = file.control_points[static_cast<std::size_t>(axis)];
    const double ends = file.control_points[static_cast<std::size_t>(last + axis)];
    if (!(std::abs(begins / 2 - ends / 2) <= tolerance * largest))
      throw contradiction("control_points",
                          "of a closed joined model end where they begin; repeat the first point, or say that the "
                          "model is not closed.")
          .at(last + axis)
          .with(ends);
  }
}

void check_level(const LevelEntry& level, Index count, Index dimension, const std::string& entry) {
  if (!level.dense.empty()) {
    require_count(level.dense.size(), count * dimension, entry + ".dense");
    if (!level.at.empty() || !level.vectors.empty())
      throw contradiction(entry, "has both \"dense\" and \"at\" with \"vectors\"; remove one of them.");
    return;
  }
  require_count(level.vectors.size(), static_cast<Index>(level.at.size()) * dimension, entry + ".vectors");
  Index least = 0;
  for (std::size_t i = 0; i < level.at.size(); ++i) {
    const Index at = level.at[i];
    if (at < least || at >= count)
      throw contradiction(entry + ".at[" + std::to_string(i) + "]",
                          "is " + std::to_string(at) + "; indices increase, and this one must be from " +
                              std::to_string(least) + " to " + std::to_string(count - 1) + ".")
          .at(static_cast<Index>(i))
          .with(static_cast<double>(at));
    least = at + 1;
  }
}

FilterPtr filter_of(const Shape& shape, const std::vector<double>& entries) {
  RowMatrix matrix(shape.rows(), shape.rows());
  std::ranges::copy(entries, matrix.data());
  return of_entry("filter.", [&] { return std::make_shared<Filter>(shape, std::move(matrix)); });
}

// Empties the entry: large levels are not kept twice.
PointsPtr details_of(LevelEntry entry, Index count, Index dimension) {
  if (!entry.dense.empty())
    return std::make_shared<Points>(Points::from_interleaved(entry.dense.data(), count, dimension));
  auto details = std::make_shared<Points>(dimension, count);
  const double* next = entry.vectors.data();
  for (const Index at : entry.at)
    for (Index axis = 0; axis < dimension; ++axis) details->plane(axis)[static_cast<std::size_t>(at)] = *next++;
  return details;
}

}  // namespace

ModelPtr read_model(std::span<const std::uint8_t> bytes) {
  Document file = read_document(bytes);
  const Index dimension = within(file.dimension, 1, 4, "dimension");
  const Shape shape = shape_of(file.filter);
  const int levels = checked_levels(file, shape, bytes.size());
  require_count(file.center.size(), dimension, "center");
  require_count(file.control_points.size(), shape.control_points() * dimension, "control_points");
  require_closed_ends(file, shape);
  for (int level = 0; level < levels; ++level)
    check_level(file.details[static_cast<std::size_t>(level)], shape.detail_count(level), dimension,
                "details[" + std::to_string(level) + "]");

  ModelParts parts;
  parts.diagonal = not_negative(file.diagonal, "diagonal");
  parts.largest_polygon = not_negative(file.largest_polygon, "largest_polygon");
  parts.filter = filter_of(shape, file.filter.matrix);
  parts.closed = file.closed;
  parts.samples = file.samples;
  parts.center = std::move(file.center);
  parts.polygon = Points::from_interleaved(file.control_points.data(), shape.control_points(), dimension);
  for (int level = 0; level < levels; ++level)
    parts.details.push_back(
        details_of(std::move(file.details[static_cast<std::size_t>(level)]), shape.detail_count(level), dimension));
  return std::make_shared<Model>(std::move(parts));
}

}  // namespace ifsm::core
