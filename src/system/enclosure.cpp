#include "system/enclosure.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "linalg/spectrum.h"

namespace ifsm::core {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr int longest_word = 64;
// Far above the rounding of a product of 64 matrices of norms near 1, which is about 64 · 3 · epsilon.
constexpr double margin = 1e-9;

// Every infinite word has a prefix whose norm, in the balanced coordinates U x, is at most some bound below 1. Such
// prefixes are a system of the same attractor, and an ellipsoid |U (x - c)| <= r that each of them maps into itself
// holds it: r >= |U (w(c) - c)| + |w| r (math.md section 1).
class Prefixes {
 public:
  Prefixes(std::span<const Affine> maps, const Matrix3& balance, const Vector3& centre)
      : maps_(maps), balance_(balance), back_(inverse(balance)), centre_(centre) {}

  // The radius r when all words shrink to the bound within the budget of products.
  std::optional<double> radius(double bound, int budget, int dimension) {
    bound_ = bound;
    budget_ = budget;
    radius_ = 0;
    length_ = 0;
    if (!all_shrink(Affine::identity(dimension), 0)) return std::nullopt;
    return radius_;
  }
  int length() const { return length_; }

 private:
  bool all_shrink(const Affine& prefix, int length) {
    if (length == longest_word) return false;
    length_ = std::max(length_, length + 1);
    for (const Affine& map : maps_) {
      if (--budget_ < 0) return false;
      const Affine word = prefix * map;
      const Matrix3 balanced = balance_ * word.linear * back_;
      if (!balanced.allFinite()) return false;
      const double norm = stretch(balanced);
      if (norm <= bound_)
        radius_ = std::max(radius_, (balance_ * (word(centre_) - centre_)).norm() / (1 - norm - margin / 2));
      else if (!all_shrink(word, length + 1))
        return false;
    }
    return true;
  }

  std::span<const Affine> maps_;
  Matrix3 balance_, back_;
  Vector3 centre_;
  double bound_ = 0, radius_ = 0;
  int budget_ = 0, length_ = 0;
};

std::vector<Eigen::MatrixXd> linear_parts(int dimension, std::span<const Affine> maps) {
  std::vector<Eigen::MatrixXd> parts;
  for (const Affine& map : maps) parts.emplace_back(map.linear.topLeftCorner(dimension, dimension));
  return parts;
}

// The fixed point of the maps' mean: the middle of a measure on the attractor.
Vector3 middle(std::span<const Affine> maps) {
  Affine mean;
  const double weight = 1 / static_cast<double>(maps.size());
  for (const Affine& map : maps) {
    mean.linear += weight * map.linear;
    mean.shift += weight * map.shift;
  }
  const Vector3 fixed = fixed_point(mean);
  return fixed.allFinite() ? fixed : Vector3::Zero();
}

Ellipsoid ellipsoid(int dimension, const Vector3& centre, const Matrix3& balance, double radius) {
  // What rounding does to a point of the attractor: some units in the last place of the numbers that make it.
  const double slack = 64 * epsilon * (stretch(balance) * centre.norm() + radius);
  Matrix3 axes = inverse(balance);
  axes.col(2) *= dimension == 2 ? 0 : 1;
  return {centre, (radius + slack) * axes};
}

}  // namespace

Contraction contraction_of(int dimension, std::span<const Affine> maps) {
  const std::vector<Eigen::MatrixXd> parts = linear_parts(dimension, maps);
  Matrix3 balance = Matrix3::Identity();
  balance.topLeftCorner(dimension, dimension) = balancing(parts);

  // A bound well below 1 makes the ellipsoid small; where that takes too many words, any bound does.
  struct Attempt {
    double bound;
    int budget;
  };
  const Vector3 centre = middle(maps);
  Prefixes prefixes(maps, balance, centre);
  for (const Attempt attempt : {Attempt{.9, 1 << 12}, Attempt{1 - margin, 1 << 16}})
    if (const auto radius = prefixes.radius(attempt.bound, attempt.budget, dimension))
      return {Contractivity::proven, prefixes.length(), {}, 0, ellipsoid(dimension, centre, balance, *radius)};

  constexpr int longest = 12;
  if (const auto growth = growing_word(parts, longest))
    return {Contractivity::refuted, static_cast<int>(growth->word.size()), growth->word, growth->radius, {}};
  return {Contractivity::undecided, prefixes.length(), {}, 0, {}};
}

}  // namespace ifsm::core
