#include "fit/curve_stage.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "curve/complement.h"
#include "curve/named.h"
#include "fit/certainty.h"
#include "fit/collage.h"
#include "fit/curve_problem.h"
#include "linalg/spectrum.h"

namespace ifsm::core {
namespace {

constexpr int inner_iterations = 5;  // of Levenberg-Marquardt, while weights or parameters still change
constexpr int most_robust_rounds = 100;
constexpr int coarse_iterations = 10;  // on the way down to the finest level
constexpr int level_step = 2;
constexpr double wide_scale = 3;        // of the median residual: a loss that gives outliers up begins so wide
constexpr double narrower_scale = 0.7;  // and goes on while it becomes narrower by this

class CurveFit {
 public:
  CurveFit(const std::vector<FitCurve>& curves, FilterPtr start, const CurveOptions& options, Watch& watch)
      : options_(options), watch_(watch), start_(std::move(start)), problem_(curves, start_, options, watch) {}

  FitResult run() {
    // Its constraints agree: that was looked at before.
    const CurveState start = problem_.state(start_->matrix(), options_.loss, problem_.levels()).value();
    CurveState best = start;
    const int starts = moves_filter() ? options_.starts : 1;
    for (int i = 0; i < starts; ++i) {
      Watch coarse = watch_.part(0.95 * i / starts, 0.95 * (i + 0.5) / starts);
      Watch fine = watch_.part(0.95 * (i + 0.5) / starts, 0.95 * (i + 1) / starts);
      std::optional<CurveState> from = start;
      if (i > 0) from = coarse_to_fine(i == 1 ? canonical_start() : collage_start(), coarse);
      if (!from) continue;
      CurveState found = fitted(std::move(*from), fine);
      if (found.cost < best.cost) best = std::move(found), best_converged_ = converged_;
    }
    return result(start, best);
  }

 private:
  bool moves_filter() const { return !options_.fixed_filter && free_count(problem_.shape(), Part::maps) > 0; }
  bool projects(int levels) const { return levels == problem_.levels() && options_.reparameterise > 0; }

  // Losses that give outliers up have many minima: their scale comes down from the residuals' own to the one asked for.
  CurveState fitted(CurveState state, Watch& watch) {
    const int levels = problem_.levels();
    if (options_.loss.kind == LossKind::cauchy || options_.loss.kind == LossKind::tukey) {
      Loss loss = options_.loss;
      loss.scale = std::numeric_limits<double>::infinity();
      for (double scale = wide_scale * problem_.median_residual(state);
           scale > options_.loss.scale && scale < narrower_scale * loss.scale;
           scale = wide_scale * problem_.median_residual(state)) {
        loss.scale = scale;
        Watch wide = watch.part(0, 0.5);
        state = improved(problem_.judged(std::move(state), loss, levels), loss, levels, inner_iterations, wide);
      }
    }
    Watch rest = watch.part(0.5, 1);
    return improved(problem_.judged(std::move(state), options_.loss, levels), options_.loss, levels,
                    options_.iterations, rest);
  }

  // Samples' places, then weights by the loss's slopes, then control points and T, in turns: none raises the objective.
  CurveState improved(CurveState state, const Loss& loss, int levels, int iterations, Watch& watch) {
    const bool alone = !loss.robust() && !projects(levels);
    const int rounds =
        std::max(loss.robust() ? most_robust_rounds : 1, projects(levels) ? options_.reparameterise + 1 : 0);
    int left = iterations;
    for (int round = 0; round < rounds; ++round) {
      Watch part = watch.part(static_cast<double>(round) / rounds, static_cast<double>(round + 1) / rounds);
      part.report(0, "curve");
      const bool projected = projects(levels) && round > 0 && round <= options_.reparameterise;
      CurveState next = state;
      if (projected) {
        problem_.project(next);
        next = problem_.judged(std::move(next), loss, levels);
      }
      CurveError error = problem_.error(next, loss, levels);
      bool inner_converged = true;
      if (moves_filter() && left > 0) {
        MinimiseOptions step = problem_.minimise_options("curve");
        step.iterations = alone ? left : std::min(left, inner_iterations);
        const Minimised found = minimise(problem_.shape(), error, next.matrix, step, part);
        left -= std::max(found.iterations, 1);
        iterations_ += found.iterations;
        inner_converged = found.converged;
        next.matrix = found.matrix;
      }
      const auto fits = error.solved(next.matrix);
      for (std::size_t c = 0; c < next.controls.size(); ++c) next.controls[c] = (*fits)[c].control;
      next = problem_.judged(std::move(next), loss, levels);
      const double fall = state.cost - next.cost;
      if (fall > 0) state = std::move(next);
      converged_ = alone ? inner_converged : round + 1 < rounds && (!moves_filter() || left > 0 || inner_converged);
      const bool more_to_come = projects(levels) && round == 0;
      if (!(fall > options_.tolerance * state.cost) && !more_to_come) break;
    }
    return state;
  }

