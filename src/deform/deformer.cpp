#include "deform/deformer.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "curve/evaluate.h"
#include "deform/falloff.h"
#include "deform/handles.h"
#include "deform/leash.h"
#include "linalg/spectrum.h"

namespace ifsm::core {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

// F^-1 v, where the curve has not been drawn together so far that F has none.
Vector untold(const SmallMatrix& frame, const Vector& seen, int level) {
  if (frame == SmallMatrix::Identity(frame.rows(), frame.cols())) return seen;
  if (condition_number(frame) < 1 / (16 * epsilon)) return inverse(frame) * seen;
  throw Error(
      Status::numerical, "level",
      "level is " + std::to_string(level) +
          "; above what is to be moved there the curve is drawn together into a point, or flat, so that no move "
          "can be told. Draw it apart first, or move a coarser level.")
      .with(level);
}

SmallMatrix restyled(const Restyle& edit, double weight, Index dimension) {
  SmallMatrix map = (1 + weight * (edit.scale - 1)) * SmallMatrix::Identity(dimension, dimension);
  if (edit.mirror >= 0) map.row(edit.mirror) *= 1 - 2 * weight;
  if (edit.angle != 0) {
    SmallMatrix turned = SmallMatrix::Identity(dimension, dimension);
    const double c = std::cos(weight * edit.angle), s = std::sin(weight * edit.angle);
    turned.topLeftCorner(2, 2) << c, -s, s, c;
    map = (turned * map).eval();
  }
  return map;
}

}  // namespace

double Levels::weight(int level) const {
  const int away = std::max({0, first - level, level - last});
  if (away == 0) return share;
  if (away > fade) return 0;
  const double t = static_cast<double>(away) / (fade + 1);
  return share * (1 - t) * (1 - t) * (1 + 2 * t);
}

Deformer::Deformer(ModelPtr model, Manner manner) : model_(std::move(model)), manner_(manner) {
  State start{{model_->parts().polygon, std::vector<Moves>(static_cast<std::size_t>(model_->levels()) + 1)},
              own_look(*model_),
              std::make_shared<Base>(model_),
              nullptr,
              {}};
  history_.push_back(std::make_shared<const State>(std::move(start)));
}

Deformer::Logged::~Logged() {
  for (auto last = std::move(before); last && last.use_count() == 1;) last = std::exchange(last->before, nullptr);
}

void Deformer::step_to(State next) {
  auto made = std::make_shared<const State>(std::move(next));
  const auto needed = static_cast<std::size_t>(now_) + 2;
  if (history_.capacity() < needed) history_.reserve(2 * needed);  // before what was undone is forgotten: it may fail
  history_.resize(static_cast<std::size_t>(now_) + 1);
  history_.push_back(std::move(made));
  ++now_;
  touched_ = state().touched;
}

void Deformer::apply(const Edit& edit) {
  State next = state();
  next.touched = {};
  std::visit([&](const auto& one) { make(next, one); }, edit);
  require_finite(next.pose);
  next.log = std::make_shared<Logged>(Timed{edit, span_}, state().log);
  step_to(std::move(next));
}

void Deformer::require_finite(const Pose& pose) const {
  bool finite = pose.polygon.matrix().allFinite();
  const auto all = [&](const std::map<Index, Vector>& vectors) {
    for (const auto& [key, vector] : vectors) finite = finite && vector.allFinite();
  };
  for (const Moves& moves : pose.moves) all(moves.own), all(moves.field), all(moves.details);
  if (finite) return;
  throw Error(Status::numerical, "deformer",
              "The edits together move points beyond the range of doubles; move them by less.");
}

// What edits together have made of the curve is known when it is told.
Points Deformer::told(Points points) {
  if (points.matrix().allFinite()) return points;
  throw Error(Status::numerical, "deformer",
              "The edits have led the curve out of the range of doubles; undo some, or make them smaller.");
}

