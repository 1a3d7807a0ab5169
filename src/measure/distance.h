// How far two curves are from each other.
#pragma once

#include "base/cancel.h"
#include "measure/polyline.h"

namespace ifsm::core {

enum class Distance : std::int32_t {
  rms = 0,      // root of the mean square between samples of the same number
  largest = 1,  // the largest between them
  hausdorff =
      2,  // between the polylines through the finest places, edges and all: the farthest that one is from the other
};

struct Distances {
  double rms;
  double largest;
  Index farthest;  // the sample that is `largest` away, the first of them
  double hausdorff;
};

// In the samples' units. A shape error unless dimensions agree and, but for Hausdorff, numbers of samples. Hausdorff
// distances are found to a millionth. A numerical error when no double holds a distance.
Distances distances(const Model& model, const Model& other);
double distance(const Model& model, const Model& other, Distance which, const Watch& watch = {});

}  // namespace ifsm::core
