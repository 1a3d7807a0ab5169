// The chaos game: points x_k+1 = w_i(x_k), i drawn by the probabilities, follow the system's measure. Counted by pixel.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/cancel.h"
#include "system/system.h"

namespace ifsm::core {

// A rectangle of the plane and its pixels, row 0 on top. A pixel owns its left and its upper edge.
struct Window {
  double left, bottom, right, top;
  std::int64_t width, height;

  std::int64_t pixels() const { return width * height; }
};

// Which pixel of a window a point is in.
struct Grid {
  double left, top, columns_per_unit, rows_per_unit;
  std::int64_t width, height;

  explicit Grid(const Window& w)
      : left(w.left),
        top(w.top),
        columns_per_unit(static_cast<double>(w.width) / (w.right - w.left)),
        rows_per_unit(static_cast<double>(w.height) / (w.top - w.bottom)),
        width(w.width),
        height(w.height) {}

  // Row by row; width · height outside.
  std::int64_t pixel(double x, double y) const {
    const double column = (x - left) * columns_per_unit, row = (top - y) * rows_per_unit;
    if (!(column >= 0 && column < static_cast<double>(width) && row >= 0 && row < static_cast<double>(height)))
      return width * height;
    return static_cast<std::int64_t>(row) * width + static_cast<std::int64_t>(column);
  }
};

// 1 … 32768 pixels a side, finite, right > left, top > bottom, and pixels that doubles tell apart.
void require_window(const Window& window);

// Refuses systems of space: a shape error.
void require_plane(const System& system);

// Of a tolerance in pixels: above what rounding does to points of the window, up to 1. A range error, argument
// "tolerance"; or "window", when rounding does more than a pixel.
void require_tolerance(double tolerance, double rounding);

struct Counts {
  std::vector<std::uint32_t> pixels;  // row by row; they saturate
  std::int64_t inside = 0;            // points in the window
};

// So many points of a plane system, counted. The same seed gives the same counts on any number of threads and on any
// machine. Points come in chunks of 2^20, of 64 orbits each, which start on the attractor and forget where. Beside the
// counts, takes a quarter of their memory, or what makes it 80 MB with them.
Counts chaos_counts(const System& system, const Window& window, std::uint64_t seed, std::int64_t points, Watch& watch);

// The same, counted where the caller wants them: a window that no cache holds takes no second array of its size.
// Written to from the beginning; after Cancelled or bad_alloc, anything may be there. Tells how many points are inside.
std::int64_t count_in_place(const System& system, const Window& window, std::uint64_t seed, std::int64_t points,
                            std::span<std::uint32_t> counts, Watch& watch);
// Above so many pixels nothing else is done.
constexpr std::int64_t counted_in_place = 1 << 23;

// The same points by a loop of double precision: what the vectors are tested against.
namespace plain {
Counts chaos_counts(const System& system, const Window& window, std::uint64_t seed, std::int64_t points);
}

// Are single precision's points told from double's by nothing but chance, in that window? (docs/systems.md)
bool single_precision_suffices(const System& system, const Window& window);

}  // namespace ifsm::core
