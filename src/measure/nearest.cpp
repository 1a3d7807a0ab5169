#include "measure/nearest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "base/parallel.h"
#include "measure/boxes.h"

namespace ifsm::core {
namespace {

constexpr double epsilon = 2.220446049250313e-16;
constexpr double infinity = std::numeric_limits<double>::infinity();

// A place on the curve, and how far it is from the query.
struct Best {
  double square = infinity;
  Index segment = 0;
  double within = 0;
};

template <int D>
using Vector = std::array<double, D>;

// The point of a segment nearest to a query, told from the segment's start: relative to what is near, not to the
// origin.
template <int D>
void compare(const Polyline& polyline, Index segment, const Vector<D>& query, Best& best) {
  const double *a = polyline.start(segment), *b = polyline.end(segment);
  Vector<D> along, off;
  double forward = 0, length = 0;
  for (int axis = 0; axis < D; ++axis) {
    along[axis] = b[axis] - a[axis];
    off[axis] = query[axis] - a[axis];
    forward += along[axis] * off[axis];
    length += along[axis] * along[axis];
  }
  const double within = length > 0 ? std::clamp(forward / length, 0.0, 1.0) : 0.0;
  double square = 0;
  for (int axis = 0; axis < D; ++axis) {
    // At its end a segment is as far as the next one is at its start.
    const double left = within == 1 ? query[axis] - b[axis] : off[axis] - within * along[axis];
    square += left * left;
  }
  if (square < best.square || (square == best.square && segment < best.segment)) best = {square, segment, within};
}

template <int D>
double box_square(const Boxes& boxes, int level, Index node, const Vector<D>& query) {
  const double *low = boxes.low(level, node), *high = boxes.high(level, node);
  double square = 0;
  for (int axis = 0; axis < D; ++axis) {
    const double left = std::max({low[axis] - query[axis], query[axis] - high[axis], 0.0});
    square += left * left;
  }
  return square;
}

template <int D>
class Search {
 public:
  // `guess` is a segment that may be near: the nearer, the less is looked at.
  Search(const Polyline& polyline, const Boxes& boxes, const Vector<D>& query, Index guess)
      : polyline_(polyline), boxes_(boxes), query_(query) {
    double largest = 2;  // no coordinate of the curve is larger
    for (const double value : query) largest = std::max(largest, std::abs(value));
    // How far rounding may have brought a segment below the distance of its box: D + 8 roundings of coordinates and
    // their differences, each at most 2 · sqrt(D) · largest long; 4 · 64 is above that for D = 4.
    slack_ = 256 * epsilon * largest;
    compare<D>(polyline, guess, query, best_);
    set_limit();
    visit(boxes_.levels() - 1, 0);
  }
  const Best& best() const { return best_; }

 private:
  bool too_far(double square) const { return square > limit_; }

  void visit(int level, Index node) {
    if (level == 0) return compare_leaf(node);
    const Index left = 2 * node, right = 2 * node + 1;
    if (right >= boxes_.nodes(level - 1)) return visit(level - 1, left);
    const double to_left = box_square<D>(boxes_, level - 1, left, query_);
    const double to_right = box_square<D>(boxes_, level - 1, right, query_);
    const bool left_first = to_left <= to_right;
    if (!too_far(left_first ? to_left : to_right)) visit(level - 1, left_first ? left : right);
    if (!too_far(left_first ? to_right : to_left)) visit(level - 1, left_first ? right : left);
  }

  void compare_leaf(Index leaf) {
    for (Index s = boxes_.first_segment(leaf); s < boxes_.end_segment(leaf); ++s)
      compare<D>(polyline_, s, query_, best_);
    set_limit();
  }

  void set_limit() {
    const double reach = std::sqrt(best_.square) + slack_;
    limit_ = reach * reach;
  }

