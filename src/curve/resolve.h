// Sketches solved anew: the kept details and the free control points that come nearest to the samples.
#pragma once

#include "curve/keep.h"
#include "curve/tree_solver.h"

namespace ifsm::core {

// The model whose kept values are solved by least squares against `model`'s samples; others are zero. Joined: exactly;
// square: by conjugate gradients.
ModelPtr resolve(const Model& model, const Kept& kept, const Watch& watch);

// A better choice of as many details, then solved (joined; square: the choice stays): subspace pursuit, that is, adds
// the details that would help most, drops those that help least, and keeps what is better. Never worse than `kept`.
ModelPtr resolve_choice(const Model& model, const Kept& kept, const Watch& watch);

// The pieces, for the fit: what a joined model's samples ask of the finest line.
Eigen::VectorXd sample_weights(const Model& model);
Lanes lanes_of(const Points& line);

struct Choice {
  Kept kept;
  Solution solution;
  double squared_error;
};

// `kept` as it is, and bettered by at most `trials` rounds of pursuit.
Choice solved(TreeSolver& solver, const RowMatrix& filter, const Kept& kept, const Lanes& data, const Watch& watch);
Choice pursued(TreeSolver& solver, const RowMatrix& filter, Choice start, const Lanes& data, int trials,
               const Watch& watch);

}  // namespace ifsm::core
