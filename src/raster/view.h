// Where one looks from: space onto the plane of a picture.
#pragma once

#include "raster/chaos.h"
#include "system/reach.h"

namespace ifsm::core {

// What of a picture: window and resolution.
struct Direction {
  double azimuth = 0;    // radians, from the x axis towards the y axis: where the eye is
  double elevation = 0;  // above the xy plane
  double field = 0;      // angle of view, below π; 0: from infinitely far, parallel lines stay parallel
};

class View {
 public:
  // The eye is so far from the ball that it fills the field.
  View(const Direction& direction, const Ball& ball);

  struct Seen {
    double x, y;      // in the plane through the ball's centre, in its units
    double nearness;  // 1 at the ball's nearest point, 0 at its farthest; the eye sees none that is behind it
    bool visible;
  };
  Seen operator()(double x, double y, double z) const {
    const Vector3 q = Vector3(x, y, z) - centre_;
    const double toward = toward_.dot(q), scale = 1 / (1 - toward * per_distance_);
    return {right_.dot(q) * scale, up_.dot(q) * scale, toward * half_per_radius_ + .5, toward * per_distance_ < 1};
  }

  // Half the side of a square, around 0, in which all of the ball is seen.
  double reach() const { return reach_; }

 private:
  Vector3 right_, up_, toward_, centre_;
  double radius_, half_per_radius_, per_distance_, reach_;
};

// Width over height as the pixels', so that they are squares; the box in its middle, with some margin.
Window window_around(const Box& box, std::int64_t width, std::int64_t height);

}  // namespace ifsm::core
