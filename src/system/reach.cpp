#include "system/reach.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <queue>
#include <tuple>
#include <vector>

#include "base/cancel.h"
#include "base/error.h"

namespace ifsm::core {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

[[noreturn]] void refuse(double tolerance) {
  throw Error(Status::limit, "tolerance",
              "The tolerance " + text_of(tolerance) +
                  " takes more pieces of the attractor than are looked at; give a larger one.")
      .with(tolerance);
}

// Of the points of one piece w_θ(A): direction·x = v·y + offset, y in A, v = M_θ^T direction.
struct Piece {
  Vector3 v;
  double offset;
  double most;  // no point reaches farther
};

// Coordinates are taken about the middle of the enclosure, so that rounding is that of the attractor's size.
class Search {
 public:
  Search(const System& system, double tolerance)
      : middle_(system.enclosure().centre), axes_{Vector3::Zero(), system.enclosure().axes}, size_(axes_.axes.norm()) {
    constexpr double least = 0x1p-44;
    // The origin alone has no size, nor is anything rounded there: no tolerance is too small.
    const bool kept = tolerance > least * size_ || (size_ == 0 && tolerance == 0);
    if (!kept || !std::isfinite(tolerance))
      throw Error(Status::range, "tolerance",
                  "tolerance is " + text_of(tolerance) + "; give a finite one above " + text_of(least * size_) +
                      ", 2^-44 of the attractor's size.")
          .with(tolerance);
    for (const Affine& map : system.active_maps()) maps_.push_back({map.linear, map(middle_) - middle_});
    inside_ = fixed_point(maps_[0]);
  }

  const Vector3& middle() const { return middle_; }
  double size() const { return size_; }

  // The largest direction·(x - middle), passed by at most the tolerance. Level by level; a piece is done with when it
  // reaches beyond the best point that is known by no more than half the tolerance.
  double reach(const Vector3& direction, double tolerance) const {
    std::vector<Piece> pieces{piece(direction, 0)}, children;
    double best = -std::numeric_limits<double>::infinity(), most = best, merged = 0, rounding = 0;
    while (!pieces.empty()) {
      children.clear();
      double largest = 0;
      for (const Piece& each : pieces) {
        polled_.step();
        largest = std::max(largest, std::abs(each.offset) + each.v.norm() * size_);
        for (const Affine& map : maps_) {
          const Piece child = piece(map.linear.transpose() * each.v, each.offset + each.v.dot(map.shift));
          best = std::max(best, child.offset + child.v.dot(inside_));
          if (child.most > best + tolerance / 2)
            children.push_back(child);
          else
            most = std::max(most, child.most);
        }
      }
      rounding += 16 * epsilon * largest;  // of the sums of products that make a child, each of fewer than 16 terms
      constexpr std::int64_t most_work = 1 << 26;  // some seconds, of all directions together
      work_ += static_cast<std::int64_t>(children.size());
      if (work_ > most_work) refuse(tolerance);
      constexpr std::size_t few = 16;
      if (children.size() > few) {
        const double allowed = (tolerance / 2 - merged) / 16;
        merge(children, allowed);
        merged += allowed;
      }
      pieces.swap(children);
    }
    return std::max(most, best) + merged + rounding;
  }

 private:
  Piece piece(const Vector3& v, double offset) const { return {v, offset, offset + axes_.reach(v)}; }

  // Flat sides have many pieces alike: of those whose v are so near that no point of A tells them apart by more than
  // `allowed`, the one of the largest offset stands for all.
  void merge(std::vector<Piece>& pieces, double allowed) const {
    const double width = allowed / (std::sqrt(3.0) * size_);
    const auto cell = [&](const Piece& p) {
      return std::tuple(std::floor(p.v(0) / width), std::floor(p.v(1) / width), std::floor(p.v(2) / width));
    };
    std::sort(pieces.begin(), pieces.end(), [&](const Piece& a, const Piece& b) {
      const auto ca = cell(a), cb = cell(b);
      return ca != cb ? ca < cb : a.offset > b.offset;
    });
    pieces.erase(
        std::unique(pieces.begin(), pieces.end(), [&](const Piece& a, const Piece& b) { return cell(a) == cell(b); }),
        pieces.end());
  }

  Vector3 middle_;
  Ellipsoid axes_;  // of the enclosure, about 0
  double size_;
  std::vector<Affine> maps_;
  Vector3 inside_;  // a point of the attractor
  mutable Polled polled_;
  mutable std::int64_t work_ = 0;  // pieces so far
};

struct Peak {
  double value;
  Vector3 direction;
};

// Some unit vectors: those through a square on a side of the cube around the unit ball (an interval of a square's
// side).
struct Cell {
  int side;
  double sign;
  std::array<double, 2> at;
  double half;

