// An attractor in the pixels of a window: across from its left edge, down from its upper one. What set_pixels and its
// plain version search.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "raster/chaos.h"
#include "raster/piece.h"
#include "system/system.h"

namespace ifsm::core {

// A point for each eighth of the directions; that of (a, b) is number (a < 0) + 2 (b < 0) + 4 (|b| > |a|).
struct Eight {
  alignas(64) std::array<double, 8> x, y;
};

struct InPixels {
  InPixels(const System& system, const Window& window);

  // Active maps, about the middle of the attractor's box.
  std::vector<Piece> maps;
  // Takes the box's middle from the origin to where it is in the window.
  Piece whole;
  // Corners of an octagon about the attractor, whose sides lie along the axes and the diagonals: of the direction's
  // eighth, the farthest. From the box's middle, as all of these.
  Eight corners;
  Eight points;                // of the attractor, that lie far out there
  std::array<double, 2> half;  // of the box
  double slowest = 0;          // the largest spectral radius of a map
  double farthest_move = 0;    // of the middle by a map, in halves of the box
  // How far a piece reaches from its middle, in the box.
  double across(const Piece& p) const { return std::abs(p.a) * half[0] + std::abs(p.b) * half[1]; }
  double down(const Piece& p) const { return std::abs(p.c) * half[0] + std::abs(p.d) * half[1]; }
  // Of coordinates of a point of a word's piece, at most, words of longest_word maps included.
  double rounding;

  static constexpr int longest_word = 4096;
};

}  // namespace ifsm::core
