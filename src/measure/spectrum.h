// How rough a curve is at each scale: the energy of its details, level by level.
#pragma once

#include <vector>

#include "curve/model.h"
#include "linalg/trend.h"

namespace ifsm::core {

struct Spectrum {
  // A level each, coarsest first.
  std::vector<double> scales;  // the share of the curve, in parameter, that a node spans: N^-level
  std::vector<double> rms;     // root mean square, over all places, of what the level's details do to the curve, in the
                               // samples' units: details times their gains
  // rms ~ scale^hurst, by least squares on the logarithms of the levels first … last that are above rounding. Fewer
  // than three: all three are not a number.
  int first, last;
  double hurst;
  double standard_error;
  double r_squared;
  // What the exponent implies, if rms really is a power of the scale. One dimension: 2 - H, of the graph over the
  // parameter. More: 1 / H, of the trail, if parameter runs as the trail's own measure does (samples equally far apart
  // along it). Within 1 … dimension of where it lies (the graph: 2).
  double dimension;
};

// Fits levels 2 … L - 2: the coarsest have few details, and the finest level's are cut off by the samples' own grid, or
// were filled in. Where those are fewer than three, all levels.
Spectrum spectrum(const Model& model);

}  // namespace ifsm::core
