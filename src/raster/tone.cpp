#include "raster/tone.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

namespace ifsm::core {
namespace {

using Light = std::array<double, 3>;

// Light of all 256 values: a picture has millions.
const std::array<double, 256>& lights() {
  static const std::array<double, 256> table = [] {
    std::array<double, 256> made{};
    for (std::size_t v = 0; v < made.size(); ++v) made[v] = light_of({static_cast<std::uint8_t>(v), 0, 0})[0];
    return made;
  }();
  return table;
}

void add(Light& light, Rgb colour, double share) {
  light[0] += share * lights()[colour.red];
  light[1] += share * lights()[colour.green];
  light[2] += share * lights()[colour.blue];
}

std::uint8_t byte_of(double share) { return static_cast<std::uint8_t>(std::lround(std::clamp(share, 0.0, 1.0) * 255)); }

}  // namespace

Density::Density(std::span<const std::uint32_t> counts) {
  constexpr std::size_t bright_one_in = 200;
  std::vector<std::uint32_t> hit;
  std::copy_if(counts.begin(), counts.end(), std::back_inserter(hit), [](std::uint32_t c) { return c > 0; });
  if (hit.empty()) return;
  double sum = 0;
  for (const std::uint32_t c : hit) sum += c;
  mean_ = sum / static_cast<double>(hit.size());
  const auto top = hit.end() - 1 - static_cast<std::ptrdiff_t>(hit.size() / bright_one_in);
  std::nth_element(hit.begin(), top, hit.end());
  top_ = *top;
}

double Density::operator()(double count) const {
  constexpr double contrast = 8;
  return std::min(std::log1p(contrast * count / mean_) / std::log1p(contrast * top_ / mean_), 1.0);
}

Picture density_picture(std::span<const std::uint32_t> counts, const Palette& palette) {
  const Density density(counts);
  Picture picture(counts.size());
  for (std::size_t k = 0; k < counts.size(); ++k)
    if (counts[k] > 0) picture[k] = {palette.at(density(counts[k])), 255};
  return picture;
}

Picture set_picture(std::span<const Meets> pixels, const Palette& palette) {
  const Rgb dark = palette.at(1);
  Picture picture(pixels.size());
  for (std::size_t k = 0; k < pixels.size(); ++k)
    if (pixels[k] != Meets::no) picture[k] = {dark, static_cast<std::uint8_t>(pixels[k] == Meets::yes ? 255 : 128)};
  return picture;
}

Picture distance_picture(std::span<const double> distances, double pixel, const Palette& palette) {
  const double farthest = distances.empty() ? 0 : *std::max_element(distances.begin(), distances.end());
  const double top = std::max(std::log1p(farthest / pixel), std::numeric_limits<double>::min());
  Picture picture(distances.size());
  for (std::size_t k = 0; k < distances.size(); ++k)
    picture[k] = {palette.at(1 - std::log1p(distances[k] / pixel) / top), 255};
  return picture;
}

Picture shrunk(const Picture& picture, std::int64_t width, std::int64_t height, std::int64_t times) {
  if (times == 1) return picture;
  const std::int64_t columns = width / times, rows = height / times;
  Picture small(static_cast<std::size_t>(columns * rows));
  for (std::int64_t row = 0; row < rows; ++row)
    for (std::int64_t column = 0; column < columns; ++column) {
      Light light{};
      double alpha = 0;
      for (std::int64_t y = row * times; y < (row + 1) * times; ++y)
        for (std::int64_t x = column * times; x < (column + 1) * times; ++x) {
          const Rgba& each = picture[static_cast<std::size_t>(y * width + x)];
          add(light, each.colour, each.alpha);
          alpha += each.alpha;
        }
      if (alpha == 0) continue;
      for (double& amount : light) amount /= alpha;
      small[static_cast<std::size_t>(row * columns + column)] = {
          colour_of(light), byte_of(alpha / (255. * static_cast<double>(times * times)))};
    }
  return small;
}

void lay_over(Picture& picture, Rgba background) {
  if (background.alpha == 0) return;
  const double behind = background.alpha / 255.;
  for (Rgba& each : picture) {
    const double front = each.alpha / 255., rest = (1 - front) * behind, alpha = front + rest;
    const auto mixed = [&](std::uint8_t a, std::uint8_t b) {
      return static_cast<std::uint8_t>(std::lround((a * front + b * rest) / alpha));
    };
    each.colour = {mixed(each.colour.red, background.colour.red), mixed(each.colour.green, background.colour.green),
                   mixed(each.colour.blue, background.colour.blue)};
    each.alpha = byte_of(alpha);
  }
}

}  // namespace ifsm::core
