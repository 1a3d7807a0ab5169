// A curve before and after it was bent, in one picture.
#pragma once

#include <vector>

#include "figures/panels.h"

namespace figures {

// A curve at one moment: its finest places and its control polygon, point-major.
struct Moment {
  std::vector<double> curve;
  std::vector<double> polygon;
  std::vector<double> moved = {};  // points that edits move, and that they hold
  std::vector<double> held = {};
};

struct Frame {
  plot::Range x, y;
};
// What all of their curves need, with a little air; control points as far as they are not far away.
Frame frame_of(const std::vector<Moment>& moments, int dimension, bool closed);

plot::Panel bent_panel(const Moment& before, const Moment& after, int dimension, bool closed, const Frame& frame);

}  // namespace figures
