// Arc length along a polyline, and points equally far apart along it.
#pragma once

#include <vector>

#include "measure/polyline.h"

namespace ifsm::core {

class ArcLength {
 public:
  explicit ArcLength(const Polyline& polyline);

  double total() const { return at_point_.back(); }  // in units of the polyline, as everything here

  // From the curve's start to a parameter. A ring's parameters count its turns: 1.25 is once round and a quarter.
  double at(double parameter) const;
  // At point k; k = segments() is the end.
  double at_point(Index point) const { return at_point_[static_cast<std::size_t>(point)]; }
  // The smallest parameter at which that much lies behind; 0 … total().
  double parameter(double length) const;
  // The segment in which that is, and how far into it (0 … 1).
  struct Spot {
    Index segment;
    double within;
  };
  Spot spot(double length) const;

 private:
  const Polyline& polyline_;
  std::vector<double> at_point_;
};

// In the samples' units: from one parameter to another along growing parameters; negative the other way. So it adds up.
double length_between(const Polyline& polyline, double from, double to);

// Parameters of `count` points that cut the curve into pieces of equal length: both ends and between them on an open
// curve (one point: its start), once round from parameter 0 on a ring.
std::vector<double> equally_spaced(const Polyline& polyline, Index count);

// Parameters of points `spacing` (samples' units) apart, from the start on; what is left at the end is shorter.
// How many: an error when `spacing` is not positive, or so small that they are more than 2^40.
Index spaced_count(const Polyline& polyline, double spacing);
std::vector<double> spaced(const Polyline& polyline, double spacing);

}  // namespace ifsm::core
