#include "fit/sparse.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "curve/named.h"
#include "curve/scale.h"
#include "fit/budgets.h"
#include "fit/parameters.h"
#include "fit/sketchbook.h"

namespace ifsm::core {
namespace {

constexpr Index default_budget = 128;
// From coast, which was trained to make curves sparse, sparsity comes nearer at small budgets alone. At 128 vectors the
// six coasts come out 1.3 % farther (on average) without it, above not at all, in a third of the time.
constexpr Index small_budget = 128;
constexpr int sparse_rounds = 2;
constexpr int pursuit_trials = 12;  // while R still moves
constexpr int last_pursuit_trials = 30;
constexpr int polish_iterations = 10;  // the choice changes after them
constexpr double sparse_tolerance = 1e-6;
constexpr double polish_tolerance = 1e-4;

FilterPtr de_casteljau(int control_points, int maps) {
  return named_filter("casteljau", Topology::joined, control_points, maps);
}

class SparseFit {
 public:
  SparseFit(const std::vector<FitCurve>& curves, FilterPtr start, std::vector<Index> budgets, const FitOptions& options,
            Watch& watch)
      : curves_(curves),
        budgets_(std::move(budgets)),
        options_(options),
        rounds_(rounds_of(options, *start, budgets_)),
        watch_(watch),
        book_(curves, std::move(start), std::vector(curves.size(), budgets_), Limits{}, watch) {}

  FitResult run() {
    const Sketches start = book_.best(book_.start()->matrix(), last_pursuit_trials);
    Sketches best = start;
    if (free_count(book_.shape()) > 0) {
      // Two ways down: sparsity gathers the curve into few details and leads far from the start where the budget is
      // small; where it is large, the start is the better one to polish.
      const double done = rounds_ > 0 ? 0.7 : 0.0;
      if (rounds_ > 0) {
        Sketches sparse = made_sparse(start, watch_.part(0.0, options_.polish_rounds > 0 ? 0.4 : 0.95));
        consider(sparse, start, best);
        consider(polished(std::move(sparse), watch_.part(0.4, done)), start, best);
      }
      consider(polished(start, watch_.part(done, 0.95)), start, best);
    }
    return result(start, best);
  }

 private:
  static int rounds_of(const FitOptions& options, const Filter& start, const std::vector<Index>& budgets) {
    if (options.sparse_rounds != by_default) return options.sparse_rounds;
    const FilterPtr known = default_filter(start.shape().control_points(), start.shape().maps());
    const FilterPtr casteljau = de_casteljau(start.shape().control_points(), start.shape().maps());
    const bool trained = start.matrix() == known->matrix() && known->matrix() != casteljau->matrix();
    const bool spared = trained && options.polish_rounds > 0 && std::ranges::min(budgets) >= small_budget;
    return spared ? 0 : sparse_rounds;
  }

  void consider(const Sketches& candidate, const Sketches& start, Sketches& best) {
    if (book_.is_anywhere_worse(candidate, start)) return;
    if (book_.judged(candidate) < book_.judged(best)) best = candidate;
  }

  Sketches made_sparse(const Sketches& state, Watch watch) {
    // The scale of the first round is that of the plain choice: a bettered one would set it too low.
    Sketches plain = book_.most_significant(state.matrix);
    const int rounds = rounds_;
    for (int round = 0; round < rounds; ++round) {
      const Minimised found =
          book_.made_sparse(plain, book_.options(options_.iterations, sparse_tolerance, "sparse"),
                            watch.part(static_cast<double>(round) / rounds, static_cast<double>(round + 1) / rounds));
      count(found);
      start_cost_ = found.start_value;
      final_cost_ = found.value;
      plain = book_.most_significant(found.matrix);
    }
    book_.pursue(plain, pursuit_trials);
    return plain;
  }

