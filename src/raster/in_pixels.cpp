#include "raster/in_pixels.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "linalg/spectrum.h"
#include "system/reach.h"

namespace ifsm::core {
namespace {

// How far it reaches from the middle, in pixels, into directions that need not be of length 1.
class Reaches {
 public:
  Reaches(const System& system, double across, double down)
      : system_(system),
        scale_(across, down, 0),
        // An outline that lies farther out makes the search slower, by less than a hundredth here, and no more.
        tolerance_(std::max(0x1p-10 * system.enclosure().axes.norm(), std::numeric_limits<double>::min())) {}

  void set_middle(const Vector3& middle) { middle_ = middle; }
  double operator()(double x, double y) const {
    const Vector3 direction = scale_.cwiseProduct(Vector3(x, y, 0));
    const double length = direction.norm();
    return length * reach(system_, direction / length, tolerance_) - direction.dot(middle_);
  }

 private:
  const System& system_;
  Vector3 scale_, middle_ = Vector3::Zero();
  double tolerance_;
};

// Where the sides of two neighbouring directions meet: (±1, 0) or (0, ±1), and the diagonal beside it.
Eight octagon(const Reaches& reach) {
  Eight corners{};
  for (std::size_t sector = 0; sector < 8; ++sector) {
    const double x = (sector & 1) != 0 ? -1 : 1, y = (sector & 2) != 0 ? -1 : 1;
    const bool steep = (sector & 4) != 0;
    const double straight = steep ? reach(0, y) : reach(x, 0), diagonal = reach(x, y);
    corners.x[sector] = x * (steep ? diagonal - straight : straight);
    corners.y[sector] = y * (steep ? straight : diagonal - straight);
  }
  return corners;
}

// Images of a point of the attractor under words of some tens of maps, that are chosen so as to come far out.
Eight far_points(const std::vector<Piece>& maps, double x, double y) {
  constexpr std::array<double, 8> far = {1, -1, 1, -1, .4, -.4, .4, -.4};  // in the middle of each eighth
  Eight points{};
  points.x.fill(x), points.y.fill(y);
  constexpr int rounds = 64;
  for (int round = 0; round < rounds; ++round) {
    const Eight before = points;
    for (std::size_t sector = 0; sector < 8; ++sector) {
      const double along_x = far[sector],
                   along_y = ((sector & 2) != 0 ? -1.4 : 1.4) - std::abs(along_x) * ((sector & 2) != 0 ? -1 : 1);
      double most = points.x[sector] * along_x + points.y[sector] * along_y;
      for (const Piece& map : maps)
        for (std::size_t k = 0; k < 8; ++k) {
          const double image_x = map.x(before.x[k], before.y[k]), image_y = map.y(before.x[k], before.y[k]);
          if (image_x * along_x + image_y * along_y <= most) continue;
          most = image_x * along_x + image_y * along_y;
          points.x[sector] = image_x, points.y[sector] = image_y;
        }
    }
  }
  return points;
}

}  // namespace

InPixels::InPixels(const System& system, const Window& window) {
  const Grid grid(window);
  const double across = grid.columns_per_unit, down = -grid.rows_per_unit;
  Reaches reach(system, across, down);
  const double left = -reach(-1, 0), right = reach(1, 0), upper = -reach(0, -1), lower = reach(0, 1);
  const Vector3 middle((left + right) / 2 / across, (upper + lower) / 2 / down, 0);
  half = {(right - left) / 2, (lower - upper) / 2};
  reach.set_middle(middle);
  corners = octagon(reach);

  for (const Affine& map : system.active_maps()) {
    const Vector3 moved = map(middle) - middle;
    maps.push_back({map.linear(0, 0), map.linear(0, 1) * across / down, map.linear(1, 0) * down / across,
                    map.linear(1, 1), moved(0) * across, moved(1) * down});
    slowest = std::max(slowest, spectral_radius(map.linear.topLeftCorner<2, 2>()));
    farthest_move =
        std::max({farthest_move, std::abs(moved(0)) * across / half[0], std::abs(moved(1) * down) / half[1]});
  }
  const Vector3 point = system.point() - middle;
  points = far_points(maps, point(0) * across, point(1) * down);
  whole = {1, 0, 0, 1, (middle(0) - window.left) * across, (middle(1) - window.top) * down};

  // Each map of a word adds some roundings of numbers as large as the attractor and the window are in pixels, and those
  // of its own move, which is a difference of numbers as large as the coordinates.
  double largest =
      std::max({std::abs(whole.e), std::abs(whole.f), 2 * half[0], 2 * half[1], std::abs(window.left) * across,
                std::abs(window.top * down), std::abs(middle(0)) * across, std::abs(middle(1) * down)});
  for (const Affine& map : system.active_maps()) {
    const Vector3 far = map.linear.cwiseAbs() * middle.cwiseAbs() + map.shift.cwiseAbs();
    largest = std::max({largest, far(0) * across, std::abs(far(1) * down)});
  }
  rounding = longest_word * 8 * std::numeric_limits<double>::epsilon() * largest;
}

}  // namespace ifsm::core
