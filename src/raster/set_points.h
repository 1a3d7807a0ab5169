// The first half of set_pixels: points of the attractor, which meet nearly all pixels that are met.
#pragma once

#include "base/cancel.h"
#include "raster/in_pixels.h"
#include "raster/set.h"

namespace ifsm::core {

// From points of the attractor through all maps, on from every pixel that was not met before; through maps that shrink
// areas little also from both of its halves. What this misses, for its pixel was met by another point, the pieces find.
// states: by pixel, "no" before; three bytes more are read. The same for every vector width.
void follow_points(const InPixels& attractor, const Window& window, Meets* states, const Watch& watch);

}  // namespace ifsm::core
