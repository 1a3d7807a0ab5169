// What every detail of a solved tree is worth: one way down with the covariance of each polygon.
#pragma once

#include <vector>

#include "curve/tree_solver.h"

namespace ifsm::core {

// TreeSolver::scores(). moments: R times the children's moments, of every detail, a lane each.
std::vector<double> scores_of(const TreeForms& forms, const Solution& solution,
                              const std::vector<std::vector<double>>& moments, const Watch& watch);

}  // namespace ifsm::core
