#include "measure/orientation.h"

#include <array>
#include <cmath>

namespace ifsm::core {
namespace {

constexpr double epsilon = 1.1102230246251565e-16;  // 2^-53: half a unit in the last place of 1

// A sum of doubles that do not overlap, smallest first: the exact value of everything that was added.
class Expansion {
 public:
  // Shewchuk's grow-expansion; components that come out zero are left out.
  void add(double value) {
    int kept = 0;
    for (int i = 0; i < count_; ++i) {
      const double sum = value + parts_[static_cast<std::size_t>(i)];
      const double of_value = sum - parts_[static_cast<std::size_t>(i)];
      const double lost = (value - of_value) + (parts_[static_cast<std::size_t>(i)] - (sum - of_value));
      value = sum;
      if (lost != 0) parts_[static_cast<std::size_t>(kept++)] = lost;
    }
    parts_[static_cast<std::size_t>(kept++)] = value;
    count_ = kept;
  }
  void add_product(double x, double y) {
    const double product = x * y;
    add(std::fma(x, y, -product));
    add(product);
  }
  // Nearly rounded; the last part is larger than all others together, so the sign is right.
  double value() const {
    double sum = 0;
    for (int i = 0; i < count_; ++i) sum += parts_[static_cast<std::size_t>(i)];
    return sum;
  }

 private:
  std::array<double, 12> parts_{};  // two for each of the six products
  int count_ = 0;
};

}  // namespace

double exact_orientation(const double* a, const double* b, const double* c) {
  // a x b + b x c + c x a: no difference is taken, so nothing is rounded before the sum.
  Expansion sum;
  sum.add_product(a[0], b[1]);
  sum.add_product(-a[1], b[0]);
  sum.add_product(b[0], c[1]);
  sum.add_product(-b[1], c[0]);
  sum.add_product(c[0], a[1]);
  sum.add_product(-c[1], a[0]);
  return sum.value();
}

double orientation(const double* a, const double* b, const double* c) {
  const double left = (a[0] - c[0]) * (b[1] - c[1]);
  const double right = (a[1] - c[1]) * (b[0] - c[0]);
  const double determinant = left - right;
  // Two roundings of differences and one of each product, and one of the last difference: Shewchuk's bound A.
  const double doubt = (3 + 16 * epsilon) * epsilon * (std::abs(left) + std::abs(right));
  if (std::abs(determinant) > doubt) return determinant;
  return exact_orientation(a, b, c);
}

}  // namespace ifsm::core
