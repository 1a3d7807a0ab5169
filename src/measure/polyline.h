// What every question is asked of: the polyline through the finest places of a model.
#pragma once

#include <vector>

#include "curve/model.h"

namespace ifsm::core {

// The finest places in the samples' coordinates, each once (of a joined ring points() repeats the first at the end).
Points places(const Model& model);

// Points and the straight segments between them, point by point, in units of a power of two that makes the largest
// coordinate 1 … 2: dividing by it rounds nothing, and squares neither overflow nor vanish.
class Polyline {
 public:
  // The points that points(model, levels) gives, told once: parameters are the model's.
  explicit Polyline(const Model& model);
  Polyline(const Points& points, bool closed);

  Index dimension() const { return dimension_; }
  bool closed() const { return closed_; }
  Index count() const { return count_; }
  // Segment k runs from point k to point k + 1; a ring's last one to point 0. A single point has none.
  Index segments() const { return segments_; }

  const double* start(Index segment) const { return values_.data() + segment * dimension_; }
  const double* end(Index segment) const { return start(segment + 1 < count_ ? segment + 1 : 0); }

  double unit() const { return unit_; }
  double diagonal() const { return diagonal_; }  // of the bounding box, in units

  // What lies `within` (0 … 1) a segment. A ring's end is its beginning.
  double parameter(Index segment, double within) const;
  // And back, in segments: 0 … segments(). A ring's is below that.
  double position(double parameter) const { return placement_.position(parameter); }

  double length(Index segment) const;  // in units

 private:
  Index dimension_;
  bool closed_;
  Index count_;
  Index segments_;
  double unit_;
  double diagonal_;
  std::vector<double> values_;
  Placement placement_;
};

// Parameters are finite and, on an open curve, 0 … 1; else an error that names the first bad one.
void require_parameters(bool closed, const double* parameters, Index count, const char* argument);

// An answer in the samples' units, or a numerical error when it has left the range of doubles.
double in_samples_units(double value, double unit, const char* what);

}  // namespace ifsm::core
