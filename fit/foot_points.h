// Samples find their place on the curve anew: the nearest point along it, by Gauss-Newton steps.
#pragma once

#include <vector>

#include "base/cancel.h"
#include "fit/target.h"

namespace ifsm::core {

// Parameters at which no sample is farther from the polyline than before; the polyline is the curve's places, one a
// row. They never change places: each moves less than the way to its neighbour, forwards from the first sample on, then
// backwards from the last, so that a whole row can move along in one call. The first stays, and an open curve's last.
std::vector<double> foot_points(const Target& target, const std::vector<double>& before, const Lanes& polyline,
                                const Watch& watch);

}  // namespace ifsm::core
