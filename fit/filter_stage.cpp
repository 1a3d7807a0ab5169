#include "fit/filter_stage.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "curve/keep.h"
#include "curve/named.h"
#include "curve/resolve.h"
#include "fit/certainty.h"
#include "fit/minimise.h"
#include "fit/region.h"
#include "fit/truncation.h"
#include "linalg/spectrum.h"

namespace ifsm::core {
namespace {

class FilterFit {
 public:
  FilterFit(const std::vector<FitCurve>& curves, FilterPtr start, const FilterOptions& options, Watch& watch)
      : curves_(curves), options_(options), watch_(watch), start_(std::move(start)), shape_(start_->shape()) {
    lines_.reserve(curves_.size());  // they are pointed to
    for (const FitCurve& curve : curves_) {
      const ModelPtr exact = analyze(start_, curve.samples, curve.closed);
      levels_.push_back(exact->levels());
      lines_.push_back(line(*exact, exact->levels()));
      weights_.push_back(sample_weights(*exact));
      neighbourhoods_.push_back(Neighbourhood::of(*exact, lines_.back(), farthest_reach));
    }
  }

  FitResult run() {
    FitResult result;
    const Minimised found = minimised(result);
    lines_.clear();  // models take their place
    return told(std::move(result), found);
  }

 private:
  int kept(std::size_t curve) const { return std::min(options_.kept_levels, levels_[curve]); }

  Minimised minimised(FitResult& result) {
    std::vector<TruncatedCurve> truncated;
    for (std::size_t c = 0; c < curves_.size(); ++c)
      truncated.push_back({&lines_[c], levels_[c], kept(c), std::move(weights_[c])});
    Truncation objective(shape_, std::move(truncated), watch_);
    const MinimiseOptions step{options_.iterations,
                               options_.tolerance,
                               std::max(Limits{}.condition, 2 * start_->condition()),
                               "filter",
                               [this](const RowMatrix& matrix) { return stay_near(shape_, matrix, neighbourhoods_); },
                               Part::details};
    Minimised found = minimise(shape_, objective, start_->matrix(), step, watch_.part(0, 0.95));
    result.certainty = std::make_shared<Certainty>(certainty(objective, found.matrix));
    return found;
  }

  Sketch sketch(std::size_t curve, const Model& model, const std::vector<PointsPtr>& zeros) const {
    ModelPtr kept_model = keep(model, first_levels(model, kept(curve)), zeros);
    const Points now = samples(*kept_model);
    const Eigen::VectorXd squares = (now.matrix() - curves_[curve].samples.matrix()).rowwise().squaredNorm();
    return {std::move(kept_model), std::sqrt(squares.mean()), std::sqrt(squares.maxCoeff())};
  }

  FitResult told(FitResult result, const Minimised& found) {
    result.stage = Stage::filter;
    const bool unchanged = found.matrix == start_->matrix();
    result.filter = unchanged ? start_ : std::make_shared<Filter>(shape_, found.matrix);
    for (std::size_t c = 0; c < curves_.size(); ++c) {
      const Index details = shape_.first_node(kept(c)) * shape_.details_per_node();
      ModelPtr exact = analyze(start_, curves_[c].samples, curves_[c].closed);
      const auto zeros = zero_details(*exact);
      Sketch start = sketch(c, *exact, zeros);
      exact = nullptr;
      exact = analyze(result.filter, curves_[c].samples, curves_[c].closed);
      result.budgets.push_back(
          {{details + shape_.control_points(), details, std::move(start), sketch(c, *exact, zeros)}});
      result.models.push_back(std::move(exact));
    }
    result.reason = unchanged ? FitReason::start_best : found.converged ? FitReason::converged : FitReason::iterations;
    result.iterations = found.iterations;
    result.start_cost = found.start_value;
    result.final_cost = found.value;
    result.start_condition = start_->condition();
    result.final_condition = result.filter->condition();
    watch_.finish();
    return result;
  }

  // What the kept vectors take of the samples is a projection of their rank; U takes what it can be seen by.
  Certainty certainty(Truncation& objective, const RowMatrix& matrix) const {
    const int count = free_count(shape_, Part::details);
    Normal normal(count);
    objective.gather(matrix, normal);
    const Eigen::MatrixXd form = normal.product().topLeftCorner(count, count).selfadjointView<Eigen::Lower>();
    Certainty certainty{shape_, 0, matrix, Part::details, true, known_inverse(form, form.diagonal()), {}, false, 0, 0};
    for (std::size_t c = 0; c < curves_.size(); ++c) {
      const Index taken = std::min(shape_.line_length(kept(c)), curves_[c].samples.count());
      certainty.freedom += (curves_[c].samples.count() - taken) * curves_[c].samples.dimension();
    }
    certainty.freedom -= std::lround((certainty.filter * form).trace());
    const double variance =
        certainty.freedom > 0 ? normal.product()(count, count) / static_cast<double>(certainty.freedom) : 0;
    certainty.noise = std::sqrt(variance);
    certainty.filter *= variance;
    return certainty;
  }

  const std::vector<FitCurve>& curves_;
  const FilterOptions& options_;
  Watch& watch_;
  FilterPtr start_;
  Shape shape_;
  std::vector<int> levels_;
  std::vector<Points> lines_;
  std::vector<Eigen::VectorXd> weights_;
  std::vector<Neighbourhood> neighbourhoods_;
};

}  // namespace

FitResult fit_filter(const std::vector<FitCurve>& curves, const FilterOptions& options, Watch& watch) {
  require_curves(curves);
  require_tolerance(options.tolerance);
  FilterPtr start =
      options.start ? options.start : named_filter("casteljau", Topology::joined, options.control_points, options.maps);
  start = require_start(std::move(start));
  return FilterFit(curves, std::move(start), options, watch).run();
}

}  // namespace ifsm::core
