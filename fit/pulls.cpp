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

Eigen::VectorXd pulled_places(const Model& model, Distance distance) {
  if (distance == Distance::largest) return sample_weights(model);
  Eigen::VectorXd all = Eigen::VectorXd::Ones(model.shape().line_length(model.levels()));
  if (model.closed()) all(all.size() - 1) = 0;
  return all;
}

}  // namespace

PullingCurve::PullingCurve(const Model& model, Distance distance)
    : distance_(distance),
      closed_(model.closed()),
      data_(line(model, model.levels())),
      pulled_(pulled_places(model, distance)),
      points_(once(data_, closed_)),
      polyline_(points_, closed_) {}

Pulls PullingCurve::pulls(const Points& line) const {
  return distance_ == Distance::hausdorff ? to_polyline(line) : to_samples(line);
}

Pulls PullingCurve::to_samples(const Points& line) const {
  Eigen::VectorXd distance = (data_.matrix() - line.matrix()).rowwise().norm().cwiseProduct(pulled_);
  const double largest = distance.maxCoeff();
  return {data_, std::move(distance), largest};
}

Pulls PullingCurve::to_polyline(const Points& line) const {
  const Points sketch = once(line, closed_);
  const Polyline polyline(sketch, closed_);
  const Nearest there = nearest(polyline_, sketch), back = nearest(polyline, points_);
  Pulls found{line, Eigen::VectorXd::Zero(line.count()), 0};
  auto target = found.target.matrix();
  target.topRows(sketch.count()) = there.points.matrix();
  for (Index k = 0; k < sketch.count(); ++k) found.distance(k) = there.distances[static_cast<std::size_t>(k)];
  for (Index s = 0; s < points_.count(); ++s) {
    const double asked = back.distances[static_cast<std::size_t>(s)];
    const Index place = std::lround(polyline.position(back.parameters[static_cast<std::size_t>(s)])) % sketch.count();
    if (!(asked > found.distance(place))) continue;
    found.distance(place) = asked;
    target.row(place) = line.matrix().row(place) + points_.matrix().row(s) - back.points.matrix().row(s);
  }
  if (closed_) target.row(line.count() - 1) = target.row(0);
  found.largest = found.distance.maxCoeff();
  return found;
}

}  // namespace ifsm::core
