#include "deform/look.h"

#include <cmath>
#include <utility>

#include "base/random.h"
#include "curve/frames.h"

namespace ifsm::core {

Look own_look(const Model& model) {
  const Index d = model.dimension();
  return Look(static_cast<std::size_t>(model.levels()), {SmallMatrix::Identity(d, d), nullptr});
}

ModelPtr dressed(const Model& model, const Look& look) {
  const Index d = model.dimension();
  ModelParts parts = model.parts();
  bool changed = false;
  for (std::size_t level = 0; level < look.size(); ++level) {
    if (look[level].details) parts.details[level] = look[level].details;
    const bool mapped = look[level].map != SmallMatrix::Identity(d, d);
    changed = changed || mapped || look[level].details;
    if (!mapped) continue;
    auto details = std::make_shared<Points>(d, parts.details[level]->count());
    details->matrix() = parts.details[level]->matrix() * look[level].map.transpose();
    parts.details[level] = std::move(details);
  }
  return changed ? std::make_shared<Model>(std::move(parts)) : std::make_shared<Model>(model.parts());
}

PointsPtr borrowed_texture(const Model& model, int level, const Model& from) {
  // A root's frame is the identity, however its polygon lies.
  const SmallMatrix root = least_rotation(from.parts().polygon.matrix(), model.parts().polygon.matrix());
  Points told = details(from, level, Frame::node);
  told.matrix() = (told.matrix() * root.transpose()).eval();
  return std::make_shared<Points>(in_frames(model, level, told));
}

PointsPtr random_texture(const Model& model, int level, double size, std::uint64_t seed) {
  auto texture = std::make_shared<Points>(model.dimension(), model.details(level).count());
  // Two numbers at a time; of a vector, its coordinates follow each other.
  const double each = size / std::sqrt(static_cast<double>(model.dimension()));
  for (Index k = 0; k < texture->size(); k += 2) {
    const auto pair = normal_pair(seed, static_cast<std::uint32_t>(level), static_cast<std::uint64_t>(k / 2));
    for (Index i = k; i < std::min(k + 2, texture->size()); ++i)
      texture->matrix()(i / model.dimension(), i % model.dimension()) = each * pair[static_cast<std::size_t>(i - k)];
  }
  return texture;
}

double texture_size(const Points& details) {
  return details.count() == 0 ? 0 : std::sqrt(details.matrix().squaredNorm() / static_cast<double>(details.count()));
}

}  // namespace ifsm::core
