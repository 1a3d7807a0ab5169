#include "colour.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace plot {

Colour mix(Colour a, Colour b, double share_of_b) {
  const auto blend = [share_of_b](double from, double to) { return from + (to - from) * share_of_b; };
  return {blend(a.red, b.red), blend(a.green, b.green), blend(a.blue, b.blue)};
}

Colour viridis(double share) {
  // Every tenth of matplotlib's map (CC0), straight lines between.
  static constexpr std::array<Colour, 11> anchors{{{0.267, 0.005, 0.329},
                                                   {0.283, 0.141, 0.458},
                                                   {0.254, 0.265, 0.530},
                                                   {0.207, 0.372, 0.553},
                                                   {0.164, 0.471, 0.558},
                                                   {0.128, 0.567, 0.551},
                                                   {0.135, 0.659, 0.518},
                                                   {0.267, 0.749, 0.441},
                                                   {0.478, 0.821, 0.318},
                                                   {0.741, 0.873, 0.150},
                                                   {0.993, 0.906, 0.144}}};
  const double place = std::clamp(share, 0.0, 1.0) * (anchors.size() - 1);
  const auto left = std::min(static_cast<std::size_t>(place), anchors.size() - 2);
  return mix(anchors[left], anchors[left + 1], place - static_cast<double>(left));
}

}  // namespace plot
