#include "curve/tree_scores.h"

#include <utility>

#include "base/parallel.h"

namespace ifsm::core {
namespace {

constexpr double dependent = 1e-9;     // of what is full: a detail that the free values can imitate brings nothing
constexpr Index roots_wanted = 64;     // subtrees that share the threads
constexpr Index worth_sharing = 4096;  // nodes: fewer are done before threads are awake

// A node on the way down, and what is known of its polygon.
struct Node {
  int level;
  Index index;
  int kind, branch;       // branch below zero: nothing is kept at it or below
  const double* spread;   // n × n: the polygon's covariance, of the free values above given everything else
  const double* polygon;  // n × lanes, a lane after the other
};

class Way {
 public:
  Way(const TreeForms& forms, const Solution& solution, const std::vector<std::vector<double>>& moments,
      const Watch& watch, std::vector<double>& score)
      : forms_(forms),
        solution_(solution),
        moments_(moments),
        watch_(watch),
        score_(score),
        shape_(forms.shape()),
        n_(shape_.control_points()),
        d_(shape_.details_per_node()),
        rows_(shape_.rows()),
        lanes_(solution.control.cols()),
        beside_(static_cast<std::size_t>(n_)),
        lifted_(static_cast<std::size_t>(n_ * rows_)),
        buffers_(static_cast<std::size_t>(forms.levels())) {
    for (Children& children : buffers_) {
      children.spread.resize(static_cast<std::size_t>(shape_.maps() * n_ * n_));
      children.polygon.resize(static_cast<std::size_t>(shape_.maps() * n_ * lanes_));
    }
  }

  // The nodes of level `end` are handed out, those above it are scored; depth first, in the memory of one path.
  template <class Take>
  void down(const Node& node, int end, const Take& take) {
    if (node.level == end) return take(node);
    if (node.index % 64 == 0) watch_.poll();
    Children& children = buffers_[static_cast<std::size_t>(node.level)];
    if (node.branch >= 0)
      score_branch(node, children);
    else if (n_ == 5)
      score_plain<5>(node, children);
    else
      score_plain<0>(node, children);
    if (node.level + 1 == forms_.levels()) return;
    for (int c = 0; c < shape_.maps(); ++c) {
      const auto at = static_cast<std::size_t>(c);
      down({node.level + 1, node.index * shape_.maps() + c, forms_.kind(node.kind).children[at],
            node.branch < 0 ? -1 : forms_.branch(node.branch).children[at], children.spread.data() + c * n_ * n_,
            children.polygon.data() + c * n_ * lanes_},
           end, take);
    }
  }

 private:
  struct Children {
    std::vector<double> spread, polygon;
  };

  Index first_detail(const Node& node) const { return (shape_.first_node(node.level) + node.index) * d_; }

  // The score of a detail that is not kept: its squared residual correlation over what of its own form is left free.
  // cross: its joint form with the free values, a value of each lane `free` apart.
  void score(const Node& node, Index detail, Index j, double own, Index free, const double* cross,
             const double* covered, const double* value) {
    double left = own, squares = 0;
    for (Index i = 0; i < free; ++i) left -= cross[i] * covered[i];
    if (!(left > dependent * forms_.full(node.level)(n_ + j))) return;
    for (Index lane = 0; lane < lanes_; ++lane) {
      double residual = moments_[static_cast<std::size_t>(lane)][static_cast<std::size_t>(detail)];
      for (Index i = 0; i < free; ++i) residual -= cross[i] * value[lane * free + i];
      squares += residual * residual;
    }
    score_[static_cast<std::size_t>(detail)] = squares / left;
  }

  // Nothing is kept here: score_branch() without its free values, by hand, since nearly all nodes are such. N: n when
  // it is known (5 is the default), which unrolls the loops.
  template <Index N>
  void score_plain(const Node& node, Children& out) {
    const Index n = N > 0 ? N : n_;
    const Eigen::MatrixXd& joint = forms_.form_of_kind(node.kind).joint;
    const Index first = first_detail(node);
    for (Index j = 0; j < d_; ++j) {
      const double* const cross = joint.data() + j * rows_;
      for (Index i = 0; i < n; ++i) {
        double sum = 0;
        for (Index k = 0; k < n; ++k) sum += node.spread[i * n + k] * cross[k];
        beside_[static_cast<std::size_t>(i)] = sum;
      }
      score(node, first + j, j, joint(n + j, j), n, cross, beside_.data(), node.polygon);
    }
    if (node.level + 1 == forms_.levels()) return;
    const RowMatrix& filter = forms_.filter();
    std::ranges::fill(lifted_, 0.0);  // the spread times C
    for (Index i = 0; i < n; ++i)
      for (Index k = 0; k < n; ++k)
        for (Index c = 0; c < rows_; ++c)
          lifted_[static_cast<std::size_t>(i * rows_ + c)] += node.spread[i * n + k] * filter(k, c);
    for (int child = 0; child < shape_.maps(); ++child) {
      const Index column = first_column(shape_, child);
      double* const spread = out.spread.data() + child * n * n;
      for (Index a = 0; a < n; ++a)
        for (Index b = 0; b <= a; ++b) {
          double sum = 0;
          for (Index k = 0; k < n; ++k)
            sum += filter(k, column + a) * lifted_[static_cast<std::size_t>(k * rows_ + column + b)];
          spread[a * n + b] = spread[b * n + a] = sum;
        }
      for (Index lane = 0; lane < lanes_; ++lane)
        for (Index a = 0; a < n; ++a) {
          double sum = 0;
          for (Index k = 0; k < n; ++k) sum += filter(k, column + a) * node.polygon[lane * n + k];
          out.polygon[static_cast<std::size_t>((child * lanes_ + lane) * n + a)] = sum;
        }
    }
  }

