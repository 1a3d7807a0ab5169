#include "fit/projection.h"

#include <cmath>
#include <numeric>
#include <utility>

#include "base/parallel.h"
#include "fit/blocks.h"
#include "linalg/spectrum.h"

namespace ifsm::core {
namespace {

// What is the same for all of a sketch's tree.
struct Setting {
  const Shape& shape;
  const std::vector<FreeEntry>& entries;
  const ProjectedSketch& sketch;
  const RowMatrix& matrix;
  const Watch& watch;
  const Solution& solution;
  const Points& error;
};

// A subtree: the polygon that it hangs from, the polygon's tangent, and the moments that it has with the places below.
struct Subtree {
  Index node;
  int branch;
  Lanes polygon, moved, moments;
};

// JᵀJ of one sketch with J = (1 - projection) tangent: tangentᵀ tangent is summed place by place on the way down the
// tree, tangentᵀ projection tangent node by node on the way up, so that no row outlives its node.
class Walk {
 public:
  explicit Walk(const Setting& setting)
      : shape_(setting.shape),
        entries_(setting.entries),
        sketch_(setting.sketch),
        matrix_(setting.matrix),
        watch_(setting.watch),
        solution_(setting.solution),
        error_(setting.error),
        count_(static_cast<Index>(entries_.size())),
        all_(static_cast<int>(count_)),
        taken_back_(static_cast<int>(count_)),
        own_details_(Lanes::Zero(shape_.details_per_node(), error_.dimension())) {
    const int rows = shape_.rows();
    const Index lanes = error_.dimension() * count_;
    buffers_.resize(static_cast<std::size_t>(sketch_.levels));
    for (Buffers& b : buffers_)
      b = {Lanes(rows, error_.dimension()), Lanes(rows, lanes), Lanes(rows, lanes), Lanes(rows, lanes)};
  }

  // A whole subtree, whose root lies on `level`.
  void gather(int level, Subtree& tree) {
    visit(level, tree.node, tree.branch, tree.polygon, tree.moved, tree.moments);
  }
  // What lies above a level: on the way down the subtrees that hang there …
  std::vector<Subtree> cut(int level, Subtree& tree) {
    std::vector<Subtree> subtrees;
    end_ = level;
    subtrees_ = &subtrees;
    down_only_ = true;
    gather(0, tree);
    return subtrees;
  }
  // … and, once they know their moments, on the way up the rest.
  void gather_above(int level, Subtree& tree, std::vector<Subtree>& subtrees) {
    end_ = level;
    subtrees_ = &subtrees;
    down_only_ = false;
    next_ = 0;
    gather(0, tree);
  }
  // The last place is the last control point: fixed values do not move it.
  void gather_control(const Subtree& tree) {
    const Lanes still = Lanes::Zero(1, error_.dimension() * count_);
    add_place(error_.count() - 1, still.row(0));
    take_back(sketch_.solver->forms().root_inverse(), tree.moments);
  }
  void add_to(Normal& normal) {
    all_ -= taken_back_;
    normal += all_;
  }

 private:
  struct Buffers {
    Lanes curve, tangent, below, moment;
  };

  // d(P_θ0 | …) = d(P_θ) C + (P_θ | δP_θ) dR, a lane for each coordinate and parameter. `out` gains the moments that
  // the node's polygon has with the tangent.
  void visit(int level, Index i, int branch, const Eigen::Ref<const Lanes>& polygon,
             const Eigen::Ref<const Lanes>& moved, Eigen::Ref<Lanes> out) {
    if (level == end_) return at_end(i, branch, polygon, moved, out);
    watch_.poll();
    const int n = shape_.control_points(), step = shape_.polygon_step();
    Buffers& b = buffers_[static_cast<std::size_t>(level)];
    b.curve.noalias() = matrix_.topRows(n).transpose() * polygon;
    add_details(branch, b.curve);
    if (level == 0)
      b.tangent.setZero();
    else
      b.tangent.noalias() = matrix_.topRows(n).transpose() * moved;
    add_filter_tangent(polygon, own_details_, b.tangent);
    b.below.setZero();
    if (level + 1 == sketch_.levels) {
      add_places(i, b);
    } else {
      for (int c = 0; c < shape_.maps(); ++c)
        visit(level + 1, i * shape_.maps() + c, child(branch, c), b.curve.middleRows(c * step, n),
              b.tangent.middleRows(c * step, n), b.below.middleRows(c * step, n));
    }
    if (down_only_) return;
    b.moment.noalias() = matrix_ * b.below;
    out += b.moment.topRows(n);
    if (branch >= 0) take_back_kept(sketch_.solver->forms().branch(branch), b.moment, out);
  }

