// Least squares for the control points and the kept details of a joined model, exactly and in one pass up and one
// down the tree.
#pragma once

#include <vector>

#include "curve/tree_forms.h"

namespace ifsm::core {

// What is kept, and nothing that follows from it.
struct Solution {
  Lanes control;  // n × dimension
  Lanes values;   // kept details × dimension, in their order
};

class TreeSolver {
 public:
  // weight: one for each value of the finest line (a closed line's last repeats its first: weight 0 there).
  TreeSolver(const Shape& shape, int levels, bool closed, Eigen::VectorXd weight);

  // Up the tree: eliminates the kept details of every node.
  void factor(const RowMatrix& filter, const Kept& kept, const Watch& watch);

  // The values that fit `data`, a finest line, best; where the samples leave one open it is zero.
  Solution solve(const Points& data, const Watch& watch) const;

  // The finest line that a solution synthesises to.
  Points curve(const Solution& solution, const Watch& watch) const;

  // Σ weight |data - curve|².
  double squared_error(const Points& data, const Solution& solution, const Watch& watch) const;

  // For every detail, by how much the squared error would rise if it were dropped (kept ones), or fall if it were
  // added (others), everything else being solved again; `solution` is solve()'s, of the same data. Where the samples
  // leave kept values open, a kept one's score may be too high: what others could take over is not seen.
  std::vector<double> scores(const Points& data, const Solution& solution, const Watch& watch) const;

  // What factor() found.
  const TreeForms& forms() const { return forms_; }
  const Eigen::VectorXd& weight() const { return forms_.weight(); }
  Index details() const { return forms_.details(); }

 private:
  // What the data asks, one lane: of the control points, and R times the children's moments, for every detail.
  struct Moments {
    Eigen::VectorXd control;
    std::vector<double> details;
  };

  Moments moments(std::span<const double> data, const Watch& watch) const;
  void descend(int index, const Lanes& polygon, const Lanes& moments, Solution& solution) const;
  // One lane of the curve.
  void synthesize(const Solution& solution, Index lane, std::span<double> line, const Watch& watch) const;

  TreeForms forms_;
};

}  // namespace ifsm::core
