// How a curve looks: its details of each level, mapped or replaced (paper 002, section 5, Appearance).
#pragma once

#include <cstdint>
#include <vector>

#include "curve/model.h"
#include "linalg/turn.h"

namespace ifsm::core {

// Of one level: details, the model's own when null, each times `map`.
struct LevelLook {
  SmallMatrix map;
  PointsPtr details;
};

using Look = std::vector<LevelLook>;  // [level]

Look own_look(const Model& model);

// The model in that look. Levels that keep their look are shared.
ModelPtr dressed(const Model& model, const Look& look);

// The details of that level of another model, told in the frames of this one's nodes (frames.h), the root's turned as
// the one control polygon lies to the other: texture that lies along this curve as it lay along the other one. Shapes
// and dimensions are the same.
PointsPtr borrowed_texture(const Model& model, int level, const Model& from);

// Gaussian details of a level, independent, of the root mean square `size`, seeded.
PointsPtr random_texture(const Model& model, int level, double size, std::uint64_t seed);

// Root mean square length of a level's details.
double texture_size(const Points& details);

}  // namespace ifsm::core
