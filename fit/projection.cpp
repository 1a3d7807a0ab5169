#include "fit/projection.h"

#include <cmath>
#include <numeric>
#include <utility>

#include "base/parallel.h"
#include "linalg/spectrum.h"

namespace ifsm::core {
namespace {

// JᵀJ of one sketch with J = (1 - projection) tangent: tangentᵀ tangent is summed place by place on the way down the
// tree, tangentᵀ projection tangent node by node on the way up, so that no row outlives its node.
class Walk {
 public:
  Walk(const Shape& shape, const std::vector<FreeEntry>& entries, const ProjectedSketch& sketch,
       const RowMatrix& matrix, const Watch& watch)
      : shape_(shape),
        entries_(entries),
        sketch_(sketch),
        matrix_(matrix),
        watch_(watch),
        count_(static_cast<Index>(entries.size())),
        all_(static_cast<int>(count_)),
        taken_back_(static_cast<int>(count_)) {}

  void gather(Normal& normal) {
    const Choice now = solved(*sketch_.solver, matrix_, sketch_.kept, *sketch_.data, watch_);
    solution_ = &now.solution;
    error_ = now.solution.curve - *sketch_.data;
    const int n = shape_.control_points(), rows = shape_.rows();
    const Index lanes = error_.cols() * count_;
    for (int level = 0; level < sketch_.levels; ++level)
      buffers_.push_back({Lanes(rows, error_.cols()), Lanes(rows, lanes), Lanes(rows, lanes), Lanes(rows, lanes)});
    Lanes below = Lanes::Zero(n, lanes);
    visit(0, 0, now.solution.control, Lanes::Zero(n, lanes), below);
    // The last place is the last control point: fixed values do not move it.
    const Lanes still = Lanes::Zero(1, lanes);
    add_place(error_.rows() - 1, still.row(0));
    take_back(sketch_.solver->root_inverse(), below);
    all_ -= taken_back_;
    normal += all_;
  }

 private:
  struct Buffers {
    Lanes curve, tangent, below, moment;
  };

  // d(P_θ0 | …) = d(P_θ) C + (P_θ | δP_θ) dR, a lane for each coordinate and parameter. `out` gains the moments that
  // the node's polygon has with the tangent.
  void visit(int level, Index i, const Eigen::Ref<const Lanes>& polygon, const Eigen::Ref<const Lanes>& moved,
             Eigen::Ref<Lanes> out) {
    watch_.poll();
    const int n = shape_.control_points(), d = shape_.details_per_node(), step = shape_.polygon_step();
    const Index node = shape_.first_node(level) + i;
    Buffers& b = buffers_[static_cast<std::size_t>(level)];
    const auto details = solution_->details.middleRows(node * d, d);
    b.curve.noalias() = matrix_.topRows(n).transpose() * polygon;
    b.curve.noalias() += matrix_.bottomRows(d).transpose() * details;
    if (level == 0)
      b.tangent.setZero();
    else
      b.tangent.noalias() = matrix_.topRows(n).transpose() * moved;
    add_filter_tangent(polygon, details, b.tangent);
    b.below.setZero();
    if (level + 1 == sketch_.levels) {
      add_places(i, b);
    } else {
      for (int c = 0; c < shape_.maps(); ++c)
        visit(level + 1, i * shape_.maps() + c, b.curve.middleRows(c * step, n), b.tangent.middleRows(c * step, n),
              b.below.middleRows(c * step, n));
    }
    b.moment.noalias() = matrix_ * b.below;
    out += b.moment.topRows(n);
    const auto& kept = sketch_.solver->kept_at(node);
    if (kept.empty()) return;
    Lanes own(static_cast<Index>(kept.size()), b.moment.cols());
    for (std::size_t a = 0; a < kept.size(); ++a) own.row(static_cast<Index>(a)) = b.moment.row(n + kept[a]);
    out.noalias() -= sketch_.solver->gain_at(node).transpose() * own;
    take_back(sketch_.solver->inverse_at(node), own);
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
    for (Index axis = 0; axis < error_.cols(); ++axis) {
      Eigen::Map<Eigen::RowVectorXd> row(all_.row(), count_ + 1);
      row.head(count_) = root * tangent.segment(axis * count_, count_);
      row(count_) = root * error_(place, axis);
    }
  }

  // momentsᵀ inverse moments, coordinate by coordinate. (The error has no moments: it was solved for.)
  void take_back(const Eigen::MatrixXd& inverse, const Lanes& moments) {
    const Lanes rows = square_root(inverse) * moments;
    for (Index a = 0; a < rows.rows(); ++a)
      for (Index axis = 0; axis < error_.cols(); ++axis) {
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
  Index count_;
  Normal all_, taken_back_;
  const Solution* solution_ = nullptr;
  Lanes error_;
  std::vector<Buffers> buffers_;
  std::vector<double> value_;
};

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
    Walk(shape_, entries_, sketch, matrix, watch_).gather(each[group]);
  });
  for (Normal& one : each) normal += one;
}

}  // namespace ifsm::core
