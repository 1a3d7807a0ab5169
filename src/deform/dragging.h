// Points of the curve dragged to places: handles or details of a level change by the least that leads them there.
#pragma once

#include "deform/edit.h"
#include "deform/state.h"

namespace ifsm::core {

// The state after the edit. Errors name the argument: "lead", "level", "parameters", "places".
Edited after(const State& now, const Drag& edit);

// A share of it: to that part of the straight way.
Drag part(const State& now, Drag edit, double share);

}  // namespace ifsm::core
