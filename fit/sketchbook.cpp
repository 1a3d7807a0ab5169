#include "fit/sketchbook.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "base/parallel.h"
#include "curve/transform.h"
#include "fit/projection.h"
#include "fit/sparsity.h"

namespace ifsm::core {
namespace {

constexpr double scale_of_error = 0.5;  // ε over the root of squared error per kept value

double largest_coordinate(std::span<const double> line) {
  double largest = 0;
  for (const double value : line) largest = std::max(largest, std::abs(value));
  return largest;
}

// Of all levels, from the centre; infinite when a coordinate is not finite.
double largest_polygon(const Shape& shape, const RowMatrix& inverse, const Points& line, int levels) {
  double largest = 0;
  for (Index axis = 0; axis < line.dimension(); ++axis) {
    std::vector<double> fine(line.plane(axis).begin(), line.plane(axis).end());
    for (int level = levels - 1; level >= 0; --level) {
      std::vector<double> coarse(static_cast<std::size_t>(shape.line_length(level)));
      coarsen_level(shape, inverse, fine, coarse);
      largest = std::max(largest, largest_coordinate(coarse));
      fine.swap(coarse);
    }
  }
  return std::isfinite(largest) ? largest : std::numeric_limits<double>::infinity();
}

}  // namespace

Sketchbook::Job::Job(ModelPtr model)
    : start(std::move(model)),
      line(core::line(*start, start->levels())),
      data(lanes_of(line)),
      solver(start->shape(), start->levels(), start->closed(), sample_weights(*start)) {}

Sketchbook::Sketchbook(const std::vector<FitCurve>& curves, FilterPtr start, std::vector<std::vector<Index>> budgets,
                       const Limits& limits, const Watch& watch)
    : curves_(curves), start_(std::move(start)), budgets_(std::move(budgets)), limits_(limits), watch_(watch) {
  for (const FitCurve& curve : curves_) jobs_.emplace_back(analyze(start_, curve.samples, curve.closed));
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
          solved(jobs_[c].solver, matrix, core::most_significant(*exact, details(budget)), jobs_[c].data, watch_));
  });
  return sketches;
}

Sketches Sketchbook::best(const RowMatrix& matrix, int trials) {
  Sketches sketches = most_significant(matrix);
  each_curve([&](std::size_t c) {
    for (Choice& choice : sketches.choices[c])
      choice = best_choice(jobs_[c].solver, matrix, choice.kept, jobs_[c].data, trials, watch_);
  });
  return sketches;
}

void Sketchbook::pursue(Sketches& sketches, int trials) {
  each_curve([&](std::size_t c) {
    for (Choice& choice : sketches.choices[c])
      choice = pursued(jobs_[c].solver, sketches.matrix, std::move(choice), jobs_[c].data, trials, watch_);
  });
}

double Sketchbook::judged(const Sketches& sketches) {
  double sum = 0;
  for (const auto& row : sketches.choices)
    for (const Choice& choice : row) sum += std::log(std::max(choice.squared_error, 1e-300));
  return sum;
}

// ε follows the error: half of it, for each value that is kept.
double Sketchbook::scale(const Job& job, double squared_error, Index budget) const {
  const Placement& placement = job.start->placement();
  const double density = static_cast<double>(placement.places()) / static_cast<double>(placement.samples());
  const double least = 1e-12 * job.start->parts().diagonal;  // a curve without error has no scale of its own
  return std::max(scale_of_error * std::sqrt(squared_error * density / static_cast<double>(budget)),
                  std::max(least, 1e-150));
}

Minimised Sketchbook::made_sparse(const Sketches& plain, const MinimiseOptions& options, Watch watch) {
  std::vector<SparseCurve> scaled;
  for (std::size_t c = 0; c < curves(); ++c) {
    SparseCurve& curve = scaled.emplace_back(SparseCurve{&jobs_[c].line, jobs_[c].start->levels(), {}});
    for (std::size_t b = 0; b < budgets_[c].size(); ++b)
      curve.scales.push_back(scale(jobs_[c], plain.choices[c][b].squared_error, budgets_[c][b]));
  }
  Sparsity objective(shape(), std::move(scaled), watch_);
  return minimise(shape(), objective, plain.matrix, options, std::move(watch));
}

Minimised Sketchbook::polished(const Sketches& sketches, const MinimiseOptions& options, Watch watch) {
  std::vector<ProjectedSketch> held;
  for (std::size_t c = 0; c < curves(); ++c)
    for (const Choice& choice : sketches.choices[c])
      if (choice.squared_error > 0)
        held.push_back(
            {&jobs_[c].solver, &jobs_[c].data, jobs_[c].start->levels(), choice.kept, 1 / choice.squared_error});
  Projection objective(shape(), std::move(held), watch_);
  return minimise(shape(), objective, sketches.matrix, options, std::move(watch));
}

// Coarse polygons that leave the curve's neighbourhood grow from level to level: R^-1 is bounded, its powers are not.
bool Sketchbook::stays_near(const RowMatrix& matrix) const {
  const RowMatrix inverse = inverse_of(shape(), matrix);
  return std::ranges::all_of(jobs_, [&](const Job& job) {
    return largest_polygon(shape(), inverse, job.line, job.start->levels()) <=
           std::max(limits_.reach * job.start->parts().diagonal, 2 * job.start->parts().largest_polygon);
  });
}

MinimiseOptions Sketchbook::options(int iterations, double tolerance, const char* stage) const {
  return {iterations, tolerance, std::max(limits_.condition, 2 * start_->condition()), stage,
          [this](const RowMatrix& matrix) { return stays_near(matrix); }};
}

}  // namespace ifsm::core
