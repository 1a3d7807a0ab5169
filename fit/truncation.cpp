#include "fit/truncation.h"

#include <utility>

#include "fit/refine.h"

namespace ifsm::core {
namespace {

// Up the subtrees of level k, depth first, in the memory of one path: how each node's inner points move with U (their
// ends are samples and never do), the quadratic form by which moving them is felt at the places below, and the moment
// that the error has with them.
class Climb {
 public:
  Climb(const Shape& shape, const std::vector<FreeEntry>& entries, const TruncatedCurve& curve,
        const std::vector<Lanes>& lines, const Lanes& weighted_error, const RowMatrix& matrix, const RowMatrix& inverse,
        const Watch& watch)
      : shape_(shape),
        entries_(entries),
        curve_(curve),
        lines_(lines),
        weighted_error_(weighted_error),
        maps_(matrix.topRows(shape.control_points())),
        inverse_(inverse),
        watch_(watch),
        inner_(shape.control_points() - 2),
        count_(static_cast<Index>(entries.size())),
        lift_(inner_, shape.maps() * inner_) {
    for (Index a = 0; a < inner_; ++a)
      for (Index b = 0; b < lift_.cols(); ++b) lift_(a, b) = inverse(b / inner_ * (inner_ + 1) + b % inner_ + 1, a + 1);
    const Index lanes = dimension() * count_;
    for (int level = curve.kept; level < curve.levels; ++level)
      buffers_.push_back({Lanes(shape.maps() * inner_, lanes), Lanes(inner_, lanes), {}, {}});
  }

  // (J | r)ᵀ(J | r) but for rᵀr.
  Eigen::MatrixXd product() {
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(count_ + 1, count_ + 1);
    if (inner_ == 0 || curve_.kept == curve_.levels) return sum;
    for (Index node = 0; node < shape_.nodes(curve_.kept); ++node) {
      visit(curve_.kept, node);
      const Buffers& b = buffers_.front();
      const Eigen::MatrixXd form = b.form.block(1, 1, inner_, inner_);
      for (Index axis = 0; axis < dimension(); ++axis) {
        const auto tangent = b.tangent.middleCols(axis * count_, count_);
        const Eigen::VectorXd gradient = tangent.transpose() * b.moment.col(axis).segment(1, inner_);
        sum.topLeftCorner(count_, count_).noalias() += tangent.transpose() * (form * tangent);
        sum.col(count_).head(count_) += gradient;
        sum.row(count_).head(count_) += gradient.transpose();
      }
    }
    return sum;
  }

 private:
  struct Buffers {
    Lanes below;    // tangents of the children's inner points
    Lanes tangent;  // of the node's own
    Eigen::MatrixXd form;
    Lanes moment;
  };

  Index dimension() const { return weighted_error_.cols(); }

  void visit(int level, Index node) {
    watch_.poll();
    Buffers& b = buffers_[static_cast<std::size_t>(level - curve_.kept)];
    const int n = shape_.control_points();
    if (level + 1 == curve_.levels) {
      const Index first = node * shape_.children_step(), places = shape_.rows() - 1;  // the last is the next node's
      const auto maps = maps_.leftCols(places);
      b.form = maps * curve_.weight.segment(first, places).asDiagonal() * maps.transpose();
      b.moment = maps * weighted_error_.middleRows(first, places);
      b.tangent.setZero();
    } else {
      Eigen::MatrixXd form = Eigen::MatrixXd::Zero(n, n);
      Lanes moment = Lanes::Zero(n, dimension());
      for (int c = 0; c < shape_.maps(); ++c) {
        visit(level + 1, node * shape_.maps() + c);
        const Buffers& child = buffers_[static_cast<std::size_t>(level + 1 - curve_.kept)];
        const auto map = maps_.middleCols(first_column(shape_, c), n);
        form += map * child.form * map.transpose();
        moment += map * child.moment;
        b.below.middleRows(c * inner_, inner_) = child.tangent;
      }
      b.form = std::move(form);
      b.moment = std::move(moment);
      b.tangent.noalias() = lift_ * b.below;
    }
    subtract_own_tangent(level, node, b.tangent);
  }

