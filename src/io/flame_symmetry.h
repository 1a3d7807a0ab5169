// The symmetry of a flame: rotations, and a reflection, beside its maps. Turned into maps that contract.
#pragma once

#include <vector>

#include "linalg/affine.h"

namespace ifsm::core {

// n > 0: n - 1 rotations by multiples of 2 π / n about the origin; n < 0: those of -n, and the reflection x → -x. Each
// is taken as often as a map of weight 1.
//
// Such a map contracts nothing, and a system that holds it has no smallest attractor. But between two of the other maps
// there is only a run of symmetries, and their product is one of the group, g with the probability r_g: so what the
// points settle to is the measure of the maps g∘w of the weights r_g × w's. That is exact, and these contract.
struct WeightedMaps {
  std::vector<Affine> maps;
  std::vector<double> weights;
};
WeightedMaps with_symmetry(const WeightedMaps& plain, int kind);

// How many elements the group has: by so much more maps there are.
int symmetry_order(int kind);

}  // namespace ifsm::core
