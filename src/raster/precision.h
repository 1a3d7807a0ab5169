// How exactly the search of set_pixels knows where a piece is, in floats and in doubles.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "raster/in_pixels.h"
#include "raster/known_pixels.h"

namespace ifsm::core {

// Pieces that reach farther from their middle, in their box, in pixels, are followed one by one, in doubles.
constexpr double large_piece = KnownPixels::side / 4.;

// What numbers of one type can follow.
struct Precision {
  // How far off the place of a piece may be, in pixels: at first, more with each map while pieces are large and then,
  // and at most.
  double at_first, of_a_large_map, of_a_map, at_most;
  double farthest;  // how far the piece may reach
};

// What was computed before (the box, the maps' moves) may be off already by as much as the longest word adds.
inline Precision doubles(const InPixels& attractor) {
  const double of_a_map = attractor.rounding / InPixels::longest_word;
  return {attractor.rounding, of_a_map, of_a_map, 2 * attractor.rounding, std::numeric_limits<double>::infinity()};
}

// Twice as many go into a vector, and pieces no larger than half a tile do with them: those that reach B = 32 pixels,
// or 2 B where maps stretch before they shrink, whose middle is then less than 6 B from the tile's corner. In units of
// 2^-24 pixels, a map's place is off by 6 B for the sum, 3 B for the products (if its move is no longer than half the
// box, else as much more) and by what M carries on: 3 2^.5 B j s^j after j maps that shrink by s. Of the last, the mean
// over the first maps is less than 21 B for s up to .94, and with s = .94 there are at most 128 maps. So 32 B are
// enough for each map; two such are for what a box rounds.
inline Precision floats(const InPixels& attractor, double tolerance) {
  constexpr double farthest = 2 * large_piece, rounding = 0x1p-24 * 32 * large_piece;
  const double of_a_map = rounding * std::max(1.0, attractor.farthest_move);
  return {attractor.rounding + 2 * of_a_map, 0, of_a_map, tolerance / 4, farthest};
}

// Do they, if all words are about as long as those of the slowest map?
inline bool floats_suffice(const Precision& floats, const InPixels& attractor, double smallest) {
  if (attractor.slowest <= 0) return true;
  constexpr double most_maps = 128;
  const double maps = std::log(floats.farthest / smallest) / -std::log(attractor.slowest);
  return maps >= 0 && maps <= most_maps && floats.at_first + maps * floats.of_a_map <= floats.at_most;
}

}  // namespace ifsm::core
