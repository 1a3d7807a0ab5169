#include "fit/train.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "fit/budgets.h"
#include "fit/fit.h"
#include "fit/parameters.h"

namespace ifsm::core {
namespace {

constexpr Index least_default_budget = 16;
constexpr Index samples_a_vector = 8;  // of the largest default budget: beyond, sketches are no longer sketches
constexpr int pursuit_trials = 12;
constexpr int judging_trials = 30;
constexpr double polish_tolerance = 1e-4;
constexpr double least_fall = 1e-3;  // of the logarithm of a squared error, on average, for another round

struct Family {
  std::vector<FitCurve> curves;
  std::vector<std::vector<Index>> budgets;
  Index sketches = 0;
};

std::vector<Index> default_budgets(const FitCurve& curve, Index most) {
  std::vector<Index> budgets;
  for (Index budget = least_default_budget; budget <= curve.samples.count() / samples_a_vector; budget *= 2)
    if (budget <= most) budgets.push_back(budget);
  if (budgets.empty()) budgets.push_back(std::min(least_default_budget, most));
  return budgets;
}

// The budgets that a curve's model holds.
std::vector<Index> budgets_of(const FitCurve& curve, const Shape& shape, const std::vector<Index>& asked) {
  const Index most = vectors_of(curve, shape);
  if (asked.empty()) return default_budgets(curve, most);
  std::vector<Index> budgets;
  std::ranges::copy_if(asked, std::back_inserter(budgets), [&](Index budget) { return budget <= most; });
  return budgets;
}

void add(Family& family, const FitCurve& curve, const Shape& shape, const std::vector<Index>& asked) {
  const auto budgets = budgets_of(curve, shape, asked);
  if (budgets.empty()) return;  // too small for any of them
  family.curves.push_back(curve);
  family.budgets.push_back(budgets);
  family.sketches += static_cast<Index>(budgets.size());
}

class Training {
 public:
  Training(const Family& family, const TrainOptions& options, Watch& watch)
      : family_(family),
        options_(options),
        watch_(watch),
        book_(family.curves, options.start, family.budgets, options.limits, watch) {}

  TrainResult run() {
    Sketches start = book_.best(options_.start->matrix(), pursuit_trials);
    Sketches best = start;
    TrainResult result;
    result.reason = TrainReason::rounds;
    while (result.rounds < options_.rounds && free_count(book_.shape()) > 0) {
      Sketches next = bettered(best, result);
      const double fall = book_.judged(best) - book_.judged(next);
      if (fall > 0) best = std::move(next);
      if (fall < least_fall * static_cast<double>(family_.sketches)) {
        result.reason = TrainReason::converged;
        break;
      }
    }
    // Rounds bettered the choices as well, which is no merit of the filter: the start's have as many trials.
    for (int round = 0; round < result.rounds; ++round) book_.pursue(start, pursuit_trials);
    const double fall = book_.judged(start) - book_.judged(best);
    if (!(fall > 0) || best.matrix == start.matrix) {
      result.reason = TrainReason::start_best;
      result.filter = options_.start;
      return result;
    }
    result.filter = std::make_shared<Filter>(book_.shape(), best.matrix);
    result.ratio = mean_ratio(-fall, family_);
    return result;
  }

  // The logarithms are of squared errors.
  static double mean_ratio(double fall, const Family& family) {
    return std::exp(fall / 2 / static_cast<double>(family.sketches));
  }

 private:
  Sketches bettered(const Sketches& now, TrainResult& result) {
    const double rounds = options_.rounds;
    const Minimised found =
        book_.polished(now, book_.options(options_.iterations, polish_tolerance, "train"),
                       watch_.part(0.05 + 0.9 * result.rounds / rounds, 0.05 + 0.9 * (result.rounds + 1) / rounds));
    result.rounds += 1;
    result.iterations += found.iterations;
    Sketches next{found.matrix, now.choices};
    book_.pursue(next, pursuit_trials);
    return next;
  }

  const Family& family_;
  const TrainOptions& options_;
  Watch& watch_;
  Sketchbook book_;
};

// What the filter is worth on curves that it was not trained on.
double judge(const Family& family, const FilterPtr& start, const FilterPtr& trained, const Watch& watch) {
  if (family.curves.empty()) return std::numeric_limits<double>::quiet_NaN();
  Sketchbook book(family.curves, start, family.budgets, Limits{}, watch);
  const double before = book.judged(book.best(start->matrix(), judging_trials));
  const double after = book.judged(book.best(trained->matrix(), judging_trials));
  return Training::mean_ratio(after - before, family);
}

}  // namespace

TrainResult train(const std::vector<FitCurve>& given, const TrainOptions& options, Watch& watch) {
  require_curves(given);
  watch.report(0.0, "train");
  const ScaledCurves near = near_unit_size(given);
  const std::vector<FitCurve>& curves = near.any ? near.curves : given;
  require_start(options.start);
  const Shape& shape = options.start->shape();
  require_least_budgets(options.budgets, shape);
  Family trained, held_out;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const bool out = options.hold_out > 0 && (c + 1) % static_cast<std::size_t>(options.hold_out) == 0;
    add(out ? held_out : trained, curves[c], shape, options.budgets);
  }
  if (trained.curves.empty())
    throw Error(
        Status::range, "budgets",
        "None of the curves to train on holds a sketch of any of these budgets; give smaller budgets, or longer "
        "curves.");
  TrainResult result = Training(trained, options, watch).run();
  result.trained = static_cast<Index>(trained.curves.size());
  result.held_out = static_cast<Index>(held_out.curves.size());
  result.sketches = trained.sketches;
  result.held_out_ratio = judge(held_out, options.start, result.filter, watch);
  watch.finish();
  return result;
}

}  // namespace ifsm::core
