#include "fit/approach.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "fit/pulls.h"

namespace ifsm::core {
namespace {

// While the choice changes, and of its values in the end: the 16-norm of 4097 places may be 1.7 times the largest.
// Tried on the six coasts: a start at 2, or twice as many trials and steps, bring nothing.
constexpr double powers[] = {4, 8, 16};
constexpr double last_powers[] = {32, 64, 128, 256};
constexpr double least_weight = 1e-4;  // of the largest: a place that is met at once still holds its part of the curve
constexpr double better = 1 - 1e-3;    // falls of the norm below a thousandth are not worth a step
constexpr int settling_steps = 10;     // before and after a choice is bettered
constexpr int trial_steps = 6;         // of a choice on trial
constexpr int exchange_trials = 8;

struct State {
  Kept kept;
  Solution solution;
  Points curve;  // the finest line
  Pulls pulls;
};

Kept kept_in(const Model& model) {
  Kept kept;
  for (int level = 0; level < model.levels(); ++level) {
    const auto details = model.details(level).matrix();
    for (Index i = 0; i < details.rows(); ++i) kept.push_back(details.row(i).isZero(0) ? 0 : 1);
  }
  return kept;
}

Index count_of(const Kept& kept) { return static_cast<Index>(std::ranges::count(kept, char{1})); }

class Approach {
 public:
  Approach(const Model& model, Distance distance, const Watch& watch)
      : model_(model), zeros_(zero_details(model)), curve_(model, distance, watch), watch_(watch) {}

  // Solved by least squares against the samples, as resolve() does.
  State start(const Kept& kept) const { return solved_by(solver(place_weights(model_), kept), kept, curve_.data()); }

  // Of all states that were met, the nearest.
  State values(State state) const {
    State best = state;
    for (const double power : powers) settle(state, power, settling_steps, best);
    return finished(std::move(best));
  }

  State choice(State state) const {
    State best = state;
    for (const double power : powers) {
      settle(state, power, settling_steps, best);
      exchange(state, power, best);
      settle(state, power, settling_steps, best);
    }
    return finished(std::move(best));
  }

  ModelPtr model_of(const State& state) const {
    return solved_model(model_.parts(), zeros_, state.kept, state.solution);
  }
  State state_of(const Model& sketch) const {
    State state{kept_in(sketch), {sketch.parts().polygon.matrix(), {}}, line(sketch, sketch.levels()), {}};
    state.solution.values = Lanes(count_of(state.kept), sketch.dimension());
    auto flag = state.kept.begin();
    Index value = 0;
    for (int level = 0; level < sketch.levels(); ++level) {
      const auto details = sketch.details(level).matrix();
      for (Index i = 0; i < details.rows(); ++i)
        if (*flag++) state.solution.values.row(value++) = details.row(i);
    }
    state.pulls = curve_.pulls(state.curve);
    return state;
  }

 private:
  State finished(State state) const {
    State best = state;
    for (const double power : last_powers) settle(state, power, settling_steps, best);
    return best;
  }

  TreeSolver solver(Eigen::VectorXd weights, const Kept& kept) const {
    TreeSolver solver(model_.shape(), model_.levels(), model_.closed(), std::move(weights));
    solver.factor(model_.filter().matrix(), kept, watch_);
    return solver;
  }

  State solved_by(const TreeSolver& solver, const Kept& kept, const Points& target) const {
    State state{kept, solver.solve(target, watch_), {}, {}};
    state.curve = solver.curve(state.solution, watch_);
    state.pulls = curve_.pulls(state.curve);
    return state;
  }

  // Reweighted least squares for the p-norm: the weights that make its gradient that of a weighted square.
  Eigen::VectorXd weights(const Pulls& pulls, double power) const {
    const Eigen::VectorXd squares = curve_.counted().cwiseAbs2();
    if (!(pulls.largest > 0)) return squares;
    const Eigen::ArrayXd relative = (pulls.distance / pulls.largest).array();
    return relative.pow(power - 2).max(least_weight).matrix().cwiseProduct(squares);
  }

  double norm(const Pulls& pulls, double power) const {
    if (!(pulls.largest > 0)) return 0;
    return pulls.largest * std::pow((pulls.distance / pulls.largest).array().pow(power).mean(), 1 / power);
  }

  std::vector<double> scores(const State& state, double power) const {
    const TreeSolver weighted = solver(weights(state.pulls, power), state.kept);
    return weighted.scores(state.pulls.target, weighted.solve(state.pulls.target, watch_), watch_);
  }

