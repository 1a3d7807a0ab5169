// Where along a curve, and at which scale, its details are.
#pragma once

#include <string>
#include <vector>

#include <ifsm.hpp>

#include "plot/panel.h"

namespace figures {

// Of each level, of each of its nodes: the RMS change of the whole curve that the node's details make.
std::vector<std::vector<double>> node_effects(const ifsm::Model& model);

// Levels from top to bottom, positions from left to right: each node as wide as its piece of the curve. `unit` of the
// samples, e.g. " in km".
plot::Panel scalogram_panel(const ifsm::Model& model, const std::vector<std::vector<double>>& effects,
                            const std::string& unit);

}  // namespace figures
