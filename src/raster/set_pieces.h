// The second half of set_pixels: pieces of the attractor, which prove what points do not show.
#pragma once

#include <cstdint>

#include "base/cancel.h"
#include "raster/in_pixels.h"
#include "raster/known_pixels.h"
#include "raster/set.h"

namespace ifsm::core {

// A square of KnownPixels::side pixels of the window, or what of it lies in the window.
struct Tile {
  std::int64_t left, top, width, height;
  Meets* first;         // the state of its first pixel
  std::int64_t stride;  // from row to row
};

// Follows words of maps to where their pieces are small, or lie in known pixels; the states of the tile's pixels become
// final. Reads and writes the tile's states alone. The same for every vector width.
void search_tile(const InPixels& attractor, double tolerance, const Tile& tile, const Watch& watch);

}  // namespace ifsm::core