  void at_end(Index i, int branch, const Eigen::Ref<const Lanes>& polygon, const Eigen::Ref<const Lanes>& moved,
              Eigen::Ref<Lanes> out) {
    if (down_only_)
      subtrees_->push_back({i, branch, polygon, moved, Lanes::Zero(out.rows(), out.cols())});
    else
      out += (*subtrees_)[next_++].moments;
  }

  int child(int branch, int c) const {
    return branch < 0 ? -1 : sketch_.solver->forms().branch(branch).children[static_cast<std::size_t>(c)];
  }

  // Leaves the node's own in own_details_.
  void add_details(int branch, Lanes& curve) {
    own_details_.setZero();
    if (branch < 0) return;
    const Branch& own = sketch_.solver->forms().branch(branch);
    if (own.kept.empty()) return;
    for (std::size_t a = 0; a < own.kept.size(); ++a)
      own_details_.row(own.kept[a]) = solution_.values.row(own.first_value + static_cast<Index>(a));
    curve.noalias() += matrix_.bottomRows(shape_.details_per_node()).transpose() * own_details_;
  }

  void take_back_kept(const Branch& branch, const Lanes& moment, Eigen::Ref<Lanes> out) {
    if (branch.kept.empty()) return;
    Lanes own(static_cast<Index>(branch.kept.size()), moment.cols());
    for (std::size_t a = 0; a < branch.kept.size(); ++a)
      own.row(static_cast<Index>(a)) = moment.row(shape_.control_points() + branch.kept[a]);
    out.noalias() -= branch.gain.transpose() * own;
    take_back(branch.inverse, own);
  }

  // tangent += (P δ) dR: parameter p moves only column entry.column, by value(row) - value(opposite).
  void add_filter_tangent(const Eigen::Ref<const Lanes>& polygon, const Eigen::Ref<const Lanes>& details,
                          Lanes& tangent) {
    for (Index axis = 0; axis < polygon.cols(); ++axis) {
      value_.resize(static_cast<std::size_t>(shape_.rows()));
      for (Index r = 0; r < polygon.rows(); ++r) value_[static_cast<std::size_t>(r)] = polygon(r, axis);
      for (Index r = 0; r < details.rows(); ++r)
        value_[static_cast<std::size_t>(polygon.rows() + r)] = details(r, axis);
      for (Index p = 0; p < count_; ++p) {
        const FreeEntry& entry = entries_[static_cast<std::size_t>(p)];
        const double opposite = entry.opposite < 0 ? 0.0 : value_[static_cast<std::size_t>(entry.opposite)];
        tangent(entry.column, axis * count_ + p) += value_[static_cast<std::size_t>(entry.row)] - opposite;
      }
    }
  }

  void add_places(Index node, Buffers& b) {
    const Index first = node * (shape_.rows() - 1);
    for (Index c = 0; c + 1 < shape_.rows(); ++c) {
      b.below.row(c) = sketch_.solver->weight()(first + c) * b.tangent.row(c);
      add_place(first + c, b.tangent.row(c));
    }
  }

  void add_place(Index place, const Eigen::Ref<const Eigen::RowVectorXd>& tangent) {
    const double weight = sketch_.solver->weight()(place);
    if (weight == 0) return;
    const double root = std::sqrt(weight * sketch_.weight);
    for (Index axis = 0; axis < error_.dimension(); ++axis) {
      Eigen::Map<Eigen::RowVectorXd> row(all_.row(), count_ + 1);
      row.head(count_) = root * tangent.segment(axis * count_, count_);
      row(count_) = root * error_.matrix()(place, axis);
    }
  }

