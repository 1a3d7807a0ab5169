#include "curve/scale.h"

#include <cmath>
#include <utility>

namespace ifsm::core {

int exponent_to_remove(double size) {
  constexpr int safe = 200;  // of 1023: squares, products with filters and sums over 2^40 places stay far inside
  if (!(size > 0) || !std::isfinite(size)) return 0;
  const int exponent = std::ilogb(size);
  return std::abs(exponent) <= safe ? 0 : exponent;
}

Points scaled(Points points, int exponent) {
  for (Index axis = 0; axis < points.dimension(); ++axis)
    for (double& value : points.plane(axis)) value = std::scalbn(value, exponent);
  return points;
}

ModelPtr scaled(const Model& model, int exponent) {
  ModelParts parts = model.parts();
  parts.polygon = scaled(std::move(parts.polygon), exponent);
  for (double& value : parts.center) value = std::scalbn(value, exponent);
  for (auto& level : parts.details) level = std::make_shared<const Points>(scaled(*level, exponent));
  parts.diagonal = std::scalbn(parts.diagonal, exponent);
  parts.largest_polygon = std::scalbn(parts.largest_polygon, exponent);
  return std::make_shared<Model>(std::move(parts));
}

}  // namespace ifsm::core
