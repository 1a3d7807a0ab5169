#include "fit/sparsity.h"

#include <cmath>
#include <numeric>
#include <utility>

#include "base/parallel.h"
#include "curve/significance.h"
#include "fit/blocks.h"

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

// A subtree, or the top of the tree: the line that it stands on, which becomes the line of its root; and the tangents
// of that line's inner points, a row each (of the finest line there are none: it does not move).
struct Sparsity::Part {
  int root, levels;
  Eigen::MatrixXd line;
  Lanes tangent;
};

// What the parts of a curve's tree share.
struct Sparsity::Climb {
  const SparseCurve& curve;
  const RowMatrix& inverse;
  GainTangents gains;
  std::vector<int> moving_out;  // values of a node that move, ends being samples
  Lanes lift;                   // by what its children's inner points move them
};

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
    gather(curves_[at], matrix, inverse, each[at]);
  });
  for (Normal& one : each) normal += one;
}

void Sparsity::rows(const RowMatrix& matrix, RowSink& sink) const {
  const RowMatrix inverse = inverse_of(shape_, matrix);
  for (const SparseCurve& curve : curves_) {
    const Climb climb = climb_of(curve, matrix, inverse);
    this->climb(curve, curve.line->dimension() * static_cast<Index>(entries_.size()),
                [&](Index groups, const Work& work) {
                  for (Index group = 0; group < groups; ++group)
                    work(group, [&](Part& part) { gather(climb, part, sink); });
                });
  }
}

// Up a curve's tree, the lowest levels first, cut into blocks; what they leave is a line again. No more of the tangents
// is held than one block's and the roots'.
void Sparsity::climb(const SparseCurve& curve, Index tangents, const Stage& stage) const {
  const Index step = shape_.polygon_step(), inner = step - 1;
  const auto finest = curve.line->matrix();
  Eigen::MatrixXd line;
  Lanes tangent;
  for (int levels = curve.levels; levels > 0;) {
    const Blocks blocks(shape_, levels);
    const Index nodes = shape_.nodes(levels - blocks.level());
    Eigen::MatrixXd roots(shape_.line_length(blocks.level()), finest.cols());
    Lanes moved(inner * blocks.count(), tangents);
    stage(blocks.groups(), [&](Index group, const Take& take) {
      for (Index b = blocks.first(group); b < blocks.first(group + 1); ++b) {
        Part part{blocks.level(), levels, {}, {}};
        if (levels == curve.levels) {
          part.line = finest.middleRows(b * nodes * step, nodes * step + 1);
        } else {
          part.line = line.middleRows(b * nodes * step, nodes * step + 1);
          part.tangent = tangent.middleRows(b * nodes * inner, nodes * inner);
        }
        take(part);
        roots.middleRows(b * step, step) = part.line.topRows(step);  // the last point is the next block's first
        if (tangents > 0) moved.middleRows(b * inner, inner) = part.tangent;
      }
    });
    roots.bottomRows(1) = finest.bottomRows(1);
    line.swap(roots);
    tangent.swap(moved);
    levels = blocks.level();
  }
}

double Sparsity::value_of(const SparseCurve& curve, const RowMatrix& matrix, const RowMatrix& inverse) const {
  const Climb climb{curve, inverse, gain_tangents(shape_, curve.levels, matrix, {}), {}, {}};
  double sum = 0;
  this->climb(curve, 0, [&](Index groups, const Work& work) {
    std::vector<double> sums(static_cast<std::size_t>(groups), 0.0);
    parallel_for(groups, 0, [&](Index group) {
      work(group, [&](Part& part) { sums[static_cast<std::size_t>(group)] += value_of(climb, part); });
    });
    sum = std::accumulate(sums.begin(), sums.end(), sum);
  });
  return sum;
}

double Sparsity::value_of(const Climb& climb, Part& part) const {
  const int n = shape_.control_points(), d = shape_.details_per_node(), rows = shape_.rows();
  double sum = 0;
  for (int level = part.levels - 1; level >= part.root; --level) {
    Eigen::MatrixXd coarse(shape_.line_length(level - part.root), part.line.cols());
    for (Index node = 0; node < shape_.nodes(level - part.root); ++node) {
      if (node % 256 == 0) watch_.poll();
      const Eigen::MatrixXd values =
          climb.inverse.transpose() * part.line.middleRows(node * shape_.children_step(), rows);
      coarse.middleRows(node * shape_.polygon_step(), n) = values.topRows(n);
      for (int j = 0; j < d; ++j) {
        const double g = climb.gains.gain[static_cast<std::size_t>(level)](j);
        sum += robust_weight(values.row(n + j).squaredNorm() * g * g, climb.curve.scales).rho;
      }
    }
    part.line.swap(coarse);
  }
  return sum;
}

