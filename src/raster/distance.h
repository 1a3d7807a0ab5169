// How far each pixel is from the attractor.
#pragma once

#include <vector>

#include "base/cancel.h"
#include "raster/chaos.h"
#include "system/system.h"

namespace ifsm::core {

// From the middle of each pixel of the window, row by row, in the system's units: above the distance by at most the
// tolerance (in pixels), and never below it by more than rounding. By branch and bound over words, begun with what the
// pixel before has found. The plane alone (shape).
std::vector<double> distances(const System& system, const Window& window, double tolerance, Watch& watch);

}  // namespace ifsm::core
