#include "raster/relief.h"

#include <algorithm>
#include <array>

namespace ifsm::core {
namespace {

// Sums of a square about each pixel, by running sums along rows, then along columns.
std::vector<float> blurred(const std::vector<float>& values, std::int64_t width, std::int64_t height,
                           std::int64_t radius) {
  const auto along = [radius](const float* from, float* to, std::int64_t count, std::int64_t stride) {
    double sum = 0;
    for (std::int64_t k = -radius; k < count; ++k) {
      if (k + radius < count) sum += from[(k + radius) * stride];
      if (k - radius - 1 >= 0) sum -= from[(k - radius - 1) * stride];
      if (k >= 0) to[k * stride] = static_cast<float>(sum);
    }
  };
  std::vector<float> rows(values.size()), all(values.size());
  for (std::int64_t y = 0; y < height; ++y) along(values.data() + y * width, rows.data() + y * width, width, 1);
  for (std::int64_t x = 0; x < width; ++x) along(rows.data() + x, all.data() + x, height, width);
  return all;
}

}  // namespace

void shade(Picture& picture, const std::vector<float>& nearness, std::int64_t width, std::int64_t height, bool fog) {
  constexpr double strength = 5, darkest = .45, lightest = 1.35, far = .4;
  const std::int64_t radius = std::max<std::int64_t>(width / 60, 1);
  std::vector<float> covered(picture.size());
  for (std::size_t p = 0; p < picture.size(); ++p) covered[p] = picture[p].alpha > 0 ? 1.0F : 0.0F;
  const std::vector<float> sums = blurred(nearness, width, height, radius);
  const std::vector<float> counts = blurred(covered, width, height, radius);
  for (std::size_t p = 0; p < picture.size(); ++p) {
    if (picture[p].alpha == 0) continue;
    const double before = nearness[p] - static_cast<double>(sums[p]) / std::max(static_cast<double>(counts[p]), 1.0);
    double light = std::clamp(1 + strength * before, darkest, lightest);
    if (fog) light *= far + (1 - far) * nearness[p];
    std::array<double, 3> amounts = light_of(picture[p].colour);
    for (double& amount : amounts) amount *= light;
    picture[p].colour = colour_of(amounts);
  }
}

}  // namespace ifsm::core
