// Robust losses: what a squared residual s costs. All are s near zero, concave, and flatter far out, so the tangent at
// any s lies above the loss: samples weighted by the slopes are a problem whose fall is a fall of the loss as well.
#pragma once

#include <cstdint>

namespace ifsm::core {

enum class LossKind : std::int32_t { squares = 0, huber = 1, cauchy = 2, tukey = 3 };

struct Loss {
  LossKind kind = LossKind::squares;
  double scale = 1;  // the residual at which outliers begin

  struct Value {
    double rho;
    double slope;  // of rho by s: the weight of the sample
  };
  Value operator()(double s) const;

  bool robust() const { return kind != LossKind::squares; }
};

}  // namespace ifsm::core
