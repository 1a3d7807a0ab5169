#include "curve/attractor.h"

#include <Eigen/Geometry>
#include <cmath>
#include <string>
#include <utility>

#include "curve/complement.h"
#include "linalg/spectrum.h"
#include "system/reach.h"

namespace ifsm::core {
namespace {

constexpr double epsilon = 2.220446049250313e-16;

// Barycentric coordinates: B holds the points as columns, over a row of ones. Square, since n = d+1.
using Frame = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 4, 4>;

Frame frame_of(const Points& points) {
  Frame b = Frame::Ones(points.dimension() + 1, points.count());
  b.topRows(points.dimension()) = points.matrix().transpose();
  return b;
}

// B^-1, or a singular error: then the points lie on a line, or in a plane.
Frame inverse_of_frame(const Points& points, const char* argument) {
  const Frame b = frame_of(points);
  // From the first point on: how flat they are does not depend on where they are.
  Eigen::MatrixXd legs = points.matrix().bottomRows(points.dimension());
  legs.rowwise() -= points.matrix().row(0);
  const Eigen::VectorXd values = svd(legs).values;
  constexpr double flattest = 64 * epsilon;  // fewer digits than that are not left to B^-1
  if (values.minCoeff() > flattest * values.maxCoeff()) return inverse(b);
  throw Error(Status::singular, argument,
              std::string("The control points lie ") + (points.dimension() == 2 ? "on a line" : "in a plane") +
                  ", so that they tell no map of all of it; move one.");
}

Frame embedded(const Affine& map, Index dimension) {
  Frame w = Frame::Zero(dimension + 1, dimension + 1);
  w.topLeftCorner(dimension, dimension) = map.linear.topLeftCorner(dimension, dimension);
  w.topRightCorner(dimension, 1) = map.shift.head(dimension);
  w(dimension, dimension) = 1;
  return w;
}

Affine affine_of(const Frame& w, Index dimension) {
  Affine map;
  map.linear.topLeftCorner(dimension, dimension) = w.topLeftCorner(dimension, dimension);
  map.shift.head(dimension) = w.topRightCorner(dimension, 1);
  return map;
}

std::vector<Affine> maps_of(const System& system) {
  std::vector<Affine> maps = system.active_maps();
  constexpr std::size_t fewest = 2, most = 8;
  if (maps.size() >= fewest && maps.size() <= most) return maps;
  throw Error(Status::range, "system",
              "The system has " + std::to_string(maps.size()) + " active maps; a model's filter has 2 to 8.")
      .with(static_cast<double>(maps.size()));
}

[[noreturn]] void refuse_polygon(const std::string& why) {
  throw Error(Status::singular, "system",
              why + ", so that no polygon can be chosen for it; give one (a joined one needs two ends that differ).");
}

Points corners(const System& system) {
  const double tolerance = 1e-6 * system.enclosure().axes.norm();
  const Box box = bounding_box(system, tolerance);
  const Index d = system.dimension();
  Points points(d, d + 1);
  const double side = (box.high - box.low).maxCoeff();
  if (!(side > 4 * tolerance)) refuse_polygon("The attractor is a single point");
  for (Index k = 0; k <= d; ++k) {
    points.matrix().row(k) = box.low.head(d).transpose();
    if (k > 0) points.matrix()(k, k - 1) += side;
  }
  return points;
}

// Two of the chain's ends, and inner points beside the line between them.
Points chain(const System& system, const std::vector<Affine>& maps) {
  const Index d = system.dimension();
  const Vector3 first = fixed_point(maps.front()), last = fixed_point(maps.back());
  const Vector3 along = last - first;
  if (!(along.norm() > 0)) refuse_polygon("The chain ends where it begins");
  const Vector3 aside = d == 2 ? Vector3::UnitZ().cross(along) : Vector3(along.norm() * along.unitOrthogonal());
  const Vector3 sides[] = {aside, along.normalized().cross(aside)};
  Points points(d, d + 1);
  points.matrix().row(0) = first.head(d).transpose();
  points.matrix().row(d) = last.head(d).transpose();
  for (Index k = 1; k < d; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(d);
    points.matrix().row(k) = (first + share * along + sides[k - 1] / 2).head(d).transpose();
  }
  return points;
}

[[noreturn]] void refuse_break(std::size_t map, const std::string& what) {
  throw Error(Status::shape, "system",
              "The pieces are no chain: " + what +
                  "; order the maps so that each begins where the one before ends, or " + "use the square topology.")
      .at(static_cast<std::int64_t>(map));
}

// C: the distinct columns of (T_0 … T_N-1), whose shared ones must agree. The ends of T_0 and T_N-1 become unit vectors
// to the bit, as joints do.
RowMatrix joined_columns(const std::vector<Frame>& maps, double tolerance) {
  const Index n = maps.front().rows(), last = n - 1;
  RowMatrix c(n, last * static_cast<Index>(maps.size()) + 1);
  if ((maps.front().col(0) - Eigen::VectorXd::Unit(n, 0)).norm() > tolerance)
    refuse_break(0, "the polygon's first point is not the first map's fixed point");
  if ((maps.back().col(last) - Eigen::VectorXd::Unit(n, last)).norm() > tolerance)
    refuse_break(maps.size() - 1, "the polygon's last point is not the last map's fixed point");
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const Index first = static_cast<Index>(i) * last;
    if (i > 0 && (c.col(first) - maps[i].col(0)).norm() > tolerance)
      refuse_break(i, "map " + std::to_string(i) + " begins elsewhere than map " + std::to_string(i - 1) + " ends");
    c.middleCols(first, n) = maps[i];
  }
  c.col(0) = Eigen::VectorXd::Unit(n, 0);
  c.col(c.cols() - 1) = Eigen::VectorXd::Unit(n, last);
  return c;
}

RowMatrix side_by_side(const std::vector<Frame>& maps) {
  const Index n = maps.front().rows();
  RowMatrix t(n, n * static_cast<Index>(maps.size()));
  for (std::size_t i = 0; i < maps.size(); ++i) t.middleCols(static_cast<Index>(i) * n, n) = maps[i];
  return t;
}

// Columns sum to one within a few roundings of B^-1 w B; exactly, as near as doubles are, afterwards.
void make_barycentric(RowMatrix& t) {
  for (Index c = 0; c < t.cols(); ++c) {
    Index largest = 0;
    t.col(c).cwiseAbs().maxCoeff(&largest);
    t(largest, c) += 1 - t.col(c).sum();
  }
}

void require_points(const Points& polygon, Index dimension) {
  in_range(polygon.dimension(), dimension, dimension, "dimension");
  if (polygon.count() == dimension + 1) return;
  throw Error(Status::shape, "count",
              "The polygon has " + std::to_string(polygon.count()) + " points; that of a system of dimension " +
                  std::to_string(dimension) + " has " + std::to_string(dimension + 1) + ".")
      .with(static_cast<double>(polygon.count()))
      .needs(dimension + 1);
}

}  // namespace

