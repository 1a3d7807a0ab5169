#include "measure/crossings.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "base/cancel.h"
#include "measure/boxes.h"
#include "measure/orientation.h"

namespace ifsm::core {
namespace {

constexpr std::size_t most_crossings = std::size_t{1} << 22;

// Coordinates are below 2 in magnitude, and those that exact products would lose are rounded: see the header.
double with_room_below(double value) {
  if (std::abs(value) >= 0x1p-397) return value;
  return std::nearbyint(value * 0x1p450) * 0x1p-450;
}

bool same_point(const double* a, const double* b) { return a[0] == b[0] && a[1] == b[1]; }

// The curve without repeated points, and where its segments were.
class Path {
 public:
  explicit Path(const Polyline& whole) : whole_(whole), thinned_(thin()) {}

  const Polyline& polyline() const { return thinned_; }
  Index segments() const { return thinned_.segments(); }
  const double* start(Index s) const { return thinned_.start(s); }
  const double* end(Index s) const { return thinned_.end(s); }
  double parameter(Index segment, double within) const {
    const Index first = from_[static_cast<std::size_t>(segment)];
    if (within < 1) return whole_.parameter(first, within);
    // At the end of a ring's last segment its points may have been repeats of the first: the ring's start.
    return whole_.parameter(first + 1, 0);
  }
  double unit() const { return whole_.unit() * thinned_.unit(); }

  bool neighbours(Index earlier, Index later) const {
    return later == earlier + 1 || (thinned_.closed() && earlier == 0 && later == segments() - 1);
  }
  // Does the segment own its end?
  bool owns_end(Index segment) const { return !thinned_.closed() && segment == segments() - 1; }

 private:
  Polyline thin() {
    std::vector<double> kept;
    for (Index k = 0; k < whole_.count(); ++k) {
      const double* given = whole_.start(k);
      const double point[] = {with_room_below(given[0]), with_room_below(given[1])};
      if (!from_.empty() && same_point(point, kept.data() + kept.size() - 2)) {
        from_.back() = k;  // the segment that leaves begins at the last of the equal points
        continue;
      }
      kept.insert(kept.end(), point, point + 2);
      from_.push_back(k);
    }
    // A ring whose last points repeat the first: the last segment is the one that arrives there.
    while (whole_.closed() && from_.size() > 1 && same_point(kept.data(), kept.data() + kept.size() - 2)) {
      from_.pop_back();
      kept.resize(kept.size() - 2);
    }
    return {Points::from_interleaved(kept.data(), static_cast<Index>(from_.size()), 2), whole_.closed()};
  }

  const Polyline& whole_;
  std::vector<Index> from_;  // segments of the whole
  Polyline thinned_;
};

// How far along a segment one of its points lies, on its longer axis: 0 and 1 exactly at its ends.
double within(const double* a, const double* b, const double* x) {
  const int axis = std::abs(b[0] - a[0]) >= std::abs(b[1] - a[1]) ? 0 : 1;
  if (x[axis] == a[axis]) return 0;
  if (x[axis] == b[axis]) return 1;
  return std::clamp((x[axis] - a[axis]) / (b[axis] - a[axis]), 0.0, 1.0);
}

class Pairs {
 public:
  explicit Pairs(const Path& path) : path_(path) {}

  void compare(Index p, Index q) {
    if (p > q) std::swap(p, q);
    const double *a = path_.start(p), *b = path_.end(p), *c = path_.start(q), *d = path_.end(q);
    if (apart(a, b, c, d)) return;
    const double of_c = orientation(a, b, c), of_d = orientation(a, b, d);
    if ((of_c > 0 && of_d > 0) || (of_c < 0 && of_d < 0)) return;
    if (of_c == 0 && of_d == 0) return collinear(p, q);
    if (path_.neighbours(p, q)) return;
    const double of_a = orientation(c, d, a), of_b = orientation(c, d, b);
    if ((of_a > 0 && of_b > 0) || (of_a < 0 && of_b < 0)) return;
    // One point. At an end that another segment owns, that one tells it.
    if (of_b == 0 && !path_.owns_end(p)) return;
    if (of_d == 0 && !path_.owns_end(q)) return;
    if (of_a == 0) return touch(p, q, a);
    if (of_b == 0) return touch(p, q, b);
    if (of_c == 0) return touch(p, q, c);
    if (of_d == 0) return touch(p, q, d);
    // Opposite signs: their difference does not cancel, so both shares are right to the last digits.
    const double to_a = exact_orientation(c, d, a), to_b = exact_orientation(c, d, b);
    const double to_c = exact_orientation(a, b, c), to_d = exact_orientation(a, b, d);
    const double s = to_a / (to_a - to_b), t = to_c / (to_c - to_d);
    const double point[] = {a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])};
    tell(p, q, {s, t, s, t}, point);
  }

