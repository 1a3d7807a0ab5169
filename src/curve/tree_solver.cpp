#include "curve/tree_solver.h"

#include <utility>

#include "linalg/spectrum.h"

namespace ifsm::core {

TreeSolver::TreeSolver(const Shape& shape, int levels, bool closed, Eigen::VectorXd weight)
    : shape_(shape), levels_(levels), closed_(closed), weight_(std::move(weight)) {
  const int n = shape_.control_points(), d = shape_.details_per_node(), rows = shape_.rows();
  joint_ = Eigen::MatrixXd(rows, rows * node_count());
  form_ = Eigen::MatrixXd(n, n * node_count());
  gain_ = Eigen::MatrixXd(d, n * node_count());
  inverse_ = Eigen::MatrixXd(d, d * node_count());
  kept_ = std::vector<std::vector<int>>(static_cast<std::size_t>(node_count()));
}

Eigen::MatrixXd TreeSolver::children_form(int level, Index i) const {
  const int n = shape_.control_points(), rows = shape_.rows();
  Eigen::MatrixXd form = Eigen::MatrixXd::Zero(rows, rows);
  if (at_leaves(level)) {
    form.diagonal().head(rows - 1) = weight_.segment(i * (rows - 1), rows - 1);
    return form;
  }
  const Index first = shape_.first_node(level + 1) + i * shape_.maps();
  for (int c = 0; c < shape_.maps(); ++c)
    form.block(first_column(shape_, c), first_column(shape_, c), n, n) += form_.middleCols((first + c) * n, n);
  return form;
}

void TreeSolver::eliminate(int level, Index node, const Kept& kept) {
  const int n = shape_.control_points(), d = shape_.details_per_node(), rows = shape_.rows();
  const auto joint = joint_.middleCols(node * rows, rows);
  auto& chosen = kept_[static_cast<std::size_t>(node)];
  chosen.clear();
  for (int j = 0; j < d; ++j)
    if (kept[static_cast<std::size_t>(node * d + j)]) chosen.push_back(j);
  auto form = form_.middleCols(node * n, n);
  form = joint.topLeftCorner(n, n);
  const auto count = static_cast<Index>(chosen.size());
  if (count == 0) return;
  Eigen::MatrixXd own(count, count), cross(count, n);
  Eigen::VectorXd full(count);
  for (Index a = 0; a < count; ++a) {
    const int row = n + chosen[static_cast<std::size_t>(a)];
    full(a) = full_[static_cast<std::size_t>(level)](row);
    for (Index b = 0; b < count; ++b) own(a, b) = joint(row, n + chosen[static_cast<std::size_t>(b)]);
    cross.row(a) = joint.row(row).head(n);
  }
  const Eigen::MatrixXd inverse = known_inverse(own, full);
  inverse_.block(0, node * d, count, count) = inverse;
  gain_.block(0, node * n, count, n) = inverse.lazyProduct(cross);
  form -= cross.transpose().lazyProduct(gain_.block(0, node * n, count, n));
}

// What the diagonals of the joint forms would be with every place a sample and nothing eliminated.
Eigen::VectorXd TreeSolver::find_full() {
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

void TreeSolver::factor(const RowMatrix& filter, const Kept& kept, const Watch& watch) {
  RowMatrix copy = filter;
  filter_.swap(copy);
  const int n = shape_.control_points(), rows = shape_.rows();
  const Eigen::VectorXd full = find_full();
  for (int level = levels_ - 1; level >= 0; --level)
    for (Index i = 0; i < shape_.nodes(level); ++i) {
      if (i % 256 == 0) watch.poll();
      const Index node = shape_.first_node(level) + i;
      const Eigen::MatrixXd lifted = filter_.lazyProduct(children_form(level, i));
      joint_.middleCols(node * rows, rows).noalias() = lifted.lazyProduct(filter_.transpose());
      eliminate(level, node, kept);
    }
  Eigen::MatrixXd root = Eigen::MatrixXd::Zero(n, n);
  if (levels_ > 0)
    root = form_.leftCols(n);
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

Lanes TreeSolver::children_moment(int level, Index i, const Lanes& data, const Lanes& below) const {
  const int n = shape_.control_points(), rows = shape_.rows();
  Lanes moment = Lanes::Zero(rows, data.cols());
  if (at_leaves(level)) {
    moment.topRows(rows - 1) =
        weight_.segment(i * (rows - 1), rows - 1).asDiagonal() * data.middleRows(i * (rows - 1), rows - 1);
    return moment;
  }
  const Index first = shape_.first_node(level + 1) + i * shape_.maps();
  for (int c = 0; c < shape_.maps(); ++c)
    moment.middleRows(first_column(shape_, c), n) += below.middleRows((first + c) * n, n);
  return moment;
}

Solution TreeSolver::solve(const Lanes& data, const Watch& watch) {
  const int n = shape_.control_points(), d = shape_.details_per_node(), rows = shape_.rows();
  Lanes moment(rows * node_count(), data.cols()), below(n * node_count(), data.cols());
  for (int level = levels_ - 1; level >= 0; --level)
    for (Index i = 0; i < shape_.nodes(level); ++i) {
      if (i % 256 == 0) watch.poll();
      const Index node = shape_.first_node(level) + i;
      auto own = moment.middleRows(node * rows, rows);
      own.noalias() = filter_ * children_moment(level, i, data, below);
      auto passed = below.middleRows(node * n, n);
      passed = own.topRows(n);
      const auto& chosen = kept_[static_cast<std::size_t>(node)];
      for (std::size_t a = 0; a < chosen.size(); ++a)
        passed.noalias() -= gain_.block(static_cast<Index>(a), node * n, 1, n).transpose() * own.row(n + chosen[a]);
    }
  moment_.swap(moment);

  Lanes top = levels_ > 0 ? Lanes(below.topRows(n)) : Lanes(weight_.asDiagonal() * data);
  if (levels_ > 0) top.row(n - 1) += weight_(weight_.size() - 1) * data.row(data.rows() - 1);
  Solution solution{root_inverse_ * top, Lanes::Zero(node_count() * d, data.cols()), {}};
  Lanes coarse = solution.control;
  for (int level = 0; level < levels_; ++level) {
    Lanes fine(shape_.line_length(level + 1), data.cols());
    for (Index i = 0; i < shape_.nodes(level); ++i) {
      if (i % 256 == 0) watch.poll();
      descend(shape_.first_node(level) + i, coarse.middleRows(i * shape_.polygon_step(), n),
              fine.middleRows(i * shape_.children_step(), rows), solution);
    }
    coarse.swap(fine);
  }
  solution.curve.swap(coarse);
  return solution;
}

void TreeSolver::descend(Index node, const Eigen::Ref<const Lanes>& polygon, Eigen::Ref<Lanes> children,
                         Solution& solution) const {
  const int n = shape_.control_points(), d = shape_.details_per_node(), rows = shape_.rows();
  children.noalias() = filter_.topRows(n).transpose() * polygon;
  const auto& chosen = kept_[static_cast<std::size_t>(node)];
  const auto count = static_cast<Index>(chosen.size());
  if (count == 0) return;
  Lanes moment(count, polygon.cols());
  for (Index a = 0; a < count; ++a) moment.row(a) = moment_.row(node * rows + n + chosen[static_cast<std::size_t>(a)]);
  const Lanes values =
      inverse_.block(0, node * d, count, count) * moment - gain_.block(0, node * n, count, n) * polygon;
  for (Index a = 0; a < count; ++a) {
    const int j = chosen[static_cast<std::size_t>(a)];
    solution.details.row(node * d + j) = values.row(a);
    children.noalias() += filter_.row(n + j).transpose() * values.row(a);
  }
}

// Down the tree with the covariance of each polygon: of the free values above and the node's own kept details, given
// everything else. A detail's score is its squared residual correlation over what of its own form is left free.
void TreeSolver::score_node(int level, Index node, const Eigen::Ref<const Eigen::MatrixXd>& spread,
                            const Eigen::Ref<const Lanes>& polygon, const Solution& solution,
                            std::vector<double>& score, Eigen::Ref<Eigen::MatrixXd> children) const {
  const int n = shape_.control_points(), d = shape_.details_per_node(), rows = shape_.rows();
  const auto& chosen = kept_[static_cast<std::size_t>(node)];
  const auto count = static_cast<Index>(chosen.size()), free = n + count;
  const auto joint = joint_.middleCols(node * rows, rows);
  const auto gain = gain_.block(0, node * n, count, n);
  Eigen::MatrixXd covariance(free, free), passed(free, rows), cross(free, d);
  Lanes value(free, polygon.cols());
  covariance.topLeftCorner(n, n) = spread;
  covariance.bottomLeftCorner(count, n) = -gain * spread;
  covariance.topRightCorner(n, count) = covariance.bottomLeftCorner(count, n).transpose();
  covariance.bottomRightCorner(count, count) =
      inverse_.block(0, node * d, count, count) - covariance.bottomLeftCorner(count, n) * gain.transpose();
  passed.topRows(n) = filter_.topRows(n);
  cross.topRows(n) = joint.block(0, n, n, d);
  value.topRows(n) = polygon;
  for (Index a = 0; a < count; ++a) {
    const int j = chosen[static_cast<std::size_t>(a)];
    passed.row(n + a) = filter_.row(n + j);
    cross.row(n + a) = joint.block(n + j, n, 1, d);
    value.row(n + a) = solution.details.row(node * d + j);
  }

  const Lanes residual = moment_.middleRows(node * rows + n, d) - cross.transpose() * value;
  const Eigen::MatrixXd covered = covariance * cross;
  constexpr double dependent = 1e-9;  // a detail that the free values can imitate brings nothing
  for (int j = 0; j < d; ++j) {
    const double left = joint(n + j, n + j) - cross.col(j).dot(covered.col(j));
    if (left > dependent * full_[static_cast<std::size_t>(level)](n + j))
      score[static_cast<std::size_t>(node * d + j)] = residual.row(j).squaredNorm() / left;
  }
  for (Index a = 0; a < count; ++a) {
    const double variance = covariance(n + a, n + a);
    score[static_cast<std::size_t>(node * d + chosen[static_cast<std::size_t>(a)])] =
        variance > 0 ? value.row(n + a).squaredNorm() / variance : 0.0;
  }
  for (int c = 0; c < shape_.maps(); ++c) {
    const auto part = passed.middleCols(first_column(shape_, c), n);
    const Eigen::MatrixXd spread_part = covariance * part;
    children.middleCols(c * n, n).noalias() = part.transpose() * spread_part;
  }
}

std::vector<double> TreeSolver::scores(const Solution& solution) const {
  const int n = shape_.control_points(), d = shape_.details_per_node(), rows = shape_.rows();
  std::vector<double> score(static_cast<std::size_t>(node_count() * d), 0.0);
  Eigen::MatrixXd spread = root_inverse_;
  Lanes coarse = solution.control;
  for (int level = 0; level < levels_; ++level) {
    Eigen::MatrixXd next(n, n * shape_.nodes(level + 1));
    Lanes fine(shape_.line_length(level + 1), coarse.cols());
    for (Index i = 0; i < shape_.nodes(level); ++i) {
      const Index node = shape_.first_node(level) + i;
      const auto polygon = coarse.middleRows(i * shape_.polygon_step(), n);
      score_node(level, node, spread.middleCols(i * n, n), polygon, solution, score,
                 next.middleCols(i * n * shape_.maps(), n * shape_.maps()));
      fine.middleRows(i * shape_.children_step(), rows) =
          filter_.topRows(n).transpose() * polygon +
          filter_.bottomRows(d).transpose() * solution.details.middleRows(node * d, d);
    }
    spread.swap(next);
    coarse.swap(fine);
  }
  return score;
}

double TreeSolver::squared_error(const Lanes& data, const Lanes& curve) const {
  return weight_.dot((data - curve).rowwise().squaredNorm());
}

}  // namespace ifsm::core