Sparsity::Climb Sparsity::climb_of(const SparseCurve& curve, const RowMatrix& matrix, const RowMatrix& inverse) const {
  const int n = shape_.control_points(), rows = shape_.rows();
  std::vector<int> moving_in, moving_out;
  for (int c = 0; c < rows; ++c)
    if (c % (n - 1) != 0) moving_in.push_back(c);
  for (int c = 1; c < rows; ++c)
    if (c != n - 1) moving_out.push_back(c);
  Lanes lift(static_cast<Index>(moving_out.size()), static_cast<Index>(moving_in.size()));
  for (Index a = 0; a < lift.rows(); ++a)
    for (Index b = 0; b < lift.cols(); ++b)
      lift(a, b) = inverse(moving_in[static_cast<std::size_t>(b)], moving_out[static_cast<std::size_t>(a)]);
  return {curve, inverse, gain_tangents(shape_, curve.levels, matrix, entries_), std::move(moving_out),
          std::move(lift)};
}

void Sparsity::gather(const SparseCurve& curve, const RowMatrix& matrix, const RowMatrix& inverse,
                      Normal& normal) const {
  const Climb climb = climb_of(curve, matrix, inverse);
  this->climb(curve, curve.line->dimension() * static_cast<Index>(entries_.size()),
              [&](Index groups, const Work& work) {
                if (groups == 1) return work(0, [&](Part& part) { gather(climb, part, normal); });
                std::vector<Normal> each(static_cast<std::size_t>(groups), Normal(normal.parameters()));
                parallel_for(groups, 0, [&](Index group) {
                  work(group, [&](Part& part) { gather(climb, part, each[static_cast<std::size_t>(group)]); });
                });
                for (Normal& one : each) normal += one;
              });
}

// [P δ] = F R^-1, so d[P δ] = (dF - [P δ] dR) R^-1. A tangent has a row for each value that moves and, for each
// coordinate, a lane for each parameter. The ends of polygons are samples and never move. At the finest level dF = 0,
// and dR has one entry (two in C) a parameter: no product is needed there.
void Sparsity::gather(const Climb& climb, Part& part, RowSink& sink) const {
  const int n = shape_.control_points(), d = shape_.details_per_node(), rows = shape_.rows(), inner = n - 2;
  const Index dimension = climb.curve.line->dimension(), count = static_cast<Index>(entries_.size());
  using RowArray = Eigen::Array<double, 1, Eigen::Dynamic>;
  RowArray along(count), slope(count);
  Lanes tangent(static_cast<Index>(climb.moving_out.size()), dimension * count);
  for (int level = part.levels - 1; level >= part.root; --level) {
    const auto& gain = climb.gains.gain[static_cast<std::size_t>(level)];
    Eigen::MatrixXd coarse(shape_.line_length(level - part.root), dimension);
    Lanes coarse_tangent(inner * shape_.nodes(level - part.root), dimension * count);
    for (Index node = 0; node < shape_.nodes(level - part.root); ++node) {
      if (node % 64 == 0) watch_.poll();
      const Eigen::MatrixXd values =
          climb.inverse.transpose() * part.line.middleRows(node * shape_.children_step(), rows);
      coarse.middleRows(node * shape_.polygon_step(), n) = values.topRows(n);
      if (level + 1 == climb.curve.levels || inner == 0)
        tangent.setZero();
      else
        tangent.noalias() = climb.lift * part.tangent.middleRows(node * shape_.maps() * inner, shape_.maps() * inner);
      subtract_own_tangent(values, climb.inverse, climb.moving_out, tangent);
      coarse_tangent.middleRows(node * inner, inner) = tangent.topRows(inner);

      for (int j = 0; j < d; ++j) {
        const Eigen::VectorXd delta = values.row(n + j);
        const double g = gain(j);
        const RobustWeight weight = robust_weight(delta.squaredNorm() * g * g, climb.curve.scales);
        const auto moved = tangent.row(inner + j).array();
        slope = climb.gains.tangent[static_cast<std::size_t>(level)].row(j).array();
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
    part.line.swap(coarse);
    part.tangent.swap(coarse_tangent);
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