void Deformer::undo() {
  if (now_ == 0) throw Error(Status::range, "deformer", "There is no step to undo; ask how many there are first.");
  touched_ = state().touched;
  --now_;
}

void Deformer::redo() {
  if (redoable() == 0)
    throw Error(Status::range, "deformer", "There is no undone step to make again; an edit forgets them.");
  ++now_;
  touched_ = state().touched;
}

void Deformer::keep_as(const std::string& name) { named_[name] = history_[static_cast<std::size_t>(now_)]; }

void Deformer::go_to(const std::string& name) {
  const auto found = named_.find(name);
  if (found == named_.end())
    throw Error(Status::range, "name", "No state is kept as \"" + name + "\"; keep one by that name first.");
  State next = *found->second;
  next.touched = {};
  step_to(std::move(next));
}

void Deformer::time_by(const Span& span) {
  require_span(span);
  span_ = span;
}

std::optional<Span> Deformer::times() const {
  std::optional<Span> all;
  for (auto entry = state().log; entry; entry = entry->before) {
    const Span& span = entry->edit.span;
    if (!all) all = span;
    all = {std::min(all->begin, span.begin), std::max(all->end, span.end), Easing::linear};
  }
  return all;
}

Deformer Deformer::at_time(double time) const {
  core::require_finite(&time, 1, "time");
  Deformer frame = *this;  // states are shared
  frame.history_.resize(1);
  frame.now_ = 0;
  frame.touched_ = {};
  frame.named_.clear();
  for (const Timed& made : log()) {
    const double share = made.span.share(time);
    frame.span_ = made.span;
    if (share == 1) frame.apply(made.edit);
    if (share > 0 && share < 1)
      frame.apply(std::visit([&](const auto& edit) -> Edit { return frame.part(edit, share); }, made.edit));
  }
  frame.span_ = span_;
  return frame;
}

Move Deformer::part(Move edit, double share) const {
  if (std::exchange(edit.places, false)) {
    const Posed now = posed();
    for (Index i = 0; i < edit.vectors.count(); ++i) {
      auto vector = edit.vectors.matrix().row(i);
      vector =
          way_to(vector.transpose(), now.places(edit.level, edit.handles[static_cast<std::size_t>(i)], 1)).transpose();
    }
  }
  edit.vectors.matrix() *= share;
  return edit;
}

Pin Deformer::part(const Pin& edit, double) const { return edit; }

Drag Deformer::part(Drag edit, double share) const {
  const Points now = at(edit.parameters);
  edit.places.matrix() = (now.matrix() + share * (edit.places.matrix() - now.matrix())).eval();
  return edit;
}

Restyle Deformer::part(Restyle edit, double share) const {
  edit.levels.share *= share;
  return edit;
}

Texture Deformer::part(Texture edit, double share) const {
  edit.levels.share *= share;
  return edit;
}

void Deformer::replay(const std::vector<Timed>& edits) {
  Deformer after = *this;  // states are shared
  for (std::size_t i = 0; i < edits.size(); ++i) {
    const std::string entry = "edits[" + std::to_string(i) + "]";
    after.span_ = edits[i].span;
    try {
      require_span(edits[i].span);
      after.apply(edits[i].edit);
    } catch (const Error& error) {
      throw Error(error.status(), entry + "." + error.argument(), entry + ": " + error.what())
          .at(error.index())
          .with(error.value())
          .needs(error.required());
    }
  }
  after.span_ = span_;
  *this = std::move(after);
}

std::vector<Timed> Deformer::log() const {
  std::vector<Timed> edits;
  for (auto entry = state().log; entry; entry = entry->before) edits.push_back(entry->edit);
  std::ranges::reverse(edits);
  return edits;
}

Index Deformer::edits() const {
  Index count = 0;
  for (auto entry = state().log; entry; entry = entry->before) ++count;
  return count;
}

int Deformer::checked_level(int level, int most) const { return static_cast<int>(in_range(level, 0, most, "level")); }

Index Deformer::handle_count(int level) const { return model_->shape().places(level, model_->closed()); }

