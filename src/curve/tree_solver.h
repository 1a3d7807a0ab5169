// Least squares for the control points and the kept details of a joined model, exactly and in one pass up and one
// down the tree: the least error of a subtree is a quadratic form in its polygon, E(P) = tr(P^T Q P) - 2 tr(P^T b) + c,
// and joined subtrees share nothing but points of that polygon. Children's forms add up through R, the node's kept
// details are eliminated, and the parent sees the Schur complement.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "base/cancel.h"
#include "curve/filter.h"
#include "curve/keep.h"

namespace ifsm::core {

// Values for many right-hand sides at once: a place or a value a row, a lane (a coordinate, a tangent) a column.
using Lanes = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct Solution {
  Lanes control;  // n × lanes
  Lanes details;  // details of all levels × lanes, zero where not kept
  Lanes curve;    // places of the finest line × lanes: their synthesis
};

class TreeSolver {
 public:
  // weight: one for each value of the finest line (a closed line's last repeats its first: weight 0 there).
  TreeSolver(const Shape& shape, int levels, bool closed, Eigen::VectorXd weight);

  // Other weights, for what is factored from now on.
  void reweigh(Eigen::VectorXd weight) { weight_.swap(weight); }

  // Up the tree: eliminates the kept details of every node.
  void factor(const RowMatrix& filter, const Kept& kept, const Watch& watch);

  // The values that fit `data` (a finest line a column) best; where the samples leave one open it is zero.
  Solution solve(const Lanes& data, const Watch& watch);

  // For every detail, by how much the squared error would rise if it were dropped (kept ones), or fall if it were
  // added (others), everything else being solved again. Follows solve(), about the same data. Where the samples leave
  // kept values open, a kept one's score may be too high: what others could take over is not seen.
  std::vector<double> scores(const Solution& solution) const;

  // Σ weight |data - curve|².
  double squared_error(const Lanes& data, const Lanes& curve) const;

  const Eigen::VectorXd& weight() const { return weight_; }
  Index details() const { return node_count() * shape_.details_per_node(); }

  // What factor() found of a node: which details are kept, the inverse of their block, and what they follow the node's
  // polygon by. Of the root: the inverse of the control points' form.
  const std::vector<int>& kept_at(Index node) const { return kept_[static_cast<std::size_t>(node)]; }
  Eigen::MatrixXd inverse_at(Index node) const {
    const auto count = static_cast<Index>(kept_at(node).size());
    return inverse_.block(0, node * shape_.details_per_node(), count, count);
  }
  Eigen::MatrixXd gain_at(Index node) const {
    const int n = shape_.control_points();
    return gain_.block(0, node * n, static_cast<Index>(kept_at(node).size()), n);
  }
  const Eigen::MatrixXd& root_inverse() const { return root_inverse_; }

 private:
  Index node_count() const { return shape_.first_node(levels_); }
  bool at_leaves(int level) const { return level + 1 == levels_; }
  Eigen::VectorXd find_full();
  void eliminate(int level, Index node, const Kept& kept);
  Eigen::MatrixXd children_form(int level, Index i) const;
  Lanes children_moment(int level, Index i, const Lanes& data, const Lanes& below) const;
  void descend(Index node, const Eigen::Ref<const Lanes>& polygon, Eigen::Ref<Lanes> children,
               Solution& solution) const;
  void score_node(int level, Index node, const Eigen::Ref<const Eigen::MatrixXd>& spread,
                  const Eigen::Ref<const Lanes>& polygon, const Solution& solution, std::vector<double>& score,
                  Eigen::Ref<Eigen::MatrixXd> children) const;

  Shape shape_;
  int levels_;
  bool closed_;
  Eigen::VectorXd weight_;
  RowMatrix filter_;
  // A block of columns a node: R F R^T, F the children's forms; the node's own form; what is kept as a linear map of
  // the polygon; the inverse of the kept details' block.
  Eigen::MatrixXd joint_, form_, gain_, inverse_;
  Eigen::MatrixXd root_inverse_;
  std::vector<std::vector<int>> kept_;
  std::vector<Eigen::VectorXd> full_;  // a level each: what rounding in its forms is proportional to
  Lanes moment_;
};

}  // namespace ifsm::core
