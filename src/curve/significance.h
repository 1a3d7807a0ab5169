// How much a detail does to the curve: |δ| g, g² the sum over all places of the squared change a unit detail makes.
#pragma once

#include <vector>

#include "curve/model.h"

namespace ifsm::core {

// g of every detail of a node, for each level, coarsest first. The same for all nodes of a level:
// g² = diag Σ U_i G_l+1 U_i^T with G_l = Σ T_i G_l+1 T_i^T, from G_L = diag(1, …, 1, 0) when joined (each place counted
// once), I when square. Square polygons with a stride below n read places more than once: each reading then counts by
// stride / n.
std::vector<Eigen::VectorXd> gains(const Filter& filter, int levels);

// |δ| g of every detail of a level.
Eigen::VectorXd significance(const Model& model, int level);
Eigen::VectorXd significance(const Model& model, int level, const Eigen::VectorXd& gains_of_level);

}  // namespace ifsm::core
