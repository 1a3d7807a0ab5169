// Details told in the frames of their nodes, and new models made from edited ones.
//
// A node's frame is size(P_θ) · Q_θ. The rotation is handed down: Q_θi = turn of (P_θ T_i → P_θi) after Q_θ, the root's
// being the identity for the polygon that a model has. A polygon that is a point has its parent's size (the root: 1),
// and one that is a point in one model alone counts as of the other's size. A similarity of the whole curve leaves
// node-frame details as they are. Source: details relative to the control polygon, math.md section 6.
#pragma once

#include "curve/model.h"

namespace ifsm::core {

enum class Frame : std::int32_t { absolute = 0, node = 1 };

// Detail vectors of a level, told in a frame.
Points details(const Model& model, int level, Frame frame);

// And back: detail vectors of a level, told in the frames of its nodes, as they are.
Points in_frames(const Model& model, int level, const Points& told);

// Absolute: details stay. Node: they turn and scale with their polygons: each node's by turn(P_θ → P'_θ). `polygon` in
// the samples' coordinates.
ModelPtr with_control_points(const Model& model, const Points& polygon, Frame frame);

// Other details at one level; the other levels stay as told in the same frame.
ModelPtr with_details(const Model& model, int level, Points vectors, Frame frame);

}  // namespace ifsm::core
