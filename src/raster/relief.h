// Shades what lies behind its surroundings: depth that the eye sees without a light.
#pragma once

#include <cstdint>
#include <vector>

#include "raster/tone.h"

namespace ifsm::core {

// nearness: 0 … 1 for each pixel that has an alpha. A pixel that is farther than the mean of the pixels around it (a
// sixtieth of the picture's width about it) becomes darker, a nearer one lighter. With fog, what is far is darker, too.
// Source: T. Luft, C. Colditz, O. Deussen, Image enhancement by unsharp masking the depth buffer, 2006.
void shade(Picture& picture, const std::vector<float>& nearness, std::int64_t width, std::int64_t height, bool fog);

}  // namespace ifsm::core