  // momentsᵀ inverse moments, coordinate by coordinate. (The error has no moments: it was solved for.)
  void take_back(const Eigen::MatrixXd& inverse, const Lanes& moments) {
    const Lanes rows = square_root(inverse) * moments;
    for (Index a = 0; a < rows.rows(); ++a)
      for (Index axis = 0; axis < error_.dimension(); ++axis) {
        Eigen::Map<Eigen::RowVectorXd> row(taken_back_.row(), count_ + 1);
        row.head(count_) = std::sqrt(sketch_.weight) * rows.row(a).segment(axis * count_, count_);
        row(count_) = 0;
      }
  }

  const Shape& shape_;
  const std::vector<FreeEntry>& entries_;
  const ProjectedSketch& sketch_;
  const RowMatrix& matrix_;
  const Watch& watch_;
  const Solution& solution_;
  const Points& error_;
  Index count_;
  Normal all_, taken_back_;
  Lanes own_details_;
  std::vector<Buffers> buffers_;
  std::vector<double> value_;
  int end_ = -1;  // the level that subtrees_ hang from; below zero: none
  std::vector<Subtree>* subtrees_ = nullptr;
  bool down_only_ = false;
  std::size_t next_ = 0;
};

void gather(const Setting& setting, Normal& normal) {
  const int n = setting.shape.control_points();
  const Index lanes = setting.error.dimension() * static_cast<Index>(setting.entries.size());
  Subtree tree{0, setting.sketch.solver->forms().root_branch(), setting.solution.control, Lanes::Zero(n, lanes),
               Lanes::Zero(n, lanes)};
  Walk walk(setting);
  const Blocks blocks(setting.shape, setting.sketch.levels);
  if (blocks.level() == 0) {
    walk.gather(0, tree);
  } else {
    std::vector<Subtree> subtrees = walk.cut(blocks.level(), tree);
    std::vector<Normal> each(static_cast<std::size_t>(blocks.groups()), Normal(normal.parameters()));
    parallel_for(blocks.groups(), 0, [&](Index group) {
      Walk own(setting);
      for (Index b = blocks.first(group); b < blocks.first(group + 1); ++b)
        own.gather(blocks.level(), subtrees[static_cast<std::size_t>(b)]);
      own.add_to(each[static_cast<std::size_t>(group)]);
    });
    for (Normal& one : each) normal += one;
    walk.gather_above(blocks.level(), tree, subtrees);
  }
  walk.gather_control(tree);
  walk.add_to(normal);
}

}  // namespace

Projection::Projection(const Shape& shape, std::vector<ProjectedSketch> sketches, const Watch& watch)
    : shape_(shape), sketches_(std::move(sketches)), watch_(watch), entries_(free_entries(shape)) {
  for (const ProjectedSketch& sketch : sketches_) {
    if (groups_.empty() || groups_.back().front()->solver != sketch.solver) groups_.emplace_back();
    groups_.back().push_back(&sketch);
  }
}

template <class Body>
void Projection::each_group(const Body& body) const {
  parallel_for(static_cast<Index>(groups_.size()), 0, [&](Index g) {
    const auto at = static_cast<std::size_t>(g);
    for (const ProjectedSketch* sketch : groups_[at]) body(at, *sketch);
  });
}

double Projection::value(const RowMatrix& matrix) {
  std::vector<double> values(groups_.size(), 0.0);
  each_group([&](std::size_t group, const ProjectedSketch& sketch) {
    values[group] += sketch.weight * solved(*sketch.solver, matrix, sketch.kept, *sketch.data, watch_).squared_error;
  });
  return std::accumulate(values.begin(), values.end(), 0.0);
}

void Projection::gather(const RowMatrix& matrix, Normal& normal) {
  std::vector<Normal> each(groups_.size(), Normal(static_cast<int>(entries_.size())));
  each_group([&](std::size_t group, const ProjectedSketch& sketch) {
    const Solution now = solved(*sketch.solver, matrix, sketch.kept, *sketch.data, watch_).solution;
    Points error = sketch.solver->curve(now, watch_);
    error.matrix() -= sketch.data->matrix();
    core::gather({shape_, entries_, sketch, matrix, watch_, now, error}, each[group]);
  });
  for (Normal& one : each) normal += one;
}

}  // namespace ifsm::core
