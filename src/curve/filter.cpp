#include "curve/filter.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "linalg/spectrum.h"

namespace ifsm::core {
namespace {

constexpr double epsilon = 2.220446049250313e-16;
constexpr Index most_work = 1 << 20;  // products of prefixes, times n³

std::string cell(Index row, Index column) {
  return "row " + std::to_string(row) + ", column " + std::to_string(column);
}

// A column's sum is rounded once an addition, and the entries once each where they were made.
void require_barycentric(const Shape& shape, const RowMatrix& r) {
  for (Index c = 0; c < r.cols(); ++c) {
    const auto column = r.col(c).head(shape.control_points());
    const double sum = column.sum();
    const double tolerance = 2 * shape.control_points() * epsilon * std::max(1.0, column.cwiseAbs().sum());
    if (std::abs(sum - 1) > tolerance)
      throw Error(Status::singular, "matrix",
                  "Column " + std::to_string(c) + " of T sums to " + text_of(sum) + "; each must sum to 1 within " +
                      text_of(tolerance) + ", or constant curves would not be kept: divide it by its sum.")
          .at(c)
          .with(sum);
  }
}

// Joined: the first and the last place of a node are its own polygon's ends, untouched by details.
void require_joints(const Shape& shape, const RowMatrix& r) {
  if (!shape.joined()) return;
  const auto require = [&](Index row, Index column, double wanted) {
    if (r(row, column) == wanted) return;
    throw Error(Status::singular, "matrix",
                "A joined filter's first and last columns are unit vectors, but " + cell(row, column) + " is " +
                    text_of(r(row, column)) + " instead of " + text_of(wanted) +
                    "; set it, or use the square topology.")
        .at(row * r.cols() + column)
        .with(r(row, column));
  };
  const Index last = r.cols() - 1;
  for (Index row = 0; row < r.rows(); ++row) {
    require(row, 0, row == 0 ? 1.0 : 0.0);
    require(row, last, row == shape.control_points() - 1 ? 1.0 : 0.0);
  }
}

RowMatrix checked(const Shape& shape, RowMatrix r) {
  const Index rows = shape.rows();
  if (r.rows() != rows || r.cols() != rows)
    throw Error(Status::shape, "matrix",
                "R must have " + std::to_string(rows) + " rows and columns for this shape; it has " +
                    std::to_string(r.rows()) + " and " + std::to_string(r.cols()) + ".")
        .needs(rows * rows);
  require_finite(r.data(), r.size(), "matrix");
  require_barycentric(shape, r);
  require_joints(shape, r);
  return r;
}

double invertible(double condition) {
  constexpr double most = 1 / (64 * epsilon);  // beyond, R^-1 has no digit that can be relied upon
  if (condition < most) return condition;
  throw Error(Status::singular, "matrix",
              "R is not invertible in double precision: its condition number is " + text_of(condition) +
                  "; choose U's rows independent of T's (ifsm_filter_from_maps finds such ones).")
      .with(condition);
}

// An orthonormal basis of the vectors of sum zero, n × (n-1) (Helmert's).
Eigen::MatrixXd sum_zero_basis(int n) {
  Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(n, n - 1);
  for (int k = 1; k < n; ++k) {
    const double scale = 1 / std::sqrt(k * (k + 1.0));
    basis.col(k - 1).head(k).setConstant(scale);
    basis(k, k - 1) = -k * scale;
  }
  return basis;
}

// Does every infinite word have a prefix whose product has a norm below 1? Then all long products shrink. Words are
// lengthened only until they are short enough, so a few products decide most cases.
class Prefixes {
 public:
  explicit Prefixes(const std::vector<Eigen::MatrixXd>& letters) : letters_(letters) {}

  bool all_shrink() {
    const Index size = letters_[0].rows();
    products_ = most_work / (size * size * size) + 64;
    return shrink_below(Eigen::MatrixXd::Identity(size, size), 0);
  }

 private:
  bool shrink_below(const Eigen::MatrixXd& prefix, int length) {
    constexpr int longest = 64;
    if (length == longest) return false;
    for (const auto& letter : letters_) {
      if (--products_ < 0) return false;
      const Eigen::MatrixXd word = prefix.lazyProduct(letter);
      // The maximum norm of columns; 1e-9 is far above the rounding of a product of 64 small matrices of norm near 1.
      const double norm = word.cwiseAbs().colwise().sum().maxCoeff();
      if (!(norm < 1 - 1e-9) && !shrink_below(word, length + 1)) return false;
    }
    return true;
  }

  const std::vector<Eigen::MatrixXd>& letters_;
  Index products_ = 0;
};

}  // namespace

Filter::Filter(const Shape& shape, RowMatrix matrix)
    : shape_(shape),
      matrix_(checked(shape, std::move(matrix))),
      condition_(invertible(condition_of(matrix_))),
      contractivity_(contractivity_of(shape, matrix_.topRows(shape.control_points()))) {
  inverse_ = inverse_of(shape_, matrix_);
}

RowMatrix Filter::map(int i) const {
  const int n = shape_.control_points();
  return matrix_.block(0, first_column(shape_, i), n, n);
}

RowMatrix Filter::detail_map(int i) const {
  const int n = shape_.control_points();
  return matrix_.block(n, first_column(shape_, i), shape_.details_per_node(), n);
}

namespace {

// I - inverse · matrix, summed in extended precision: it consists of what doubles round away.
RowMatrix left_over(const RowMatrix& inverse, const RowMatrix& matrix) {
  const Index rows = matrix.rows();
  RowMatrix left(rows, rows);
  std::vector<long double> sums(static_cast<std::size_t>(rows));
  for (Index r = 0; r < rows; ++r) {
    std::ranges::fill(sums, 0.0L);
    sums[static_cast<std::size_t>(r)] = 1;
    for (Index k = 0; k < rows; ++k) {
      const long double factor = inverse(r, k);
      for (Index c = 0; c < rows; ++c) sums[static_cast<std::size_t>(c)] -= factor * matrix(k, c);
    }
    for (Index c = 0; c < rows; ++c) left(r, c) = static_cast<double>(sums[static_cast<std::size_t>(c)]);
  }
  return left;
}

}  // namespace

RowMatrix inverse_of(const Shape& shape, const RowMatrix& matrix) {
  RowMatrix inverse = core::inverse(matrix);
  inverse += left_over(inverse, matrix) * inverse;  // a step of Newton's: from eps · condition to eps
  if (!shape.joined()) return inverse;
  const Index last = matrix.rows() - 1;
  for (const auto& [column, end] : {std::pair<Index, Index>{0, 0}, {shape.control_points() - 1, last}}) {
    inverse.col(column).setZero();
    inverse(end, column) = 1;
  }
  return inverse;
}

double condition_of(const RowMatrix& matrix) { return condition_number(matrix); }

Contractivity contractivity_of(const Shape& shape, const Eigen::Ref<const RowMatrix>& maps) {
  const int n = shape.control_points();
  if (n == 1) return Contractivity::proven;
  const Eigen::MatrixXd basis = sum_zero_basis(n);
  std::vector<Eigen::MatrixXd> letters;
  for (int i = 0; i < shape.maps(); ++i)
    letters.push_back(basis.transpose() * maps.middleCols(first_column(shape, i), n) * basis);
  const Eigen::MatrixXd upper = balancing(letters), back = inverse(upper);
  for (auto& letter : letters) letter = (upper * letter * back).eval();

  if (Prefixes(letters).all_shrink()) return Contractivity::proven;
  constexpr int longest = 4;
  return growing_word(letters, longest) ? Contractivity::refuted : Contractivity::undecided;
}

}  // namespace ifsm::core
