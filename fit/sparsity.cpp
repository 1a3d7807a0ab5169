#include "fit/sparsity.h"

#include <cmath>
#include <numeric>
#include <utility>

#include "base/parallel.h"
#include "curve/significance.h"

namespace ifsm::core {
namespace {

// ρ(s) = Σ log(1 + s/ε²), s = |v|². The residual v·w has the squared norm ρ; its derivative is w dv + turn v (v·dv).
struct RobustWeight {
  double rho, w, turn;
};

RobustWeight robust_weight(double s, const std::vector<double>& scales) {
  double rho = 0, slope = 0, a = 0, b = 0, largest = 0;
  for (const double scale : scales) {
    const double k = 1 / (scale * scale);
    rho += std::log1p(s * k);
    slope += k / (1 + s * k);
    a += k;
    b += k * k;
    largest = std::max(largest, s * k);
  }
  if (largest < 1e-5) {  // ρ = a s - b s²/2 + …: the next term is below 1e-10 of the first
    const double w = std::sqrt(a - b * s / 2);
    return {rho, w, -b / (2 * w)};
  }
  const double w = std::sqrt(rho / s);
  return {rho, w, (slope - rho / s) / (s * w)};
}

// The blocks of the columns of child i: all rows, n columns.
auto child_columns(const Shape& shape, const RowMatrix& matrix, int i) {
  return matrix.middleCols(first_column(shape, i), shape.control_points());
}

}  // namespace

GainTangents gain_tangents(const Shape& shape, int levels, const RowMatrix& matrix,
                           const std::vector<FreeEntry>& entries) {
  const int n = shape.control_points(), d = shape.details_per_node(), maps = shape.maps();
  const auto count = static_cast<Index>(entries.size());
  GainTangents result{std::vector<Eigen::VectorXd>(static_cast<std::size_t>(levels)),
                      std::vector<Lanes>(static_cast<std::size_t>(levels), Lanes::Zero(d, count))};
  Eigen::MatrixXd gram = Eigen::MatrixXd::Identity(n, n);
  gram(n - 1, n - 1) = 0;
  std::vector<Eigen::MatrixXd> gram_tangent(entries.size(), Eigen::MatrixXd::Zero(n, n));
  for (int level = levels - 1; level >= 0; --level) {
    std::vector<Eigen::MatrixXd> lifted;  // R_i G, all rows
    Eigen::MatrixXd coarser = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd squares = Eigen::VectorXd::Zero(d);
    for (int i = 0; i < maps; ++i) {
      const auto child = child_columns(shape, matrix, i);
      lifted.emplace_back(child * gram);
      coarser += lifted.back().topRows(n) * child.topRows(n).transpose();
      squares += lifted.back().bottomRows(d).cwiseProduct(child.bottomRows(d)).rowwise().sum();
    }
    const Eigen::VectorXd gain = squares.cwiseMax(0).cwiseSqrt();
    for (std::size_t p = 0; p < entries.size(); ++p) {
      const FreeEntry& entry = entries[p];
      Eigen::MatrixXd next = Eigen::MatrixXd::Zero(n, n);
      Eigen::VectorXd change = Eigen::VectorXd::Zero(d);
      for (int i = 0; i < maps; ++i) {
        const auto child = child_columns(shape, matrix, i);
        if (level + 1 < levels) {
          const Eigen::MatrixXd y = child * gram_tangent[p];
          next += y.topRows(n) * child.topRows(n).transpose();
          change += y.bottomRows(d).cwiseProduct(child.bottomRows(d)).rowwise().sum();
        }
        const int column = entry.column - first_column(shape, i);
        if (column < 0 || column >= n) continue;
        const Eigen::VectorXd moved = lifted[static_cast<std::size_t>(i)].col(column);  // R_i G e_column
        const auto add_row = [&](int row, double sign) {
          next.row(row) += sign * moved.head(n).transpose();
          next.col(row) += sign * moved.head(n);
        };
        if (entry.opposite < 0) {
          change(entry.row - n) += 2 * moved(entry.row);
        } else {
          add_row(entry.row, 1);
          add_row(entry.opposite, -1);
        }
      }
      for (int j = 0; j < d; ++j)
        result.tangent[static_cast<std::size_t>(level)](j, static_cast<Index>(p)) =
            gain(j) > 0 ? change(j) / (2 * gain(j)) : 0.0;
      gram_tangent[p] = std::move(next);
    }
    result.gain[static_cast<std::size_t>(level)] = gain;
    gram = std::move(coarser);
  }
  return result;
}

Sparsity::Sparsity(const Shape& shape, std::vector<SparseCurve> curves, const Watch& watch)
    : shape_(shape), curves_(std::move(curves)), watch_(watch), entries_(free_entries(shape)) {}

double Sparsity::value(const RowMatrix& matrix) {
  const RowMatrix inverse = inverse_of(shape_, matrix);
  std::vector<double> values(curves_.size());
  parallel_for(static_cast<Index>(curves_.size()), 0, [&](Index c) {
    const auto at = static_cast<std::size_t>(c);
    values[at] = value_of(curves_[at], matrix, inverse);
  });
  return std::accumulate(values.begin(), values.end(), 0.0);
}

void Sparsity::gather(const RowMatrix& matrix, Normal& normal) {
  const RowMatrix inverse = inverse_of(shape_, matrix);
  std::vector<Normal> each(curves_.size(), Normal(static_cast<int>(entries_.size())));
  parallel_for(static_cast<Index>(curves_.size()), 0, [&](Index c) {
    const auto at = static_cast<std::size_t>(c);
    gather_curve(curves_[at], matrix, inverse, each[at]);
  });
  for (Normal& one : each) normal += one;
}

void Sparsity::rows(const RowMatrix& matrix, RowSink& sink) const {
  const RowMatrix inverse = inverse_of(shape_, matrix);
  for (const SparseCurve& curve : curves_) gather_curve(curve, matrix, inverse, sink);
}

double Sparsity::value_of(const SparseCurve& curve, const RowMatrix& matrix, const RowMatrix& inverse) const {
  const int n = shape_.control_points(), d = shape_.details_per_node(), rows = shape_.rows();
  const GainTangents gains = gain_tangents(shape_, curve.levels, matrix, {});
  double sum = 0;
  Eigen::MatrixXd fine = curve.line->matrix();
  for (int level = curve.levels - 1; level >= 0; --level) {
    Eigen::MatrixXd coarse(shape_.line_length(level), fine.cols());
    for (Index node = 0; node < shape_.nodes(level); ++node) {
      if (node % 256 == 0) watch_.poll();
      const Eigen::MatrixXd values = inverse.transpose() * fine.middleRows(node * shape_.children_step(), rows);
      coarse.middleRows(node * shape_.polygon_step(), n) = values.topRows(n);
      for (int j = 0; j < d; ++j) {
        const double g = gains.gain[static_cast<std::size_t>(level)](j);
        sum += robust_weight(values.row(n + j).squaredNorm() * g * g, curve.scales).rho;
      }
    }
    fine.swap(coarse);
  }
  return sum;
}

// [P δ] = F R^-1, so d[P δ] = (dF - [P δ] dR) R^-1. A tangent has a row for each value that moves and, for each
// coordinate, a lane for each parameter. The ends of polygons are samples and never move. At the finest level dF = 0,
// and dR has one entry (two in C) a parameter: no product is needed there.
void Sparsity::gather_curve(const SparseCurve& curve, const RowMatrix& matrix, const RowMatrix& inverse,
                            RowSink& sink) const {
  const int n = shape_.control_points(), d = shape_.details_per_node(), rows = shape_.rows(), inner = n - 2;
  const Index dimension = curve.line->dimension(), count = static_cast<Index>(entries_.size());
  const GainTangents gains = gain_tangents(shape_, curve.levels, matrix, entries_);

  std::vector<int> moving_in, moving_out;
  for (int c = 0; c < rows; ++c)
    if (c % (n - 1) != 0) moving_in.push_back(c);
  for (int c = 1; c < rows; ++c)
    if (c != n - 1) moving_out.push_back(c);
  Lanes lift(static_cast<Index>(moving_out.size()), static_cast<Index>(moving_in.size()));
  for (Index a = 0; a < lift.rows(); ++a)
    for (Index b = 0; b < lift.cols(); ++b)
      lift(a, b) = inverse(moving_in[static_cast<std::size_t>(b)], moving_out[static_cast<std::size_t>(a)]);

  using RowArray = Eigen::Array<double, 1, Eigen::Dynamic>;
  RowArray along(count), slope(count);
  Lanes tangent(static_cast<Index>(moving_out.size()), dimension * count), fine_tangent;
  Eigen::MatrixXd fine = curve.line->matrix();
  for (int level = curve.levels - 1; level >= 0; --level) {
    const auto& gain = gains.gain[static_cast<std::size_t>(level)];
    Eigen::MatrixXd coarse(shape_.line_length(level), dimension);
    Lanes coarse_tangent(inner * shape_.nodes(level), dimension * count);
    for (Index node = 0; node < shape_.nodes(level); ++node) {
      if (node % 64 == 0) watch_.poll();
      const Eigen::MatrixXd values = inverse.transpose() * fine.middleRows(node * shape_.children_step(), rows);
      coarse.middleRows(node * shape_.polygon_step(), n) = values.topRows(n);
      if (level + 1 == curve.levels || inner == 0)
        tangent.setZero();
      else
        tangent.noalias() = lift * fine_tangent.middleRows(node * shape_.maps() * inner, shape_.maps() * inner);
      subtract_own_tangent(values, inverse, moving_out, tangent);
      coarse_tangent.middleRows(node * inner, inner) = tangent.topRows(inner);

      for (int j = 0; j < d; ++j) {
        const Eigen::VectorXd delta = values.row(n + j);
        const double g = gain(j);
        const RobustWeight weight = robust_weight(delta.squaredNorm() * g * g, curve.scales);
        const auto moved = tangent.row(inner + j).array();
        slope = gains.tangent[static_cast<std::size_t>(level)].row(j).array();
        along = (delta.squaredNorm() * g) * slope;  // v·dv, v = δ g
        for (Index axis = 0; axis < dimension; ++axis)
          along += (delta(axis) * g * g) * moved.segment(axis * count, count);
        for (Index axis = 0; axis < dimension; ++axis) {
          Eigen::Map<RowArray> row(sink.row(), count + 1);
          row.head(count) = (weight.w * g) * moved.segment(axis * count, count) + (weight.w * delta(axis)) * slope +
                            (weight.turn * delta(axis) * g) * along;
          row(count) = weight.w * delta(axis) * g;
        }
      }
    }
    fine.swap(coarse);
    fine_tangent.swap(coarse_tangent);
  }
}

// tangent -= [P δ] dR R^-1: parameter p moves only column entry.column, by value(row) - value(opposite).
void Sparsity::subtract_own_tangent(const Eigen::MatrixXd& values, const RowMatrix& inverse,
                                    const std::vector<int>& out, Lanes& tangent) const {
  const auto count = static_cast<Index>(entries_.size());
  Eigen::ArrayXd change(shape_.rows());
  for (Index axis = 0; axis < values.cols(); ++axis)
    for (Index p = 0; p < count;) {
      const int column = entries_[static_cast<std::size_t>(p)].column;
      Index length = 0;
      for (; p + length < count && entries_[static_cast<std::size_t>(p + length)].column == column; ++length) {
        const FreeEntry& entry = entries_[static_cast<std::size_t>(p + length)];
        change(length) = values(entry.row, axis) - (entry.opposite < 0 ? 0.0 : values(entry.opposite, axis));
      }
      for (std::size_t a = 0; a < out.size(); ++a)
        tangent.row(static_cast<Index>(a)).segment(axis * count + p, length).array() -=
            inverse(column, out[a]) * change.head(length).transpose();
      p += length;
    }
}

}  // namespace ifsm::core
