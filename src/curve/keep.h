// Sketches: models that keep some details, the others being zero.
#pragma once

#include <vector>

#include "base/cancel.h"
#include "curve/model.h"

namespace ifsm::core {

// Which details are kept: a flag for each, level by level, node by node.
using Kept = std::vector<char>;

Kept first_levels(const Model& model, Index levels);
Kept most_significant(const Model& model, Index count);  // ties go to the coarser, then to the first
Kept above(const Model& model, double threshold);        // significance > threshold

// The `count` largest values, ties to the first.
Kept largest(const std::vector<double>& values, Index count);

// The model with its other details zero.
ModelPtr keep(const Model& model, const Kept& kept);
// Of every level as many details as the model's, all zero: what sketches of one curve may share.
std::vector<PointsPtr> zero_details(const Model& model);
// The same as keep(), levels without kept details taken from `zeros`.
ModelPtr keep(const Model& model, const Kept& kept, const std::vector<PointsPtr>& zeros);

}  // namespace ifsm::core