void Deformer::check_handles(int level, const std::vector<Index>& handles) const {
  const Index count = handle_count(level);
  std::set<Index> named;
  for (std::size_t i = 0; i < handles.size(); ++i) {
    const bool there = handles[i] >= 0 && handles[i] < count;
    if (there && named.insert(handles[i]).second) continue;
    throw Error(
        Status::range, "handles",
        "handles[" + std::to_string(i) + "] is " + std::to_string(handles[i]) +
            (there ? ", for the second time; name each once."
                   : "; level " + std::to_string(level) + " has handles 0 to " + std::to_string(count - 1) + "."))
        .at(static_cast<Index>(i))
        .with(static_cast<double>(handles[i]));
  }
}

Deformer::Touched Deformer::nodes_of(int level, const std::vector<Index>& handles) const {
  if (handles.empty() || level == 0) return {};
  const Handles all(model_->shape(), model_->closed(), level);
  Touched touched{level, model_->shape().nodes(level) - 1, 0};
  for (const Index handle : handles)
    for (const Seat& seat : all.seats(handle)) {
      touched.first = std::min(touched.first, seat.node);
      touched.last = std::max(touched.last, seat.node);
    }
  return touched;
}

// A place that is given back as it was read is no move, which adding and subtracting the centre need not give.
Vector Deformer::way_to(const Vector& place, const Points& now) const {
  const auto& center = model_->parts().center;
  if (from_center(now, center).matrix().row(0).transpose() == place) return Vector::Zero(place.size());
  return place - Eigen::Map<const Eigen::VectorXd>(center.data(), place.size()) - now.matrix().row(0).transpose();
}

void Deformer::make(State& next, const Move& edit) const {
  checked_level(edit.level, model_->levels());
  check_handles(edit.level, edit.handles);
  const auto level = static_cast<std::size_t>(edit.level);
  require_vectors(edit.vectors, static_cast<Index>(edit.handles.size()), "vectors");
  if (edit.falloff != Falloff::none && !(edit.radius > 0 && std::isfinite(edit.radius)))
    throw Error(Status::range, "radius",
                "radius is " + text_of(edit.radius) + "; a falloff reaches some way: give more than 0.")
        .with(edit.radius);
  for (std::size_t i = 0; i < edit.handles.size(); ++i)
    if (state().pose.moves[level].pins.contains(edit.handles[i]))
      throw Error(Status::range, "handles",
                  "handles[" + std::to_string(i) + "], " + std::to_string(edit.handles[i]) +
                      ", is pinned; let it go before you move it.")
          .at(static_cast<Index>(i))
          .with(static_cast<double>(edit.handles[i]));
  if (edit.handles.empty()) return;

  const Posed now = posed();
  std::map<Index, Vector> moved;
  for (std::size_t i = 0; i < edit.handles.size(); ++i) {
    const Index handle = edit.handles[i];
    const Vector told = edit.vectors.matrix().row(static_cast<Index>(i)).transpose();
    moved[handle] = edit.places ? way_to(told, now.places(edit.level, handle, 1)) : told;
  }
  if (edit.falloff != Falloff::none) {
    moved = spread_by_falloff(moved, now.places(edit.level, 0, handle_count(edit.level)), model_->closed(),
                              edit.falloff, edit.ruler, edit.radius);
    for (const auto& [handle, pin] : state().pose.moves[level].pins) moved.erase(handle);
  }
  std::vector<Index> all;
  for (const auto& [handle, by] : moved) {
    all.push_back(handle);
    const bool turns = edit.level > 0 && edit.reach == Reach::nodes;
    displace(next, edit.level, handle, by, edit.reach, turns ? now.frame(edit.level, handle) : now.whole());
  }
  if (edit.reach == Reach::nodes) next.touched = nodes_of(edit.level, all);
}