  // Few levels see the shape and little of the texture, and have fewer minima.
  std::optional<CurveState> coarse_to_fine(RowMatrix matrix, Watch& watch) {
    for (int levels = problem_.coarsest_level(); levels < problem_.levels(); levels += level_step) {
      auto state = problem_.state(matrix, options_.loss, levels);
      if (state) matrix = improved(std::move(*state), options_.loss, levels, coarse_iterations, watch).matrix;
    }
    return problem_.state(matrix, options_.loss, problem_.levels());
  }

  RowMatrix canonical_start() const {
    return with_complement(problem_.shape(), start_->matrix().topRows(problem_.shape().control_points()));
  }
  RowMatrix collage_start() const {
    std::vector<ModelPtr> models;
    for (std::size_t c = 0; c < problem_.targets().size(); ++c) models.push_back(problem_.exact(c, start_));
    return collage(models, [this](const RowMatrix& matrix) { return problem_.admits(matrix); });
  }

  FitResult result(const CurveState& start, const CurveState& best) {
    FitResult result;
    result.stage = Stage::curve;
    const bool same_filter = best.matrix == start_->matrix();
    result.filter = same_filter ? start_ : std::make_shared<Filter>(problem_.shape(), best.matrix);
    const int n = problem_.shape().control_points();
    for (std::size_t c = 0; c < problem_.targets().size(); ++c) {
      result.models.push_back(problem_.exact(c, result.filter));
      const auto zeros = zero_details(*result.models.back());
      result.budgets.push_back(
          {{n, 0, problem_.sketch(c, start_, start, zeros), problem_.sketch(c, result.filter, best, zeros)}});
      result.parameters.push_back(best.parameters[c]);
    }
    const bool unchanged = !(best.cost < start.cost);
    result.reason = unchanged && moves_filter() ? FitReason::start_best
                    : best_converged_           ? FitReason::converged
                                                : FitReason::iterations;
    result.iterations = iterations_;
    result.start_cost = start.cost;
    result.final_cost = best.cost;
    result.start_condition = start_->condition();
    result.final_condition = result.filter->condition();
    result.certainty = std::make_shared<Certainty>(certainty(best));
    watch_.finish();
    return result;
  }

  Certainty certainty(const CurveState& state) const {
    const Shape& shape = problem_.shape();
    Certainty certainty{shape, problem_.levels(), state.matrix, Part::maps, moves_filter(), {}, {}, true, 0, 0};
    const int count = free_count(shape, Part::maps);
    const CurveError error = problem_.error(state, options_.loss, problem_.levels());
    Eigen::MatrixXd form = Eigen::MatrixXd::Zero(count, count);
    double sum = 0;
    for (std::size_t c = 0; c < error.terms().size(); ++c) {
      const CurveTerm& term = error.terms()[c];
      Eliminated own = error.eliminated(term, state.matrix, state.controls[c]);
      form += own.product.topLeftCorner(count, count);
      sum += own.product(count, count) - term.offset;
      certainty.freedom += term.target->count() * term.target->dimension - own.rank;
      certainty.noise_known = certainty.noise_known && term.target->whitening.rows() > 0;
      certainty.curves.push_back({state.controls[c], std::move(own.follow), std::move(own.spread), own.open == 0});
    }
    certainty.filter = Eigen::MatrixXd::Zero(count, count);
    if (moves_filter()) {
      certainty.filter = known_inverse(form, form.diagonal());
      certainty.freedom -= std::lround((certainty.filter * form).trace());
    }
    const double variance = certainty.noise_known   ? 1
                            : certainty.freedom > 0 ? sum / static_cast<double>(certainty.freedom)
                                                    : 0;
    certainty.noise = std::sqrt(variance);
    certainty.filter *= variance;
    for (CurveCertainty& curve : certainty.curves) curve.spread *= variance;
    return certainty;
  }

  const CurveOptions& options_;
  Watch& watch_;
  FilterPtr start_;
  CurveProblem problem_;
  int iterations_ = 0;
  bool converged_ = true;
  bool best_converged_ = true;
};

void require_loss(const Loss& loss) {
  if (!loss.robust() || (std::isfinite(loss.scale) && loss.scale > 0)) return;
  throw Error(std::isfinite(loss.scale) ? Status::range : Status::not_finite, "loss_scale",
              "loss_scale is " + text_of(loss.scale) +
                  "; give the residual, above 0, at which outliers begin: 1.3 to 5 standard deviations of the noise.")
      .with(loss.scale);
}

}  // namespace

FitResult fit_curve(const std::vector<FitCurve>& curves, const CurveOptions& options, Watch& watch) {
  require_curves(curves);
  require_loss(options.loss);
  require_tolerance(options.tolerance);
  FilterPtr start =
      options.start ? options.start : named_filter("casteljau", Topology::joined, options.control_points, options.maps);
  start = require_start(std::move(start));
  return CurveFit(curves, std::move(start), options, watch).run();
}

}  // namespace ifsm::core
