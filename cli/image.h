// Pixels and points as files.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace cli {

// Red, green, blue, alpha, row by row, as PNG. Tells now and then how much is written, 0 … 1; what `tell` throws ends
// it. Throws Failure{Computing} when the image is larger than PNG's writer takes.
std::string png_of(const std::vector<std::uint8_t>& rgba, int width, int height,
                   const std::function<void(double)>& tell);

// Points of 2 or 3 coordinates as PLY: binary, little-endian, single precision; and for each a number below 256.
std::string ply_of(const std::vector<double>& points, int dimension, const std::vector<std::int32_t>& numbers,
                   const std::string& comment);

}  // namespace cli