// By a vector as it is seen, told in a frame.
void Deformer::displace(State& next, int level, Index handle, const Vector& by, Reach reach,
                        const SmallMatrix& frame) const {
  if (level == 0) {
    for (const Seat& seat : Handles(model_->shape(), model_->closed(), 0).seats(handle))
      next.pose.polygon.matrix().row(seat.point) += by.transpose();
    return;
  }
  Moves& all = next.pose.moves[static_cast<std::size_t>(level)];
  auto& moves = reach == Reach::curve ? all.field : all.own;
  moves.try_emplace(handle, Vector::Zero(by.size())).first->second += untold(frame, by, level);
}

void Deformer::require_vectors(const Points& vectors, Index count, const char* argument) const {
  if (vectors.count() != count || (count > 0 && vectors.dimension() != model_->dimension()))
    throw Error(Status::shape, argument,
                std::string(argument) + " must be " + std::to_string(count) + " of dimension " +
                    std::to_string(model_->dimension()) + ".")
        .needs(count * model_->dimension());
  for (Index axis = 0; axis < vectors.dimension(); ++axis)
    core::require_finite(vectors.plane(axis).data(), vectors.count(), argument);
}

// From the centre.
Points Deformer::points_at(const Posed& posed, const std::vector<double>& parameters) const {
  Points all(model_->dimension(), static_cast<Index>(parameters.size()));
  const Index count = handle_count(model_->levels());
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const double position = model_->placement().position(parameters[k]), first = std::floor(position);
    const auto place = static_cast<Index>(first);
    const bool between = position > first, together = between && place + 1 < count;
    const Points ends = posed.places(model_->levels(), place, together ? 2 : 1);
    auto point = all.matrix().row(static_cast<Index>(k));
    point = ends.matrix().row(0);
    if (!between) continue;
    const Points next = together ? Points() : posed.places(model_->levels(), 0, 1);  // a ring's first
    point += (position - first) * ((together ? ends.matrix().row(1) : next.matrix().row(0)) - point);
  }
  return all;
}

Points Deformer::at(const std::vector<double>& parameters) const {
  return told(from_center(points_at(posed(), parameters), model_->parts().center));
}

void Deformer::make(State& next, const Pin& edit) const {
  checked_level(edit.level, model_->levels());
  check_handles(edit.level, edit.handles);
  auto& pins = next.pose.moves[static_cast<std::size_t>(edit.level)].pins;
  const Posed now = posed();
  for (const Index handle : edit.handles)
    if (edit.hold)
      pins[handle] = now.places(edit.level, handle, 1).matrix().row(0).transpose();
    else
      pins.erase(handle);
  next.touched = nodes_of(edit.level, edit.handles);
}

void Deformer::check_drag(const Drag& edit) const {
  if (!model_->shape().joined())
    throw Error(Status::shape, "deformer",
                "The model is square: its places are means of several polygons. Move its handles instead.");
  checked_level(edit.level, edit.lead == Lead::details ? model_->levels() - 1 : model_->levels());
  require_parameters(*model_, edit.parameters);
  require_vectors(edit.places, static_cast<Index>(edit.parameters.size()), "places");
}

// Whatever is found is a combination of the linear problem's rows, so that nothing changes less and ends so.
void Deformer::make(State& next, const Drag& edit) const {
  check_drag(edit);
  if (edit.parameters.empty()) return;
  const bool handles = edit.lead == Lead::handles;
  std::vector<Shares> shares;
  for (const double t : edit.parameters)
    shares.push_back(handles ? handle_shares(*model_, edit.level, t) : detail_shares(*model_, edit.level, t));
  const auto& pins = state().pose.moves[static_cast<std::size_t>(edit.level)].pins;
  const Leash leash(shares, handles ? pins : std::map<Index, Vector>());
  const Posed before = posed();
  const Eigen::MatrixXd wanted = to_center(edit.places, model_->parts().center).matrix();
  std::map<Index, SmallMatrix> frames;
  for (const Index value : leash.values())
    frames[value] = !handles          ? before.turn_at(edit.level, value / model_->shape().details_per_node())
                    : edit.level == 0 ? before.whole()
                                      : before.frame(edit.level, value);
  const auto left = [&](const Eigen::MatrixXd& ways) -> Eigen::MatrixXd {
    next.pose = state().pose;
    for (const auto& [value, by] : leash.changes(ways)) lead(next, edit, value, by, frames.at(value));
    return wanted - points_at(Posed(*next.base, next.pose, manner_), edit.parameters).matrix();
  };
  const double close = 2e-13 * (model_->parts().diagonal + wanted.cwiseAbs().maxCoeff());
  if (!find_ways(left, wanted.rows(), wanted.cols(), close))
    throw Error(
        Status::numerical, "places",
        "The points could not be led there: the texture turns more than it is led. Lead by details, or less far.");
  if (handles) next.touched = nodes_of(edit.level, leash.values());
}

