#include "raster/view.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace ifsm::core {

View::View(const Direction& direction, const Ball& ball)
    : right_(-std::sin(direction.azimuth), std::cos(direction.azimuth), 0),
      toward_(std::cos(direction.elevation) * std::cos(direction.azimuth),
              std::cos(direction.elevation) * std::sin(direction.azimuth), std::sin(direction.elevation)),
      centre_(ball.centre),
      radius_(ball.radius > 0 ? ball.radius : 1),  // a point: any scale is as good
      half_per_radius_(.5 / radius_),
      per_distance_(std::sin(direction.field / 2) / radius_),
      reach_(radius_ / std::cos(direction.field / 2)) {
  up_ = toward_.cross(right_);
}

Window window_around(const Box& box, std::int64_t width, std::int64_t height) {
  constexpr double margin = 1.04;
  const double w = static_cast<double>(width), h = static_cast<double>(height);
  const Vector3 middle = (box.low + box.high) / 2;
  double pixel = margin * std::max((box.high(0) - box.low(0)) / w, (box.high(1) - box.low(1)) / h);
  if (!(pixel > 0)) pixel = 1 / std::max(w, h);  // a point: any scale is as good
  // At least what doubles tell apart there.
  pixel = std::max(pixel, 4 * std::numeric_limits<double>::epsilon() * middle.cwiseAbs().maxCoeff());
  return {middle(0) - pixel * w / 2,
          middle(1) - pixel * h / 2,
          middle(0) + pixel * w / 2,
          middle(1) + pixel * h / 2,
          width,
          height};
}

}  // namespace ifsm::core
