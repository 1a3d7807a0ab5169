#include "linalg/trend.h"

#include <cmath>
#include <cstddef>

namespace ifsm::core {

Trend trend(std::span<const double> x, std::span<const double> y) {
  const auto count = static_cast<double>(x.size());
  double mean_x = 0, mean_y = 0;
  for (std::size_t i = 0; i < x.size(); ++i) mean_x += x[i] / count, mean_y += y[i] / count;
  double xx = 0, xy = 0, yy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
    yy += (y[i] - mean_y) * (y[i] - mean_y);
  }
  Trend line{};
  line.slope = xy / xx;
  line.intercept = mean_y - line.slope * mean_x;
  double left = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double residual = y[i] - (line.intercept + line.slope * x[i]);
    left += residual * residual;
  }
  line.standard_error = std::sqrt(left / (count - 2) / xx);
  line.r_squared = yy > 0 ? 1 - left / yy : 1.0;
  return line;
}

}  // namespace ifsm::core
