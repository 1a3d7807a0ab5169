#include "raster/set.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "base/error.h"
#include "system/reach.h"

namespace ifsm::core {
namespace {

// x → M x + t of the plane, in pixels: across from the left edge, down from the upper one. Affine's without what is
// zero in the plane: a third of the products, in the innermost loop.
struct Piece {
  double a, b, c, d, e, f;

  friend Piece operator*(const Piece& p, const Piece& q) {
    return {p.a * q.a + p.b * q.c, p.a * q.b + p.b * q.d,       p.c * q.a + p.d * q.c,
            p.c * q.b + p.d * q.d, p.a * q.e + p.b * q.f + p.e, p.c * q.e + p.d * q.f + p.f};
  }
};

// Pixels first_column … last_column of rows first_row … last_row.
struct Range {
  std::int64_t first_column, last_column, first_row, last_row;

  bool is_one() const { return first_column == last_column && first_row == last_row; }
  std::int64_t pixels() const { return (last_column - first_column + 1) * (last_row - first_row + 1); }
};

class Search {
 public:
  Search(const System& system, const Window& window, double tolerance)
      : window_(window), tolerance_(tolerance), states_(static_cast<std::size_t>(window.pixels()), Meets::no) {
    const Box box = bounding_box(system, 0x1p-40 * system.enclosure().axes.norm());
    const Grid grid(window);
    // A's middle becomes the origin: a piece is then its own middle and a matrix of that of A's box.
    const double across = grid.columns_per_unit, down = -grid.rows_per_unit;
    const Vector3 middle = (box.low + box.high) / 2;
    half_[0] = (box.high(0) - box.low(0)) / 2 * across, half_[1] = (box.high(1) - box.low(1)) / 2 * -down;
    for (const int i : system.active()) {
      const Affine& map = system.maps()[static_cast<std::size_t>(i)];
      const Vector3 moved = map(middle) - middle;
      maps_.push_back({map.linear(0, 0), map.linear(0, 1) * across / down, map.linear(1, 0) * down / across,
                       map.linear(1, 1), moved(0) * across, moved(1) * down});
    }
    const Vector3 inside = fixed_point(system.maps()[static_cast<std::size_t>(system.active()[0])]) - middle;
    inside_ = {inside(0) * across, inside(1) * down};
    whole_ = {1, 0, 0, 1, (middle(0) - window.left) * across, (middle(1) - window.top) * down};

    // Each map of a word adds some roundings of numbers as large as the attractor and the window are in pixels.
    const double largest = std::max({std::abs(whole_.e), std::abs(whole_.f), 2 * half_[0], 2 * half_[1]});
    rounding_ = longest_word * 8 * std::numeric_limits<double>::epsilon() * largest;
    if (!(tolerance > 4 * rounding_ && tolerance <= 1))
      throw Error(Status::range, "tolerance",
                  "tolerance is " + text_of(tolerance) + " pixels; give one above " + text_of(4 * rounding_) +
                      ", four times what rounding does to points of this window, and at most 1.")
          .with(tolerance);
  }

  // First points of the attractor, which meet most pixels; then proofs for the others.
  // Depth first down to pieces of some pixels, each of which is then gone through level by level: when it comes to its
  // small pieces, the pixels around them are mostly known to be met.
  std::vector<Meets> states(Watch& watch) {
    follow_points(watch);
    std::vector<Open> large{{whole_, 0}};
    while (!large.empty()) {
      const Open now = large.back();
      large.pop_back();
      if (is_large(now.piece))
        split(now, large);
      else
        go_through(now, watch);
    }
    return std::move(states_);
  }

 private:
  static constexpr int longest_word = 4096;
  struct Open {
    Piece piece;
    int length;
  };

  // From a point of the attractor through all maps, on from every pixel that was not met before. What it misses, for
  // its pixel was met by another point, the pieces find.
  void follow_points(Watch& watch) {
    struct Point {
      double x, y;  // from the box's middle
      int length;
    };
    std::vector<Point> open{{inside_[0], inside_[1], 0}};
    while (!open.empty()) {
      const Point now = open.back();
      open.pop_back();
      poll(watch);
      for (const Piece& map : maps_) {
        const Point next{map.a * now.x + map.b * now.y + map.e, map.c * now.x + map.d * now.y + map.f, now.length + 1};
        const Range point = around(next.x + whole_.e, next.y + whole_.f, rounding_, rounding_);
        if (!point.is_one() || !is_inside(point) || all_met(point) || next.length == longest_word) continue;
        mark(point, Meets::yes);
        open.push_back(next);
      }
    }
  }
  bool is_inside(const Range& pixel) const {
    return pixel.first_column >= 0 && pixel.first_column < window_.width && pixel.first_row >= 0 &&
           pixel.first_row < window_.height;
  }

