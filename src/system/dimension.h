// The similarity dimension of a system of similarities.
#pragma once

#include "system/system.h"

namespace ifsm::core {

// s with Σ r_i^s = 1 over the active maps of ratios r_i; a map of ratio 0 adds nothing. It is the Hausdorff dimension
// where pieces overlap little (the open set condition), else above it, and may then pass the plane's or space's own. A
// shape error names the first map that is no similarity, within rounding.
double similarity_dimension(const System& system);

}  // namespace ifsm::core
