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
  std::vector<FitCurve> curves;  // none when all are near it already
  std::vector<int> exponents;    // what to put back
  bool any = false;              // not all are zero
};
inline ScaledCurves near_unit_size(const std::vector<FitCurve>& curves) {
  ScaledCurves result;
  for (const FitCurve& curve : curves) {
    const int exponent = exponent_to_remove(diagonal(curve.samples));
    result.exponents.push_back(exponent);
    result.any = result.any || exponent != 0;
  }
  for (std::size_t c = 0; result.any && c < curves.size(); ++c) {
    const int exponent = result.exponents[c];
    result.curves.push_back(exponent == 0 ? curves[c]
                                          : FitCurve{scaled(curves[c].samples, -exponent), curves[c].closed});
  }
  return result;
}

}  // namespace ifsm::core
