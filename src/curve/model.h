// A detail model: a control polygon, a filter, and the details of a tree of nodes. Immutable.
#pragma once

#include <memory>
#include <vector>

#include "curve/filter.h"
#include "curve/placement.h"

namespace ifsm::core {

using PointsPtr = std::shared_ptr<const Points>;

// The parts, all of them; coordinates are from the centre, which is near the samples (map coordinates are large).
struct ModelParts {
  FilterPtr filter;
  bool closed = false;
  Index samples = 0;               // how many, at the places of the finest level
  std::vector<double> center;      // dimension doubles
  Points polygon;                  // n points
  std::vector<PointsPtr> details;  // a level each, coarsest first; details_per_node() points a node
  double diagonal = 0;             // of the samples' bounding box
  double largest_polygon = 0;      // largest coordinate of any polygon seen by the analysis, from the centre
};

class Model {
 public:
  explicit Model(ModelParts parts);

  const ModelParts& parts() const { return parts_; }
  const Filter& filter() const { return *parts_.filter; }
  const Shape& shape() const { return parts_.filter->shape(); }
  bool closed() const { return parts_.closed; }
  int levels() const { return static_cast<int>(parts_.details.size()); }
  Index dimension() const { return parts_.polygon.dimension(); }
  const Placement& placement() const { return placement_; }
  Index details_total() const { return details_total_; }
  Index details_kept() const { return details_kept_; }  // not zero

  const Points& details(int level) const { return *parts_.details[static_cast<std::size_t>(level)]; }

 private:
  ModelParts parts_;
  Placement placement_;
  Index details_total_;
  Index details_kept_;
};

using ModelPtr = std::shared_ptr<const Model>;

// The exact model of ordered samples, by analysis. levels 0: the smallest number with a place for every sample.
ModelPtr analyze(const FilterPtr& filter, const Points& samples, bool closed, int levels = 0);

// A model without details; its samples are its places.
ModelPtr from_polygon(const FilterPtr& filter, const Points& polygon, bool closed, int levels);

// Synthesis to a level, from the centre: all its polygons, one after the other.
Points line(const Model& model, int level);
// The same for any parts that fit the model's shape (its filter, polygon, details).
Points line(const ModelParts& parts, int level);

// A line as points: joined it is one already; square polygons are laid on their places, places read more than once
// averaged.
Points lay(const Shape& shape, bool closed, Points line, int level);
// And back: the line whose polygons read these points.
Points read(const Shape& shape, bool closed, Points points, int level);

// Points of a level, in the samples' coordinates (joined and closed: the last repeats the first).
Points points(const Model& model, int level);
// The curve at the samples.
Points samples(const Model& model);
// The control polygon in the samples' coordinates.
Points control_points(const Model& model);

// A closed joined polygon ends where it begins: to the bit, whatever solved for it.
void close_ends(ModelParts& parts);

// Adds the centre.
Points from_center(Points points, const std::vector<double>& center);
Points to_center(Points points, const std::vector<double>& center);

// New models. Frames: src/curve/frames.h.
ModelPtr with_filter(const Model& model, const FilterPtr& filter);

}  // namespace ifsm::core
