#include "fit/truncation.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/parallel.h"
#include "fit/blocks.h"
#include "fit/refine.h"

namespace ifsm::core {

// The filter that the curve is seen under.
struct Truncation::Seen {
  const RowMatrix& matrix;
  RowMatrix inverse;
  Eigen::MatrixXd analysis;  // the columns of R^-1 that give a node's polygon, transposed
};

// Of a node: how its inner points move with U (its ends are samples and never do), the quadratic form by which moving
// its polygon is felt at the places below, and the moment that the error has with it.
struct Truncation::Felt {
  Lanes tangent;  // inner points × (coordinate by coordinate, a lane each parameter)
  Eigen::MatrixXd form;
  Lanes moment;
};

namespace {

// The line of the level above, by analysis, from the line of `nodes` nodes' children.
Lanes coarser(const Shape& shape, const Eigen::MatrixXd& analysis, const Eigen::Ref<const Lanes>& fine, Index nodes,
              const Watch& watch) {
  Lanes coarse(nodes * shape.polygon_step() + 1, fine.cols());
  for (Index node = 0; node < nodes; ++node) {
    if (node % 256 == 0) watch.poll();
    coarse.middleRows(node * shape.polygon_step(), shape.control_points()).noalias() =
        analysis * fine.middleRows(node * shape.children_step(), shape.rows());
  }
  return coarse;
}

// Up a subtree, depth first, in the memory of one path. Its lowest nodes stand on places, or on nodes of which all is
// known.
template <class Felt>
class Climb {
 public:
  // lines: of the subtree's levels, the root's polygon first.
  Climb(const Shape& shape, const std::vector<FreeEntry>& entries, const RowMatrix& matrix, const RowMatrix& inverse,
        const std::vector<Lanes>& lines, const Watch& watch)
      : shape_(shape),
        entries_(entries),
        lines_(lines),
        maps_(matrix.topRows(shape.control_points())),
        inverse_(inverse),
        watch_(watch),
        inner_(shape.control_points() - 2),
        count_(static_cast<Index>(entries.size())),
        lift_(inner_, shape.maps() * inner_) {
    for (Index a = 0; a < inner_; ++a)
      for (Index b = 0; b < lift_.cols(); ++b) lift_(a, b) = inverse(b / inner_ * (inner_ + 1) + b % inner_ + 1, a + 1);
    const Index lanes = lines.front().cols() * count_;
    for (std::size_t level = 0; level + 1 < lines.size(); ++level) {
      below_.emplace_back(shape.maps() * inner_, lanes);
      felt_.push_back({Lanes(inner_, lanes), {}, {}});
    }
  }

  void stand_on(const Eigen::Ref<const Eigen::VectorXd>& weight, const Lanes& weighted_error) {
    weight_ = weight;
    weighted_error_ = &weighted_error;
  }
  void stand_on(const std::vector<Felt>& nodes) { nodes_ = &nodes; }

  // A node of a level, counted within the subtree.
  const Felt& felt(int level, Index node) {
    if (nodes_ != nullptr && level + 1 == static_cast<int>(lines_.size()))
      return (*nodes_)[static_cast<std::size_t>(node)];
    watch_.poll();
    Felt& own = felt_[static_cast<std::size_t>(level)];
    if (nodes_ == nullptr && level + 2 == static_cast<int>(lines_.size()))
      stand(node, own);
    else
      gather_children(level, node, own);
    subtract_own_tangent(level, node, own.tangent);
    return own;
  }

 private:
  void stand(Index node, Felt& own) const {
    const Index first = node * shape_.children_step(), places = shape_.rows() - 1;  // the last is the next node's
    const auto maps = maps_.leftCols(places);
    own.form = maps * weight_.segment(first, places).asDiagonal() * maps.transpose();
    own.moment = maps * weighted_error_->middleRows(first, places);
    own.tangent.setZero();
  }

  void gather_children(int level, Index node, Felt& own) {
    const int n = shape_.control_points();
    Lanes& below = below_[static_cast<std::size_t>(level)];
    Eigen::MatrixXd form = Eigen::MatrixXd::Zero(n, n);
    Lanes moment = Lanes::Zero(n, lines_.front().cols());
    for (int c = 0; c < shape_.maps(); ++c) {
      const Felt& child = felt(level + 1, node * shape_.maps() + c);
      const auto map = maps_.middleCols(first_column(shape_, c), n);
      form += map * child.form * map.transpose();
      moment += map * child.moment;
      below.middleRows(c * inner_, inner_) = child.tangent;
    }
    own.form = std::move(form);
    own.moment = std::move(moment);
    own.tangent.noalias() = lift_ * below;
  }

