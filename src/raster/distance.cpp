#include "raster/distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/error.h"
#include "base/parallel.h"
#include "raster/piece.h"
#include "system/reach.h"

namespace ifsm::core {
namespace {

struct Spot {
  double x, y;
};

// A piece as one looks at it: a parallelogram that holds it, the attractor's box under the map, and a point of it.
struct Frame {
  Piece piece;
  Spot centre, point;
  double size;  // from the centre to the farthest corner, at most
};

// In pixels no square leaves the range of doubles.
double length(double x, double y) { return std::sqrt(x * x + y * y); }
double between(const Spot& a, const Spot& b) { return length(a.x - b.x, a.y - b.y); }

// Pixels by blocks, each with the pieces that may hold the nearest point of one of its pixels.
class Field {
 public:
  Field(const System& system, const Box& box, const Window& window, double unit, double tolerance, const Watch& watch)
      : window_(window),
        unit_(unit),
        per_column_((window.right - window.left) / static_cast<double>(window.width) / unit),
        per_row_((window.top - window.bottom) / static_cast<double>(window.height) / unit),
        tolerance_(tolerance),
        watch_(watch) {
    for (const Affine& map : system.active_maps()) maps_.push_back(in_units(map));
    const Vector3 centre = place_of((box.low + box.high) / 2), half = (box.high - box.low) / (2 * unit);
    centre_ = {centre(0), centre(1)};
    half_ = {half(0), half(1)};
    const Vector3 point = place_of(system.point());
    point_ = {point(0), point(1)};
  }

  // A square block of pixels, or what of it is in the window.
  void fill(std::int64_t row, std::int64_t column, std::int64_t side, std::vector<double>& found) {
    fill(row, column, side, {frame_of({1, 0, 0, 1, 0, 0})}, found);
  }

 private:
  // Overlapping pieces may take long.
  void poll_now_and_then() const {
    constexpr std::int64_t between = 1 << 12;
    if (++looked_ % between == 0) watch_.poll();
  }

  Frame frame_of(const Piece& piece) const {
    return {piece,
            {piece.x(centre_.x, centre_.y), piece.y(centre_.x, centre_.y)},
            {piece.x(point_.x, point_.y), piece.y(point_.x, point_.y)},
            half_.x * length(piece.a, piece.c) + half_.y * length(piece.b, piece.d)};
  }

  // No point of the piece is nearer: seen along the line from its centre, the parallelogram reaches so far.
  double least(const Frame& frame, const Spot& from) const {
    const double x = from.x - frame.centre.x, y = from.y - frame.centre.y, far = length(x, y);
    if (far <= 0) return 0;
    const Piece& m = frame.piece;
    const double reach = half_.x * std::abs(x * m.a + y * m.c) + half_.y * std::abs(x * m.b + y * m.d);
    return far - reach / far;
  }

  // From the window's corner, in units.
  Vector3 place_of(const Vector3& x) const { return (x - Vector3(window_.left, window_.top, 0)) / unit_; }
  Piece in_units(const Affine& map) const {
    const Vector3 shift = place_of(map(Vector3(window_.left, window_.top, 0)));
    return {map.linear(0, 0), map.linear(0, 1), map.linear(1, 0), map.linear(1, 1), shift(0), shift(1)};
  }

  Spot place(double row, double column) const { return {column * per_column_, -row * per_row_}; }

  void fill(std::int64_t row, std::int64_t column, std::int64_t side, std::vector<Frame> frames,
            std::vector<double>& found) {
    if (row >= window_.height || column >= window_.width) return;
    if (side == 1) {
      const Spot middle = place(static_cast<double>(row) + .5, static_cast<double>(column) + .5);
      found[static_cast<std::size_t>(row * window_.width + column)] = unit_ * distance(middle, frames);
      return;
    }
    const double half = static_cast<double>(side) / 2;
    const Spot middle = place(static_cast<double>(row) + half, static_cast<double>(column) + half);
    // Of pixels' middles.
    const double radius = length(per_column_, per_row_) * (half - .5);
    refine(middle, radius, frames);
    const std::int64_t small = side / 2;
    for (const std::int64_t down : {std::int64_t{0}, small})
      for (const std::int64_t right : {std::int64_t{0}, small}) fill(row + down, column + right, small, frames, found);
  }

