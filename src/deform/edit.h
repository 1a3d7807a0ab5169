// Edits of a deformer: plain values, which a log keeps and a keyframe takes a part of.
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "curve/model.h"
#include "deform/span.h"

namespace ifsm::core {

// Whose details follow a handle that moves: those of the nodes that hold it, by each node's own turn, so that nothing
// else changes (ours); or all, by the turn of the curve as a whole (paper 002, Local).
enum class Reach : std::int32_t { nodes = 0, curve = 1 };

// How handles near a moved one follow: by 1 - t, or (1 - t²)², t the distance over the radius.
enum class Falloff : std::int32_t { none = 0, linear = 1, smooth = 2 };
// What distance counts: handles from one to the next, or arc length along the level's polyline as it is.
enum class Ruler : std::int32_t { handles = 0, length = 1 };

// Handles of a level: points of the curve synthesised so far; level 0's are the control points, whose move bends the
// curve as a whole, whatever `reach` says.
struct Move {
  int level = 0;
  std::vector<Index> handles;
  Points vectors;       // one a handle
  bool places = false;  // vectors are where handles go to, in the samples' coordinates; else by how much they move
  Reach reach = Reach::nodes;
  Falloff falloff = Falloff::none;
  Ruler ruler = Ruler::handles;
  double radius = 0;
};

// Handles that stay where they are, whatever moves above them, until they are let go.
struct Pin {
  int level = 0;
  std::vector<Index> handles;
  bool hold = true;
};

// Points of the curve, at parameters, led to places by the least change (sum of squares) of a level: of its handles,
// the nodes that hold them turning as ever, or of its details, which turn nothing. Pinned handles stay.
enum class Lead : std::int32_t { handles = 0, details = 1 };
struct Drag {
  int level = 0;
  std::vector<double> parameters;
  Points places;  // one a parameter, in the samples' coordinates; a point that is to stay: where it is
  Lead lead = Lead::handles;
};

// Levels `first` … `last`; with fade f, the f levels on each side follow by less and less. All of it by a share: less
// than 1 while the edit is under way.
struct Levels {
  int first = 0;
  int last = 0;
  int fade = 0;
  double share = 1;

  // The share within, 0 from fade + 1 levels away, smoothly between.
  double weight(int level) const;
};

// Details scaled, mirrored along an axis, and turned in the plane of the first two axes, in this order; a level of
// weight w by 1 + w (scale - 1), 1 - 2 w and w · angle.
struct Restyle {
  Levels levels;
  double scale = 1;
  double angle = 0;  // radians; dimension 2 and more
  int mirror = -1;   // an axis; -1: none
};

// Details blended with others: of another model, turned into this one's frames; or random ones.
struct Texture {
  Levels levels;
  ModelPtr from;           // another model; null: random, or as told
  double roughness = 0.5;  // H: from level to level sizes shrink by N^-H
  double size = 0;         // root mean square of the details of the first level; 0: as the curve's own
  std::uint64_t seed = 0;
  std::vector<PointsPtr> told = {};  // level by level, as they lie along this curve; not empty: instead of the others
};

using Edit = std::variant<Move, Pin, Drag, Restyle, Texture>;

// An edit, and when it takes place.
struct Timed {
  Edit edit;
  Span span;
};

}  // namespace ifsm::core