  void poll(const Watch& watch) {
    constexpr std::int64_t between = 1 << 12;
    if (++looked_ % between == 0) watch.poll();
  }

  void split(const Open& open, std::vector<Open>& parts) const {
    if (open.length == longest_word)
      throw Error(Status::limit, "tolerance",
                  "Pieces of words of " + std::to_string(longest_word) +
                      " maps are still larger than the tolerance; give a larger one.")
          .with(tolerance_);
    for (const Piece& map : maps_) parts.push_back({open.piece * map, open.length + 1});
  }

  void go_through(const Open& first, Watch& watch) {
    std::vector<Open> level{first}, next;
    for (; !level.empty(); level.swap(next)) {
      next.clear();
      for (const Open& open : level) {
        poll(watch);
        if (!is_settled(open.piece)) split(open, next);
      }
    }
  }

  double across(const Piece& p) const { return std::abs(p.a) * half_[0] + std::abs(p.b) * half_[1] + rounding_; }
  double down(const Piece& p) const { return std::abs(p.c) * half_[0] + std::abs(p.d) * half_[1] + rounding_; }
  bool misses(const Piece& p, double across, double down) const {
    return !(p.e + across >= 0 && p.e - across < static_cast<double>(window_.width) && p.f + down >= 0 &&
             p.f - down < static_cast<double>(window_.height));
  }
  // One that reaches into the window, and is worth going through in parts.
  bool is_large(const Piece& p) const {
    constexpr double some = 32;  // pixels, to each side of its middle
    return std::max(across(p), down(p)) > some && !misses(p, across(p), down(p));
  }

  // Does the piece tell nothing more, or is it too small to be looked into?
  bool is_settled(const Piece& p) {
    const double across = this->across(p), down = this->down(p);
    if (misses(p, across, down)) return true;
    const Range touched = around(p.e, p.f, across, down);
    if (touched.is_one()) {  // also when it passes the window's edge: pixels beyond are pixels
      mark(touched, Meets::yes);
      return true;
    }
    const Range seen = clipped(touched);
    constexpr std::int64_t few = 64;
    if (seen.pixels() > few) return false;
    const double x = p.a * inside_[0] + p.b * inside_[1] + p.e, y = p.c * inside_[0] + p.d * inside_[1] + p.f;
    if (const Range point = around(x, y, rounding_, rounding_); point.is_one()) mark(point, Meets::yes);
    if (all_met(seen)) return true;
    if (std::max(across, down) > tolerance_) return false;
    mark(seen, Meets::undecided);
    return true;
  }

  static Range around(double x, double y, double across, double down) {
    const auto pixel = [](double coordinate) {  // the whole part below, without a call
      const auto whole = static_cast<std::int64_t>(coordinate);
      return whole - (static_cast<double>(whole) > coordinate ? 1 : 0);
    };
    return {pixel(x - across), pixel(x + across), pixel(y - down), pixel(y + down)};
  }
  Range clipped(const Range& r) const {
    return {std::max(r.first_column, std::int64_t{0}), std::min(r.last_column, window_.width - 1),
            std::max(r.first_row, std::int64_t{0}), std::min(r.last_row, window_.height - 1)};
  }
  template <class Each>
  bool for_all(const Range& range, const Each& each) {
    const Range r = clipped(range);
    for (std::int64_t row = r.first_row; row <= r.last_row; ++row)
      for (std::int64_t column = r.first_column; column <= r.last_column; ++column)
        if (!each(states_[static_cast<std::size_t>(row * window_.width + column)])) return false;
    return true;
  }
  bool all_met(const Range& range) {
    return for_all(range, [](Meets state) { return state == Meets::yes; });
  }
  void mark(const Range& range, Meets as) {
    for_all(range, [&](Meets& state) {
      state = std::max(state, as);
      return true;
    });
  }

  Window window_;
  double tolerance_;
  std::vector<Meets> states_;
  std::vector<Piece> maps_;
  Piece whole_{};
  std::array<double, 2> half_{};    // of the attractor's box
  std::array<double, 2> inside_{};  // a point of the attractor, from the box's middle
  double rounding_ = 0;
  std::int64_t looked_ = 0;
};

}  // namespace

std::vector<Meets> set_pixels(const System& system, const Window& window, double tolerance, Watch& watch) {
  require_plane(system);
  require_window(window);
  return Search(system, window, tolerance).states(watch);
}

}  // namespace ifsm::core
