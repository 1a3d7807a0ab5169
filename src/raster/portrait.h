// Pictures of systems by the chaos game: in the plane coloured by density or by addresses, in space by what is nearest.
#pragma once

#include <cstdint>
#include <span>

#include "base/cancel.h"
#include "raster/chaos.h"
#include "raster/tone.h"
#include "raster/view.h"

namespace ifsm::core {

// tone: density over the palette; of space, nearness. letter: the map that was taken last, so the piece that the point
// is in. address: the share of the measure that lies in pieces of smaller addresses, over the palette.
enum class Colouring : std::int32_t { tone = 0, letter = 1, address = 2 };

struct Look {
  Colouring colouring = Colouring::tone;
  int letters = 0;  // of the address, up to 16; 0: all
  const Palette* palette = nullptr;
  std::span<const Rgb> letter_colours = {};  // in turn, instead of letter_colour()'s
};

struct Portrait {
  Picture pixels;
  std::int64_t inside = 0;  // points in the window
  std::int64_t met = 0;     // pixels that were hit
};

// How many points to play for so many a pixel in the window, of which a part of them falls into: 2^20 are asked, and at
// most 64 times as many are played as there would be if all fell there.
std::int64_t points_for(const System& system, const Window& window, std::uint64_t seed, std::int64_t a_pixel,
                        Watch& watch);

// A plane system in a window. The same seed gives the same picture on any number of threads.
Portrait plane_portrait(const System& system, const Window& window, const Look& look, std::uint64_t seed,
                        std::int64_t points, Watch& watch);

// A system of space, in a window of the view's plane: the nearest point of each pixel, darker where it is farther than
// its surroundings.
Portrait space_portrait(const System& system, const View& view, const Window& window, const Look& look,
                        std::uint64_t seed, std::int64_t points, Watch& watch);

}  // namespace ifsm::core
