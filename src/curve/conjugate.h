// The same least squares for square models, whose polygons share places: conjugate gradients on synthesis itself.
#pragma once

#include "curve/keep.h"

namespace ifsm::core {

// `sketch` (model's kept details, others zero) corrected so that it comes nearest to `model`'s places, as far as
// those count (resolve.h).
ModelPtr conjugate_resolve(const Model& model, const Model& sketch, const Kept& kept, const Watch& watch);

}  // namespace ifsm::core