  // Splits pieces that are larger than the block, and forgets those that hold no nearest point of its pixels.
  void refine(const Spot& middle, double radius, std::vector<Frame>& frames) const {
    constexpr std::size_t many = 24;  // more cost more than they save: overlapping systems have any number
    for (bool split = true; split;) {
      double most = std::numeric_limits<double>::infinity();
      for (const Frame& frame : frames) most = std::min(most, between(frame.point, middle));
      std::erase_if(frames, [&](const Frame& frame) { return least(frame, middle) > most + 2 * radius; });
      split = false;
      poll_now_and_then();
      if (frames.size() > many) return;
      std::vector<Frame> finer;
      for (const Frame& frame : frames) {
        if (frame.size <= radius || finer.size() > many) {
          finer.push_back(frame);
          continue;
        }
        for (const Piece& map : maps_) finer.push_back(frame_of(frame.piece * map));
        split = true;
      }
      frames = std::move(finer);
    }
  }

  double distance(const Spot& from, const std::vector<Frame>& frames) {
    double best = std::numeric_limits<double>::infinity();
    for (const Frame& frame : frames) best = std::min(best, between(frame.point, from));
    std::vector<Near>& order = order_at(0);
    for (const Frame& frame : frames) order.push_back({between(frame.point, from), frame});
    descend(from, best, 0);
    return best;
  }

  struct Near {
    double known;  // distance of the frame's point
    Frame frame;
  };

  std::vector<Near>& order_at(std::size_t depth) {
    if (orders_.size() <= depth) orders_.resize(depth + 1);
    orders_[depth].clear();
    return orders_[depth];
  }

  // From the piece whose known point is nearest on; what is behind is often done with then.
  void descend(const Spot& from, double& best, std::size_t depth) {
    std::sort(orders_[depth].begin(), orders_[depth].end(),
              [](const Near& a, const Near& b) { return a.known < b.known; });
    for (std::size_t k = 0; k < orders_[depth].size(); ++k) {
      poll_now_and_then();
      if (best <= tolerance_) return;
      const Frame frame = orders_[depth][k].frame;
      if (least(frame, from) >= best - tolerance_) continue;
      if (depth > longest_word) refuse_words();
      std::vector<Near>& finer = order_at(depth + 1);
      for (const Piece& map : maps_) {
        const Frame next = frame_of(frame.piece * map);
        finer.push_back({between(next.point, from), next});
        best = std::min(best, finer.back().known);
      }
      descend(from, best, depth + 1);
    }
  }

  // What the stack holds, too.
  static constexpr std::size_t longest_word = 4096;
  [[noreturn]] void refuse_words() const {
    throw Error(Status::limit, "tolerance",
                "Pieces of words of " + std::to_string(longest_word) +
                    " maps are still larger than the tolerance: the maps shrink too slowly for this; give a larger "
                    "tolerance, up to 1, or larger pixels.")
        .with(tolerance_);
  }

  Window window_;
  double unit_, per_column_, per_row_, tolerance_;
  const Watch& watch_;
  mutable std::int64_t looked_ = 0;
  std::vector<Piece> maps_;
  Spot centre_{}, half_{}, point_{};
  std::vector<std::vector<Near>> orders_;  // by depth: kept, so that nothing is allocated
};

}  // namespace

std::vector<double> distances(const System& system, const Window& window, double tolerance, Watch& watch) {
  require_plane(system);
  require_window(window);
  static_cast<void>(system.enclosure());
  const double pixel = std::max((window.right - window.left) / static_cast<double>(window.width),
                                (window.top - window.bottom) / static_cast<double>(window.height));
  // Rounding of coordinates, with room for the words' products.
  constexpr double rounding = 0x1p-44;
  const double far =
      std::max({std::abs(window.left), std::abs(window.right), std::abs(window.bottom), std::abs(window.top)});
  const double least =
      rounding * (system.enclosure().axes.norm() + system.enclosure().centre.cwiseAbs().maxCoeff() + far) / pixel;
  require_tolerance(tolerance, least);
  std::vector<double> found(static_cast<std::size_t>(window.pixels()));
  const Box box = bounding_box(system, 0x1p-20 * system.enclosure().axes.norm());
  constexpr std::int64_t side = 64;
  const std::int64_t across = (window.width + side - 1) / side, down = (window.height + side - 1) / side;
  // A row of blocks after the other, between which progress is told.
  for (std::int64_t row = 0; row < down; ++row) {
    parallel_for(across, 0, [&](std::int64_t column) {
      watch.poll();
      Field(system, box, window, pixel, tolerance, watch).fill(row * side, column * side, side, found);
    });
    watch.report(static_cast<double>(row + 1) / static_cast<double>(down), "rows");
  }
  watch.finish();
  return found;
}

}  // namespace ifsm::core