  const Polyline& polyline_;
  const Boxes& boxes_;
  const Vector<D>& query_;
  double slack_;
  double limit_ = infinity;
  Best best_;
};

template <int D>
Vector<D> in_units(const Points& queries, Index query, double unit) {
  Vector<D> scaled;
  for (int axis = 0; axis < D; ++axis) scaled[axis] = queries.plane(axis)[static_cast<std::size_t>(query)] / unit;
  return scaled;
}

// Told as the curve tells it: at its points, to the bit.
void tell(const Polyline& polyline, const Best& best, Index query, Nearest& answer) {
  const auto k = static_cast<std::size_t>(query);
  answer.parameters[k] = polyline.parameter(best.segment, best.within);
  answer.distances[k] = std::sqrt(best.square) * polyline.unit();
  const double* a = polyline.start(best.segment);
  const double* b = polyline.segments() > 0 ? polyline.end(best.segment) : a;
  const double t = best.within;
  for (Index axis = 0; axis < polyline.dimension(); ++axis)
    answer.points.plane(axis)[k] = (t == 1 ? b[axis] : a[axis] + t * (b[axis] - a[axis])) * polyline.unit();
}

template <int D, class Find>
Nearest nearest_of_each(const Polyline& polyline, const Points& queries, const Watch& watch, const Find& find) {
  constexpr Index chunk = 256;
  const Index count = queries.count();
  Nearest answer{std::vector<double>(static_cast<std::size_t>(count)),
                 std::vector<double>(static_cast<std::size_t>(count)), Points(D, count)};
  parallel_for((count + chunk - 1) / chunk, 0, [&](Index part) {
    watch.poll();
    Best last;  // queries are often neighbours, and so is what is near them
    for (Index q = part * chunk; q < std::min((part + 1) * chunk, count); ++q) {
      last = find(in_units<D>(queries, q, polyline.unit()), last.segment);
      tell(polyline, last, q, answer);
    }
  });
  for (Index q = 0; q < count; ++q)
    if (const double distance = answer.distances[static_cast<std::size_t>(q)]; !std::isfinite(distance))
      throw Error(Status::numerical, "queries",
                  "queries[" + std::to_string(q * D) +
                      "] begins a point whose distance from the curve leaves the range "
                      "of doubles; leave such far points out.")
          .at(q * D);
  return answer;
}

template <int D>
Nearest by_tree(const Polyline& polyline, const Points& queries, const Watch& watch) {
  const Boxes boxes(polyline);
  return nearest_of_each<D>(polyline, queries, watch, [&](const Vector<D>& query, Index guess) {
    return Search<D>(polyline, boxes, query, guess).best();
  });
}

template <int D>
Nearest by_all(const Polyline& polyline, const Points& queries, const Watch& watch) {
  return nearest_of_each<D>(polyline, queries, watch, [&](const Vector<D>& query, Index) {
    Best best;
    for (Index segment = 0; segment < polyline.segments(); ++segment) compare<D>(polyline, segment, query, best);
    if (polyline.segments() > 0) return best;
    best.square = 0;
    for (int axis = 0; axis < D; ++axis) {
      const double left = query[axis] - polyline.start(0)[axis];
      best.square += left * left;
    }
    return best;
  });
}

template <template <int> class Way>
Nearest of_dimension(const Polyline& polyline, const Points& queries, const Watch& watch) {
  if (queries.dimension() != polyline.dimension())
    throw Error(Status::shape, "queries",
                "queries must be points of dimension " + std::to_string(polyline.dimension()) + ", as the curve is.");
  switch (polyline.dimension()) {
    case 1: return Way<1>::find(polyline, queries, watch);
    case 2: return Way<2>::find(polyline, queries, watch);
    case 3: return Way<3>::find(polyline, queries, watch);
    default: return Way<4>::find(polyline, queries, watch);
  }
}

template <int D>
struct Tree {
  static Nearest find(const Polyline& polyline, const Points& queries, const Watch& watch) {
    return polyline.segments() > 0 ? by_tree<D>(polyline, queries, watch) : by_all<D>(polyline, queries, watch);
  }
};
template <int D>
struct All {
  static Nearest find(const Polyline& polyline, const Points& queries, const Watch& watch) {
    return by_all<D>(polyline, queries, watch);
  }
};

}  // namespace

Nearest nearest(const Polyline& polyline, const Points& queries, const Watch& watch) {
  return of_dimension<Tree>(polyline, queries, watch);
}

Nearest plain::nearest(const Polyline& polyline, const Points& queries) {
  return of_dimension<All>(polyline, queries, {});
}

}  // namespace ifsm::core
