#include "fit/loss.h"

#include <cmath>

namespace ifsm::core {

Loss::Value Loss::operator()(double s) const {
  const double a = scale * scale, q = s / a;
  switch (kind) {
    case LossKind::squares: break;
    case LossKind::huber:
      if (q <= 1) break;
      return {a * (2 * std::sqrt(q) - 1), 1 / std::sqrt(q)};
    case LossKind::cauchy: return {a * std::log1p(q), 1 / (1 + q)};
    case LossKind::tukey: {
      if (q > 1) return {a / 3, 0};
      const double rest = 1 - q;
      return {a * q * (1 - q + q * q / 3), rest * rest};  // a/3 (1 - rest³), without its cancellation
    }
  }
  return {s, 1};
}

}  // namespace ifsm::core
