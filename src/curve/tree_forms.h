// The quadratic forms of a joined tree: the least error of a subtree is E(P) = tr(P^T Q P) - 2 tr(P^T b) + c in its
// polygon P, and joined subtrees share nothing but points of that polygon. Children's forms add up through R, the
// node's kept details are eliminated, and the parent sees the Schur complement.
//
// Few details are kept, and samples sit evenly. So Q is held by what can differ: a form for each kind of node (nodes
// under which weights are the same and nothing is kept), and one for each branch (a node with something kept at it or
// below). Memory follows those, not the nodes.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "base/cancel.h"
#include "curve/filter.h"
#include "curve/keep.h"

namespace ifsm::core {

// Values for many right-hand sides at once: a place or a value a row, a lane (a coordinate, a tangent) a column.
using Lanes = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

inline constexpr std::size_t most_maps = 8;

// Of a node: its own form Q, and the columns of R F R^T that belong to its details, F the children's forms.
struct NodeForm {
  Eigen::MatrixXd form;
  Eigen::MatrixXd joint;  // rows × details a node
};

// Nodes of one level with the same weights below.
struct NodeKind {
  Index first;                          // the first such node of its level
  std::array<int, most_maps> children;  // their kinds; of leaves nothing
};

// A node with something kept at it or below. kept: which of its details; what they follow the node's polygon by, and
// the inverse of their block.
struct Branch {
  Index node;  // of its level
  int level;
  int kind;
  std::array<int, most_maps> children;  // branches; below zero: nothing is kept there
  std::vector<int> kept;
  Index first_value;  // of its kept details among all
  Eigen::MatrixXd gain, inverse;
  NodeForm form;
};

class TreeForms {
 public:
  TreeForms(const Shape& shape, int levels, bool closed, Eigen::VectorXd weight);

  // Up the tree: eliminates the kept details of every node.
  void factor(const RowMatrix& filter, const Kept& kept, const Watch& watch);

  const Shape& shape() const { return shape_; }
  int levels() const { return levels_; }
  bool closed() const { return closed_; }
  const Eigen::VectorXd& weight() const { return weight_; }
  const RowMatrix& filter() const { return filter_; }
  Index details() const { return shape_.first_node(levels_) * shape_.details_per_node(); }
  Index kept_count() const { return kept_count_; }

  // Branches of a level in order; the root is the first of all, when there is one.
  std::span<const Branch> branches(int level) const;
  const Branch& branch(int index) const { return branches_[static_cast<std::size_t>(index)]; }
  int root_branch() const { return branches_.empty() ? -1 : 0; }
  const NodeKind& kind(int index) const { return kinds_[static_cast<std::size_t>(index)]; }
  int root_kind() const { return static_cast<int>(kinds_.size()) - 1; }
  const NodeForm& form_of_kind(int index) const { return forms_[static_cast<std::size_t>(index)]; }

  // What rounding in the joint forms of a level is proportional to.
  const Eigen::VectorXd& full(int level) const { return full_[static_cast<std::size_t>(level)]; }
  // The inverse of the control points' form.
  const Eigen::MatrixXd& root_inverse() const { return root_inverse_; }

 private:
  bool at_leaves(int level) const { return level + 1 == levels_; }
  void find_kinds();
  void find_branches(const Kept& kept);
  void add_branch(int level, Index node, const Kept& kept, std::span<const Index> below);
  Eigen::VectorXd find_full();
  template <class FormOf>
  Eigen::MatrixXd joint_form(int level, Index node, const FormOf& form_of) const;
  void eliminate(Branch& branch, const Eigen::MatrixXd& joint);
  void invert_root(const Eigen::VectorXd& full);

  Shape shape_;
  int levels_;
  bool closed_;
  Eigen::VectorXd weight_;
  RowMatrix filter_;
  std::vector<NodeKind> kinds_;    // finest level first
  std::vector<int> first_kind_;    // a level each
  std::vector<NodeForm> forms_;    // of the kinds
  std::vector<Branch> branches_;   // coarsest level first
  std::vector<int> first_branch_;  // a level each, and the end
  Index kept_count_ = 0;
  std::vector<Eigen::VectorXd> full_;
  Eigen::MatrixXd root_inverse_;
};

}  // namespace ifsm::core
