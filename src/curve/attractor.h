// Between the two kinds of shapes: a detail model of d+1 control points, its details left out, is the attractor of a
// system, and a system is such a model (paper 002: with n = d+1 points T_i = B^-1 w_i B).
#pragma once

#include "curve/model.h"
#include "system/system.h"

namespace ifsm::core {

// The system whose attractor is the model's limit without details; its maps are equally likely, as pieces of the
// parameter are. A shape error unless the model lies in the plane with three control points or in space with four; a
// singular one when these lie on a line (in a plane).
SystemPtr system_of(const Model& model);

// The model without details whose limit is the attractor of the active maps, in their order: 2 … 8. `polygon`: d+1
// points, not on a line (in a plane), or none at all for the library's choice.
// Square: any system, any polygon; chosen, the corners of its box. Joined: the maps' pieces are one chain; the
// polygon's ends are the first map's fixed point and the last one's, and each map leads the last end to where the next
// one leads the first: a shape error names the map where that breaks. Inner points are free; chosen, they lie beside
// the line between the ends.
ModelPtr model_of(const System& system, Topology topology, const Points& polygon, int levels);

}  // namespace ifsm::core
