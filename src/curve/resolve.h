// Sketches solved anew: the kept details and the free control points that come nearest to the samples.
#pragma once

#include "curve/keep.h"
#include "curve/tree_solver.h"

namespace ifsm::core {

// Between samples a curve is taken to be straight, and there it is a guess: a place counts half of its distance, so a
// quarter of its square. Without it, sketches of many details leave those places to themselves: 2500 details of
// Iceland's 3059 samples went 40 000 km out to sea, 141 m from the samples (docs/fitting.md).
inline constexpr double between_samples = 0.5;

// What counts of the distance at each place of the finest line: 1 at samples, between_samples between them, 0 where a
// joined ring's last place repeats its first.
Eigen::VectorXd counted_distances(const Model& model);
// Its squares: what least squares weigh places by.
Eigen::VectorXd place_weights(const Model& model);
// 1 at samples, 0 elsewhere.
Eigen::VectorXd sample_weights(const Model& model);

// The model whose kept values are solved by least squares against `model`'s places; others are zero. Joined: exactly;
// square: by conjugate gradients.
ModelPtr resolve(const Model& model, const Kept& kept, const Watch& watch);

// A better choice of as many details, then solved (joined; square: the choice stays). Never worse than `kept`.
ModelPtr resolve_choice(const Model& model, const Kept& kept, const Watch& watch);

// The pieces, for the fit.
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
Choice pursued(TreeSolver& solver, const RowMatrix& filter, const Choice& start, const Points& data, int trials,
               const Watch& watch);

// `count` details gathered from none, those first that help most beside what is there: a start that does not trust the
// size of the details, which under an ill-conditioned filter are large and cancel.
Choice gathered(TreeSolver& solver, const RowMatrix& filter, Index count, const Points& data, const Watch& watch);
// The better one of both starts, pursued.
Choice best_choice(TreeSolver& solver, const RowMatrix& filter, const Kept& kept, const Points& data, int trials,
                   const Watch& watch);

}  // namespace ifsm::core
