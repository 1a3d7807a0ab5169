#include "curve/tree_forms.h"

#include <algorithm>
#include <cstring>
#include <unordered_map>
#include <utility>

#include "linalg/spectrum.h"

namespace ifsm::core {
namespace {

std::size_t mixed(std::size_t hash, std::uint64_t word) {
  hash = (hash ^ word) * 0x9E3779B97F4A7C15U;
  return hash ^ (hash >> 32);
}

}  // namespace

TreeForms::TreeForms(const Shape& shape, int levels, bool closed, Eigen::VectorXd weight)
    : shape_(shape), levels_(levels), closed_(closed), weight_(std::move(weight)) {
  find_kinds();
}

// Up the tree, level by level: two nodes are of one kind when their children are, two leaves when their weights are
// the same.
void TreeForms::find_kinds() {
  const auto maps = static_cast<std::size_t>(shape_.maps());
  const Index places = shape_.rows() - 1;
  std::vector<int> below, now;
  first_kind_.assign(static_cast<std::size_t>(levels_), 0);
  for (int level = levels_ - 1; level >= 0; --level) {
    first_kind_[static_cast<std::size_t>(level)] = static_cast<int>(kinds_.size());
    std::unordered_multimap<std::size_t, int> known;
    now.assign(static_cast<std::size_t>(shape_.nodes(level)), -1);
    for (std::size_t i = 0; i < now.size(); ++i) {
      NodeKind kind{static_cast<Index>(i), {}};
      const double* const own = weight_.data() + kind.first * places;
      std::size_t hash = 0;
      if (at_leaves(level)) {
        for (Index p = 0; p < places; ++p) {
          std::uint64_t word = 0;
          std::memcpy(&word, own + p, sizeof word);
          hash = mixed(hash, word);
        }
      } else {
        std::copy_n(below.begin() + static_cast<std::ptrdiff_t>(i * maps), maps, kind.children.begin());
        for (std::size_t c = 0; c < maps; ++c) hash = mixed(hash, static_cast<std::uint64_t>(kind.children[c]));
      }
      const auto [first, last] = known.equal_range(hash);
      for (auto other = first; other != last && now[i] < 0; ++other) {
        const NodeKind& that = kinds_[static_cast<std::size_t>(other->second)];
        const bool same = at_leaves(level) ? std::equal(own, own + places, weight_.data() + that.first * places)
                                           : kind.children == that.children;
        if (same) now[i] = other->second;
      }
      if (now[i] >= 0) continue;
      now[i] = static_cast<int>(kinds_.size());
      known.emplace(hash, now[i]);
      kinds_.push_back(kind);
    }
    below.swap(now);
  }
}

std::span<const Branch> TreeForms::branches(int level) const {
  const auto first = static_cast<std::size_t>(first_branch_[static_cast<std::size_t>(level)]);
  const auto last = static_cast<std::size_t>(first_branch_[static_cast<std::size_t>(level) + 1]);
  return std::span(branches_).subspan(first, last - first);
}

// Up the tree for the nodes, then down it for the branches, so that the coarsest come first.
void TreeForms::find_branches(const Kept& kept) {
  const Index d = shape_.details_per_node();
  std::vector<std::vector<Index>> nodes(static_cast<std::size_t>(levels_) + 1);
  for (int level = levels_ - 1; level >= 0; --level) {
    const auto begin = kept.begin() + shape_.first_node(level) * d, end = begin + shape_.detail_count(level);
    auto& own = nodes[static_cast<std::size_t>(level)];
    const auto add = [&](Index node) {
      if (own.empty() || own.back() != node) own.push_back(node);
    };
    auto below = nodes[static_cast<std::size_t>(level) + 1].cbegin();
    const auto below_end = nodes[static_cast<std::size_t>(level) + 1].cend();
    for (auto flag = std::find_if(begin, end, [](char f) { return f != 0; }); flag != end;
         flag = std::find_if(flag + 1, end, [](char f) { return f != 0; })) {
      const Index node = (flag - begin) / d;
      for (; below != below_end && *below / shape_.maps() < node; ++below) add(*below / shape_.maps());
      add(node);
    }
    for (; below != below_end; ++below) add(*below / shape_.maps());
  }
  branches_.clear();
  first_branch_.assign(1, 0);
  kept_count_ = 0;
  for (int level = 0; level < levels_; ++level) {
    const auto& own = nodes[static_cast<std::size_t>(level)];
    first_branch_.push_back(first_branch_.back() + static_cast<int>(own.size()));
    auto below = std::span<const Index>(nodes[static_cast<std::size_t>(level) + 1]);
    for (const Index node : own) add_branch(level, node, kept, below);
  }
}

// `below`: the branches of the next level, the first of which is a child of the first node of this level.
void TreeForms::add_branch(int level, Index node, const Kept& kept, std::span<const Index> below) {
  const int d = shape_.details_per_node(), maps = shape_.maps();
  Branch branch{node, level, root_kind(), {}, {}, kept_count_, {}, {}, {}};
  branch.children.fill(-1);
  const auto first = std::ranges::lower_bound(below, node * maps);
  for (auto child = first; child != below.end() && *child < (node + 1) * maps; ++child)
    branch.children[static_cast<std::size_t>(*child - node * maps)] =
        first_branch_.back() + static_cast<int>(child - below.begin());
  // The way down to it tells its kind.
  Index nodes = 1;
  for (int l = 1; l <= level; ++l) nodes *= maps;
  for (Index rest = node; nodes > 1;) {
    nodes /= maps;
    branch.kind = kind(branch.kind).children[static_cast<std::size_t>(rest / nodes)];
    rest %= nodes;
  }
  const char* const flags = kept.data() + (shape_.first_node(level) + node) * d;
  for (int j = 0; j < d; ++j)
    if (flags[j]) branch.kept.push_back(j);
  kept_count_ += static_cast<Index>(branch.kept.size());
  branches_.push_back(std::move(branch));
}

// R F R^T, F the forms of the children, or the weights of a leaf's places.
template <class FormOf>
Eigen::MatrixXd TreeForms::joint_form(int level, Index node, const FormOf& form_of) const {
  const int n = shape_.control_points(), rows = shape_.rows();
  Eigen::MatrixXd below = Eigen::MatrixXd::Zero(rows, rows);
  if (at_leaves(level)) {
    below.diagonal().head(rows - 1) = weight_.segment(node * (rows - 1), rows - 1);
  } else {
    for (int c = 0; c < shape_.maps(); ++c)
      below.block(first_column(shape_, c), first_column(shape_, c), n, n) += form_of(static_cast<std::size_t>(c));
  }
  const Eigen::MatrixXd lifted = filter_.lazyProduct(below);
  return lifted.lazyProduct(filter_.transpose());
}

void TreeForms::eliminate(Branch& branch, const Eigen::MatrixXd& joint) {
  const int n = shape_.control_points(), d = shape_.details_per_node();
  branch.form.joint = joint.rightCols(d);
  branch.form.form = joint.topLeftCorner(n, n);
  const auto count = static_cast<Index>(branch.kept.size());
  if (count == 0) return;
  Eigen::MatrixXd own(count, count), cross(count, n);
  Eigen::VectorXd full(count);
  for (Index a = 0; a < count; ++a) {
    const int row = n + branch.kept[static_cast<std::size_t>(a)];
    full(a) = this->full(branch.level)(row);
    for (Index b = 0; b < count; ++b) own(a, b) = joint(row, n + branch.kept[static_cast<std::size_t>(b)]);
    cross.row(a) = joint.row(row).head(n);
  }
  branch.inverse = known_inverse(own, full);
  branch.gain = branch.inverse.lazyProduct(cross);
  branch.form.form -= cross.transpose().lazyProduct(branch.gain);
}

// What the diagonals of the joint forms would be with every place a sample and nothing eliminated.
Eigen::VectorXd TreeForms::find_full() {
  const int n = shape_.control_points();
  const double most = weight_.maxCoeff();
  Eigen::MatrixXd form = most * Eigen::MatrixXd::Identity(n, n);
  form(n - 1, n - 1) = 0;
  full_.assign(static_cast<std::size_t>(levels_), {});
  for (int level = levels_ - 1; level >= 0; --level) {
    Eigen::MatrixXd joint = Eigen::MatrixXd::Zero(shape_.rows(), shape_.rows());
    for (int c = 0; c < shape_.maps(); ++c) {
      const auto child = filter_.middleCols(first_column(shape_, c), n);
      joint += child * form * child.transpose();
    }
    full_[static_cast<std::size_t>(level)] = joint.diagonal();
    form = joint.topLeftCorner(n, n).eval();
  }
  form(n - 1, n - 1) += most;
  return form.diagonal();
}

void TreeForms::factor(const RowMatrix& filter, const Kept& kept, const Watch& watch) {
  RowMatrix copy = filter;
  filter_.swap(copy);
  const int n = shape_.control_points(), d = shape_.details_per_node();
  const Eigen::VectorXd full = find_full();
  find_branches(kept);
  forms_.resize(kinds_.size());
  std::size_t k = 0;
  for (int level = levels_ - 1; level >= 0; --level) {
    const std::size_t end =
        level > 0 ? static_cast<std::size_t>(first_kind_[static_cast<std::size_t>(level) - 1]) : kinds_.size();
    for (; k < end; ++k) {
      if (k % 256 == 0) watch.poll();
      const NodeKind& kind = kinds_[k];
      const Eigen::MatrixXd joint = joint_form(level, kind.first, [&](std::size_t c) -> const Eigen::MatrixXd& {
        return form_of_kind(kind.children[c]).form;
      });
      forms_[k] = {joint.topLeftCorner(n, n), joint.rightCols(d)};
    }
  }
  for (std::size_t b = branches_.size(); b-- > 0;) {
    if (b % 256 == 0) watch.poll();
    Branch& branch = branches_[b];
    const auto form_of = [&](std::size_t c) -> const Eigen::MatrixXd& {
      const int child = branch.children[c];
      return child < 0 ? form_of_kind(kind(branch.kind).children[c]).form : this->branch(child).form.form;
    };
    eliminate(branch, joint_form(branch.level, branch.node, form_of));
  }
  invert_root(full);
}

void TreeForms::invert_root(const Eigen::VectorXd& full) {
  const int n = shape_.control_points();
  Eigen::MatrixXd root = Eigen::MatrixXd::Zero(n, n);
  if (levels_ > 0)
    root = branches_.empty() ? form_of_kind(root_kind()).form : branch(0).form.form;
  else
    root.diagonal().head(n - 1) = weight_.head(n - 1);
  root(n - 1, n - 1) += weight_(weight_.size() - 1);
  if (!closed_) {
    root_inverse_ = known_inverse(root, full);
    return;
  }
  // p_n-1 = p_0: solve for the others.
  Eigen::MatrixXd tie = Eigen::MatrixXd::Identity(n, n - 1);
  tie(n - 1, 0) = 1;
  const Eigen::MatrixXd reduced = tie.transpose() * root * tie;
  root_inverse_ = tie * known_inverse(reduced, tie.cwiseAbs2().transpose() * full) * tie.transpose();
}

}  // namespace ifsm::core
