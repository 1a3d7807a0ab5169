// Colours for numbers and for letters.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace ifsm::core {

struct Rgb {
  std::uint8_t red, green, blue;

  friend bool operator==(const Rgb&, const Rgb&) = default;
};

// Shades from one end to the other, even to the eye: between stops, Oklab's coordinates are linear. Source:
// B. Ottosson, A perceptual color space for image processing, 2020.
class Palette {
 public:
  // 1 … 256 stops, equally far apart.
  explicit Palette(std::span<const Rgb> stops);

  // 0 … 1; beyond, the ends.
  Rgb at(double t) const;

 private:
  static constexpr std::size_t shades = 1024;
  std::array<Rgb, shades> table_;
};

// All run from light to dark, by lightness alone: in grey print and to the colour-blind they say the same.
enum class PaletteName : std::int32_t { dusk = 0, sea = 1, fern = 2, ember = 3, ink = 4 };
const Palette& palette(PaletteName name);

// Of a map's number: eight that the colour-blind tell apart (M. Okabe, K. Ito, Color universal design, 2008), and for
// higher numbers the same ones lighter, then darker.
Rgb letter_colour(int letter);

// Light, as amounts that add up: sRGB without its curve, 0 … 1.
std::array<double, 3> light_of(Rgb colour);
Rgb colour_of(const std::array<double, 3>& light);

// Oklab's L of a colour: 0 black, 1 white.
double lightness(Rgb colour);

}  // namespace ifsm::core
