#include "raster/palette.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace ifsm::core {
namespace {

using Triple = std::array<double, 3>;

Triple times(const std::array<Triple, 3>& m, const Triple& v) {
  Triple result{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) result[i] += m[i][j] * v[j];
  return result;
}

Triple oklab_of(Rgb colour) {
  Triple cones = times({{{0.4122214708, 0.5363325363, 0.0514459929},
                         {0.2119034982, 0.6806995451, 0.1073969566},
                         {0.0883024619, 0.2817188376, 0.6299787005}}},
                       light_of(colour));
  for (double& cone : cones) cone = std::cbrt(cone);
  return times({{{0.2104542553, 0.7936177850, -0.0040720468},
                 {1.9779984951, -2.4285922050, 0.4505937099},
                 {0.0259040371, 0.7827717662, -0.8086757660}}},
               cones);
}

Rgb rgb_of(const Triple& oklab) {
  Triple cones = times(
      {{{1, 0.3963377774, 0.2158037573}, {1, -0.1055613458, -0.0638541728}, {1, -0.0894841775, -1.2914855480}}}, oklab);
  for (double& cone : cones) cone = cone * cone * cone;
  return colour_of(times({{{4.0767416621, -3.3077115913, 0.2309699292},
                           {-1.2684380046, 2.6097574011, -0.3413193965},
                           {-0.0041960863, -0.7034186147, 1.7076147010}}},
                         cones));
}

Triple between(const Triple& a, const Triple& b, double share) {
  Triple result{};
  for (std::size_t i = 0; i < 3; ++i) result[i] = a[i] + share * (b[i] - a[i]);
  return result;
}

constexpr Rgb hex(std::uint32_t code) {
  return {static_cast<std::uint8_t>(code >> 16), static_cast<std::uint8_t>(code >> 8), static_cast<std::uint8_t>(code)};
}

}  // namespace

std::array<double, 3> light_of(Rgb colour) {
  const auto linear = [](std::uint8_t value) {
    const double v = value / 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  };
  return {linear(colour.red), linear(colour.green), linear(colour.blue)};
}

Rgb colour_of(const std::array<double, 3>& light) {
  const auto curved = [](double value) {
    const double v = std::clamp(value, 0.0, 1.0);
    const double s = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(s * 255));
  };
  return {curved(light[0]), curved(light[1]), curved(light[2])};
}

double lightness(Rgb colour) { return oklab_of(colour)[0]; }

Palette::Palette(std::span<const Rgb> stops) {
  in_range(static_cast<std::int64_t>(stops.size()), 1, 256, "stops");
  std::vector<Triple> lab;
  for (const Rgb& stop : stops) lab.push_back(oklab_of(stop));
  for (std::size_t k = 0; k < shades; ++k) {
    const double place = static_cast<double>(k) / (shades - 1) * static_cast<double>(lab.size() - 1);
    const std::size_t low = std::min(static_cast<std::size_t>(place), lab.size() - 1);
    const std::size_t high = std::min(low + 1, lab.size() - 1);
    table_[k] = rgb_of(between(lab[low], lab[high], place - static_cast<double>(low)));
  }
}

Rgb Palette::at(double t) const {
  const double place = std::clamp(t, 0.0, 1.0) * (shades - 1);
  return table_[static_cast<std::size_t>(std::lround(place))];
}

const Palette& palette(PaletteName name) {
  static const std::array<Palette, 5> all = [] {
    const auto of = [](std::initializer_list<std::uint32_t> codes) {
      std::vector<Rgb> stops;
      for (const std::uint32_t code : codes) stops.push_back(hex(code));
      return Palette(stops);
    };
    return std::array{of({0xfbd9a0, 0xf0936b, 0xc04c75, 0x68348a, 0x1d1a4a}),
                      of({0xc9e6ee, 0x6fb6d3, 0x2f73a8, 0x0e2a52}), of({0xcfe3a4, 0x7bb05f, 0x2f7040, 0x0b3322}),
                      of({0xffdf8f, 0xf59a38, 0xc9422b, 0x4d0d1d}), of({0xc4c7cf, 0x6d7482, 0x14161c})};
  }();
  return all[static_cast<std::size_t>(name)];
}

Rgb letter_colour(int letter) {
  static constexpr std::array colours = {hex(0x0072b2), hex(0xd55e00), hex(0x009e73), hex(0xcc79a7),
                                         hex(0xe69f00), hex(0x56b4e9), hex(0x7a5195), hex(0x5f6368)};
  const auto count = static_cast<int>(colours.size());
  const Rgb colour = colours[static_cast<std::size_t>(letter % count)];
  const int round = letter / count % 3;
  if (round == 0) return colour;
  constexpr double share = .35;
  const Rgb toward = round == 1 ? Rgb{255, 255, 255} : Rgb{0, 0, 0};
  return rgb_of(between(oklab_of(colour), oklab_of(toward), share));
}

}  // namespace ifsm::core
