#include "deform/dragging.h"

#include <map>
#include <vector>

#include "curve/evaluate.h"
#include "deform/leash.h"
#include "deform/moving.h"

namespace ifsm::core {
namespace {

void check(const State& now, const Drag& edit) {
  const Model& model = *now.model;
  if (edit.lead == Lead::details && model.levels() == 0)
    throw Error(Status::range, "lead", "The model has no levels, hence no details to lead by; lead by handles.")
        .with(static_cast<double>(edit.lead));
  in_range(edit.level, 0, edit.lead == Lead::details ? model.levels() - 1 : model.levels(), "level");
  require_parameters(model, edit.parameters);
  require_vectors(model, edit.places, static_cast<Index>(edit.parameters.size()), "places");
}

Leash leash_of(const State& now, const Drag& edit) {
  const bool handles = edit.lead == Lead::handles;
  std::vector<Shares> shares;
  for (const double t : edit.parameters)
    shares.push_back(handles ? handle_shares(*now.model, edit.level, t) : detail_shares(*now.model, edit.level, t));
  const auto& pins = now.pose.moves[static_cast<std::size_t>(edit.level)].pins;
  return {shares, handles ? pins : std::map<Index, Vector>()};
}

// What a handle, or a detail, is told in.
SmallMatrix frame_of(const State& now, const Posed& posed, const Drag& edit, Index value) {
  if (edit.lead == Lead::details) return posed.turn_at(edit.level, value / now.model->shape().details_per_node());
  return edit.level == 0 ? posed.whole() : posed.frame(edit.level, value);
}

void lead(State& next, const Drag& edit, Index value, const Vector& by, const SmallMatrix& frame) {
  if (edit.lead == Lead::handles) return displace(next, edit.level, value, by, Reach::nodes, frame);
  auto& details = next.pose.moves[static_cast<std::size_t>(edit.level)].details;
  details.try_emplace(value, Vector::Zero(by.size())).first->second += untold(frame, by, edit.level);
}

}  // namespace

// Whatever is found is a combination of the linear problem's rows, so that nothing changes less and ends so.
Edited after(const State& now, const Drag& edit) {
  check(now, edit);
  Edited next{now};
  if (edit.parameters.empty()) return next;
  const Leash leash = leash_of(now, edit);
  const Posed posed = now.posed();
  std::map<Index, SmallMatrix> frames;
  for (const Index value : leash.values()) frames[value] = frame_of(now, posed, edit, value);
  const Eigen::MatrixXd wanted = to_center(edit.places, now.model->parts().center).matrix();
  const auto left = [&](const Eigen::MatrixXd& ways) -> Eigen::MatrixXd {
    next.state.pose = now.pose;
    for (const auto& [value, by] : leash.changes(ways)) lead(next.state, edit, value, by, frames.at(value));
    return wanted - points_at(*now.model, next.state.posed(), edit.parameters).matrix();
  };
  const double close = 2e-13 * (now.model->parts().diagonal + wanted.cwiseAbs().maxCoeff());
  if (!find_ways(left, wanted.rows(), wanted.cols(), close))
    throw Error(
        Status::numerical, "places",
        "The points could not be led there: the texture turns more than it is led. Lead by details, or less far.");
  if (edit.lead == Lead::handles) next.touched = nodes_of(*now.model, edit.level, leash.values());
  return next;
}

Drag part(const State& now, Drag edit, double share) {
  const Points here = now.at(edit.parameters);
  edit.places.matrix() = (here.matrix() + share * (edit.places.matrix() - here.matrix())).eval();
  return edit;
}

}  // namespace ifsm::core
