// What stage *curve* works on: targets, and states that can be compared.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/curve_error.h"
#include "fit/curve_stage.h"
#include "fit/minimise.h"
#include "fit/region.h"

namespace ifsm::core {

// One way to tell the curves.
struct CurveState {
  RowMatrix matrix;
  std::vector<Lanes> controls;                  // from the centre
  std::vector<std::vector<double>> parameters;  // of the samples
  std::vector<std::vector<double>> squared;     // residuals of the samples, weighted; empty by plain squares
  double cost = 0;                              // of the loss that judged it
};

class CurveProblem {
 public:
  CurveProblem(const std::vector<FitCurve>& curves, const FilterPtr& start, const CurveOptions& options,
               const Watch& watch);

  const Shape& shape() const { return shape_; }
  int levels() const { return levels_; }
  int coarsest_level() const;
  const std::vector<Target>& targets() const { return targets_; }
  bool admits(const RowMatrix& matrix) const;
  MinimiseOptions minimise_options(const char* stage) const;

  // Control points by plain least squares, at the targets' parameters. None where constraints contradict each other:
  // three points on one leg, say, which more levels tell apart.
  std::optional<CurveState> state(const RowMatrix& matrix, const Loss& loss, int levels) const;
  // The same state with residuals and cost by another loss, or on another number of levels.
  CurveState judged(CurveState state, const Loss& loss, int levels) const;

  // The objective around a state: `loss` enters by its slopes there.
  CurveError error(const CurveState& state, const Loss& loss, int levels) const;
  // Samples find their places on the state's curve anew.
  void project(CurveState& state) const;

  double median_residual(const CurveState& state) const;
  // Distances between samples and the curve, unweighted.
  // zeros: a level each, of no details, which sketches share.
  Sketch sketch(std::size_t curve, const FilterPtr& filter, const CurveState& state,
                std::span<const PointsPtr> zeros) const;
  ModelPtr exact(std::size_t curve, const FilterPtr& filter) const;

 private:
  const std::vector<FitCurve>& curves_;
  Shape shape_;
  const Watch& watch_;
  int levels_ = 0;
  std::vector<ModelParts> blanks_;  // of the exact models under the start, without their details
  std::vector<Points> lines_;
  std::vector<Neighbourhood> neighbourhoods_;
  std::vector<Target> targets_;
  double condition_;
  double tolerance_;
};

}  // namespace ifsm::core
