#include "system/moments.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace ifsm::core {
namespace {

using Matrix = Eigen::MatrixXd;

// Polynomials as their coefficients by monomial.
class Basis {
 public:
  Basis(int dimension, int degree) : dimension_(dimension), powers_(monomials(dimension, degree)) {}

  Eigen::Index size() const { return static_cast<Eigen::Index>(powers_.size()); }
  const Powers& powers(Eigen::Index k) const { return powers_[static_cast<std::size_t>(k)]; }
  Eigen::Index place(const Powers& wanted) const {
    return std::find(powers_.begin(), powers_.end(), wanted) - powers_.begin();
  }

  // The monomials of w(x), a row each, as polynomials in x: each is one of lower degree times a coordinate of w(x).
  Matrix after(const Affine& map) const {
    Matrix rows = Matrix::Zero(size(), size());
    rows(0, 0) = 1;
    for (Eigen::Index k = 1; k < size(); ++k) {
      Powers lower = powers(k);
      const int axis = lower[0] > 0 ? 0 : lower[1] > 0 ? 1 : 2;
      --lower[static_cast<std::size_t>(axis)];
      const Eigen::Index from = place(lower);
      for (Eigen::Index j = 0; j < k; ++j) {
        const double coefficient = rows(from, j);
        if (coefficient == 0) continue;
        rows(k, j) += coefficient * map.shift(axis);
        for (int a = 0; a < dimension_; ++a) {
          Powers higher = powers(j);
          ++higher[static_cast<std::size_t>(a)];
          rows(k, place(higher)) += coefficient * map.linear(axis, a);
        }
      }
    }
    return rows;
  }

 private:
  int dimension_;
  std::vector<Powers> powers_;
};

}  // namespace

std::vector<Powers> monomials(int dimension, int degree) {
  std::vector<Powers> all;
  for (int total = 0; total <= degree; ++total)
    for (int x = total; x >= 0; --x)
      for (int y = total - x; y >= 0; --y)
        if (const int z = total - x - y; z == 0 || dimension == 3) all.push_back({x, y, z});
  return all;
}

// m = Σ p_i E[monomials of w_i(x)] = B m with B block lower triangular by degree: (I - B_kk) m_k = B_k,<k m_<k.
std::vector<double> moments(const System& system, int degree, const Vector3& about) {
  in_range(degree, 1, most_moment_degree, "degree");
  static_cast<void>(system.enclosure());  // refuses what is not contractive
  const Basis basis(system.dimension(), degree);
  Matrix mean = Matrix::Zero(basis.size(), basis.size());
  for (const int i : system.active()) {
    const auto k = static_cast<std::size_t>(i);
    const Affine& map = system.maps()[k];
    mean += system.probabilities()[k] * basis.after({map.linear, map(about) - about});
  }
  Eigen::VectorXd m = Eigen::VectorXd::Zero(basis.size());
  m(0) = 1;
  Eigen::Index first = 1;
  for (int k = 1; k <= degree; ++k) {
    const auto end = static_cast<Eigen::Index>(monomials(system.dimension(), k).size());
    const Eigen::Index count = end - first;
    const Matrix block = Matrix::Identity(count, count) - mean.block(first, first, count, count);
    m.segment(first, count) = block.partialPivLu().solve(mean.block(first, 0, count, first) * m.head(first));
    first = end;
  }
  return {m.begin(), m.end()};
}

}  // namespace ifsm::core