void Deformer::lead(State& next, const Drag& edit, Index value, const Vector& by, const SmallMatrix& frame) const {
  if (edit.lead == Lead::handles) return displace(next, edit.level, value, by, Reach::nodes, frame);
  auto& details = next.pose.moves[static_cast<std::size_t>(edit.level)].details;
  details.try_emplace(value, Vector::Zero(by.size())).first->second += untold(frame, by, edit.level);
}

void Deformer::check_levels(const Levels& levels) const {
  if (model_->levels() == 0)
    throw Error(Status::range, "first",
                "The model has no levels, hence no details to look otherwise; make it with more levels.");
  in_range(levels.first, 0, model_->levels() - 1, "first");
  in_range(levels.last, levels.first, model_->levels() - 1, "last");
  in_range(levels.fade, 0, 64, "fade");
  if (!(levels.share >= 0 && levels.share <= 1))
    throw Error(Status::range, "share", "share is " + text_of(levels.share) + "; give what is made, from 0 to 1.")
        .with(levels.share);
}

void Deformer::make(State& next, const Restyle& edit) const {
  check_levels(edit.levels);
  core::require_finite(&edit.scale, 1, "scale");
  constexpr double most_scale = 1e12;  // beyond, what is left of the polygons below is rounding
  if (std::abs(edit.scale) > most_scale)
    throw Error(Status::range, "scale",
                "scale is " + text_of(edit.scale) + "; give a factor from -1e12 to 1e12, or scale the whole model.")
        .with(edit.scale);
  core::require_finite(&edit.angle, 1, "angle");
  in_range(edit.mirror + 1, 0, model_->dimension(), "mirror");  // as the C ABI and files count axes
  if (edit.angle != 0 && model_->dimension() == 1)
    throw Error(Status::range, "angle", "The curve has one dimension, and nothing to turn in: leave the angle at 0.")
        .with(edit.angle);
  for (int level = 0; level < model_->levels(); ++level)
    if (const double weight = edit.levels.weight(level); weight > 0) {
      SmallMatrix& map = next.look[static_cast<std::size_t>(level)].map;
      map = (restyled(edit, weight, model_->dimension()) * map).eval();
    }
  next.base = std::make_shared<Base>(dressed(*model_, next.look));
}

void Deformer::make(State& next, const Texture& edit) const {
  check_texture(edit);
  for (int level = 0; level < model_->levels(); ++level) {
    const PointsPtr fresh = texture(edit, level);
    if (!fresh) continue;
    const double weight = edit.levels.weight(level);
    auto& look = next.look[static_cast<std::size_t>(level)];
    PointsPtr details = fresh;
    if (weight < 1) {
      auto blend = std::make_shared<Points>(look.details ? *look.details : model_->details(level));
      blend->matrix() = (blend->matrix() * look.map.transpose()).eval();
      blend->matrix() += weight * (fresh->matrix() - blend->matrix());
      details = std::move(blend);
    }
    look = {SmallMatrix::Identity(model_->dimension(), model_->dimension()), std::move(details)};  // as they are told
  }
  next.base = std::make_shared<Base>(dressed(*model_, next.look));
}

