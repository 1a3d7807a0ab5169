// Edits of a curve's appearance: its details scaled, mirrored, turned and replaced (paper 002, section 5).
#pragma once

#include "deform/edit.h"
#include "deform/state.h"

namespace ifsm::core {

// The state after an edit. Errors name the argument: "first", "last", "fade", "share", "scale", "angle", "mirror",
// "roughness", "size", "from", "details".
Edited after(const State& now, const Restyle& edit);
Edited after(const State& now, const Texture& edit);

// What of an edit a share of it is.
Restyle part(const State& now, Restyle edit, double share);
Texture part(const State& now, Texture edit, double share);

// What a texture puts on a level, before its share: null where it does not reach.
PointsPtr texture(const Model& model, const Texture& edit, int level);

}  // namespace ifsm::core
