#include "deform/look.h"

#include <cmath>
#include <utility>
#include <vector>

#include "base/random.h"
#include "curve/frames.h"

namespace ifsm::core {

Look own_look(const Model& model) {
  const Index d = model.dimension();
  return Look(static_cast<std::size_t>(model.levels()), {identity(d), nullptr});
}

ModelPtr dressed(const Model& model, const Look& look) {
  const Index d = model.dimension();
  ModelParts parts = model.parts();
  bool changed = false;
  for (std::size_t level = 0; level < look.size(); ++level) {
    if (look[level].details) parts.details[level] = look[level].details;
    const bool mapped = look[level].map != identity(d);
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
  const Index count = model.details(level).count(), d = model.dimension();
  std::vector<double> numbers(static_cast<std::size_t>(count * d));  // of a vector, its coordinates follow each other
  normal_numbers(seed, static_cast<std::uint32_t>(level), numbers);
  auto texture = std::make_shared<Points>(Points::from_interleaved(numbers.data(), count, d));
  texture->matrix() *= size / std::sqrt(static_cast<double>(d));
  return texture;
}

double texture_size(const Points& details) {
  return details.count() == 0 ? 0 : std::sqrt(details.matrix().squaredNorm() / static_cast<double>(details.count()));
}

}  // namespace ifsm::core
