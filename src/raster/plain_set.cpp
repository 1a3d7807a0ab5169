// set_pixels as it is explained: one piece after the other, in the box about the attractor.
#include <algorithm>
#include <cmath>

#include "raster/in_pixels.h"
#include "raster/set.h"

namespace ifsm::core {
namespace {

class Search {
 public:
  Search(const System& system, const Window& window, double tolerance)
      : attractor_(system, window),
        window_(window),
        tolerance_(tolerance),
        states_(static_cast<std::size_t>(window.pixels()), Meets::no) {}

  std::vector<Meets> states() {
    std::vector<Piece> open{attractor_.whole};
    while (!open.empty()) {
      const Piece now = open.back();
      open.pop_back();
      if (is_settled(now)) continue;
      for (const Piece& map : attractor_.maps) open.push_back(now * map);
    }
    return std::move(states_);
  }

 private:
  // Pixels first_column … last_column of rows first_row … last_row; those beyond the window are pixels too.
  struct Range {
    double first_column, last_column, first_row, last_row;
  };

  // Does the piece tell nothing more, or is it too small to be looked into?
  bool is_settled(const Piece& p) {
    const double across = attractor_.across(p) + attractor_.rounding, down = attractor_.down(p) + attractor_.rounding;
    const Range touched{std::floor(p.e - across), std::floor(p.e + across), std::floor(p.f - down),
                        std::floor(p.f + down)};
    if (all(touched, [](Meets state) { return state == Meets::yes; })) return true;  // also when it misses the window
    const bool is_one = touched.first_column == touched.last_column && touched.first_row == touched.last_row;
    if (!is_one && 2 * std::max(across, down) > tolerance_) return false;
    all(touched, [&](Meets& state) {
      state = std::max(state, is_one ? Meets::yes : Meets::undecided);
      return true;
    });
    return true;
  }

  // Of those in the window, until one is not.
  template <class Is>
  bool all(const Range& r, const Is& is) {
    const auto last_column = std::min(r.last_column, static_cast<double>(window_.width - 1));
    const auto last_row = std::min(r.last_row, static_cast<double>(window_.height - 1));
    for (double row = std::max(r.first_row, 0.0); row <= last_row; ++row)
      for (double column = std::max(r.first_column, 0.0); column <= last_column; ++column)
        if (!is(states_[static_cast<std::size_t>(row) * static_cast<std::size_t>(window_.width) +
                        static_cast<std::size_t>(column)]))
          return false;
    return true;
  }

  InPixels attractor_;
  Window window_;
  double tolerance_;
  std::vector<Meets> states_;
};

}  // namespace

std::vector<Meets> plain::set_pixels(const System& system, const Window& window, double tolerance) {
  return Search(system, window, tolerance).states();
}

}  // namespace ifsm::core
