// Curves that share a filter, and for each of them and each budget the nearest sketch that is known under the filter
// at hand: what fits of the filter work on.
#pragma once

#include <vector>

#include "base/cancel.h"
#include "curve/resolve.h"
#include "fit/curve.h"
#include "fit/minimise.h"
#include "fit/region.h"

namespace ifsm::core {

// R, and the best choice of details known under it, [curve][budget].
struct Sketches {
  RowMatrix matrix;
  std::vector<std::vector<Choice>> choices;
};

class Sketchbook {
 public:
  // Budgets, a list for each curve, count control points and details. `curves` and `watch` are borrowed.
  Sketchbook(const std::vector<FitCurve>& curves, FilterPtr start, std::vector<std::vector<Index>> budgets,
             const Limits& limits, const Watch& watch);

  const Shape& shape() const { return start_->shape(); }
  const FilterPtr& start() const { return start_; }
  std::size_t curves() const { return jobs_.size(); }
  const std::vector<Index>& budgets(std::size_t curve) const { return budgets_[curve]; }
  Index details(Index budget) const { return budget - shape().control_points(); }
  // What all models of a curve have in common: parts without details.
  const ModelParts& blank(std::size_t curve) const { return jobs_[curve].blank; }
  // The exact model of a curve under any filter.
  ModelPtr model(std::size_t curve, const FilterPtr& filter) const;

  // The most significant details, solved.
  Sketches most_significant(const RowMatrix& matrix);
  // The best choices that are found from those, or from none.
  Sketches best(const RowMatrix& matrix, int trials);
  // Choices bettered under the filter that is there now.
  void pursue(Sketches& sketches, int trials);

  // Σ log squared error: budgets and curves of all sizes count alike. Errors below rounding are all the same.
  double judged(const Sketches& sketches) const;
  // Is any sketch farther from its samples than the other of its curve and budget, and not by rounding? (`part`: than
  // that part of the other's squared error.) Places between samples, which solving counts a little, do not matter.
  bool is_anywhere_worse(const Sketches& sketches, const Sketches& others, double part = 1);

  // One minimisation of the sparsity objective, its scales following the errors of `plain`.
  Minimised made_sparse(const Sketches& plain, const MinimiseOptions& options, Watch watch);
  // One of the sketches' own errors, their choices held.
  Minimised polished(const Sketches& sketches, const MinimiseOptions& options, Watch watch);

  MinimiseOptions options(int iterations, double tolerance, const char* stage) const;

 private:
  // A curve with its tree, and what is solved on it again and again.
  struct Job {
    Points line;  // the finest line, from the centre: the same under every filter
    int levels;
    ModelParts blank;  // of the model under the starting filter, without its details
    Placement placement;
    TreeSolver solver;

    explicit Job(const Model& start);
  };

  // Calls body(curve) for every curve, curves sharing the threads.
  template <class Body>
  void each_curve(const Body& body);
  double scale(const Job& job, double squared_error, Index budget) const;
  double rounding(const Job& job) const;
  double squared_at_samples(Job& job, const RowMatrix& matrix, const Choice& choice);
  std::vector<std::vector<double>> weights(const Sketches& sketches) const;

  const std::vector<FitCurve>& curves_;
  FilterPtr start_;
  std::vector<std::vector<Index>> budgets_;
  Limits limits_;
  const Watch& watch_;
  std::vector<Job> jobs_;
  std::vector<Neighbourhood> neighbourhoods_;
};

}  // namespace ifsm::core
