#include "measure/distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "measure/nearest.h"

namespace ifsm::core {
namespace {

void require_like(const Model& model, const Model& other) {
  if (other.dimension() != model.dimension())
    throw Error(Status::shape, "other",
                "other is a curve of dimension " + std::to_string(other.dimension()) + ", the model one of dimension " +
                    std::to_string(model.dimension()) + "; compare curves of one dimension.")
        .with(static_cast<double>(other.dimension()))
        .needs(model.dimension());
}

void require_as_many_samples(const Model& model, const Model& other) {
  const Index own = model.placement().samples(), given = other.placement().samples();
  if (given != own)
    throw Error(Status::shape, "other",
                "other has " + std::to_string(given) + " samples, the model " + std::to_string(own) +
                    "; distances at samples need as many.")
        .with(static_cast<double>(given))
        .needs(own);
}

Eigen::VectorXd at_samples(const Model& model, const Model& other) {
  require_as_many_samples(model, other);
  const Eigen::MatrixXd apart = samples(model).matrix() - samples(other).matrix();
  Eigen::VectorXd lengths(apart.rows());
  for (Index k = 0; k < apart.rows(); ++k) lengths(k) = apart.row(k).stableNorm();
  for (Index k = 0; k < lengths.size(); ++k)
    if (!std::isfinite(lengths(k)))
      throw Error(Status::numerical, "other",
                  "The curves' samples " + std::to_string(k) +
                      " are farther from each other than a double can tell; scale both curves down.")
          .at(k);
  return lengths;
}

double rms_of(const Eigen::VectorXd& lengths) {
  return lengths.stableNorm() / std::sqrt(static_cast<double>(lengths.size()));
}

// The farthest that a polyline goes from another one, edges and all. A point of an edge is at most as far as
// - the ends allow, since distances change no faster than places: (d0 + d1 + length) / 2;
// - the segment nearest to one end: the distance from a segment is convex along the edge, so the other end bounds it.
// Edges that may hold more than what was found are halved, all at once, until none is left.
class Farthest {
 public:
  Farthest(const Points& points, bool closed, const Points& others, bool others_closed, const Watch& watch)
      : watch_(watch),
        polyline_(others, others_closed),
        rounding_(64 * std::numeric_limits<double>::epsilon() * polyline_.unit()) {
    const Nearest there = asked(points);
    const Index count = points.count(), edges = closed ? count : count - 1;
    for (Index k = 0; k < edges; ++k)
      if (Edge edge(told(points, there, k), told(points, there, (k + 1) % count)); is_open(edge))
        edges_.push_back(edge);
  }

  double find() {
    while (!edges_.empty()) {
      halve();
      std::erase_if(edges_, [&](const Edge& edge) { return !is_open(edge); });
    }
    return found_;
  }

 private:
  static constexpr double precision = 1e-6;

  using Place = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 4, 1>;

  struct Point {
    Place place;
    double distance;
    Index segment;  // of the other, the nearest
  };
  using Edge = std::pair<Point, Point>;

  Nearest asked(const Points& points) {
    Nearest there = nearest(polyline_, points, watch_);
    found_ = std::max(found_, *std::ranges::max_element(there.distances));
    return there;
  }

  // Not kept for all: of ten million points few are at edges that may hold more.
  Point told(const Points& points, const Nearest& there, Index k) const {
    const auto segment = static_cast<Index>(polyline_.position(there.parameters[static_cast<std::size_t>(k)]));
    return {points.matrix().row(k), there.distances[static_cast<std::size_t>(k)],
            std::clamp<Index>(segment, 0, std::max<Index>(0, polyline_.segments() - 1))};
  }

  double to_segment(const Place& place, Index segment) const {
    using At = Eigen::Map<const Place>;
    const At start(polyline_.start(segment), polyline_.dimension());
    if (polyline_.segments() == 0) return (place - start * polyline_.unit()).stableNorm();
    const Place along = At(polyline_.end(segment), polyline_.dimension()) - start;
    const Place off = place / polyline_.unit() - start;
    const double length = along.squaredNorm();
    const double within = length > 0 ? std::clamp(off.dot(along) / length, 0.0, 1.0) : 0.0;
    return (off - within * along).norm() * polyline_.unit();
  }

  // May it hold more than what was found?
  bool is_open(const Edge& edge) const { return bound(edge.first, edge.second) > found_ * (1 + precision) + rounding_; }

  double bound(const Point& a, const Point& b) const {
    const double by_ends = (a.distance + b.distance + (b.place - a.place).stableNorm()) / 2;
    if (by_ends <= found_) return by_ends;
    return std::min({by_ends, std::max(a.distance, to_segment(b.place, a.segment)),
                     std::max(b.distance, to_segment(a.place, b.segment))});
  }

  void halve() {
    Points middles(polyline_.dimension(), static_cast<Index>(edges_.size()));
    for (std::size_t k = 0; k < edges_.size(); ++k)
      middles.matrix().row(static_cast<Index>(k)) = (edges_[k].first.place + edges_[k].second.place) / 2;
    const Nearest there = asked(middles);
    std::vector<Edge> halves;
    for (std::size_t k = 0; k < edges_.size(); ++k) {
      const Point middle = told(middles, there, static_cast<Index>(k));
      halves.emplace_back(edges_[k].first, middle);
      halves.emplace_back(middle, edges_[k].second);
    }
    edges_.swap(halves);
  }

  const Watch& watch_;
  Polyline polyline_;
  double rounding_;  // coordinates are 1 … 2 units at most, places and feet rounded a few times
  std::vector<Edge> edges_;
  double found_ = 0;
};

double hausdorff(const Model& model, const Model& other, const Watch& watch) {
  const Points own = places(model), given = places(other);
  return std::max(Farthest(own, model.closed(), given, other.closed(), watch).find(),
                  Farthest(given, other.closed(), own, model.closed(), watch).find());
}

}  // namespace

Distances distances(const Model& model, const Model& other) {
  require_like(model, other);
  const Eigen::VectorXd lengths = at_samples(model, other);
  Index farthest = 0;
  const double largest = lengths.maxCoeff(&farthest);
  return {rms_of(lengths), largest, farthest, hausdorff(model, other, {})};
}

double distance(const Model& model, const Model& other, Distance which, const Watch& watch) {
  require_like(model, other);
  switch (which) {
    case Distance::rms: return rms_of(at_samples(model, other));
    case Distance::largest: return at_samples(model, other).maxCoeff();
    default: return hausdorff(model, other, watch);
  }
}

}  // namespace ifsm::core
