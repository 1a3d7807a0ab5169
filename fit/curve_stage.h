// Stage *curve*: the control points, and T, whose curve without details comes nearest to the samples (paper 002,
// section 4, step 1).
#pragma once

#include <vector>

#include "base/cancel.h"
#include "fit/target.h"

namespace ifsm::core {

struct CurveOptions {
  FilterPtr start;  // joined; null: de Casteljau's of the shape below
  int control_points = 5;
  int maps = 2;
  bool fixed_filter = false;  // control points alone move
  ParameterRule parameters = ParameterRule::index;
  int reparameterise = 0;  // rounds in which samples find their places anew
  Loss loss;
  int levels = 0;                   // 0: as many as give every sample a place
  int starts = 2;                   // 1: from the start alone; 2: and coarse to fine; 3: and from the polygons' collage
  int iterations = 40;              // of Levenberg-Marquardt, a start
  double tolerance = 1e-9;          // relative fall of the objective at which it stops
  std::vector<FitSamples> samples;  // one a curve, or none
};

// Never above its start by the objective: the sum of the loss over samples. The start: control points by plain least
// squares under the starting filter.
FitResult fit_curve(const std::vector<FitCurve>& curves, const CurveOptions& options, Watch& watch);

}  // namespace ifsm::core
