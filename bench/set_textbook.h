// The attractor's pixels as every textbook has them: words of maps are followed until the ball about their piece has
// a radius of half a pixel, and the pixel of its middle is marked. Compiled with -O3 -march=native.
#pragma once

#include <cstdint>
#include <vector>

// x' = a x + b y + e, y' = c x + d y + f, in pixels from the window's upper left corner.
struct PixelMap {
  double a, b, c, d, e, f;
};

// `whole` takes the origin to the middle of the attractor's ball, of that radius, about which the maps are told.
// marks: width · height. Returns how many words were looked at.
std::int64_t textbook_set(const std::vector<PixelMap>& maps, const PixelMap& whole, double radius, std::int64_t width,
                          std::int64_t height, std::uint8_t* marks);
