#include "fit/sparse.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "curve/named.h"
#include "curve/resolve.h"
#include "fit/minimise.h"
#include "fit/parameters.h"
#include "fit/projection.h"
#include "fit/region.h"
#include "fit/sparsity.h"

namespace ifsm::core {
namespace {

constexpr Index default_budget = 128;
constexpr int pursuit_trials = 12;  // while R still moves
constexpr int last_pursuit_trials = 30;
constexpr int polish_iterations = 10;  // the choice changes after them
constexpr double sparse_tolerance = 1e-6;
constexpr double polish_tolerance = 1e-4;
constexpr double scale_of_error = 0.5;  // ε over the root of squared error per kept value

// A curve with its tree, and what is solved on it again and again.
struct Job {
  ModelPtr start;  // the exact model under the starting filter
  Points line;     // its finest line, from the centre: the same under every filter
  Lanes data;
  TreeSolver solver;

  explicit Job(ModelPtr model)
      : start(std::move(model)),
        line(core::line(*start, start->levels())),
        data(lanes_of(line)),
        solver(start->shape(), start->levels(), start->closed(), sample_weights(*start)) {}
};

// The state of a fit: R, and for every curve and budget the best choice known under it.
struct State {
  RowMatrix matrix;
  std::vector<std::vector<Choice>> choices;  // [curve][budget]
};

class SparseFit {
 public:
  SparseFit(const std::vector<FitCurve>& curves, FilterPtr start, std::vector<Index> budgets, const FitOptions& options,
            Watch& watch)
      : curves_(curves),
        start_(std::move(start)),
        shape_(start_->shape()),
        budgets_(std::move(budgets)),
        options_(options),
        watch_(watch) {
    for (const FitCurve& curve : curves_) jobs_.emplace_back(analyze(start_, curve.samples, curve.closed));
    for (const Job& job : jobs_) neighbourhoods_.push_back(Neighbourhood::of(*job.start, job.line));
  }

  FitResult run() {
    const State start = start_state();
    State best = start;
    if (free_count(shape_) > 0) {
      // Two ways down: sparsity gathers the curve into few details and leads far from the start where the budget is
      // small; where it is large, the start is the better one to polish.
      State sparse = made_sparse(start, watch_.part(0.0, options_.polish_rounds > 0 ? 0.4 : 0.95));
      consider(sparse, start, best);
      consider(polished(std::move(sparse), watch_.part(0.4, 0.7)), start, best);
      consider(polished(start, watch_.part(0.7, 0.95)), start, best);
    }
    return result(start, best);
  }

 private:
  Index details(Index budget) const { return budget - shape_.control_points(); }

  MinimiseOptions minimise_options(int iterations, double tolerance, const char* stage) const {
    return {iterations, tolerance, std::max(most_condition, 2 * start_->condition()), stage,
            [this](const RowMatrix& matrix) { return stay_near(shape_, matrix, neighbourhoods_); }};
  }

  // Sums of logarithms of squared errors: budgets and curves of all sizes count alike.
  static double judged(const State& state) {
    double sum = 0;
    for (const auto& row : state.choices)
      for (const Choice& choice : row) sum += std::log(std::max(choice.squared_error, 1e-300));
    return sum;
  }

  void consider(const State& candidate, const State& start, State& best) const {
    for (std::size_t c = 0; c < jobs_.size(); ++c)
      for (std::size_t b = 0; b < budgets_.size(); ++b)
        if (candidate.choices[c][b].squared_error > start.choices[c][b].squared_error) return;
    if (judged(candidate) < judged(best)) best = candidate;
  }

  Choice most_significant_choice(Job& job, const FilterPtr& filter, Index budget) {
    const ModelPtr model = with_samples(job, filter);
    return solved(job.solver, filter->matrix(), most_significant(*model, details(budget)), job.data, watch_);
  }

  ModelPtr with_samples(const Job& job, const FilterPtr& filter) const {
    const auto c = static_cast<std::size_t>(&job - jobs_.data());
    return analyze(filter, curves_[c].samples, curves_[c].closed);
  }

  State chosen(const RowMatrix& matrix) {
    const auto filter = std::make_shared<Filter>(shape_, matrix);
    State state{matrix, {}};
    for (Job& job : jobs_) {
      auto& row = state.choices.emplace_back();
      for (const Index budget : budgets_) row.push_back(most_significant_choice(job, filter, budget));
    }
    return state;
  }

  void pursue(State& state, int trials) {
    for (std::size_t c = 0; c < jobs_.size(); ++c)
      for (Choice& choice : state.choices[c])
        choice = pursued(jobs_[c].solver, state.matrix, std::move(choice), jobs_[c].data, trials, watch_);
  }

