#include "scale.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace plot {

double Scale::share(double value) const {
  if (kind_ == Kind::Linear) return (value - low_) / (high_ - low_);
  return std::log(value / low_) / std::log(high_ / low_);
}

std::vector<Tick> Scale::ticks(int wanted) const {
  return kind_ == Kind::Linear ? linear_ticks(wanted) : logarithmic_ticks(wanted);
}

std::vector<Tick> Scale::linear_ticks(int wanted) const {
  const double step = round_down((high_ - low_) / std::max(wanted, 1) * 1.6);
  const double largest = std::max(std::abs(low_), std::abs(high_));
  const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step))));
  const int digits = static_cast<int>(std::floor(std::log10(largest)) - std::floor(std::log10(step)));
  const bool with_exponent = largest >= 1e7 || decimals > 4;
  std::vector<Tick> ticks;
  constexpr int most = 100;  // against steps that rounding swallows
  const double first = std::ceil(low_ / step);
  for (int k = 0; k < most && (first + k) * step <= high_ + 1e-9 * step; ++k) {
    const double value = (first + k) * step;
    ticks.push_back({value, with_exponent ? scientific(value, digits) : plain(value, decimals)});
  }
  return ticks;
}

std::vector<Tick> Scale::logarithmic_ticks(int wanted) const {
  const double decades = std::log10(high_ / low_);
  const bool between = decades <= 3.5;  // few decades: 2 and 5 are labelled as well
  const double stride = std::ceil(decades / 8);
  std::vector<Tick> ticks;
  for (double decade = std::floor(std::log10(low_) / stride) * stride; decade <= std::log10(high_); decade += stride)
    for (const double digit : {1.0, 2.0, 5.0}) {
      const double value = digit * std::pow(10, decade);
      if ((digit == 1 || between) && value >= low_ * (1 - 1e-9) && value <= high_ * (1 + 1e-9))
        ticks.push_back({value, value >= 1e6 || value < 1e-4 ? scientific(value, 0)
                                                             : plain(value, std::max(0, static_cast<int>(-decade)))});
    }
  constexpr std::size_t fewest = 3;
  return ticks.size() < fewest ? linear_ticks(wanted) : ticks;  // a piece of a decade reads like a straight axis
}

double round_down(double value) {
  const double decade = std::pow(10, std::floor(std::log10(value)));
  for (const double digit : {5.0, 2.0})
    if (digit * decade <= value * (1 + 1e-9)) return digit * decade;
  return decade;
}

std::string scientific(double value, int decimals) {
  if (value == 0) return "0";
  char text[64];
  std::snprintf(text, sizeof text, "%.*e", std::clamp(decimals, 0, 15), value);
  const std::string all(text);
  const auto e = all.find('e');
  auto mantissa = all.substr(0, e);
  if (mantissa.find('.') != mantissa.npos) mantissa.erase(mantissa.find_last_not_of('0') + 1);
  if (mantissa.back() == '.') mantissa.pop_back();
  return mantissa + "e" + std::to_string(std::stoi(all.substr(e + 1)));
}

std::string plain(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value == 0 ? 0 : value);  // no "-0"
  std::string digits(text);
  if (digits.find('.') != digits.npos) digits.erase(digits.find_last_not_of('0') + 1);
  if (!digits.empty() && digits.back() == '.') digits.pop_back();
  return digits == "-0" ? "0" : digits;
}

}  // namespace plot
