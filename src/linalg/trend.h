// A straight line through points, by least squares: what slopes on double logarithmic paper are read from.
#pragma once

#include <span>

namespace ifsm::core {

struct Trend {
  double slope, intercept;
  double standard_error;  // of the slope, from the residuals; needs three points
  double r_squared;       // the share of y's variance that the line explains; 1 when y does not vary
};

// y over x: at least three points, x not all the same.
Trend trend(std::span<const double> x, std::span<const double> y);

}  // namespace ifsm::core
