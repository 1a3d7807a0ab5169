// From counts, and from what was seen at pixels, to red, green, blue and alpha.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "raster/palette.h"
#include "raster/set.h"

namespace ifsm::core {

struct Rgba {
  Rgb colour;
  std::uint8_t alpha;

  friend bool operator==(const Rgba&, const Rgba&) = default;
};

using Picture = std::vector<Rgba>;  // row by row, row 0 on top; alpha not multiplied in

// How dense each pixel is, as the eye sees it: log(1 + 8 c / mean), 0 … 1, the mean being that of the pixels that were
// hit. 1 is reached by one in two hundred of them, so that a few bright spots do not leave the rest dark. Depends
// neither on how many points there were nor on the pixels' number.
class Density {
 public:
  explicit Density(std::span<const std::uint32_t> counts);

  double operator()(double count) const;

 private:
  double mean_ = 1, top_ = 1;
};

// Counts over a palette: nothing where nothing was hit.
Picture density_picture(std::span<const std::uint32_t> counts, const Palette& palette);

// Pixels that are met in the palette's darkest colour, undecided ones half covered.
Picture set_picture(std::span<const Meets> pixels, const Palette& palette);

// Distances, in pixels, by their logarithms: from dark, near, to light.
Picture distance_picture(std::span<const double> distances, double pixel, const Palette& palette);

// `times` × `times` pixels to one: colours are averaged as light, by alpha.
Picture shrunk(const Picture& picture, std::int64_t width, std::int64_t height, std::int64_t times);

// Over a background.
void lay_over(Picture& picture, Rgba background);

}  // namespace ifsm::core
