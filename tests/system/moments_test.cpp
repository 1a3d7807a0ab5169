#include "system/moments.h"

#include "base/error.h"
#include "support.h"
#include "system/named.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

double power(const Vector3& x, const Powers& powers) {
  return std::pow(x(0), powers[0]) * std::pow(x(1), powers[1]) * std::pow(x(2), powers[2]);
}

TEST(Monomials, AreInTheOrderThatIsPromised) {
  EXPECT_EQ(monomials(2, 2), (std::vector<Powers>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {1, 1, 0}, {0, 2, 0}}));
  EXPECT_EQ(monomials(2, 8).size(), 45u);
  EXPECT_EQ(monomials(3, 8).size(), 165u);
}

TEST(Moments, OfTheRightGasketAreThoseOfTheMathPage) {
  const System gasket(2, named_system("gasket_right")->maps(), {1, 1, 1});
  const double wanted[] = {1, 1. / 3, 1. / 3, 5. / 27, 2. / 27, 5. / 27};
  const auto found = moments(gasket, 2, Vector3::Zero());
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(found[k], wanted[k], 4 * epsilon);
}

TEST(Moments, OfTheUnitSquareAndCubeAreThoseOfUniformNumbers) {
  std::vector<Affine> quarters, eighths;
  for (int k = 0; k < 8; ++k) {
    Affine map = Affine::identity(3);
    map.linear *= .5;
    map.shift = Vector3(k & 1, k >> 1 & 1, k >> 2) / 2;
    eighths.push_back(map);
    map.linear(2, 2) = 0;
    if (k < 4) quarters.push_back(map);
  }
  for (const int d : {2, 3}) {
    const auto found = moments(System(d, d == 2 ? quarters : eighths), 8, Vector3::Zero());
    const auto powers = monomials(d, 8);
    for (std::size_t k = 0; k < powers.size(); ++k) {
      const double wanted = 1. / ((powers[k][0] + 1) * (powers[k][1] + 1) * (powers[k][2] + 1));
      EXPECT_NEAR(found[k], wanted, 16 * epsilon) << k;
    }
  }
}

// m = Σ p_i ∫ (w_i x)^a dμ, by exact integration of polynomials of degree 8 over a measure that is known: words.
TEST(Moments, AreThoseOfTheMeasureOnLongWords) {
  Random random(4);
  for (int k = 0; k < 12; ++k) {
    const System system = random_system(random, k % 2 + 2, .25);
    const Vector3 about(.3, -.2, k % 2 == 0 ? 0 : .1);
    const auto powers = monomials(system.dimension(), 5);
    // Pieces of six letters are below 4^-6 of the whole; the measure put on their points is that near to μ.
    std::vector<double> wanted(powers.size(), 0);
    struct Point {
      Vector3 x;
      double p;
    };
    std::vector<Point> points{{fixed_point(system.maps()[0]), 1}};
    for (int length = 0; length < 6; ++length) {
      std::vector<Point> next;
      for (std::size_t i = 0; i < system.maps().size(); ++i)
        for (const Point& each : points) next.push_back({system.maps()[i](each.x), each.p * system.probabilities()[i]});
      points = next;
    }
    double largest = 1;
    for (const Point& each : points) {
      largest = std::max(largest, (each.x - about).norm());
      for (std::size_t a = 0; a < powers.size(); ++a) wanted[a] += each.p * power(each.x - about, powers[a]);
    }
    const auto found = moments(system, 5, about);
    const double size = 2 * system.enclosure().axes.norm() * std::pow(.25, 6);
    for (std::size_t a = 0; a < powers.size(); ++a) {
      const int degree = powers[a][0] + powers[a][1] + powers[a][2];
      // The sum's own rounding: of as many terms as there are points.
      const double rounding = epsilon * static_cast<double>(points.size());
      EXPECT_NEAR(found[a], wanted[a], (2 * degree * size + rounding) * std::pow(2 * largest, degree))
          << "system " << k << ", moment " << a;
    }
  }
}

TEST(Moments, DoNotChangeWhenThePlaneLiesInSpace) {
  const auto fern = named_system("fern");
  const auto flat = moments(*fern, 6, Vector3::Zero()), deep = moments(embedded(*fern), 6, Vector3::Zero());
  const auto powers = monomials(2, 6), all = monomials(3, 6);
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto same = std::find(powers.begin(), powers.end(), all[k]) - powers.begin();
    const double wanted = all[k][2] > 0 ? 0 : flat[static_cast<std::size_t>(same)];
    EXPECT_NEAR(deep[k], wanted, 64 * epsilon * std::abs(wanted));
  }
}

TEST(Moments, RefuseDegreesAndSystemsThatHaveNone) {
  EXPECT_THROW(moments(*named_system("fern"), 0, Vector3::Zero()), Error);
  EXPECT_THROW(moments(*named_system("fern"), 9, Vector3::Zero()), Error);
  EXPECT_THROW(moments(System(2, {plane(2, 0, 0, 2, 0, 0)}), 2, Vector3::Zero()), Error);
}

}  // namespace