SystemPtr system_of(const Model& model) {
  const Index d = model.dimension(), n = model.shape().control_points();
  if (d < 2 || d > 3 || n != d + 1)
    throw Error(Status::shape, "model",
                "A model of dimension " + std::to_string(d) + " with " + std::to_string(n) +
                    " control points is no system; one needs 3 in the plane, or 4 in space.")
        .needs(d + 1);
  const Points polygon = control_points(model);
  const Frame b = frame_of(polygon), inverse = inverse_of_frame(polygon, "model");
  std::vector<Affine> maps;
  for (int i = 0; i < model.shape().maps(); ++i) maps.push_back(affine_of(b * model.filter().map(i) * inverse, d));
  const std::size_t count = maps.size();
  return std::make_shared<System>(static_cast<int>(d), std::move(maps), std::vector<double>(count, 1.0));
}

ModelPtr model_of(const System& system, Topology topology, const Points& polygon, int levels) {
  static_cast<void>(system.enclosure());  // contractive, or an error that says why not
  const Index d = system.dimension();
  const std::vector<Affine> maps = maps_of(system);
  const bool joined = topology == Topology::joined;
  const bool given = polygon.count() > 0;
  const Points places = given ? polygon : joined ? chain(system, maps) : corners(system);
  require_points(places, d);
  const Frame b = frame_of(places), inverse = inverse_of_frame(places, given ? "polygon" : "system");
  std::vector<Frame> t;
  for (const Affine& map : maps) t.push_back(inverse * embedded(map, d) * b);
  // What rounding of coordinates and of B^-1 may do to a column.
  const double tolerance = 64 * epsilon * inverse.norm() * b.norm();
  RowMatrix columns = joined ? joined_columns(t, tolerance) : side_by_side(t);
  make_barycentric(columns);
  const Shape shape(topology, static_cast<int>(d + 1), static_cast<int>(maps.size()));
  const auto filter = std::make_shared<Filter>(shape, with_complement(shape, columns));
  return from_polygon(filter, places, false, levels);
}

}  // namespace ifsm::core
