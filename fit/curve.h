// What a fit is given: ordered samples.
#pragma once

#include <vector>

#include "curve/scale.h"

namespace ifsm::core {

struct FitCurve {
  Points samples;
  bool closed = false;
};

// Curves far from unit size, brought near it by powers of two; the others as they are.
struct ScaledCurves {
  std::vector<FitCurve> curves;
  std::vector<int> exponents;  // what to put back
  bool any = false;            // not all are zero
};
inline ScaledCurves near_unit_size(const std::vector<FitCurve>& curves) {
  ScaledCurves result;
  for (const FitCurve& curve : curves) {
    const int exponent = exponent_to_remove(diagonal(curve.samples));
    result.exponents.push_back(exponent);
    result.any = result.any || exponent != 0;
    result.curves.push_back(exponent == 0 ? curve : FitCurve{scaled(curve.samples, -exponent), curve.closed});
  }
  return result;
}

}  // namespace ifsm::core
