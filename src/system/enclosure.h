// Is a list of affine maps contractive, and where then is its attractor?
#pragma once

#include <span>
#include <vector>

#include "linalg/affine.h"
#include "linalg/contractivity.h"

namespace ifsm::core {

// Numbers of maps, the outermost first: the word (i, j) stands for x → map_i(map_j(x)).
using Word = std::vector<int>;

struct Contraction {
  Contractivity answer;
  // Proven: the longest word that was needed. Undecided: the longest that was tried. Refuted: that of `word`.
  int length;
  Word word;            // refuted: one whose linear part has a spectral radius of 1 or more
  double radius;        // refuted: that radius
  Ellipsoid enclosure;  // proven: holds the attractor, rounding included
};

// Of maps that are all active, in that dimension.
Contraction contraction_of(int dimension, std::span<const Affine> maps);

}  // namespace ifsm::core
