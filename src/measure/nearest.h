// The point of a polyline that is nearest to a given one.
#pragma once

#include <vector>

#include "base/cancel.h"
#include "measure/polyline.h"

namespace ifsm::core {

struct Nearest {
  std::vector<double> parameters;
  std::vector<double> distances;  // in the samples' units
  Points points;                  // of the curve
};

// For each query, in the samples' units. Of points equally near the one of the smallest parameter: what comparing with
// all segments, in their order, finds, to the bit. A tree of boxes, queries shared among the threads,
// all of which poll.
Nearest nearest(const Polyline& polyline, const Points& queries, const Watch& watch = {});

// The same by comparing with all segments: what the tree is tested against.
namespace plain {
Nearest nearest(const Polyline& polyline, const Points& queries);
}  // namespace plain

}  // namespace ifsm::core
