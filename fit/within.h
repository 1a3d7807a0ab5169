// Sketches made to measure: so many details, nearest by a distance; or the fewest within a bound.
#pragma once

#include "curve/keep.h"
#include "measure/distance.h"

namespace ifsm::core {

// What becomes of kept values: they stay; are solved; and their choice is bettered.
enum class Resolve : std::int32_t { none = 0, values = 1, choice = 2 };

// A range error below 1e-12 of the diagonal, which is what models promise of their samples: such a bound asks for
// rounding.
void require_bound(double bound, double diagonal, const char* argument);

// The sketch that keeps these details (Resolve::choice: as many). Square models: solved for Distance::rms, whatever is
// asked, and their choice stays.
ModelPtr resolved(const Model& model, const Kept& kept, Resolve how, Distance distance, const Watch& watch);

// A sketch at most `bound` from the model's curve, of so few details that the search finds none of one fewer that is;
// Resolve::choice for distances other than the RMS: of one in 32 fewer. A range error when the bound is below what
// models promise of their own samples. Progress is told to `watch`.
ModelPtr keep_within(const Model& model, double bound, Resolve how, Distance distance, Watch& watch);

// The same by whole levels: the first that suffice. Not Resolve::choice.
ModelPtr keep_levels_within(const Model& model, double bound, Resolve how, Distance distance, Watch& watch);

}  // namespace ifsm::core
