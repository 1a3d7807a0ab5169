#include "io/flame_symmetry.h"

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <numeric>

namespace ifsm::core {
namespace {

// r_g of the identity, of each other rotation, of the reflection, and of each other product of it with a rotation.
struct Shares {
  double identity, rotation, reflection, glide;
};

// With e the identity, F the reflection, N the sum of the n rotations, and q the probability of each symmetry (P: of
// any map), a step is Q = q (N - e + F), and Σ r_g g = P (e + Q + Q² + …) = P (e - Q)^-1. As F² = e, N² = n N and
// F N = N F, it is a e + b F + c N + d F N; comparing coefficients gives these. Nothing cancels.
Shares shares(double q, int n, bool mirrored) {
  if (!mirrored) return {(1 - q * (n - 2)) / (1 + q), q / (1 + q), 0, 0};
  const double p = 1 - q * n;
  const double a = (1 + q) / (1 + 2 * q), b = q / (1 + 2 * q);
  const double c = q * ((p + q) * a + q * b) / (p + 2 * q), d = q * ((p + q) * b + q * a) / (p + 2 * q);
  return {p * a + c, c, p * b + d, d};
}

Affine rotation(int k, int n) {
  // Quarter turns have the zeros that a cosine of π / 2 has not.
  constexpr double quarters[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  const double angle = 2 * std::numbers::pi * k / n;
  const bool quarter = 4 * k % n == 0;
  const double cosine = quarter ? quarters[4 * k / n][0] : std::cos(angle);
  const double sine = quarter ? quarters[4 * k / n][1] : std::sin(angle);
  Affine turn;
  turn.linear.topLeftCorner<2, 2>() << cosine, -sine, sine, cosine;
  return turn;
}

}  // namespace

int symmetry_order(int kind) { return kind < 0 ? -2 * kind : kind; }

WeightedMaps with_symmetry(const WeightedMaps& plain, int kind) {
  const int n = std::abs(kind);
  const bool mirrored = kind < 0;
  const double sum = std::accumulate(plain.weights.begin(), plain.weights.end(), 0.0);
  const Shares share = shares(1 / (sum + (mirrored ? n : n - 1)), n, mirrored);
  Affine mirror = Affine::identity(2);
  mirror.linear(0, 0) = -1;

  WeightedMaps all;
  const auto add = [&](const Affine& symmetry, double part) {
    for (std::size_t i = 0; i < plain.maps.size(); ++i) {
      all.maps.push_back(symmetry * plain.maps[i]);
      all.weights.push_back(part * plain.weights[i]);
    }
  };
  for (int k = 0; k < n; ++k) add(rotation(k, n), k == 0 ? share.identity : share.rotation);
  for (int k = 0; mirrored && k < n; ++k) add(rotation(k, n) * mirror, k == 0 ? share.reflection : share.glide);
  return all;
}

}  // namespace ifsm::core