  State start_state() {
    State state = chosen(start_->matrix());
    for (std::size_t c = 0; c < jobs_.size(); ++c)
      for (Choice& choice : state.choices[c])
        choice = best_choice(jobs_[c].solver, state.matrix, choice.kept, jobs_[c].data, last_pursuit_trials, watch_);
    return state;
  }

  // ε follows the error: half of it, for each value that is kept.
  std::vector<SparseCurve> scaled(const State& state) const {
    std::vector<SparseCurve> curves;
    for (std::size_t c = 0; c < jobs_.size(); ++c) {
      const Job& job = jobs_[c];
      const Placement& placement = job.start->placement();
      const double density = static_cast<double>(placement.places()) / static_cast<double>(placement.samples());
      SparseCurve curve{&job.line, job.start->levels(), {}};
      for (std::size_t b = 0; b < budgets_.size(); ++b) {
        const double error = state.choices[c][b].squared_error * density / static_cast<double>(budgets_[b]);
        const double least = 1e-12 * job.start->parts().diagonal;  // a curve without error has no scale of its own
        curve.scales.push_back(std::max(scale_of_error * std::sqrt(error), std::max(least, 1e-150)));
      }
      curves.push_back(std::move(curve));
    }
    return curves;
  }

  State made_sparse(const State& state, Watch watch) {
    // The scale of the first round is that of the plain choice: a bettered one would set it too low.
    State plain = chosen(state.matrix);
    for (int round = 0; round < options_.sparse_rounds; ++round) {
      Sparsity objective(shape_, scaled(plain), watch_);
      const Minimised found =
          minimise(shape_, objective, plain.matrix, minimise_options(options_.iterations, sparse_tolerance, "sparse"),
                   watch.part(static_cast<double>(round) / options_.sparse_rounds,
                              static_cast<double>(round + 1) / options_.sparse_rounds));
      count(found);
      start_cost_ = found.start_value;
      final_cost_ = found.value;
      plain = chosen(found.matrix);
    }
    pursue(plain, pursuit_trials);
    return plain;
  }

  State polished(State state, Watch watch) {
    const int rounds = options_.polish_rounds;
    for (int round = 0; round < rounds; ++round) {
      std::vector<ProjectedSketch> sketches;
      for (std::size_t c = 0; c < jobs_.size(); ++c)
        for (const Choice& choice : state.choices[c])
          if (choice.squared_error > 0)
            sketches.push_back(
                {&jobs_[c].solver, &jobs_[c].data, jobs_[c].start->levels(), choice.kept, 1 / choice.squared_error});
      Projection objective(shape_, std::move(sketches), watch_);
      const Minimised found =
          minimise(shape_, objective, state.matrix,
                   minimise_options(std::min(options_.iterations, polish_iterations), polish_tolerance, "polish"),
                   watch.part(static_cast<double>(round) / rounds, static_cast<double>(round + 1) / rounds));
      count(found);
      State next{found.matrix, state.choices};
      pursue(next, round + 1 == rounds ? last_pursuit_trials : pursuit_trials);
      const double fall = judged(state) - judged(next);
      if (!(fall > 0)) break;
      state = std::move(next);
      if (fall < 1e-3) break;
    }
    return state;
  }

  void count(const Minimised& found) {
    iterations_ += found.iterations;
    converged_ = found.converged;
  }

  Sketch sketch(std::size_t curve, const FilterPtr& filter, const Choice& choice) {
    const Job& job = jobs_[curve];
    ModelParts parts = job.start->parts();
    parts.filter = filter;
    parts.polygon.matrix() = choice.solution.control;
    close_ends(parts);
    Index first = 0;
    for (auto& level : parts.details) {
      auto details = std::make_shared<Points>(level->dimension(), level->count());
      details->matrix() = choice.solution.details.middleRows(first, details->count());
      first += details->count();
      level = std::move(details);
    }
    auto model = std::make_shared<Model>(std::move(parts));
    const Points now = samples(*model);
    const Eigen::VectorXd squares = (now.matrix() - curves_[curve].samples.matrix()).rowwise().squaredNorm();
    return {std::move(model), std::sqrt(squares.mean()), std::sqrt(squares.maxCoeff())};
  }

  FitResult result(const State& start, const State& best) {
    FitResult result;
    const bool unchanged = best.matrix == start.matrix;
    result.filter = unchanged ? start_ : std::make_shared<Filter>(shape_, best.matrix);
    for (std::size_t c = 0; c < jobs_.size(); ++c) {
      result.models.push_back(with_samples(jobs_[c], result.filter));
      auto& rows = result.budgets.emplace_back();
      for (std::size_t b = 0; b < budgets_.size(); ++b)
        rows.push_back({budgets_[b], details(budgets_[b]), sketch(c, start_, start.choices[c][b]),
                        sketch(c, result.filter, best.choices[c][b])});
    }
    result.reason = unchanged ? FitReason::start_best : converged_ ? FitReason::converged : FitReason::iterations;
    result.iterations = iterations_;
    result.start_cost = start_cost_;
    result.final_cost = final_cost_;
    result.start_condition = start_->condition();
    result.final_condition = result.filter->condition();
    watch_.report(1.0, "done");
    return result;
  }

