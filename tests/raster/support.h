// Windows for tests of pixels.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "../system/support.h"
#include "raster/chaos.h"
#include "system/named.h"
#include "system/reach.h"

namespace ifsm::core::testing {

inline Window around(const System& system, std::int64_t width, std::int64_t height) {
  const Box box = bounding_box(system, 1e-6 * system.enclosure().axes.norm());
  return {box.low(0), box.low(1), box.high(0), box.high(1), width, height};
}

inline Counts counted(const System& system, const Window& window, std::uint64_t seed, std::int64_t points) {
  Watch watch;
  return chaos_counts(system, window, seed, points, watch);
}

}  // namespace ifsm::core::testing
