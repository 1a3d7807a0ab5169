// The squared error of solved sketches as a function of R alone (variable projection): the details that are kept stay
// the same ones, their values and the control points follow R by least squares. This is what paper 002 asks for in
// words: a small amount of detail data as close as possible to the given curve.
#pragma once

#include <vector>

#include "base/cancel.h"
#include "curve/resolve.h"
#include "fit/objective.h"
#include "fit/parameters.h"

namespace ifsm::core {

// One sketch of one curve; its squared error counts by `weight`.
struct ProjectedSketch {
  TreeSolver* solver;
  const Points* data;  // the finest line
  int levels;
  Kept kept;
  double weight;
};

class Projection : public Objective {
 public:
  // Sketches that share a solver stand side by side; those of different solvers share the threads.
  Projection(const Shape& shape, std::vector<ProjectedSketch> sketches, const Watch& watch);
  Projection(const Projection&) = delete;
  Projection& operator=(const Projection&) = delete;

  double value(const RowMatrix& matrix) override;
  // Kaufman's Jacobian, as JᵀJ and Jᵀr: the tangent of the synthesis at fixed values, less what solving again takes
  // back of it.
  void gather(const RowMatrix& matrix, Normal& normal) override;

 private:
  template <class Body>
  void each_group(const Body& body) const;

  Shape shape_;
  std::vector<ProjectedSketch> sketches_;
  std::vector<std::vector<const ProjectedSketch*>> groups_;
  const Watch& watch_;
  std::vector<FreeEntry> entries_;
};

}  // namespace ifsm::core