  Sketches polished(Sketches state, Watch watch) {
    const int rounds = options_.polish_rounds;
    for (int round = 0; round < rounds; ++round) {
      const Minimised found = book_.polished(
          state, book_.options(std::min(options_.iterations, polish_iterations), polish_tolerance, "polish"),
          watch.part(static_cast<double>(round) / rounds, static_cast<double>(round + 1) / rounds));
      count(found);
      if (rounds_ == 0) start_cost_ = found.start_value, final_cost_ = found.value;
      Sketches next{found.matrix, state.choices};
      book_.pursue(next, round + 1 == rounds ? last_pursuit_trials : pursuit_trials);
      const double fall = book_.judged(state) - book_.judged(next);
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

  // Levels without details are the same in all sketches of a curve.
  Sketch sketch(std::size_t curve, const FilterPtr& filter, const Choice& choice, const std::vector<PointsPtr>& zeros) {
    ModelParts parts = book_.blank(curve);
    parts.filter = filter;
    ModelPtr model = solved_model(std::move(parts), zeros, choice.kept, choice.solution);
    const Points now = samples(*model);
    const Eigen::VectorXd squares = (now.matrix() - curves_[curve].samples.matrix()).rowwise().squaredNorm();
    return {std::move(model), std::sqrt(squares.mean()), std::sqrt(squares.maxCoeff())};
  }

  FitResult result(const Sketches& start, const Sketches& best) {
    FitResult result;
    const bool unchanged = best.matrix == start.matrix;
    result.filter = unchanged ? book_.start() : std::make_shared<Filter>(book_.shape(), best.matrix);
    for (std::size_t c = 0; c < curves_.size(); ++c) {
      result.models.push_back(book_.model(c, result.filter));
      const auto zeros = zero_details(*result.models.back());
      auto& rows = result.budgets.emplace_back();
      for (std::size_t b = 0; b < budgets_.size(); ++b)
        rows.push_back({budgets_[b], book_.details(budgets_[b]), sketch(c, book_.start(), start.choices[c][b], zeros),
                        sketch(c, result.filter, best.choices[c][b], zeros)});
    }
    result.reason = unchanged ? FitReason::start_best : converged_ ? FitReason::converged : FitReason::iterations;
    result.iterations = iterations_;
    result.start_cost = start_cost_;
    result.final_cost = final_cost_;
    result.start_condition = book_.start()->condition();
    result.final_condition = result.filter->condition();
    return result;
  }

  const std::vector<FitCurve>& curves_;
  std::vector<Index> budgets_;
  FitOptions options_;
  int rounds_;  // of sparsity
  Watch& watch_;
  Sketchbook book_;
  int iterations_ = 0;
  bool converged_ = true;
  double start_cost_ = 0;
  double final_cost_ = 0;
};

// A quarter of the samples of small curves: a sketch of more vectors than that is hardly one.
Index least_budget(const std::vector<FitCurve>& curves) {
  Index least = default_budget;
  for (const FitCurve& curve : curves) least = std::min(least, curve.samples.count() / 4);
  return least;
}

std::vector<Index> budgets_or_default(const std::vector<FitCurve>& curves, const Shape& shape,
                                      std::vector<Index> budgets) {
  const Index most = fewest_vectors(curves, shape);
  if (budgets.empty()) return {std::min(most, std::max(least_budget(curves), Index{shape.control_points()}))};
  require_budgets(budgets, shape, curves);
  return budgets;
}

// Relative error of a fit, all curves and budgets.
double merit(const FitResult& result) {
  double sum = 0;
  for (const auto& rows : result.budgets)
    for (const FitBudget& row : rows) sum += std::log(std::max(row.fitted.rms, 1e-300));
  return sum;
}

// Where a fit starts that is told nothing: coast where it has the shape, unless de Casteljau's filter is nowhere worse
// (smooth curves: it reproduces polynomials).
FilterPtr better_start(const std::vector<FitCurve>& curves, int control_points, int maps, const FitOptions& options,
                       const Watch& watch) {
  FilterPtr first = default_filter(control_points, maps);
  const FilterPtr second = de_casteljau(control_points, maps);
  if (first->matrix() == second->matrix()) return first;
  const auto budgets = std::vector(curves.size(), budgets_or_default(curves, first->shape(), options.budgets));
  Sketchbook book(curves, first, budgets, Limits{}, watch);
  // Bettering choices takes long, and rough curves are seen to be rough without it: of smooth ones de Casteljau's
  // sketches are nearer by orders of magnitude.
  Sketches a = book.most_significant(first->matrix()), b = book.most_significant(second->matrix());
  if (book.is_anywhere_worse(b, a, 0.5)) return first;
  a = book.best(first->matrix(), pursuit_trials), b = book.best(second->matrix(), pursuit_trials);
  return !book.is_anywhere_worse(b, a) && book.judged(b) < book.judged(a) ? second : first;
}

FitResult fit_from(const std::vector<FitCurve>& curves, FilterPtr start, const FitOptions& options, Watch& watch) {
  require_start(start);
  auto budgets = budgets_or_default(curves, start->shape(), options.budgets);
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

FitResult fit_near_unit_size(const std::vector<FitCurve>& curves, const FitOptions& options, Watch& watch) {
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
    FitResult found = fit_from(curves, better_start(curves, n, maps, options, watch), options, part);
    if (!best || merit(found) < merit(*best)) best = std::move(found);
  }
  return std::move(*best);
}

Sketch scaled(const Sketch& sketch, int exponent) {
  return {scaled(*sketch.model, exponent), std::scalbn(sketch.rms, exponent), std::scalbn(sketch.max, exponent)};
}

}  // namespace

FitResult fit_sparse(const std::vector<FitCurve>& curves, const FitOptions& options, Watch& watch) {
  require_curves(curves);
  watch.report(0.0, "start");
  const ScaledCurves near = near_unit_size(curves);
  FitResult result = fit_near_unit_size(near.any ? near.curves : curves, options, watch);
  for (std::size_t c = 0; near.any && c < curves.size(); ++c) {
    result.models[c] = analyze(result.filter, curves[c].samples, curves[c].closed);
    for (FitBudget& row : result.budgets[c]) {
      row.start = scaled(row.start, near.exponents[c]);
      row.fitted = scaled(row.fitted, near.exponents[c]);
    }
  }
  watch.finish();
  return result;
}

}  // namespace ifsm::core
