// From data to a share of an axis, and the ticks a reader expects there.
#pragma once

#include <string>
#include <vector>

namespace plot {

struct Tick {
  double value;
  std::string label;
};

class Scale {
 public:
  enum class Kind { Linear, Logarithmic };

  Scale() = default;
  Scale(Kind kind, double low, double high) : kind_(kind), low_(low), high_(high) {}

  double low() const { return low_; }
  double high() const { return high_; }
  double share(double value) const;  // 0 at low, 1 at high

  // About `wanted` ticks at round values, all within the scale.
  std::vector<Tick> ticks(int wanted) const;

 private:
  std::vector<Tick> linear_ticks(int wanted) const;
  std::vector<Tick> logarithmic_ticks(int wanted) const;

  Kind kind_ = Kind::Linear;
  double low_ = 0;
  double high_ = 1;
};

// The largest of 1, 2, 5 × 10^k that is not above `value`.
double round_down(double value);

// Fixed digits, without trailing zeros: "0.05", "3", "1200".
std::string plain(double value, int decimals);

// With an exponent, as short as those decimals allow: "1.25e-7", "2e6".
std::string scientific(double value, int decimals);

}  // namespace plot
