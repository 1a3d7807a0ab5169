// Sketches whose largest distance from the curve is small, instead of the mean of its square: the p-norm of all
// distances, p doubling, by reweighted least squares on the tree.
#pragma once

#include "curve/keep.h"
#include "measure/distance.h"

namespace ifsm::core {

// The best values found for the details that are kept; the best choice of as many. Never farther than resolve() and
// resolve_choice(). Joined models; `distance` is largest or hausdorff.
ModelPtr approach(const Model& model, const Kept& kept, Distance distance, const Watch& watch);
ModelPtr approach_choice(const Model& model, const Kept& kept, Distance distance, const Watch& watch);

}  // namespace ifsm::core
