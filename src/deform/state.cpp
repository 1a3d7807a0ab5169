#include "deform/state.h"

#include <algorithm>
#include <string>
#include <utility>

#include "curve/evaluate.h"
#include "deform/handles.h"

namespace ifsm::core {
namespace {

// What edits together have made of the curve is known when it is told.
Points told(Points points) {
  if (points.matrix().allFinite()) return points;
  throw Error(Status::numerical, "deformer",
              "The edits have led the curve out of the range of doubles; undo some, or make them smaller.");
}

}  // namespace

Window Touched::places(const Model& model, int of) const {
  const Shape& shape = model.shape();
  const Index all = shape.places(of, model.closed());
  if (level == 0) return {0, all};
  const Index above = level > of ? shape.nodes(level - of) : 1, below = level < of ? shape.nodes(of - level) : 1;
  const auto run = Handles(shape, model.closed(), of).held_by(first * below / above, last / above * below + below - 1);
  return run.first + run.count > all ? Window{0, all} : Window{run.first, run.count};
}

State::State(ModelPtr of, Manner in)
    : model(std::move(of)),
      manner(in),
      pose{model->parts().polygon, std::vector<Moves>(static_cast<std::size_t>(model->levels()) + 1)},
      look(own_look(*model)),
      base(std::make_shared<Base>(model)) {}

Index State::count(int level) const {
  in_range(level, 0, model->levels(), "level");
  return model->shape().places(level, model->closed());
}

void State::check_window(int level, Index first, Index number) const {
  const Index all = count(level);
  in_range(first, 0, all, "first");
  in_range(number, 0, all - first, "number");
}

Points State::places(int level, Index first, Index number) const {
  check_window(level, first, number);
  if (number == 0) return {model->dimension(), 0};
  return told(from_center(posed().places(level, first, number), model->parts().center));
}

Points State::at(const std::vector<double>& parameters) const {
  return told(from_center(points_at(*model, posed(), parameters), model->parts().center));
}

Points State::samples() const { return model->placement().pick(places(model->levels(), 0, count(model->levels()))); }

ModelPtr State::snapshot() const {
  ModelPtr made = posed().snapshot();
  told(core::samples(*made));
  return made;
}

Points points_at(const Model& model, const Posed& posed, const std::vector<double>& parameters) {
  Points all(model.dimension(), static_cast<Index>(parameters.size()));
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const auto [place, next, part] = model.placement().between(parameters[k]);
    const bool together = part > 0 && next == place + 1;  // one walk tells both
    const Points first = posed.places(model.levels(), place, together ? 2 : 1);
    auto point = all.matrix().row(static_cast<Index>(k));
    point = first.matrix().row(0);
    if (part == 0) continue;
    const Points second = together ? Points() : posed.places(model.levels(), next, 1);
    point = (1 - part) * point + part * (together ? first.matrix().row(1) : second.matrix().row(0));
  }
  return all;
}

void require_finite(const Pose& pose) {
  bool finite = pose.polygon.matrix().allFinite();
  const auto all = [&](const std::map<Index, Vector>& vectors) {
    for (const auto& [key, vector] : vectors) finite = finite && vector.allFinite();
  };
  for (const Moves& moves : pose.moves) all(moves.own), all(moves.field), all(moves.details);
  if (finite) return;
  throw Error(Status::numerical, "deformer",
              "The edits together move points beyond the range of doubles; move them by less.");
}

}  // namespace ifsm::core
