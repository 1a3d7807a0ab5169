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
  return kind_ == Kind::Linear ? linear_ticks(wanted) : logarithmic_ticks();
}

std::vector<Tick> Scale::linear_ticks(int wanted) const {
  const double step = round_down((high_ - low_) / std::max(wanted, 1) * 1.6);
  const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step))));
  std::vector<Tick> ticks;
  for (double k = std::ceil(low_ / step); k * step <= high_ + 1e-9 * step; ++k)
    ticks.push_back({k * step, plain(k * step, decimals)});
  return ticks;
}

std::vector<Tick> Scale::logarithmic_ticks() const {
  const double decades = std::log10(high_ / low_);
  const bool between = decades <= 3.5;  // few decades: 2 and 5 are labelled as well
  std::vector<Tick> ticks;
  for (double decade = std::floor(std::log10(low_)); decade <= std::log10(high_); ++decade)
    for (const double digit : {1.0, 2.0, 5.0}) {
      const double value = digit * std::pow(10, decade);
      if ((digit == 1 || between) && value >= low_ * (1 - 1e-9) && value <= high_ * (1 + 1e-9))
        ticks.push_back({value, plain(value, std::max(0, static_cast<int>(-decade)))});
    }
  return ticks;
}

double round_down(double value) {
  const double decade = std::pow(10, std::floor(std::log10(value)));
  for (const double digit : {5.0, 2.0})
    if (digit * decade <= value * (1 + 1e-9)) return digit * decade;
  return decade;
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
