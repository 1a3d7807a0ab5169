#include "curve/model.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "curve/transform.h"

namespace ifsm::core {
namespace {

constexpr double epsilon = 2.220446049250313e-16;

bool is_zero(const Points& points, Index i) { return points.matrix().row(i).isZero(0); }

Index count_kept(const ModelParts& parts) {
  Index kept = 0;
  for (const auto& level : parts.details)
    for (Index i = 0; i < level->count(); ++i) kept += is_zero(*level, i) ? 0 : 1;
  return kept;
}

Index count_all(const ModelParts& parts) {
  Index all = 0;
  for (const auto& level : parts.details) all += level->count();
  return all;
}

// The middle of the bounding box: subtracting it is exact where coordinates are large beside their spread.
std::vector<double> middle(const Points& samples) {
  std::vector<double> center;
  for (Index axis = 0; axis < samples.dimension(); ++axis) {
    const auto [low, high] = std::ranges::minmax(samples.plane(axis));
    center.push_back(low / 2 + high / 2);
  }
  return center;
}

double largest_coordinate(const Points& points) {
  return points.size() == 0 ? 0.0 : points.matrix().cwiseAbs().maxCoeff();
}

void require_in_range_of_doubles(double largest) {
  if (std::isfinite(largest)) return;
  throw Error(Status::numerical, "curve",
              "The analysis left the range of doubles; scale the samples down, or use a better conditioned filter.");
}

void require_samples(const Points& samples, bool closed) {
  in_range(samples.dimension(), 1, 4, "dimension");
  if (samples.count() < 2)
    throw Error(Status::range, "count",
                "The curve has " + std::to_string(samples.count()) + " samples; give at least 2.")
        .with(static_cast<double>(samples.count()))
        .needs(2);
  (void)closed;
}

std::vector<ConstLine> lines_of(const std::vector<PointsPtr>& details, Index axis, int levels) {
  std::vector<ConstLine> lines;
  for (int level = 0; level < levels; ++level) lines.push_back(details[static_cast<std::size_t>(level)]->plane(axis));
  return lines;
}

// Details of every level, and what is left at the top.
void take_apart(ModelParts& parts, const Points& finest, int levels) {
  const Shape& shape = parts.filter->shape();
  const Index dimension = finest.dimension();
  std::vector<std::shared_ptr<Points>> details;
  for (int level = 0; level < levels; ++level)
    details.push_back(std::make_shared<Points>(dimension, shape.detail_count(level)));
  parts.polygon = Points(dimension, shape.line_length(0));
  parts.largest_polygon = largest_coordinate(finest);
  for (Index axis = 0; axis < dimension; ++axis) {
    std::vector<Line> lines;
    for (const auto& level : details) lines.push_back(level->plane(axis));
    const Extent extent = analyze(*parts.filter, finest.plane(axis), parts.polygon.plane(axis), lines);
    require_in_range_of_doubles(extent.polygons);
    require_in_range_of_doubles(extent.details);
    parts.largest_polygon = std::max(parts.largest_polygon, extent.polygons);
  }
  parts.details.assign(details.begin(), details.end());
}

// What synthesis misses of the finest line, taken apart and added: takes back what analysis rounded away where large
// polygons cancel. Filters of few control points do not need it, and it costs as much again.
void correct(ModelParts& parts, Points finest, int levels) {
  constexpr double worth = 1e-13;  // of the diagonal: a tenth of what is promised
  // Sums of rows() products lose a few roundings of the largest of them.
  const double lost = 2 * epsilon * parts.filter->shape().rows() * parts.largest_polygon;
  if (!(lost > worth * parts.diagonal)) return;
  Points left = std::move(finest);
  left.matrix() -= line(parts, levels).matrix();
  ModelParts correction;
  correction.filter = parts.filter;
  take_apart(correction, left, levels);
  parts.polygon.matrix() += correction.polygon.matrix();
  for (std::size_t level = 0; level < parts.details.size(); ++level) {
    auto sum = std::make_shared<Points>(*parts.details[level]);
    sum->matrix() += correction.details[level]->matrix();
    parts.details[level] = std::move(sum);
  }
}

}  // namespace

Model::Model(ModelParts parts)
    : parts_(std::move(parts)),
      placement_(parts_.samples, shape().places(levels(), parts_.closed), parts_.closed),
      details_total_(count_all(parts_)),
      details_kept_(count_kept(parts_)) {}

ModelPtr analyze(const FilterPtr& filter, const Points& samples, bool closed, int levels) {
  require_samples(samples, closed);
  const Shape& shape = filter->shape();
  const int needed = shape.levels_for(samples.count(), closed);
  if (levels != 0 && shape.checked_levels(levels) < needed)
    throw Error(Status::range, "levels",
                std::to_string(levels) + " levels have no place for each of the " + std::to_string(samples.count()) +
                    " samples; give at least " + std::to_string(needed) + ", or 0 for that.")
        .with(levels)
        .needs(needed);
  const int chosen = levels == 0 ? needed : levels;
  shape.require_memory(chosen, samples.dimension());

  ModelParts parts;
  parts.filter = filter;
  parts.closed = closed;
  parts.samples = samples.count();
  parts.center = middle(samples);
  parts.diagonal = diagonal(samples);
  require_in_range_of_doubles(parts.diagonal);
  const Placement placement(samples.count(), shape.places(chosen, closed), closed);
  Points finest = read(shape, closed, placement.fill(to_center(samples, parts.center)), chosen);
  take_apart(parts, finest, chosen);
  correct(parts, std::move(finest), chosen);
  return std::make_shared<Model>(std::move(parts));
}

ModelPtr from_polygon(const FilterPtr& filter, const Points& polygon, bool closed, int levels) {
  const Shape& shape = filter->shape();
  in_range(polygon.dimension(), 1, 4, "dimension");
  if (polygon.count() != shape.control_points())
    throw Error(Status::shape, "count",
                "The polygon has " + std::to_string(polygon.count()) + " points; this filter's has " +
                    std::to_string(shape.control_points()) + ".")
        .with(static_cast<double>(polygon.count()))
        .needs(shape.control_points());
  if (closed && shape.joined() && polygon.matrix().row(0) != polygon.matrix().row(polygon.count() - 1))
    throw Error(Status::shape, "polygon", "A closed joined polygon ends where it begins; repeat its first point.");
  ModelParts parts;
  parts.filter = filter;
  parts.closed = closed;
  parts.center = middle(polygon);
  parts.polygon = to_center(polygon, parts.center);
  parts.diagonal = diagonal(polygon);
  require_in_range_of_doubles(parts.diagonal);
  parts.largest_polygon = largest_coordinate(parts.polygon);
  const int checked = shape.checked_levels(levels);
  shape.require_memory(checked, polygon.dimension());
  for (int level = 0; level < checked; ++level)
    parts.details.push_back(std::make_shared<Points>(polygon.dimension(), shape.detail_count(level)));
  parts.samples = shape.places(checked, closed);
  return std::make_shared<Model>(std::move(parts));
}

Points line(const ModelParts& parts, int level) {
  Points fine(parts.polygon.dimension(), parts.filter->shape().line_length(level));
  for (Index axis = 0; axis < fine.dimension(); ++axis)
    synthesize(*parts.filter, parts.polygon.plane(axis), lines_of(parts.details, axis, level), fine.plane(axis));
  return fine;
}

Points line(const Model& model, int level) { return line(model.parts(), level); }

Points lay(const Shape& shape, bool closed, Points line, int level) {
  if (shape.joined()) return line;
  const int n = shape.control_points();
  const Index places = shape.places(level, closed);
  Points laid(line.dimension(), places);
  Eigen::VectorXd readings = Eigen::VectorXd::Zero(places);
  for (Index q = 0; q < shape.nodes(level); ++q)
    for (int c = 0; c < n; ++c) {
      const Index place = (q * shape.stride() + c) % places;
      // A running mean: readings that agree leave it as it is, bit for bit.
      readings(place) += 1;
      for (Index axis = 0; axis < line.dimension(); ++axis) {
        double& mean = laid.plane(axis)[static_cast<std::size_t>(place)];
        mean += (line.plane(axis)[static_cast<std::size_t>(q * n + c)] - mean) / readings(place);
      }
    }
  return laid;
}

Points read(const Shape& shape, bool closed, Points points, int level) {
  const Index length = shape.line_length(level);
  if (shape.joined() && !closed) return points;
  Points line(points.dimension(), length);
  for (Index axis = 0; axis < points.dimension(); ++axis) {
    const auto from = points.plane(axis);
    const auto to = line.plane(axis);
    const auto n = shape.joined() ? shape.polygon_step() : shape.control_points();
    for (Index i = 0; i < length; ++i)
      to[static_cast<std::size_t>(i)] =
          from[static_cast<std::size_t>((i / n * shape.stride() + i % n) % points.count())];
  }
  return line;
}

Points points(const Model& model, int level) {
  return from_center(lay(model.shape(), model.closed(), line(model, level), level), model.parts().center);
}

Points samples(const Model& model) {
  const Points places = lay(model.shape(), model.closed(), line(model, model.levels()), model.levels());
  return from_center(model.placement().pick(places), model.parts().center);
}

Points control_points(const Model& model) { return from_center(model.parts().polygon, model.parts().center); }

void close_ends(ModelParts& parts) {
  if (!parts.closed || !parts.filter->shape().joined()) return;
  for (Index axis = 0; axis < parts.polygon.dimension(); ++axis) {
    const auto plane = parts.polygon.plane(axis);
    plane.back() = plane.front();
  }
}

Points from_center(Points points, const std::vector<double>& center) {
  for (Index axis = 0; axis < points.dimension(); ++axis)
    for (double& value : points.plane(axis)) value += center[static_cast<std::size_t>(axis)];
  return points;
}

Points to_center(Points points, const std::vector<double>& center) {
  for (Index axis = 0; axis < points.dimension(); ++axis)
    for (double& value : points.plane(axis)) value -= center[static_cast<std::size_t>(axis)];
  return points;
}

ModelPtr with_filter(const Model& model, const FilterPtr& filter) {
  if (!(filter->shape() == model.shape()))
    throw Error(Status::shape, "filter",
                "The filter has another topology, number of control points, maps, or stride than the model; make a "
                "model of the samples with it instead (ifsm_model_create).");
  ModelParts parts = model.parts();
  parts.filter = filter;
  return std::make_shared<Model>(std::move(parts));
}

}  // namespace ifsm::core