  Vector3 direction(int dimension) const {
    Vector3 u = Vector3::Zero();
    u(side) = sign;
    for (int k = 1; k < dimension; ++k) u((side + k) % dimension) = at[static_cast<std::size_t>(k - 1)];
    return u.normalized();
  }
  // No direction of the cell is at a larger angle from its middle one.
  double angle(int dimension) const { return half * std::sqrt(dimension - 1.0); }
};

std::vector<Cell> parts(const Cell& whole, int dimension, int cuts) {
  std::vector<Cell> all;
  const double half = whole.half / cuts;
  const auto place = [&](double middle, int k) { return middle - whole.half + half * (2 * k + 1); };
  for (int i = 0; i < cuts; ++i)
    for (int j = 0; j < (dimension == 3 ? cuts : 1); ++j)
      all.push_back(
          {whole.side, whole.sign, {place(whole.at[0], i), dimension == 3 ? place(whole.at[1], j) : 0}, half});
  return all;
}

// The largest value over all directions of a function f whose largest value F, at u, makes f(v) >= F cos(u, v): a
// distance seen from all sides. f(v, tolerance) passes the exact value by at most the tolerance.
template <class Function>
Peak over_directions(int dimension, bool symmetric, double tolerance, const Function& f) {
  struct Seen {
    double most;
    Cell cell;
    bool operator<(const Seen& other) const { return most < other.most; }
  };
  std::priority_queue<Seen> open;
  Peak peak{-std::numeric_limits<double>::infinity(), Vector3::Zero()};
  int looks = 0;
  const auto look = [&](const Cell& cell) {
    constexpr int most_looks = 1 << 14;
    if (++looks > most_looks) refuse(tolerance);
    const Vector3 u = cell.direction(dimension);
    const double cosine = std::cos(cell.angle(dimension));
    // Large cells are judged roughly.
    const double rough = std::max(tolerance / 4, (1 - cosine) * std::max(peak.value, 0.0) / 4);
    const double value = f(u, rough);
    if (value - rough > peak.value) peak = {value - rough, u};
    open.push({value / cosine, cell});
  };
  for (int side = 0; side < dimension; ++side)
    for (const double sign : {1.0, -1.0})
      if (sign > 0 || !symmetric)
        for (const Cell& part : parts({side, sign, {0, 0}, 1}, dimension, 4)) look(part);
  while (open.top().most - peak.value > tolerance) {
    const Cell cell = open.top().cell;
    open.pop();
    for (const Cell& part : parts(cell, dimension, 2)) look(part);
  }
  return {open.top().most, peak.direction};
}

Peak farthest(const Search& search, int dimension, const Vector3& from, double tolerance) {
  const Vector3 to_middle = search.middle() - from;
  return over_directions(dimension, false, tolerance,
                         [&](const Vector3& u, double rough) { return search.reach(u, rough) + u.dot(to_middle); });
}

}  // namespace

double reach(const System& system, const Vector3& direction, double tolerance) {
  const Search search(system, tolerance);
  return search.reach(direction, tolerance) + direction.dot(search.middle());
}

Box bounding_box(const System& system, double tolerance) {
  const Search search(system, tolerance);
  Box box{Vector3::Zero(), Vector3::Zero()};
  for (int axis = 0; axis < system.dimension(); ++axis) {
    const Vector3 unit = Vector3::Unit(axis);
    box.high(axis) = search.middle()(axis) + search.reach(unit, tolerance);
    box.low(axis) = search.middle()(axis) - search.reach(-unit, tolerance);
  }
  return box;
}

double farthest(const System& system, const Vector3& from, double tolerance) {
  return farthest(Search(system, tolerance), system.dimension(), from, tolerance).value;
}

double diameter(const System& system, double tolerance) {
  const Search search(system, tolerance);
  return over_directions(
             system.dimension(), true, tolerance,
             [&](const Vector3& u, double rough) { return search.reach(u, rough / 2) + search.reach(-u, rough / 2); })
      .value;
}

Ball enclosing_ball(const System& system, double tolerance) {
  const Search search(system, tolerance);
  const double rough = std::max(tolerance, search.size() / 256);
  // Bădoiu and Clarkson: go towards the farthest point, by ever smaller parts of the way.
  Vector3 centre = search.middle();
  constexpr int steps = 100;
  for (int k = 1; k <= steps; ++k) {
    const Peak peak = farthest(search, system.dimension(), centre, rough);
    centre += peak.value * peak.direction / (k + 1);
  }
  return {centre, farthest(search, system.dimension(), centre, tolerance).value};
}

}  // namespace ifsm::core
