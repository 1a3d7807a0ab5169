#include "measure/orientation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>

using ifsm::core::exact_orientation;
using ifsm::core::orientation;

namespace {

__extension__ using Wide = __int128;

int sign(double value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

// By integers: coordinates times 2^53.
int true_sign(const double* a, const double* b, const double* c) {
  const auto whole = [](double value) { return static_cast<Wide>(std::ldexp(value, 53)); };
  const Wide left = (whole(b[0]) - whole(a[0])) * (whole(c[1]) - whole(a[1]));
  const Wide right = (whole(b[1]) - whole(a[1])) * (whole(c[0]) - whole(a[0]));
  return left > right ? 1 : left < right ? -1 : 0;
}

// The grid on which the plain formula famously goes wrong: points a few last places apart beside a diagonal.
TEST(Orientation, IsExactOnAGridOfLastPlacesBesideALine) {
  const double b[] = {12, 12}, c[] = {24, 24};
  int wrong_without = 0;
  for (int x = 0; x < 256; ++x)
    for (int y = 0; y < 256; ++y) {
      const double a[] = {0.5 + x * 0x1p-53, 0.5 + y * 0x1p-53};
      const int wanted = true_sign(a, b, c);
      ASSERT_EQ(sign(orientation(a, b, c)), wanted) << x << ", " << y;
      ASSERT_EQ(sign(exact_orientation(a, b, c)), wanted) << x << ", " << y;
      const double plain = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
      wrong_without += sign(plain) != wanted;
    }
  EXPECT_GT(wrong_without, 1000);  // else the grid tests nothing
}

TEST(Orientation, IsExactForPointsNearlyOnALine) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> spread(-2, 2), share(-1, 2);
  int collinear = 0;
  for (int trial = 0; trial < 100000; ++trial) {
    // Of 30 bits, so that points of the line between them can be exactly on it.
    const auto rounded = [&](double value) { return std::ldexp(std::nearbyint(std::ldexp(value, 28)), -28); };
    const double a[] = {rounded(spread(random)), rounded(spread(random))};
    const double b[] = {rounded(spread(random)), rounded(spread(random))};
    const double t = trial % 2 == 0 ? 0.25 : share(random);
    double c[] = {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
    if (trial % 4 == 0) c[0] = std::ldexp(std::nearbyint(std::ldexp(c[0], 52)), -52);
    for (double& value : c) value = std::ldexp(std::nearbyint(std::ldexp(value, 53)), -53);
    const int wanted = true_sign(a, b, c);
    collinear += wanted == 0;
    ASSERT_EQ(sign(orientation(a, b, c)), wanted) << trial;
    ASSERT_EQ(sign(orientation(b, c, a)), wanted) << trial;
    ASSERT_EQ(sign(orientation(b, a, c)), -wanted) << trial;
  }
  EXPECT_GT(collinear, 10000);
}

TEST(Orientation, IsExactBesideTheSmallestCoordinatesThatItIsPromisedFor) {
  const double tiny = 0x1p-450, a[] = {0, 0}, b[] = {tiny, tiny};
  const double on[] = {1, 1}, left[] = {1, 1 + 0x1p-52}, right[] = {1, 1 - 0x1p-53};
  EXPECT_EQ(orientation(a, b, on), 0);
  EXPECT_GT(orientation(a, b, left), 0);
  EXPECT_LT(orientation(a, b, right), 0);
}

}  // namespace