  const std::vector<FitCurve>& curves_;
  FilterPtr start_;
  Shape shape_;
  std::vector<Index> budgets_;
  FitOptions options_;
  Watch& watch_;
  std::vector<Job> jobs_;
  std::vector<Neighbourhood> neighbourhoods_;
  int iterations_ = 0;
  bool converged_ = true;
  double start_cost_ = 0;
  double final_cost_ = 0;
};

// Vectors that all curves' models hold at least.
Index fewest_vectors(const std::vector<FitCurve>& curves, const Shape& shape) {
  Index fewest = std::numeric_limits<Index>::max();
  for (const FitCurve& curve : curves) {
    const int levels = shape.levels_for(curve.samples.count(), curve.closed);
    fewest = std::min(fewest, shape.control_points() + shape.first_node(levels) * shape.details_per_node());
  }
  return fewest;
}

std::vector<Index> require_budgets(const std::vector<FitCurve>& curves, const Shape& shape,
                                   std::vector<Index> budgets) {
  const Index most = fewest_vectors(curves, shape);
  if (budgets.empty()) return {std::min(default_budget, most)};
  for (std::size_t b = 0; b < budgets.size(); ++b) {
    if (budgets[b] >= shape.control_points() && budgets[b] <= most) continue;
    throw Error(Status::range, "budgets",
                "budgets[" + std::to_string(b) + "] is " + std::to_string(budgets[b]) +
                    "; a sketch of these curves holds from " + std::to_string(shape.control_points()) +
                    " (the control points alone) to " + std::to_string(most) + " vectors.")
        .at(static_cast<Index>(b))
        .with(static_cast<double>(budgets[b]));
  }
  return budgets;
}

// Relative error of a fit, all curves and budgets.
double merit(const FitResult& result) {
  double sum = 0;
  for (const auto& rows : result.budgets)
    for (const FitBudget& row : rows) sum += std::log(std::max(row.fitted.rms, 1e-300));
  return sum;
}

FitResult fit_from(const std::vector<FitCurve>& curves, FilterPtr start, const FitOptions& options, Watch& watch) {
  start = require_start(std::move(start));
  auto budgets = require_budgets(curves, start->shape(), options.budgets);
  return SparseFit(curves, std::move(start), std::move(budgets), options, watch).run();
}

std::vector<std::pair<int, int>> shapes_asked(const FitOptions& options) {
  std::vector<std::pair<int, int>> shapes;
  const auto [first_n, last_n] =
      options.control_points == 0 ? std::pair{2, 6} : std::pair{options.control_points, options.control_points};
  const auto [first_maps, last_maps] = options.maps == 0 ? std::pair{2, 4} : std::pair{options.maps, options.maps};
  for (int n = first_n; n <= last_n; ++n)
    for (int maps = first_maps; maps <= last_maps; ++maps) shapes.emplace_back(n, maps);
  return shapes;
}

// Shapes that cannot hold a budget are passed over when there is a choice.
bool holds(const std::vector<FitCurve>& curves, const Shape& shape, const std::vector<Index>& budgets) {
  const Index most = fewest_vectors(curves, shape);
  return std::ranges::all_of(budgets, [&](Index b) { return b >= shape.control_points() && b <= most; });
}

}  // namespace

FitResult fit_sparse(const std::vector<FitCurve>& curves, const FitOptions& options, Watch& watch) {
  require_curves(curves);
  if (options.start) return fit_from(curves, options.start, options, watch);
  std::vector<std::pair<int, int>> shapes = shapes_asked(options);
  if (shapes.size() > 1) {
    const auto cannot = [&](const auto& s) {
      return !holds(curves, Shape(Topology::joined, s.first, s.second), options.budgets);
    };
    const auto first = shapes.front();
    std::erase_if(shapes, cannot);
    if (shapes.empty()) shapes.push_back(first);  // its error tells the bounds
  }
  std::optional<FitResult> best;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    Watch part = watch.part(static_cast<double>(i) / static_cast<double>(shapes.size()),
                            static_cast<double>(i + 1) / static_cast<double>(shapes.size()));
    const auto [n, maps] = shapes[i];
    FitResult found = fit_from(curves, named_filter("casteljau", Topology::joined, n, maps), options, part);
    if (!best || merit(found) < merit(*best)) best = std::move(found);
  }
  return std::move(*best);
}

}  // namespace ifsm::core
