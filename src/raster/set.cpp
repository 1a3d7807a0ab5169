#include "raster/set.h"

#include <algorithm>

#include "base/parallel.h"
#include "raster/in_pixels.h"
#include "raster/set_pieces.h"
#include "raster/set_points.h"

namespace ifsm::core {
std::vector<Meets> set_pixels(const System& system, const Window& window, double tolerance, Watch& watch) {
  require_plane(system);
  require_window(window);
  const InPixels attractor(system, window);
  require_tolerance(tolerance, 4 * attractor.rounding);
  constexpr std::size_t read_beyond = 3;
  std::vector<Meets> states(static_cast<std::size_t>(window.pixels()) + read_beyond, Meets::no);
  follow_points(attractor, window, states.data(), watch);

  constexpr auto side = static_cast<std::int64_t>(KnownPixels::side);
  const std::int64_t across = (window.width + side - 1) / side, down = (window.height + side - 1) / side;
  const auto search = [&](std::int64_t number) {
    const std::int64_t left = number % across * side, top = number / across * side;
    search_tile(attractor, tolerance,
                {left, top, std::min(side, window.width - left), std::min(side, window.height - top),
                 states.data() + top * window.width + left, window.width},
                watch);
  };
  // Rounds of tiles, between which progress is told.
  constexpr std::int64_t round = 64;
  const std::int64_t tiles = across * down;
  for (std::int64_t done = 0; done < tiles; done += round) {
    watch.report(static_cast<double>(done) / static_cast<double>(tiles), "pixels");
    parallel_for(std::min(round, tiles - done), 0, [&](std::int64_t number) { search(done + number); });
  }
  watch.finish();
  states.resize(static_cast<std::size_t>(window.pixels()));
  return states;
}

}  // namespace ifsm::core
