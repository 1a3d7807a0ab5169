#include "io/flame_symmetry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "linalg/affine.h"

using namespace ifsm::core;

namespace {

Matrix3 plane(double a, double b, double c, double d) {
  Matrix3 m = Matrix3::Zero();
  m.topLeftCorner<2, 2>() << a, b, c, d;
  return m;
}

// As flam3 adds them (flam3_add_symmetry), each of the weight 1.
std::vector<Matrix3> symmetries(int kind) {
  std::vector<Matrix3> all;
  if (kind < 0) all.push_back(plane(-1, 0, 0, 1));
  for (int k = 1; k < std::abs(kind); ++k) {
    const double a = 2 * std::numbers::pi * k / std::abs(kind);
    all.push_back(plane(std::cos(a), -std::sin(a), std::sin(a), std::cos(a)));
  }
  return all;
}

std::size_t place_of(const std::vector<Matrix3>& group, const Matrix3& wanted) {
  for (std::size_t k = 0; k < group.size(); ++k)
    if ((group[k] - wanted).norm() < 1e-9) return k;
  ADD_FAILURE() << "not of the group:\n" << wanted;
  return 0;
}

// Of the product of a run of symmetries, step by step, until what is left of runs is nothing.
std::vector<double> products_of_runs(const std::vector<Matrix3>& group, const std::vector<Matrix3>& steps, double sum) {
  const double all = sum + static_cast<double>(steps.size());
  std::vector<double> now(group.size(), 0), result(group.size(), 0);
  now[place_of(group, plane(1, 0, 0, 1))] = sum / all;
  for (int length = 0; length < 3000; ++length) {
    std::vector<double> next(group.size(), 0);
    for (std::size_t k = 0; k < group.size(); ++k) {
      result[k] += now[k];
      for (const Matrix3& step : steps) next[place_of(group, step * group[k])] += now[k] / all;
    }
    now = next;
  }
  return result;
}

TEST(FlameSymmetry, TakesProductsAsOftenAsRunsOfSymmetriesHaveThem) {
  const WeightedMaps plain{{{plane(.5, .1, -.2, .3), {1, 2, 0}}, {plane(.1, .2, .3, -.4), {-1, 0, 0}}}, {.7, .2}};
  const Matrix3 back = plane(.3, -.1, .2, .5) / .17;  // of the first map's linear part
  for (const int kind : {2, 3, 4, 5, 7, -1, -2, -3, -4, -6}) {
    const WeightedMaps all = with_symmetry(plain, kind);
    ASSERT_EQ(static_cast<int>(all.maps.size()), 2 * symmetry_order(kind));
    std::vector<Matrix3> group;
    for (std::size_t k = 0; k < all.maps.size(); k += 2) group.push_back(all.maps[k].linear * back);
    const std::vector<double> expected = products_of_runs(group, symmetries(kind), .9);
    for (std::size_t k = 0; k < group.size(); ++k) {
      EXPECT_NEAR(all.weights[2 * k], .7 * expected[k], 1e-12) << kind << " " << k;
      EXPECT_NEAR(all.weights[2 * k + 1], .2 * expected[k], 1e-12) << kind << " " << k;
      EXPECT_LT((all.maps[2 * k].shift - group[k] * plain.maps[0].shift).norm(), 1e-14);
      EXPECT_LT((all.maps[2 * k + 1].linear - group[k] * plain.maps[1].linear).norm(), 1e-14);
    }
  }
}

TEST(FlameSymmetry, HasExactQuarterTurns) {
  const WeightedMaps plain{{{plane(1, 0, 0, 1), {0, 0, 0}}}, {1}};
  const WeightedMaps all = with_symmetry(plain, 4);
  EXPECT_EQ(all.maps[1].linear, plane(0, -1, 1, 0));
  EXPECT_EQ(all.maps[2].linear, plane(-1, 0, 0, -1));
  EXPECT_EQ(all.maps[3].linear, plane(0, 1, -1, 0));
}

}  // namespace
