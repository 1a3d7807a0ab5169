// How a polyline bends when it is looked at through a window.
#pragma once

#include <span>
#include <vector>

#include "measure/polyline.h"

namespace ifsm::core {

// Curvature, 1 / samples' units, at each parameter, of the quadratic in arc length that comes nearest (least squares,
// each coordinate) to the arc within `scale` (samples' units, along the curve) on both sides; an open curve's ends cut
// the arc short. In the plane positive where the curve turns left; in space it has no sign.
//
// Of an arc of a circle of radius r it is (5/3) j2(w) / j1(w)² / r with w = scale / r (spherical Bessel functions, the
// projections of sine and cosine): 1/r · (1 + 0.13 w² + …). The integrals over the straight pieces are exact.
//
// Errors: a scale that is not positive, or above the curve's length (a ring's: half); a curve of one dimension; an arc
// without direction, as that of a point, or one that comes back (numerical, with the parameter's index).
std::vector<double> curvature(const Polyline& polyline, std::span<const double> parameters, double scale);

}  // namespace ifsm::core
