#include "curve/shape.h"

#include "base/memory.h"

namespace ifsm::core {
namespace {

constexpr Index most_places = Index{1} << 40;

int chosen_stride(Topology topology, int control_points, int stride) {
  const int natural = control_points > 1 ? control_points - 1 : 1;
  if (stride == 0) return natural;
  if (topology == Topology::joined) return static_cast<int>(in_range(stride, natural, natural, "stride"));
  return static_cast<int>(in_range(stride, 1, control_points, "stride"));
}

}  // namespace

Shape::Shape(Topology topology, int control_points, int maps, int stride)
    : topology_(topology),
      control_points_(
          static_cast<int>(in_range(control_points, topology == Topology::joined ? 2 : 1, 16, "control_points"))),
      maps_(static_cast<int>(in_range(maps, 2, 8, "maps"))),
      stride_(chosen_stride(topology, control_points, stride)) {}

Index Shape::nodes(int level) const {
  Index count = 1;
  for (int l = 0; l < level; ++l) count *= maps_;
  return count;
}

Index Shape::first_node(int level) const { return (nodes(level) - 1) / (maps_ - 1); }

Index Shape::line_length(int level) const { return polygon_step() * nodes(level) + (joined() ? 1 : 0); }

Index Shape::detail_count(int level) const { return details_per_node() * nodes(level); }

Index Shape::places(int level, bool closed) const {
  if (closed) return stride_ * nodes(level);
  return joined() ? line_length(level) : stride_ * (nodes(level) - 1) + control_points_;
}

int Shape::levels_for(Index samples, bool closed) const {
  int level = 0;
  while (places(level, closed) < samples) level = checked_levels(level + 1);
  return level;
}

int Shape::checked_levels(Index levels) const {
  Index nodes = 1;
  for (Index l = 0; l < levels; ++l) {
    nodes *= maps_;
    if (nodes * control_points_ > most_places)
      throw Error(Status::limit, "levels",
                  "A tree of " + std::to_string(levels) + " levels of " + std::to_string(maps_) +
                      " maps has more than 2^40 places; use fewer levels.")
          .with(static_cast<double>(levels));
  }
  return static_cast<int>(in_range(levels, 0, 40, "levels"));
}

void Shape::require_memory(int levels, Index dimension) const {
  core::require_memory(checked_product(2 * dimension, line_length(levels), "levels"), "levels");
}

}  // namespace ifsm::core