  std::vector<Crossing> sorted() && {
    std::ranges::sort(found_, {}, [](const Found& f) { return std::pair(f.p, f.q); });
    std::vector<Crossing> all;
    all.reserve(found_.size());
    for (const Found& f : found_) all.push_back(f.crossing);
    return all;
  }

 private:
  struct Found {
    Index p, q;
    Crossing crossing;
  };
  struct Shares {
    double first_p, first_q, last_p, last_q;  // within the segments
  };

  static bool apart(const double* a, const double* b, const double* c, const double* d) {
    for (int axis = 0; axis < 2; ++axis)
      if (std::max(a[axis], b[axis]) < std::min(c[axis], d[axis]) ||
          std::max(c[axis], d[axis]) < std::min(a[axis], b[axis]))
        return true;
    return false;
  }

  // On one line: what of q lies between p's ends, in the order of p.
  void collinear(Index p, Index q) {
    const double *a = path_.start(p), *b = path_.end(p), *c = path_.start(q), *d = path_.end(q);
    const int axis = a[0] != b[0] ? 0 : 1;
    const auto before = [&](const double* x, const double* y) {
      return a[axis] < b[axis] ? x[axis] < y[axis] : x[axis] > y[axis];
    };
    const bool along = before(c, d);
    const double *q_first = along ? c : d, *q_last = along ? d : c;
    const double *first = before(a, q_first) ? q_first : a, *last = before(q_last, b) ? q_last : b;
    if (before(last, first)) return;
    if (before(first, last))
      return tell(p, q, {within(a, b, first), within(c, d, first), within(a, b, last), within(c, d, last)}, first);
    if (path_.neighbours(p, q)) return;
    if (same_point(first, b) && !path_.owns_end(p)) return;
    if (same_point(first, d) && !path_.owns_end(q)) return;
    touch(p, q, first);
  }

  void touch(Index p, Index q, const double* point) {
    const double s = within(path_.start(p), path_.end(p), point), t = within(path_.start(q), path_.end(q), point);
    tell(p, q, {s, t, s, t}, point);
  }

  void tell(Index p, Index q, const Shares& shares, const double* point) {
    if (found_.size() == most_crossings)
      throw Error(Status::limit, "model",
                  "The curve meets itself more than " + std::to_string(most_crossings) +
                      " times; ask about a coarser model of it, or a part.");
    found_.push_back({p,
                      q,
                      {path_.parameter(p, shares.first_p),
                       path_.parameter(q, shares.first_q),
                       path_.parameter(p, shares.last_p),
                       path_.parameter(q, shares.last_q),
                       {point[0] * path_.unit(), point[1] * path_.unit()}}});
  }

  const Path& path_;
  std::vector<Found> found_;
};

bool meet(const Boxes& boxes, int level, Index a, Index b) {
  for (int axis = 0; axis < 2; ++axis)
    if (boxes.high(level, a)[axis] < boxes.low(level, b)[axis] ||
        boxes.high(level, b)[axis] < boxes.low(level, a)[axis])
      return false;
  return true;
}

// All pairs of segments in boxes that meet: a box with itself, or two of one level.
void descend(const Boxes& boxes, Pairs& pairs, int level, Index a, Index b) {
  if (a != b && !meet(boxes, level, a, b)) return;
  if (level == 0) {
    poll_interrupt();
    for (Index p = boxes.first_segment(a); p < boxes.end_segment(a); ++p)
      for (Index q = a == b ? p + 1 : boxes.first_segment(b); q < boxes.end_segment(b); ++q) pairs.compare(p, q);
    return;
  }
  const Index end = boxes.nodes(level - 1);
  for (Index child = 2 * a; child < std::min(2 * a + 2, end); ++child)
    for (Index other = a == b ? child : 2 * b; other < std::min(2 * b + 2, end); ++other)
      descend(boxes, pairs, level - 1, child, other);
}

void require_plane(const Polyline& polyline) {
  if (polyline.dimension() == 2) return;
  throw Error(Status::shape, "model",
              "Self-intersections are told of curves in the plane, and this one has dimension " +
                  std::to_string(polyline.dimension()) + "; project it to two coordinates first.");
}

}  // namespace

std::vector<Crossing> crossings(const Polyline& polyline) {
  require_plane(polyline);
  const Path path(polyline);
  if (path.segments() == 0) return {};
  Pairs pairs(path);
  const Boxes boxes(path.polyline());
  descend(boxes, pairs, boxes.levels() - 1, 0, 0);
  return std::move(pairs).sorted();
}

std::vector<Crossing> plain::crossings(const Polyline& polyline) {
  require_plane(polyline);
  const Path path(polyline);
  Pairs pairs(path);
  for (Index p = 0; p < path.segments(); ++p)
    for (Index q = p + 1; q < path.segments(); ++q) pairs.compare(p, q);
  return std::move(pairs).sorted();
}

}  // namespace ifsm::core
