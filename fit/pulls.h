// What draws a sketch to the curve that it tells: for each place of its finest line the point to meet, and how far that
// is. The largest of them is the distance that the sketch is judged by.
#pragma once

#include "curve/resolve.h"
#include "measure/distance.h"

namespace ifsm::core {

struct Pulls {
  Points target;
  Eigen::VectorXd distance;  // what counts of it; 0 where nothing pulls
  double largest;
};

// Distance::largest: places are drawn to their samples; those between samples count less (resolve.h).
// Distance::hausdorff: to the nearest point of the samples' polyline, so that sliding along the curve costs nothing;
// and where a sample is farther from the sketch than its nearest place is from the samples, that place moves as the
// sample asks, lest capes be cut off. Middles of edges ask as well.
class PullingCurve {
 public:
  // `model` is joined.
  PullingCurve(const Model& model, Distance distance, const Watch& watch);

  Pulls pulls(const Points& line) const;

  // The curve's own finest line, and what counts of each place's distance.
  const Points& data() const { return data_; }
  const Eigen::VectorXd& counted() const { return counted_; }

 private:
  Pulls to_samples(const Points& line) const;
  Pulls to_polyline(const Points& line) const;

  Distance distance_;
  const Watch& watch_;
  bool closed_;
  Points data_;
  Eigen::VectorXd counted_;
  Polyline polyline_;
  Points asked_;  // its points, and the middles of its edges
};

}  // namespace ifsm::core
