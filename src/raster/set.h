// The attractor as a set: the pixels whose square it meets, with proofs.
#pragma once

#include <cstdint>
#include <vector>

#include "base/cancel.h"
#include "raster/chaos.h"
#include "system/system.h"

namespace ifsm::core {

enum class Meets : std::uint8_t {
  no = 0,         // no point of the attractor is in the pixel's square
  undecided = 1,  // one is within the tolerance of it, but none was found inside
  yes = 2,        // one is
};

// For each pixel of the window, row by row. `tolerance`: in pixels, up to 1; pieces of the attractor that lie across a
// pixel's edge are looked at down to that size. A range error when it is not well above what rounding does to pixel
// coordinates. Deterministic: words of maps are followed to where their pieces are small; nothing is drawn.
std::vector<Meets> set_pixels(const System& system, const Window& window, double tolerance, Watch& watch);

// The same proofs by a plain search of pieces in their boxes, of which more may stay undecided: what the vectors are
// tested against.
namespace plain {
std::vector<Meets> set_pixels(const System& system, const Window& window, double tolerance);
}

}  // namespace ifsm::core