  // With details kept here or below. The free values are the polygon's and the node's own kept ones.
  void score_branch(const Node& node, Children& out) {
    const Branch& branch = forms_.branch(node.branch);
    const RowMatrix& filter = forms_.filter();
    const Eigen::MatrixXd& joint = branch.form.joint;
    const Index first = first_detail(node);
    const auto count = static_cast<Index>(branch.kept.size()), free = n_ + count;
    const Eigen::Map<const Eigen::MatrixXd> spread(node.spread, n_, n_), polygon(node.polygon, n_, lanes_);
    Eigen::MatrixXd covariance(free, free), passed(free, rows_), cross(free, d_), value(free, lanes_);
    covariance.topLeftCorner(n_, n_) = spread;
    passed.topRows(n_) = filter.topRows(n_);
    cross.topRows(n_) = joint.topRows(n_);
    value.topRows(n_) = polygon;
    if (count > 0) {
      covariance.bottomLeftCorner(count, n_) = -branch.gain * spread;
      covariance.topRightCorner(n_, count) = covariance.bottomLeftCorner(count, n_).transpose();
      covariance.bottomRightCorner(count, count) =
          branch.inverse - covariance.bottomLeftCorner(count, n_) * branch.gain.transpose();
      value.bottomRows(count) = solution_.values.middleRows(branch.first_value, count);
    }
    for (Index a = 0; a < count; ++a) {
      const int j = branch.kept[static_cast<std::size_t>(a)];
      passed.row(n_ + a) = filter.row(n_ + j);
      cross.row(n_ + a) = joint.row(n_ + j);
    }
    const Eigen::MatrixXd covered = covariance * cross;
    for (Index j = 0; j < d_; ++j)
      score(node, first + j, j, joint(n_ + j, j), free, cross.col(j).data(), covered.col(j).data(), value.data());
    for (Index a = 0; a < count; ++a) {
      const double variance = covariance(n_ + a, n_ + a);
      score_[static_cast<std::size_t>(first + branch.kept[static_cast<std::size_t>(a)])] =
          variance > 0 ? value.row(n_ + a).squaredNorm() / variance : 0.0;
    }
    for (int c = 0; c < shape_.maps(); ++c) {
      const auto part = passed.middleCols(first_column(shape_, c), n_);
      const Eigen::MatrixXd spread_part = covariance * part;
      Eigen::Map<Eigen::MatrixXd>(out.spread.data() + c * n_ * n_, n_, n_) = part.transpose() * spread_part;
      Eigen::Map<Eigen::MatrixXd>(out.polygon.data() + c * n_ * lanes_, n_, lanes_) = part.transpose() * value;
    }
  }

  const TreeForms& forms_;
  const Solution& solution_;
  const std::vector<std::vector<double>>& moments_;
  const Watch& watch_;
  std::vector<double>& score_;
  const Shape& shape_;
  Index n_, d_, rows_, lanes_;
  std::vector<double> beside_, lifted_;
  std::vector<Children> buffers_;  // by level
};

struct Root {
  Node node;
  std::vector<double> spread, polygon;
};

}  // namespace

std::vector<double> scores_of(const TreeForms& forms, const Solution& solution,
                              const std::vector<std::vector<double>>& moments, const Watch& watch) {
  std::vector<double> score(static_cast<std::size_t>(forms.details()), 0.0);
  const Shape& shape = forms.shape();
  const Eigen::MatrixXd control = solution.control;
  const Node root{0, 0, forms.root_kind(), forms.root_branch(), forms.root_inverse().data(), control.data()};
  int cut = forms.levels();
  if (shape.first_node(forms.levels()) >= worth_sharing)
    for (cut = 0; shape.nodes(cut) < roots_wanted;) ++cut;
  std::vector<Root> roots;
  const auto squares = control.rows() * control.rows();
  Way(forms, solution, moments, watch, score).down(root, cut, [&](const Node& node) {
    roots.push_back({node, {node.spread, node.spread + squares}, {node.polygon, node.polygon + control.size()}});
  });
  parallel_for(static_cast<Index>(roots.size()), 0, [&](Index r) {
    Root& own = roots[static_cast<std::size_t>(r)];
    own.node.spread = own.spread.data();
    own.node.polygon = own.polygon.data();
    Way(forms, solution, moments, watch, score).down(own.node, forms.levels(), [](const Node&) {});
  });
  return score;
}

}  // namespace ifsm::core
