#include "deform/dressing.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace ifsm::core {
namespace {

SmallMatrix restyled(const Restyle& edit, double weight, Index dimension) {
  SmallMatrix map = (1 + weight * (edit.scale - 1)) * identity(dimension);
  if (edit.mirror >= 0) map.row(edit.mirror) *= 1 - 2 * weight;
  if (edit.angle != 0) {
    SmallMatrix turned = identity(dimension);
    const double c = std::cos(weight * edit.angle), s = std::sin(weight * edit.angle);
    turned.topLeftCorner(2, 2) << c, -s, s, c;
    map = (turned * map).eval();
  }
  return map;
}

void check(const Model& model, const Levels& levels) {
  if (model.levels() == 0)
    throw Error(Status::range, "first",
                "The model has no levels, hence no details to look otherwise; make it with more levels.");
  in_range(levels.first, 0, model.levels() - 1, "first");
  in_range(levels.last, levels.first, model.levels() - 1, "last");
  in_range(levels.fade, 0, 64, "fade");
  if (!(levels.share >= 0 && levels.share <= 1))
    throw Error(Status::range, "share", "share is " + text_of(levels.share) + "; give what is made, from 0 to 1.")
        .with(levels.share);
}

void check(const Model& model, const Restyle& edit) {
  check(model, edit.levels);
  require_finite(edit.scale, "scale");
  constexpr double most_scale = 1e12;  // beyond, what is left of the polygons below is rounding
  if (std::abs(edit.scale) > most_scale)
    throw Error(Status::range, "scale",
                "scale is " + text_of(edit.scale) + "; give a factor from -1e12 to 1e12, or scale the whole model.")
        .with(edit.scale);
  require_finite(edit.angle, "angle");
  in_range(edit.mirror + 1, 0, model.dimension(), "mirror");  // as the C ABI and files count axes
  if (edit.angle != 0 && model.dimension() == 1)
    throw Error(Status::range, "angle", "The curve has one dimension, and nothing to turn in: leave the angle at 0.")
        .with(edit.angle);
}

void check_lender(const Model& model, const Model& from, int last) {
  if (!(from.shape() == model.shape()) || from.dimension() != model.dimension())
    throw Error(Status::shape, "from",
                "from has another topology, number of control points or maps, or another dimension; texture can be "
                "borrowed from models of the same.");
  if (from.levels() <= last)
    throw Error(Status::range, "last",
                "last is " + std::to_string(last) + "; the model that texture is taken from has levels 0 to " +
                    std::to_string(from.levels() - 1) + ".")
        .with(last);
}

void check_told(const Model& model, const std::vector<PointsPtr>& told) {
  for (std::size_t at = 0; at < told.size(); ++at) {
    const auto level = static_cast<int>(at);
    if (!told[at]) continue;
    if (level < model.levels() && told[at]->count() == model.details(level).count() &&
        told[at]->dimension() == model.dimension())
      continue;
    const std::string needed = level >= model.levels()
                                   ? "the model has no such level"
                                   : "the level has " + std::to_string(model.details(level).count()) +
                                         " of dimension " + std::to_string(model.dimension());
    throw Error(Status::shape, "details",
                "details[" + std::to_string(at) + "] are " + std::to_string(told[at]->count()) + " of dimension " +
                    std::to_string(told[at]->dimension()) + "; " + needed + ".")
        .with(static_cast<double>(told[at]->count()))
        .at(level);
  }
}

void check(const Model& model, const Texture& edit) {
  check(model, edit.levels);
  require_finite(edit.roughness, "roughness");
  constexpr double most_roughness = 8;  // of measured curves: 0 … 1; beyond it a level is nothing beside its neighbour
  if (std::abs(edit.roughness) > most_roughness)
    throw Error(Status::range, "roughness",
                "roughness is " + text_of(edit.roughness) + "; give an exponent from -8 to 8, of a coast about 0.8.")
        .with(edit.roughness);
  if (!(edit.size >= 0 && std::isfinite(edit.size)))
    throw Error(Status::range, "size", "size is " + text_of(edit.size) + "; give a length, or 0 for the curve's own.")
        .with(edit.size);
  if (edit.from) check_lender(model, *edit.from, edit.levels.last);
  check_told(model, edit.told);
}

// A level's details, on the way from what they look like to others.
PointsPtr blended(const Model& model, int level, const LevelLook& look, const PointsPtr& fresh, double weight) {
  if (weight == 1) return fresh;
  auto blend = std::make_shared<Points>(look.details ? *look.details : model.details(level));
  blend->matrix() = (blend->matrix() * look.map.transpose()).eval();
  blend->matrix() += weight * (fresh->matrix() - blend->matrix());
  return blend;
}

Edited in_look(const State& now, Look look) {
  Edited next{now};
  next.state.base = std::make_shared<Base>(dressed(*now.model, look));
  next.state.look = std::move(look);
  return next;
}

}  // namespace

double Levels::weight(int level) const {
  const int away = std::max({0, first - level, level - last});
  if (away == 0) return share;
  if (away > fade) return 0;
  const double t = static_cast<double>(away) / (fade + 1);
  return share * (1 - t) * (1 - t) * (1 + 2 * t);
}

Edited after(const State& now, const Restyle& edit) {
  check(*now.model, edit);
  Look look = now.look;
  for (int level = 0; level < now.model->levels(); ++level)
    if (const double weight = edit.levels.weight(level); weight > 0) {
      SmallMatrix& map = look[static_cast<std::size_t>(level)].map;
      map = (restyled(edit, weight, now.model->dimension()) * map).eval();
    }
  return in_look(now, std::move(look));
}

Edited after(const State& now, const Texture& edit) {
  const Model& model = *now.model;
  check(model, edit);
  Look look = now.look;
  for (int level = 0; level < model.levels(); ++level)
    if (const PointsPtr fresh = texture(model, edit, level)) {
      LevelLook& own = look[static_cast<std::size_t>(level)];
      own.details = blended(model, level, own, fresh, edit.levels.weight(level));
      own.map.setIdentity();  // as they are told
    }
  return in_look(now, std::move(look));
}

Restyle part(const State&, Restyle edit, double share) {
  edit.levels.share *= share;
  return edit;
}

Texture part(const State&, Texture edit, double share) {
  edit.levels.share *= share;
  return edit;
}

PointsPtr texture(const Model& model, const Texture& edit, int level) {
  if (!(edit.levels.weight(level) > 0)) return nullptr;
  const auto at = static_cast<std::size_t>(level);
  if (!edit.told.empty()) return at < edit.told.size() ? edit.told[at] : nullptr;
  if (edit.from) return level < edit.from->levels() ? borrowed_texture(model, level, *edit.from) : nullptr;
  const double size = edit.size > 0 ? edit.size : texture_size(model.details(edit.levels.first));
  const auto finer = static_cast<double>(level - edit.levels.first);
  const double shrunk = std::pow(static_cast<double>(model.shape().maps()), -edit.roughness * finer);
  return random_texture(model, level, size * shrunk, edit.seed);
}

}  // namespace ifsm::core