  State after(const State& state, const Kept& kept, double power) const {
    return solved_by(solver(weights(state.pulls, power), kept), kept, state.pulls.target);
  }

  // Steps of 2 / (p - 1) of the way to the weighted solution, halved while the norm does not fall: whole ones overshoot
  // (the norm's Hessian is p - 1 times the weighted square's). Returns the norm.
  double settle(State& state, double power, int steps, State& best) const {
    double now = norm(state.pulls, power);
    for (int step = 0; step < steps; ++step) {
      const TreeSolver weighted = solver(weights(state.pulls, power), state.kept);
      const Solution aim = weighted.solve(state.pulls.target, watch_);
      const Points there = weighted.curve(aim, watch_);
      const double before = now;
      double part = std::min(1.0, 2 / (power - 1));
      for (int halving = 0; halving < 4 && now == before; ++halving, part /= 2) {
        State next = towards(state, aim, there, part);
        const double nearer = norm(next.pulls, power);
        if (!(nearer < now)) continue;
        now = nearer;
        state = std::move(next);
      }
      if (state.pulls.largest < best.pulls.largest) best = state;
      if (!(now < better * before)) break;
    }
    return now;
  }

  // Part of the way to a solution and its curve.
  State towards(const State& from, const Solution& aim, const Points& curve, double part) const {
    State next{from.kept, from.solution, from.curve, {}};
    next.solution.control += part * (aim.control - from.solution.control);
    next.solution.values += part * (aim.values - from.solution.values);
    next.curve.matrix() += part * (curve.matrix() - from.curve.matrix());
    next.pulls = curve_.pulls(next.curve);
    return next;
  }

  // Subspace pursuit, as pursued() does it, for this norm: with more details than asked, then without those that are
  // missed least.
  void exchange(State& state, double power, State& best) const {
    const Index count = count_of(state.kept), all = static_cast<Index>(state.kept.size());
    if (count == 0 || count == all) return;
    double now = norm(state.pulls, power);
    Index more = std::max<Index>(1, count / 4);
    for (int trial = 0; trial < exchange_trials && more > 0; ++trial) {
      State wide = after(state, most_wished(state, power, std::min(more, all - count)), power);
      State none = wide;  // has more details than asked: never the best
      settle(wide, power, trial_steps, none);
      State next = after(wide, least_missed(wide, power, count_of(wide.kept) - count), power);
      State best_next = next;
      const double there = settle(next, power, trial_steps, best_next);
      if (best_next.pulls.largest < best.pulls.largest) best = std::move(best_next);
      if (there < better * now) {
        now = there;
        state = std::move(next);
      } else {
        more /= 2;
      }
    }
  }

  Kept most_wished(const State& state, double power, Index more) const {
    std::vector<double> wish = scores(state, power);
    for (std::size_t i = 0; i < wish.size(); ++i)
      if (state.kept[i]) wish[i] = std::numeric_limits<double>::infinity();
    return largest(wish, count_of(state.kept) + more);
  }

  Kept least_missed(const State& state, double power, Index fewer) const {
    std::vector<double> worth = scores(state, power);
    for (std::size_t i = 0; i < worth.size(); ++i)
      if (!state.kept[i]) worth[i] = -1;
    return largest(worth, count_of(state.kept) - fewer);
  }

  const Model& model_;
  std::vector<PointsPtr> zeros_;
  PullingCurve curve_;
  const Watch& watch_;
};

// Pulls see the middles of edges, and not what lies between.
ModelPtr nearer(const Model& model, const ModelPtr& a, const ModelPtr& b, Distance by, const Watch& watch) {
  return distance(*a, model, by, watch) <= distance(*b, model, by, watch) ? a : b;
}

}  // namespace

ModelPtr approach(const Model& model, const Kept& kept, Distance distance, const Watch& watch) {
  Approach approach(model, distance, watch);
  const State squares = approach.start(kept);
  return nearer(model, approach.model_of(approach.values(squares)), approach.model_of(squares), distance, watch);
}

ModelPtr approach_choice(const Model& model, const Kept& kept, Distance distance, const Watch& watch) {
  const ModelPtr squares = resolve_choice(model, kept, watch);
  Approach approach(model, distance, watch);
  return nearer(model, approach.model_of(approach.choice(approach.state_of(*squares))), squares, distance, watch);
}

}  // namespace ifsm::core
