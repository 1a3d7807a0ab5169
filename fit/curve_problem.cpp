#include "fit/curve_problem.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.h"
#include "fit/foot_points.h"
#include "fit/refine.h"

namespace ifsm::core {
namespace {

int levels_of(const std::vector<FitCurve>& curves, const Shape& shape, int asked) {
  int least = 0;
  for (const FitCurve& curve : curves) least = std::max(least, shape.levels_for(curve.samples.count(), curve.closed));
  if (asked == 0) return least;
  if (asked < least)
    throw Error(Status::range, "levels",
                "levels is " + std::to_string(asked) + "; " + std::to_string(least) +
                    " are needed to give every sample a place: give at least so many, or 0.")
        .with(asked);
  return shape.checked_levels(asked);
}

}  // namespace

CurveProblem::CurveProblem(const std::vector<FitCurve>& curves, const FilterPtr& start, const CurveOptions& options,
                           const Watch& watch)
    : curves_(curves),
      shape_(start->shape()),
      watch_(watch),
      levels_(levels_of(curves, shape_, options.levels)),
      condition_(std::max(Limits{}.condition, 2 * start->condition())),
      tolerance_(options.tolerance) {
  if (!options.samples.empty() && options.samples.size() != curves.size())
    throw Error(Status::shape, "samples",
                "There are " + std::to_string(curves.size()) + " curves and " + std::to_string(options.samples.size()) +
                    " entries about their samples; give one a curve, or none.")
        .with(static_cast<double>(options.samples.size()))
        .needs(static_cast<Index>(curves.size()));
  const FitSamples nothing;
  lines_.reserve(curves.size());  // they are pointed to
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const ModelPtr model = exact(c, start);
    blanks_.push_back(model->parts());
    blanks_.back().details.clear();
    lines_.push_back(line(*model, levels_));
    neighbourhoods_.push_back(Neighbourhood::of(*model, lines_.back(), farthest_reach));
    const std::string prefix = "samples[" + std::to_string(c) + "].";
    targets_.push_back(make_target(curves[c], options.samples.empty() ? nothing : options.samples[c],
                                   options.parameters, *model, prefix));
    require_consistent(targets_.back(), ConstraintSet(targets_.back(), shape_, levels_), start->matrix(), prefix,
                       watch);
  }
}

int CurveProblem::coarsest_level() const {
  // As many places as C has free entries: what is seen there can be told apart.
  int levels = 1;
  while (levels < levels_ && shape_.line_length(levels) < free_count(shape_, Part::maps)) ++levels;
  return levels;
}

bool CurveProblem::admits(const RowMatrix& matrix) const {
  return matrix.allFinite() && condition_of(matrix) <= condition_ &&
         contractivity_of(shape_, matrix.topRows(shape_.control_points())) == Contractivity::proven &&
         stay_near(shape_, matrix, neighbourhoods_);
}

MinimiseOptions CurveProblem::minimise_options(const char* stage) const {
  return {40,
          tolerance_,
          condition_,
          stage,
          [this](const RowMatrix& matrix) { return stay_near(shape_, matrix, neighbourhoods_); },
          Part::maps};
}

CurveError CurveProblem::error(const CurveState& state, const Loss& loss, int levels) const {
  std::vector<CurveTerm> terms;
  for (std::size_t c = 0; c < targets_.size(); ++c) {
    const Target& target = targets_[c];
    CurveTerm term{&target,
                   ConstraintSet(target, shape_, levels),
                   positions_of(shape_, levels, state.parameters[c]),
                   state.controls.empty() ? Lanes(blanks_[c].polygon.matrix()) : state.controls[c],
                   {},
                   0};
    if (loss.robust())
      for (const double s : state.squared[c]) {
        const Loss::Value value = loss(s);
        term.slopes.push_back(value.slope);
        term.offset += value.rho - value.slope * s;
      }
    terms.push_back(std::move(term));
  }
  return {shape_, levels, std::move(terms), watch_};
}

std::optional<CurveState> CurveProblem::state(const RowMatrix& matrix, const Loss& loss, int levels) const {
  CurveState state{matrix, {}, {}, {}, 0};
  for (const Target& target : targets_) state.parameters.push_back(target.parameters);
  const auto fits = error(state, Loss{}, levels).solved(matrix);
  if (!fits) return std::nullopt;
  for (const ControlFit& fit : *fits) state.controls.push_back(fit.control);
  return judged(std::move(state), loss, levels);
}

CurveState CurveProblem::judged(CurveState state, const Loss& loss, int levels) const {
  const int n = shape_.control_points();
  state.squared.clear();
  state.cost = 0;
  for (std::size_t c = 0; c < targets_.size(); ++c) {
    const Target& target = targets_[c];
    const Lanes& control = state.controls[c];
    auto& squared = state.squared.emplace_back(static_cast<std::size_t>(loss.robust() ? target.count() : 0));
    const std::vector<Position> positions = positions_of(shape_, levels, state.parameters[c]);
    const SampleGroups groups(positions);
    std::vector<double> costs(static_cast<std::size_t>(groups.count()), 0.0);
    parallel_for(groups.count(), 0, [&](Index group) {
      Eigen::RowVectorXd error(target.dimension);
      CurveWalk(shape_, levels, state.matrix, watch_)
          .basis(groups.positions(group), [&](Index at, const double* basis) {
            const Index k = groups.first(group) + at;
            error.noalias() = Eigen::Map<const Eigen::RowVectorXd>(basis, n) * control;
            error -= target.samples.row(k);
            const double square = target.squared(k, error);
            if (loss.robust()) squared[static_cast<std::size_t>(k)] = square;
            costs[static_cast<std::size_t>(group)] += loss(square).rho;
          });
    });
    for (const double cost : costs) state.cost += cost;
  }
  return state;
}

void CurveProblem::project(CurveState& state) const {
  for (std::size_t c = 0; c < targets_.size(); ++c) {
    const Lanes places = refined(shape_, state.matrix, state.controls[c], 0, levels_);
    state.parameters[c] = foot_points(targets_[c], state.parameters[c], places, watch_);
  }
}

double CurveProblem::median_residual(const CurveState& state) const {
  std::vector<double> all;
  for (const auto& squared : state.squared) all.insert(all.end(), squared.begin(), squared.end());
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::ranges::nth_element(all, middle);
  return std::sqrt(*middle);
}

ModelPtr CurveProblem::exact(std::size_t curve, const FilterPtr& filter) const {
  return analyze(filter, curves_[curve].samples, curves_[curve].closed, levels_);
}

Sketch CurveProblem::sketch(std::size_t curve, const FilterPtr& filter, const CurveState& state,
                            std::span<const PointsPtr> zeros) const {
  ModelParts parts = blanks_[curve];
  parts.filter = filter;
  parts.polygon.matrix() = state.controls[curve];
  close_ends(parts);
  parts.details.assign(zeros.begin(), zeros.end());
  const Target& target = targets_[curve];
  const int n = shape_.control_points();
  double sum = 0, most = 0;
  CurveWalk(shape_, levels_, state.matrix, watch_)
      .basis(positions_of(shape_, levels_, state.parameters[curve]), [&](Index k, const double* basis) {
        const double squared =
            (Eigen::Map<const Eigen::RowVectorXd>(basis, n) * state.controls[curve] - target.samples.row(k))
                .squaredNorm();
        sum += squared;
        most = std::max(most, squared);
      });
  return {std::make_shared<Model>(std::move(parts)), std::sqrt(sum / static_cast<double>(target.count())),
          std::sqrt(most)};
}

}  // namespace ifsm::core