  // tangent -= [P δ] dR R^-1: parameter p moves only column entry.column, by the detail of its row.
  void subtract_own_tangent(int level, Index node, Lanes& tangent) const {
    const Lanes& fine = lines_[static_cast<std::size_t>(level) + 1];
    const Lanes values = inverse_.transpose() * fine.middleRows(node * shape_.children_step(), shape_.rows());
    for (Index a = 0; a < inner_; ++a)
      for (Index axis = 0; axis < values.cols(); ++axis)
        for (Index p = 0; p < count_; ++p) {
          const FreeEntry& entry = entries_[static_cast<std::size_t>(p)];
          tangent(a, axis * count_ + p) -= inverse_(entry.column, a + 1) * values(entry.row, axis);
        }
  }

  const Shape& shape_;
  const std::vector<FreeEntry>& entries_;
  const std::vector<Lanes>& lines_;
  Eigen::MatrixXd maps_;
  const RowMatrix& inverse_;
  const Watch& watch_;
  Index inner_, count_;
  Lanes lift_;
  std::vector<Lanes> below_;  // by level: the tangents of the children's inner points
  std::vector<Felt> felt_;    // by level
  Eigen::VectorXd weight_;
  const Lanes* weighted_error_ = nullptr;
  const std::vector<Felt>* nodes_ = nullptr;
};

// What moving one of the coarsest polygons does to the error.
template <class Felt>
void add_product(const Felt& felt, Index count, Eigen::MatrixXd& sum) {
  const Index inner = felt.tangent.rows();
  if (inner == 0) return;
  const Eigen::MatrixXd form = felt.form.block(1, 1, inner, inner);
  for (Index axis = 0; axis < felt.moment.cols(); ++axis) {
    const auto tangent = felt.tangent.middleCols(axis * count, count);
    const Eigen::VectorXd gradient = tangent.transpose() * felt.moment.col(axis).segment(1, inner);
    sum.topLeftCorner(count, count).noalias() += tangent.transpose() * (form * tangent);
    sum.col(count).head(count) += gradient;
    sum.row(count).head(count) += gradient.transpose();
  }
}

}  // namespace

Truncation::Truncation(const Shape& shape, std::vector<TruncatedCurve> curves, const Watch& watch)
    : shape_(shape), curves_(std::move(curves)), watch_(watch), entries_(free_entries(shape, Part::details)) {}

double Truncation::value(const RowMatrix& matrix) {
  const Seen seen = this->seen(matrix);
  double sum = 0;
  for (const TruncatedCurve& curve : curves_) sum += gather(curve, seen, nullptr);
  return sum;
}

void Truncation::gather(const RowMatrix& matrix, Normal& normal) {
  const Seen seen = this->seen(matrix);
  const auto count = static_cast<Index>(entries_.size());
  for (const TruncatedCurve& curve : curves_) {
    Eigen::MatrixXd product = Eigen::MatrixXd::Zero(count + 1, count + 1);
    product(count, count) = gather(curve, seen, &product);
    normal.add(product);
  }
}

Truncation::Seen Truncation::seen(const RowMatrix& matrix) const {
  const int n = shape_.control_points();
  RowMatrix inverse = inverse_of(shape_, matrix);
  Eigen::MatrixXd analysis = inverse.leftCols(n).transpose();
  return {matrix, std::move(inverse), std::move(analysis)};
}

// Subtrees below a level share the threads, in groups that each sum on their own. Lines of the finest levels are held
// of one subtree at a time: they are found twice, for the coarsest polygons, and for what moving them does.
double Truncation::gather(const TruncatedCurve& curve, const Seen& seen, Eigen::MatrixXd* product) const {
  const Blocks blocks(shape_, curve.levels, curve.kept);
  const int cut = blocks.level(), step = shape_.polygon_step(), n = shape_.control_points();
  const auto count = static_cast<Index>(entries_.size());
  const std::vector<Lanes> lines = analysed(curve, seen, blocks);
  const Lanes sketch = refined(shape_, seen.matrix, lines.front(), curve.kept, cut);
  const bool deep = product != nullptr && cut > curve.kept;
  std::vector<Felt> felt(deep ? static_cast<std::size_t>(blocks.count()) : 0);
  std::vector<double> values(static_cast<std::size_t>(blocks.groups()), 0.0);
  std::vector<Eigen::MatrixXd> products(values.size(), Eigen::MatrixXd::Zero(count + 1, count + 1));
  parallel_for(blocks.groups(), 0, [&](Index group) {
    const auto at = static_cast<std::size_t>(group);
    for (Index b = blocks.first(group); b < blocks.first(group + 1); ++b) {
      Felt own;
      values[at] += gather_subtree(curve, seen, cut, b, sketch.middleRows(b * step, n), product ? &own : nullptr);
      if (deep)
        felt[static_cast<std::size_t>(b)] = std::move(own);
      else if (product != nullptr)
        add_product(own, count, products[at]);
    }
  });
  for (const Eigen::MatrixXd& one : products)
    if (product != nullptr) *product += one;
  if (deep) {
    Climb<Felt> climb(shape_, entries_, seen.matrix, seen.inverse, lines, watch_);
    climb.stand_on(felt);
    for (Index node = 0; node < shape_.nodes(curve.kept); ++node) add_product(climb.felt(0, node), count, *product);
  }
  return std::accumulate(values.begin(), values.end(), 0.0);
}

// Lines of levels from the kept to the blocks' roots.
std::vector<Lanes> Truncation::analysed(const TruncatedCurve& curve, const Seen& seen, const Blocks& blocks) const {
  const int cut = blocks.level(), step = shape_.polygon_step();
  std::vector<Lanes> lines(static_cast<std::size_t>(cut - curve.kept) + 1);
  Lanes& roots = lines.back();
  roots = Lanes(shape_.line_length(cut), curve.line->dimension());
  parallel_for(blocks.groups(), 0, [&](Index group) {
    for (Index b = blocks.first(group); b < blocks.first(group + 1); ++b)
      roots.middleRows(b * step, step) = subtree_lines(curve, seen, cut, b).front().topRows(step);
  });
  roots.bottomRows(1) = curve.line->matrix().bottomRows(1);
  for (int level = cut - 1; level >= curve.kept; --level) {
    const auto at = static_cast<std::size_t>(level - curve.kept);
    lines[at] = coarser(shape_, seen.analysis, lines[at + 1], shape_.nodes(level), watch_);
  }
  return lines;
}

// Of all its levels, the root's polygon first.
std::vector<Lanes> Truncation::subtree_lines(const TruncatedCurve& curve, const Seen& seen, int cut, Index node) const {
  const int height = curve.levels - cut;
  const Index places = shape_.polygon_step() * shape_.nodes(height);
  std::vector<Lanes> lines(static_cast<std::size_t>(height) + 1);
  lines.back() = curve.line->matrix().middleRows(node * places, places + 1);
  for (int level = height - 1; level >= 0; --level) {
    const auto at = static_cast<std::size_t>(level);
    lines[at] = coarser(shape_, seen.analysis, lines[at + 1], shape_.nodes(level), watch_);
  }
  return lines;
}

double Truncation::gather_subtree(const TruncatedCurve& curve, const Seen& seen, int cut, Index node,
                                  const Eigen::Ref<const Lanes>& polygon, Felt* felt) const {
  const std::vector<Lanes> lines = subtree_lines(curve, seen, cut, node);
  const Index places = lines.back().rows() - 1;  // the last is the next subtree's, or an end, which has no error
  const auto weight = curve.weight.segment(node * places, places);
  const Lanes error = refined(shape_, seen.matrix, polygon, 0, curve.levels - cut) - lines.back();
  const Lanes weighted_error = weight.asDiagonal() * error.topRows(places);
  if (felt != nullptr && curve.levels > cut) {
    Climb<Felt> climb(shape_, entries_, seen.matrix, seen.inverse, lines, watch_);
    climb.stand_on(weight, weighted_error);
    *felt = climb.felt(0, 0);
  }
  return weighted_error.cwiseProduct(error.topRows(places)).sum();
}

}  // namespace ifsm::core
