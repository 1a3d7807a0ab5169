#include "deform/moving.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "deform/falloff.h"
#include "deform/handles.h"
#include "linalg/spectrum.h"

namespace ifsm::core {
namespace {

Error refused(std::size_t i, Index handle, const std::string& why) {
  return Error(Status::range, "handles", "handles[" + std::to_string(i) + "] is " + std::to_string(handle) + why)
      .at(static_cast<Index>(i))
      .with(static_cast<double>(handle));
}

void check_handles(const State& now, int level, const std::vector<Index>& handles) {
  const Index count = now.count(level);
  std::set<Index> named;
  for (std::size_t i = 0; i < handles.size(); ++i) {
    if (handles[i] < 0 || handles[i] >= count)
      throw refused(i, handles[i],
                    "; level " + std::to_string(level) + " has handles 0 to " + std::to_string(count - 1) + ".");
    if (!named.insert(handles[i]).second) throw refused(i, handles[i], ", for the second time; name each once.");
  }
}

void check(const State& now, const Move& edit) {
  check_handles(now, edit.level, edit.handles);
  require_vectors(*now.model, edit.vectors, static_cast<Index>(edit.handles.size()), "vectors");
  if (edit.falloff != Falloff::none && !(edit.radius > 0 && std::isfinite(edit.radius)))
    throw Error(Status::range, "radius",
                "radius is " + text_of(edit.radius) + "; a falloff reaches some way: give more than 0.")
        .with(edit.radius);
  if (edit.falloff == Falloff::none && edit.radius != 0)
    throw Error(Status::range, "radius",
                "radius is " + text_of(edit.radius) + " without a falloff; choose one, or leave the radius 0.")
        .with(edit.radius);
  const auto& pins = now.pose.moves[static_cast<std::size_t>(edit.level)].pins;
  for (std::size_t i = 0; i < edit.handles.size(); ++i)
    if (pins.contains(edit.handles[i]))
      throw refused(i, edit.handles[i], ", which is pinned; let it go before you move it.");
}

// A place that is given back as it was read is no move, which adding and subtracting the centre need not give.
Vector way_to(const Model& model, const Vector& place, const Points& now) {
  const auto& center = model.parts().center;
  if (from_center(now, center).matrix().row(0).transpose() == place) return Vector::Zero(place.size());
  return place - Eigen::Map<const Eigen::VectorXd>(center.data(), place.size()) - now.matrix().row(0).transpose();
}

// By how much each handle moves that the edit names.
Points ways(const State& now, const Move& edit) {
  if (!edit.places) return edit.vectors;
  const Posed posed = now.posed();
  Points ways = edit.vectors;
  for (Index i = 0; i < ways.count(); ++i) {
    auto way = ways.matrix().row(i);
    way = way_to(*now.model, way.transpose(), posed.places(edit.level, edit.handles[static_cast<std::size_t>(i)], 1))
              .transpose();
  }
  return ways;
}

}  // namespace

Edited after(const State& now, const Move& edit) {
  check(now, edit);
  Edited next{now};
  const Points told = ways(now, edit);
  std::map<Index, Vector> moved;
  for (std::size_t i = 0; i < edit.handles.size(); ++i)
    moved[edit.handles[i]] = told.matrix().row(static_cast<Index>(i)).transpose();
  const Posed posed = now.posed();
  if (edit.falloff != Falloff::none) {
    moved = spread_by_falloff(moved, posed.places(edit.level, 0, now.count(edit.level)), now.model->closed(),
                              edit.falloff, edit.ruler, edit.radius);
    for (const auto& [handle, pin] : now.pose.moves[static_cast<std::size_t>(edit.level)].pins) moved.erase(handle);
  }
  std::vector<Index> all;
  for (const auto& [handle, by] : moved) {
    all.push_back(handle);
    const bool turns = edit.level > 0 && edit.reach == Reach::nodes;
    displace(next.state, edit.level, handle, by, edit.reach, turns ? posed.frame(edit.level, handle) : posed.whole());
  }
  if (edit.reach == Reach::nodes) next.touched = nodes_of(*now.model, edit.level, all);
  return next;
}

Edited after(const State& now, const Pin& edit) {
  check_handles(now, edit.level, edit.handles);
  Edited next{now, nodes_of(*now.model, edit.level, edit.handles)};
  auto& pins = next.state.pose.moves[static_cast<std::size_t>(edit.level)].pins;
  const Posed posed = now.posed();
  for (const Index handle : edit.handles)
    if (edit.hold)
      pins[handle] = posed.places(edit.level, handle, 1).matrix().row(0).transpose();
    else
      pins.erase(handle);
  return next;
}

Move part(const State& now, Move edit, double share) {
  edit.vectors = ways(now, edit);
  edit.vectors.matrix() *= share;
  edit.places = false;
  return edit;
}

Pin part(const State&, Pin edit, double) { return edit; }

void displace(State& next, int level, Index handle, const Vector& by, Reach reach, const SmallMatrix& frame) {
  if (level == 0) {
    for (const Seat& seat : Handles(next.model->shape(), next.model->closed(), 0).seats(handle))
      next.pose.polygon.matrix().row(seat.point) += by.transpose();
    return;
  }
  Moves& all = next.pose.moves[static_cast<std::size_t>(level)];
  auto& moves = reach == Reach::curve ? all.field : all.own;
  moves.try_emplace(handle, Vector::Zero(by.size())).first->second += untold(frame, by, level);
}

Vector untold(const SmallMatrix& frame, const Vector& seen, int level) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  if (frame == identity(frame.rows())) return seen;
  if (condition_number(frame) < 1 / (16 * epsilon)) return inverse(frame) * seen;
  throw Error(
      Status::numerical, "level",
      "level is " + std::to_string(level) +
          "; above what is to be moved there the curve is drawn together into a point, or flat, so that no move "
          "can be told. Draw it apart first, or move a coarser level.")
      .with(level);
}

Touched nodes_of(const Model& model, int level, const std::vector<Index>& handles) {
  if (handles.empty() || level == 0) return {};
  const Handles all(model.shape(), model.closed(), level);
  Touched touched{level, model.shape().nodes(level) - 1, 0};
  for (const Index handle : handles)
    for (const Seat& seat : all.seats(handle)) {
      touched.first = std::min(touched.first, seat.node);
      touched.last = std::max(touched.last, seat.node);
    }
  return touched;
}

void require_vectors(const Model& model, const Points& vectors, Index count, const char* argument) {
  if (vectors.count() != count || (count > 0 && vectors.dimension() != model.dimension()))
    throw Error(Status::shape, argument,
                std::string(argument) + " are " + std::to_string(vectors.count()) + " of dimension " +
                    std::to_string(vectors.dimension()) + " and must be " + std::to_string(count) + " of dimension " +
                    std::to_string(model.dimension()) + ".")
        .with(static_cast<double>(vectors.count()))
        .needs(count * model.dimension());
  for (Index axis = 0; axis < vectors.dimension(); ++axis)
    require_finite(vectors.plane(axis).data(), vectors.count(), argument);
}

}  // namespace ifsm::core
