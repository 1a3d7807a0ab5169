#include "curve/resolve.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "curve/conjugate.h"
#include "curve/scale.h"

namespace ifsm::core {
namespace {

constexpr int pursuit_trials = 30;

// What the samples still miss: corrections are solved for, so that what they leave open stays as it is.
Points missing(const Model& model, const Model& sketch) {
  Points missing = line(model, model.levels());
  missing.matrix() -= line(sketch, sketch.levels()).matrix();
  return missing;
}

ModelPtr corrected(const Model& sketch, const Kept& kept, const Solution& correction) {
  ModelParts parts = sketch.parts();
  parts.polygon.matrix() += correction.control;
  close_ends(parts);
  auto flag = kept.begin();
  Index value = 0;
  for (auto& level : parts.details) {
    auto details = std::make_shared<Points>(*level);
    for (Index i = 0; i < details->count(); ++i)
      if (*flag++) details->matrix().row(i) += correction.values.row(value++);
    level = std::move(details);
  }
  return std::make_shared<Model>(std::move(parts));
}

TreeSolver solver_of(const Model& model) {
  return {model.shape(), model.levels(), model.closed(), place_weights(model)};
}

}  // namespace

Eigen::VectorXd counted_distances(const Model& model) {
  Eigen::VectorXd counted = Eigen::VectorXd::Zero(model.shape().line_length(model.levels()));
  counted.head(model.placement().places()).setConstant(between_samples);
  for (Index k = 0; k < model.placement().samples(); ++k) counted(model.placement().place(k)) = 1;
  return counted;
}

Eigen::VectorXd place_weights(const Model& model) { return counted_distances(model).cwiseAbs2(); }

Eigen::VectorXd sample_weights(const Model& model) { return (counted_distances(model).array() == 1).cast<double>(); }

ModelPtr resolve(const Model& model, const Kept& kept, const Watch& watch) {
  if (const int exponent = exponent_to_remove(model.parts().diagonal))
    return scaled(*resolve(*scaled(model, -exponent), kept, watch), exponent);
  const ModelPtr sketch = keep(model, kept);
  if (!model.shape().joined()) return conjugate_resolve(model, *sketch, kept, watch);
  TreeSolver solver = solver_of(model);
  solver.factor(model.filter().matrix(), kept, watch);
  // Twice: the second time it solves for what rounding in the factors left over.
  const ModelPtr once = corrected(*sketch, kept, solver.solve(missing(model, *sketch), watch));
  return corrected(*once, kept, solver.solve(missing(model, *once), watch));
}

ModelPtr resolve_choice(const Model& model, const Kept& kept, const Watch& watch) {
  if (!model.shape().joined()) return resolve(model, kept, watch);
  if (const int exponent = exponent_to_remove(model.parts().diagonal))
    return scaled(*resolve_choice(*scaled(model, -exponent), kept, watch), exponent);
  TreeSolver solver = solver_of(model);
  const Points data = line(model, model.levels());
  const RowMatrix& filter = model.filter().matrix();
  const Choice choice = best_choice(solver, filter, kept, data, pursuit_trials, watch);
  return resolve(model, choice.kept, watch);
}

ModelPtr solved_model(ModelParts parts, const std::vector<PointsPtr>& zeros, const Kept& kept,
                      const Solution& solution) {
  parts.polygon.matrix() = solution.control;
  close_ends(parts);
  parts.details.clear();
  auto flag = kept.begin();
  Index value = 0;
  for (const PointsPtr& zero : zeros) {
    const auto end = flag + zero->count();
    if (std::find(flag, end, char{1}) == end) {
      parts.details.push_back(zero);
      flag = end;
      continue;
    }
    auto details = std::make_shared<Points>(zero->dimension(), zero->count());
    for (Index i = 0; flag != end; ++i)
      if (*flag++) details->matrix().row(i) = solution.values.row(value++);
    parts.details.push_back(std::move(details));
  }
  return std::make_shared<Model>(std::move(parts));
}

Choice solved(TreeSolver& solver, const RowMatrix& filter, const Kept& kept, const Points& data, const Watch& watch) {
  solver.factor(filter, kept, watch);
  Solution solution = solver.solve(data, watch);
  const double squared_error = solver.squared_error(data, solution, watch);
  return {kept, std::move(solution), squared_error};
}

Choice pursued(TreeSolver& solver, const RowMatrix& filter, const Choice& start, const Points& data, int trials,
               const Watch& watch) {
  constexpr double better = 1 - 1e-9;
  const auto count = static_cast<Index>(std::ranges::count(start.kept, char{1}));
  const auto all = static_cast<Index>(start.kept.size());
  // solver holds the factors of the last solved choice: `best` at first. `start` may have been solved under another
  // filter.
  Choice best = solved(solver, filter, start.kept, data, watch);
  if (count == 0 || count == all) return best;
  std::vector<double> scores = solver.scores(data, best.solution, watch);
  Index step = std::max<Index>(1, count / 4);
  for (int trial = 0; trial < trials && step > 0; ++trial) {
    std::vector<double> wish = scores;
    for (std::size_t i = 0; i < wish.size(); ++i)
      if (best.kept[i]) wish[i] = std::numeric_limits<double>::infinity();
    const Choice more = solved(solver, filter, largest(wish, std::min(count + step, all)), data, watch);
    std::vector<double> worth = solver.scores(data, more.solution, watch);
    for (std::size_t i = 0; i < worth.size(); ++i)
      if (!more.kept[i]) worth[i] = -1;
    Choice next = solved(solver, filter, largest(worth, count), data, watch);
    if (next.squared_error < better * best.squared_error) {
      scores = solver.scores(data, next.solution, watch);
      best = std::move(next);
    } else {
      step /= 2;
    }
  }
  return best;
}

Choice gathered(TreeSolver& solver, const RowMatrix& filter, Index count, const Points& data, const Watch& watch) {
  constexpr Index batches = 12;
  const auto all = static_cast<std::size_t>(solver.details());
  Choice choice = solved(solver, filter, Kept(all, char{0}), data, watch);
  for (Index batch = 1; batch <= batches; ++batch) {
    std::vector<double> wish = solver.scores(data, choice.solution, watch);
    for (std::size_t i = 0; i < all; ++i)
      if (choice.kept[i]) wish[i] = std::numeric_limits<double>::infinity();
    choice = solved(solver, filter, largest(wish, count * batch / batches), data, watch);
  }
  return choice;
}

Choice best_choice(TreeSolver& solver, const RowMatrix& filter, const Kept& kept, const Points& data, int trials,
                   const Watch& watch) {
  const auto count = static_cast<Index>(std::ranges::count(kept, char{1}));
  Choice given = pursued(solver, filter, solved(solver, filter, kept, data, watch), data, trials, watch);
  Choice fresh = pursued(solver, filter, gathered(solver, filter, count, data, watch), data, trials, watch);
  return fresh.squared_error < given.squared_error ? fresh : given;
}

}  // namespace ifsm::core
