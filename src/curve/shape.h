// The shape of a filter and of the tree that it spans: counts, and which places a polygon reads.
#pragma once

#include "base/error.h"
#include "linalg/points.h"

namespace ifsm::core {

// Joined: neighbouring polygons share their end points. Square (paper 002): polygons stand alone.
enum class Topology : std::int32_t { joined = 0, square = 1 };

// A line of level l holds all polygons of that level in order: joined polygons overlap in one value, square ones lie
// side by side. Level 0 is the control polygon. Names: n control points, N maps, as in math and paper.
class Shape {
 public:
  // stride 0 chooses n - 1 (1 for n = 1). Range errors name the argument.
  Shape(Topology topology, int control_points, int maps, int stride = 0);

  Topology topology() const { return topology_; }
  bool joined() const { return topology_ == Topology::joined; }
  int control_points() const { return control_points_; }
  int maps() const { return maps_; }
  int stride() const { return stride_; }

  // R is rows × rows; the first control_points() rows are T's.
  int rows() const { return joined() ? (control_points_ - 1) * maps_ + 1 : control_points_ * maps_; }
  int details_per_node() const { return rows() - control_points_; }

  // In a line: how far a polygon lies from the next one, and the children of a node from the next node's.
  int polygon_step() const { return joined() ? control_points_ - 1 : control_points_; }
  int children_step() const { return polygon_step() * maps_; }

  Index nodes(int level) const;         // N^level
  Index first_node(int level) const;    // nodes of all coarser levels: where this level's begin in a list of all
  Index line_length(int level) const;   // values in a line of that level
  Index detail_count(int level) const;  // detail vectors of that level

  // Places (distinct points) of that level. Closed: a ring.
  Index places(int level, bool closed) const;

  // The smallest number of levels with `samples` places; a limit error when 2^40 places do not suffice.
  int levels_for(Index samples, bool closed) const;
  // Refuses levels whose places pass 2^40.
  int checked_levels(Index levels) const;
  // Refuses levels whose finest line and details, of so many coordinates, are more than the machine's memory.
  void require_memory(int levels, Index dimension) const;

  friend bool operator==(const Shape&, const Shape&) = default;

 private:
  Topology topology_;
  int control_points_;
  int maps_;
  int stride_;
};

}  // namespace ifsm::core
