// What a fit is given: ordered samples.
#pragma once

#include "linalg/points.h"

namespace ifsm::core {

struct FitCurve {
  Points samples;
  bool closed = false;
};

}  // namespace ifsm::core
