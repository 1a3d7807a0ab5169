// Sketches solved anew: the kept details and the free control points that come nearest to the samples.
#pragma once

#include "curve/keep.h"
#include "curve/tree_solver.h"

namespace ifsm::core {

// The model whose kept values are solved by least squares against `model`'s samples; others are zero. Joined: exactly;
// square: by conjugate gradients.
ModelPtr resolve(const Model& model, const Kept& kept, const Watch& watch);

// A better choice of as many details, then solved (joined; square: the choice stays). Never worse than `kept`.
ModelPtr resolve_choice(const Model& model, const Kept& kept, const Watch& watch);

// The pieces, for the fit: what a joined model's samples ask of the finest line.
Eigen::VectorXd sample_weights(const Model& model);

struct Choice {
  Kept kept;
  Solution solution;
  double squared_error;
};

// The model that has the solved values; levels that keep nothing are those of `zeros` (keep.h).
ModelPtr solved_model(ModelParts parts, const std::vector<PointsPtr>& zeros, const Kept& kept,
                      const Solution& solution);

// `kept` as it is.
Choice solved(TreeSolver& solver, const RowMatrix& filter, const Kept& kept, const Points& data, const Watch& watch);
// Subspace pursuit, at most `trials` rounds: adds the details that would help most, drops those that help least, keeps
// what is better.
Choice pursued(TreeSolver& solver, const RowMatrix& filter, Choice start, const Points& data, int trials,
               const Watch& watch);

// `count` details gathered from none, those first that help most beside what is there: a start that does not trust the
// size of the details, which under an ill-conditioned filter are large and cancel.
Choice gathered(TreeSolver& solver, const RowMatrix& filter, Index count, const Points& data, const Watch& watch);
// The better one of both starts, pursued.
Choice best_choice(TreeSolver& solver, const RowMatrix& filter, const Kept& kept, const Points& data, int trials,
                   const Watch& watch);

}  // namespace ifsm::core
