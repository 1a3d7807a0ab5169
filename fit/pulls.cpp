#include "fit/pulls.h"

#include <algorithm>
#include <cmath>

#include "measure/nearest.h"

namespace ifsm::core {
namespace {

// A ring's last place is its first one.
Points once(const Points& line, bool closed) {
  Points points(line.dimension(), line.count() - (closed ? 1 : 0));
  points.matrix() = line.matrix().topRows(points.count());
  return points;
}

// The points, then the middles of the edges from each of them to the next.
Points with_middles(const Points& points, bool closed) {
  const Index count = points.count(), edges = count < 2 ? 0 : closed ? count : count - 1;
  Points all(points.dimension(), count + edges);
  all.matrix().topRows(count) = points.matrix();
  for (Index e = 0; e < edges; ++e)
    all.matrix().row(count + e) = (points.matrix().row(e) + points.matrix().row((e + 1) % count)) / 2;
  return all;
}

Eigen::VectorXd counted_by(const Model& model, Distance distance) {
  if (distance == Distance::largest) return counted_distances(model);
  Eigen::VectorXd all = Eigen::VectorXd::Ones(model.shape().line_length(model.levels()));
  if (model.closed()) all(all.size() - 1) = 0;
  return all;
}

}  // namespace

PullingCurve::PullingCurve(const Model& model, Distance distance, const Watch& watch)
    : distance_(distance),
      watch_(watch),
      closed_(model.closed()),
      data_(line(model, model.levels())),
      counted_(counted_by(model, distance)),
      polyline_(once(data_, closed_), closed_),
      asked_(with_middles(once(data_, closed_), closed_)) {}

Pulls PullingCurve::pulls(const Points& line) const {
  return distance_ == Distance::hausdorff ? to_polyline(line) : to_samples(line);
}

Pulls PullingCurve::to_samples(const Points& line) const {
  Eigen::VectorXd distance = (data_.matrix() - line.matrix()).rowwise().norm().cwiseProduct(counted_);
  const double largest = distance.maxCoeff();
  return {data_, std::move(distance), largest};
}

Pulls PullingCurve::to_polyline(const Points& line) const {
  const Points sketch = once(line, closed_), asked = with_middles(sketch, closed_);
  const Polyline polyline(sketch, closed_);
  const Nearest there = nearest(polyline_, asked, watch_), back = nearest(polyline, asked_, watch_);
  const Index count = sketch.count();
  Pulls found{line, Eigen::VectorXd::Zero(line.count()), 0};
  auto target = found.target.matrix();
  const auto pull = [&](Index place, double distance, const Eigen::RowVectorXd& way) {
    if (!(distance > found.distance(place))) return;
    found.distance(place) = distance;
    target.row(place) = sketch.matrix().row(place) + way;
  };
  for (Index k = 0; k < asked.count(); ++k) {
    const Eigen::RowVectorXd way = there.points.matrix().row(k) - asked.matrix().row(k);
    const double distance = there.distances[static_cast<std::size_t>(k)];
    pull(k % count, distance, way);
    if (k >= count) pull((k + 1) % count, distance, way);  // the middle of an edge moves with both of its ends
  }
  for (Index s = 0; s < asked_.count(); ++s) {
    const double position = polyline.position(back.parameters[static_cast<std::size_t>(s)]);
    pull(std::lround(position) % count, back.distances[static_cast<std::size_t>(s)],
         asked_.matrix().row(s) - back.points.matrix().row(s));
  }
  if (closed_) target.row(line.count() - 1) = target.row(0);
  found.largest = found.distance.maxCoeff();
  return found;
}

}  // namespace ifsm::core