  // tangent -= [P δ] dR R^-1: parameter p moves only column entry.column, by the detail of its row.
  void subtract_own_tangent(int level, Index node, Lanes& tangent) const {
    const Lanes& fine = lines_[static_cast<std::size_t>(level + 1 - curve_.kept)];
    const Lanes values = inverse_.transpose() * fine.middleRows(node * shape_.children_step(), shape_.rows());
    for (Index a = 0; a < inner_; ++a)
      for (Index axis = 0; axis < dimension(); ++axis)
        for (Index p = 0; p < count_; ++p) {
          const FreeEntry& entry = entries_[static_cast<std::size_t>(p)];
          tangent(a, axis * count_ + p) -= inverse_(entry.column, a + 1) * values(entry.row, axis);
        }
  }

  const Shape& shape_;
  const std::vector<FreeEntry>& entries_;
  const TruncatedCurve& curve_;
  const std::vector<Lanes>& lines_;
  const Lanes& weighted_error_;
  Eigen::MatrixXd maps_;
  const RowMatrix& inverse_;
  const Watch& watch_;
  Index inner_, count_;
  Lanes lift_;
  std::vector<Buffers> buffers_;  // by level - kept
};

}  // namespace

Truncation::Truncation(const Shape& shape, std::vector<TruncatedCurve> curves, const Watch& watch)
    : shape_(shape), curves_(std::move(curves)), watch_(watch), entries_(free_entries(shape, Part::details)) {}

Truncation::Analysed Truncation::analysed(const TruncatedCurve& curve, const RowMatrix& matrix,
                                          const RowMatrix& inverse) const {
  const int n = shape_.control_points();
  Analysed result{std::vector<Lanes>(static_cast<std::size_t>(curve.levels - curve.kept + 1)), {}, 0};
  result.lines.back() = curve.line->matrix();
  const Lanes analysis = inverse.leftCols(n).transpose();
  for (int level = curve.levels - 1; level >= curve.kept; --level) {
    const Lanes& fine = result.lines[static_cast<std::size_t>(level + 1 - curve.kept)];
    Lanes coarse(shape_.line_length(level), fine.cols());
    for (Index node = 0; node < shape_.nodes(level); ++node) {
      if (node % 256 == 0) watch_.poll();
      coarse.middleRows(node * shape_.polygon_step(), n).noalias() =
          analysis * fine.middleRows(node * shape_.children_step(), shape_.rows());
    }
    result.lines[static_cast<std::size_t>(level - curve.kept)] = std::move(coarse);
  }
  Lanes error = refined(shape_, matrix, result.lines.front(), curve.kept, curve.levels) - result.lines.back();
  result.weighted_error = curve.weight.asDiagonal() * error;
  result.value = result.weighted_error.cwiseProduct(error).sum();
  return result;
}

double Truncation::value(const RowMatrix& matrix) {
  const RowMatrix inverse = inverse_of(shape_, matrix);
  double sum = 0;
  for (const TruncatedCurve& curve : curves_) sum += analysed(curve, matrix, inverse).value;
  return sum;
}

void Truncation::gather(const RowMatrix& matrix, Normal& normal) {
  const RowMatrix inverse = inverse_of(shape_, matrix);
  for (const TruncatedCurve& curve : curves_) {
    const Analysed now = analysed(curve, matrix, inverse);
    Eigen::MatrixXd product =
        Climb(shape_, entries_, curve, now.lines, now.weighted_error, matrix, inverse, watch_).product();
    product(product.rows() - 1, product.cols() - 1) = now.value;
    normal.add(product);
  }
}

}  // namespace ifsm::core