PointsPtr Deformer::texture(const Texture& edit, int level) const {
  if (!(edit.levels.weight(level) > 0)) return nullptr;
  const auto at = static_cast<std::size_t>(level);
  if (!edit.told.empty()) return at < edit.told.size() ? edit.told[at] : nullptr;
  if (edit.from) return level < edit.from->levels() ? borrowed_texture(*model_, level, *edit.from) : nullptr;
  const double size = edit.size > 0 ? edit.size : texture_size(model_->details(edit.levels.first));
  const auto finer = static_cast<double>(level - edit.levels.first);
  return random_texture(
      *model_, level, size * std::pow(static_cast<double>(model_->shape().maps()), -edit.roughness * finer), edit.seed);
}

void Deformer::check_texture(const Texture& edit) const {
  check_levels(edit.levels);
  core::require_finite(&edit.roughness, 1, "roughness");
  constexpr double most_roughness =
      8;  // of measured curves: 0 … 1; beyond this, a level is nothing beside its neighbour
  if (std::abs(edit.roughness) > most_roughness)
    throw Error(Status::range, "roughness",
                "roughness is " + text_of(edit.roughness) + "; give an exponent from -8 to 8, of a coast about 0.8.")
        .with(edit.roughness);
  if (!(edit.size >= 0 && std::isfinite(edit.size)))
    throw Error(Status::range, "size", "size is " + text_of(edit.size) + "; give a length, or 0 for the curve's own.")
        .with(edit.size);
  if (edit.from) {
    if (!(edit.from->shape() == model_->shape()) || edit.from->dimension() != model_->dimension())
      throw Error(Status::shape, "from",
                  "from has another topology, number of control points or maps, or another dimension; texture can be "
                  "borrowed from models of the same.");
    if (edit.from->levels() <= edit.levels.last)
      throw Error(Status::range, "last",
                  "last is " + std::to_string(edit.levels.last) +
                      "; the model that texture is taken from has levels 0 to " +
                      std::to_string(edit.from->levels() - 1) + ".")
          .with(edit.levels.last);
  }
  for (std::size_t level = 0; level < edit.told.size(); ++level)
    if (edit.told[level] && (static_cast<int>(level) >= model_->levels() ||
                             edit.told[level]->count() != model_->details(static_cast<int>(level)).count() ||
                             edit.told[level]->dimension() != model_->dimension()))
      throw Error(
          Status::shape, "details",
          "details[" + std::to_string(level) + "] are not as many as the model's level has, or of another dimension.")
          .at(static_cast<Index>(level));
}

Index Deformer::count(int level) const { return handle_count(checked_level(level, model_->levels())); }

void Deformer::check_window(int level, Index first, Index number) const {
  const Index all = count(level);
  in_range(first, 0, all, "first");
  in_range(number, 0, all - first, "number");
}

Points Deformer::places(int level, Index first, Index count) const {
  check_window(level, first, count);
  if (count == 0) return {model_->dimension(), 0};
  return told(from_center(posed().places(level, first, count), model_->parts().center));
}

Points Deformer::samples() const {
  return model_->placement().pick(places(model_->levels(), 0, count(model_->levels())));
}

Deformer::Window Deformer::changed(int level) const {
  const Index all = count(level);
  if (touched_.level == 0) return {0, all};
  const Index above = touched_.level > level ? model_->shape().nodes(touched_.level - level) : 1;
  const Index below = touched_.level < level ? model_->shape().nodes(level - touched_.level) : 1;
  const auto run = Handles(model_->shape(), model_->closed(), level)
                       .held_by(touched_.first * below / above, touched_.last / above * below + below - 1);
  return run.first + run.count > all ? Window{0, all} : Window{run.first, run.count};
}

ModelPtr Deformer::snapshot() const {
  ModelPtr made = posed().snapshot();
  told(core::samples(*made));
  return made;
}

}  // namespace ifsm::core
