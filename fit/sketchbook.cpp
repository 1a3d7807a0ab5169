#include "fit/sketchbook.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/parallel.h"
#include "fit/projection.h"
#include "fit/sparsity.h"

namespace ifsm::core {
namespace {

constexpr double scale_of_error = 0.5;  // ε over the root of squared error per kept value

}  // namespace

Sketchbook::Job::Job(const Model& start)
    : line(core::line(start, start.levels())),
      levels(start.levels()),
      blank(start.parts()),
      placement(start.placement()),
      solver(start.shape(), start.levels(), start.closed(), place_weights(start)) {
  blank.details.clear();
}

Sketchbook::Sketchbook(const std::vector<FitCurve>& curves, FilterPtr start, std::vector<std::vector<Index>> budgets,
                       const Limits& limits, const Watch& watch)
    : curves_(curves), start_(std::move(start)), budgets_(std::move(budgets)), limits_(limits), watch_(watch) {
  jobs_.reserve(curves_.size());  // their lines are pointed to
  for (std::size_t c = 0; c < curves_.size(); ++c) {
    const ModelPtr exact = model(c, start_);
    const Job& job = jobs_.emplace_back(*exact);
    neighbourhoods_.push_back(Neighbourhood::of(*exact, job.line, limits_.reach));
  }
}

template <class Body>
void Sketchbook::each_curve(const Body& body) {
  parallel_for(static_cast<Index>(jobs_.size()), 0, [&](Index c) { body(static_cast<std::size_t>(c)); });
}

ModelPtr Sketchbook::model(std::size_t curve, const FilterPtr& filter) const {
  return analyze(filter, curves_[curve].samples, curves_[curve].closed);
}

Sketches Sketchbook::most_significant(const RowMatrix& matrix) {
  const auto filter = std::make_shared<Filter>(shape(), matrix);
  Sketches sketches{matrix, std::vector<std::vector<Choice>>(curves())};
  each_curve([&](std::size_t c) {
    const ModelPtr exact = model(c, filter);
    for (const Index budget : budgets_[c])
      sketches.choices[c].push_back(
          solved(jobs_[c].solver, matrix, core::most_significant(*exact, details(budget)), jobs_[c].line, watch_));
  });
  return sketches;
}

Sketches Sketchbook::best(const RowMatrix& matrix, int trials) {
  Sketches sketches = most_significant(matrix);
  each_curve([&](std::size_t c) {
    for (Choice& choice : sketches.choices[c])
      choice = best_choice(jobs_[c].solver, matrix, choice.kept, jobs_[c].line, trials, watch_);
  });
  return sketches;
}

void Sketchbook::pursue(Sketches& sketches, int trials) {
  each_curve([&](std::size_t c) {
    for (Choice& choice : sketches.choices[c])
      choice = pursued(jobs_[c].solver, sketches.matrix, choice, jobs_[c].line, trials, watch_);
  });
}

// A squared error that is nothing but rounding: models promise 1e-12 of the diagonal at each sample.
double Sketchbook::rounding(const Job& job) const {
  const double of_a_sample = 1e-12 * job.blank.diagonal;
  return static_cast<double>(job.placement.samples()) * of_a_sample * of_a_sample;
}

double Sketchbook::judged(const Sketches& sketches) const {
  double sum = 0;
  for (std::size_t c = 0; c < curves(); ++c) {
    const double least = std::max(rounding(jobs_[c]), 1e-300);
    for (const Choice& choice : sketches.choices[c]) sum += std::log(std::max(choice.squared_error, least));
  }
  return sum;
}

double Sketchbook::squared_at_samples(Job& job, const RowMatrix& matrix, const Choice& choice) {
  job.solver.factor(matrix, choice.kept, watch_);
  const Points curve = job.solver.curve(choice.solution, watch_);
  double sum = 0;
  for (Index k = 0; k < job.placement.samples(); ++k) {
    const Index place = job.placement.place(k);
    sum += (curve.matrix().row(place) - job.line.matrix().row(place)).squaredNorm();
  }
  return sum;
}

bool Sketchbook::is_anywhere_worse(const Sketches& sketches, const Sketches& others, double part) {
  for (std::size_t c = 0; c < curves(); ++c)
    for (std::size_t b = 0; b < budgets_[c].size(); ++b) {
      const double own = squared_at_samples(jobs_[c], sketches.matrix, sketches.choices[c][b]);
      const double other = squared_at_samples(jobs_[c], others.matrix, others.choices[c][b]);
      if (own > std::max(part * other, rounding(jobs_[c]))) return true;
    }
  return false;
}

// ε follows the error: half of it, for each value that is kept.
double Sketchbook::scale(const Job& job, double squared_error, Index budget) const {
  const Placement& placement = job.placement;
  const double density = static_cast<double>(placement.places()) / static_cast<double>(placement.samples());
  const double least = 1e-12 * job.blank.diagonal;  // a curve without error has no scale of its own
  return std::max(scale_of_error * std::sqrt(squared_error * density / static_cast<double>(budget)),
                  std::max(least, 1e-150));
}

Minimised Sketchbook::made_sparse(const Sketches& plain, const MinimiseOptions& options, Watch watch) {
  std::vector<SparseCurve> scaled;
  for (std::size_t c = 0; c < curves(); ++c) {
    SparseCurve& curve = scaled.emplace_back(SparseCurve{&jobs_[c].line, jobs_[c].levels, {}});
    for (std::size_t b = 0; b < budgets_[c].size(); ++b)
      curve.scales.push_back(scale(jobs_[c], plain.choices[c][b].squared_error, budgets_[c][b]));
  }
  Sparsity objective(shape(), std::move(scaled), watch_);
  return minimise(shape(), objective, plain.matrix, options, std::move(watch));
}

// One over the squared error, so that curves and budgets of all sizes count alike; but a curve that is nearly straight,
// told far better than others by as many vectors, must not hold the filter where it is.
std::vector<std::vector<double>> Sketchbook::weights(const Sketches& sketches) const {
  constexpr double share = 0.1;  // of the median error, added: a third of its RMS
  const auto scale = [&](std::size_t c) {
    const double diagonal = jobs_[c].blank.diagonal;
    return diagonal > 0 ? diagonal * diagonal * static_cast<double>(curves_[c].samples.count()) : 1;
  };
  std::map<Index, std::vector<double>> errors;  // of a budget, relative to the curves' sizes
  for (std::size_t c = 0; c < curves(); ++c)
    for (std::size_t b = 0; b < budgets_[c].size(); ++b)
      errors[budgets_[c][b]].push_back(sketches.choices[c][b].squared_error / scale(c));
  for (auto& [budget, all] : errors) std::ranges::sort(all);
  std::vector<std::vector<double>> weights(curves());
  for (std::size_t c = 0; c < curves(); ++c)
    for (std::size_t b = 0; b < budgets_[c].size(); ++b) {
      const auto& all = errors[budgets_[c][b]];
      weights[c].push_back(1 / (sketches.choices[c][b].squared_error + share * all[all.size() / 2] * scale(c)));
    }
  return weights;
}

Minimised Sketchbook::polished(const Sketches& sketches, const MinimiseOptions& options, Watch watch) {
  std::vector<ProjectedSketch> held;
  const auto weight = weights(sketches);
  for (std::size_t c = 0; c < curves(); ++c)
    for (std::size_t b = 0; b < budgets_[c].size(); ++b)
      if (const Choice& choice = sketches.choices[c][b]; choice.squared_error > rounding(jobs_[c]))
        held.push_back({&jobs_[c].solver, &jobs_[c].line, jobs_[c].levels, choice.kept, weight[c][b]});
  Projection objective(shape(), std::move(held), watch_);
  return minimise(shape(), objective, sketches.matrix, options, std::move(watch));
}

MinimiseOptions Sketchbook::options(int iterations, double tolerance, const char* stage) const {
  return {iterations, tolerance, std::max(limits_.condition, 2 * start_->condition()), stage,
          [this](const RowMatrix& matrix) { return stay_near(shape(), matrix, neighbourhoods_); }};
}

}  // namespace ifsm::core
