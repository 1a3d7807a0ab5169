#include "curve/frames.h"

#include <utility>

#include "curve/transform.h"
#include "linalg/turn.h"

namespace ifsm::core {
namespace {

constexpr double epsilon = 2.220446049250313e-16;

Points next_line(const Filter& filter, int level, const Points& coarse, const Points& details) {
  Points fine(coarse.dimension(), filter.shape().line_length(level + 1));
  for (Index axis = 0; axis < coarse.dimension(); ++axis)
    synthesize_level(filter, coarse.plane(axis), details.plane(axis), fine.plane(axis));
  return fine;
}

// All frames of a level, on the way down.
class FrameWalk {
 public:
  FrameWalk(const Filter& filter, Points polygon, SmallMatrix rotation)
      : filter_(filter), line_(std::move(polygon)), rotations_{std::move(rotation)}, sizes_{1.0} {
    measure(1);
  }

  Index nodes() const { return static_cast<Index>(rotations_.size()); }
  auto polygon(Index node) const {
    return line_.polygon(node * filter_.shape().polygon_step(), filter_.shape().control_points());
  }
  // A polygon that is a point has no size of its own: its parent's.
  double size(Index node) const { return sizes_[static_cast<std::size_t>(node)]; }
  bool is_point(Index node) const { return points_[static_cast<std::size_t>(node)] != 0; }
  const SmallMatrix& rotation(Index node) const { return rotations_[static_cast<std::size_t>(node)]; }

  void descend(const Points& details) {
    const Shape& shape = filter_.shape();
    const Points fine = next_line(filter_, level_, line_, details);
    const Points predicted = next_line(filter_, level_, line_, Points(details.dimension(), details.count()));
    std::vector<SmallMatrix> rotations;
    rotations.reserve(rotations_.size() * static_cast<std::size_t>(shape.maps()));
    for (Index child = 0; child < nodes() * shape.maps(); ++child) {
      const Index first = child * shape.polygon_step();
      rotations.push_back(least_rotation(predicted.polygon(first, shape.control_points()),
                                         fine.polygon(first, shape.control_points())) *
                          rotation(child / shape.maps()));
    }
    line_ = fine;
    rotations_ = std::move(rotations);
    ++level_;
    measure(shape.maps());
  }

 private:
  // Sizes of this level's polygons; sizes_ holds those of their parents, of `children` each.
  void measure(Index children) {
    std::vector<double> sizes;
    points_.clear();
    for (Index node = 0; node < nodes(); ++node) {
      const double own = polygon_size(polygon(node));
      points_.push_back(own > 0 ? 0 : 1);
      sizes.push_back(own > 0 ? own : sizes_[static_cast<std::size_t>(node / children)]);
    }
    sizes_ = std::move(sizes);
  }

  const Filter& filter_;
  Points line_;
  std::vector<SmallMatrix> rotations_;
  std::vector<double> sizes_;
  std::vector<char> points_;
  int level_ = 0;
};

// Rows of `vectors` that belong to a node, times a matrix: v ← m v for each.
void transform_node(const Points& from, Points& to, Index node, Index count, const SmallMatrix& m) {
  to.matrix().middleRows(node * count, count) = from.matrix().middleRows(node * count, count) * m.transpose();
}

Points told_in_nodes(const FrameWalk& walk, const Points& absolute, Index per_node) {
  Points told(absolute.dimension(), absolute.count());
  for (Index node = 0; node < walk.nodes(); ++node)
    transform_node(absolute, told, node, per_node, walk.rotation(node).transpose() / walk.size(node));
  return told;
}

Points told_absolutely(const FrameWalk& walk, const Points& told, Index per_node) {
  Points absolute(told.dimension(), told.count());
  for (Index node = 0; node < walk.nodes(); ++node)
    transform_node(told, absolute, node, per_node, walk.size(node) * walk.rotation(node));
  return absolute;
}

// How much larger the nodes of one walk are than the other's. Where one polygon alone is a point, the two cannot be
// compared: as much as their parents.
class Growth {
 public:
  void follow(const FrameWalk& from, const FrameWalk& to) {
    const Index children = from.nodes() / static_cast<Index>(ratios_.size());
    std::vector<double> ratios;
    for (Index node = 0; node < from.nodes(); ++node)
      ratios.push_back(from.is_point(node) == to.is_point(node) ? to.size(node) / from.size(node)
                                                                : of(node / children));
    ratios_ = std::move(ratios);
  }
  double of(Index node) const { return ratios_[static_cast<std::size_t>(node)]; }

 private:
  std::vector<double> ratios_{1.0};
};

// Details carried from one model's frames to another's; where the frames are the same, so are the bits.
Points carried(const FrameWalk& from, const FrameWalk& to, const Growth& growth, const Points& details,
               Index per_node) {
  Points result = details;
  for (Index node = 0; node < from.nodes(); ++node) {
    const double size = growth.of(node);
    if (size == 1 && to.rotation(node) == from.rotation(node)) continue;
    transform_node(details, result, node, per_node, size * to.rotation(node) * from.rotation(node).transpose());
  }
  return result;
}

// Walks down the old and the new model together; below `level` details are carried, above they are shared.
ModelPtr rebuilt(const Model& model, int level, const Points& told) {
  ModelParts parts = model.parts();
  const Index per_node = model.shape().details_per_node();
  FrameWalk before(model.filter(), parts.polygon, identity(model.dimension()));
  FrameWalk after(model.filter(), parts.polygon, identity(model.dimension()));
  Growth growth;
  for (int l = 0; l < model.levels(); ++l) {
    growth.follow(before, after);
    const Points& old = model.details(l);
    auto fresh = std::make_shared<Points>(l == level ? told_absolutely(after, told, per_node)
                                                     : carried(before, after, growth, old, per_node));
    before.descend(old);
    after.descend(*fresh);
    parts.details[static_cast<std::size_t>(l)] = std::move(fresh);
  }
  return std::make_shared<Model>(std::move(parts));
}

double largest(const Points& points) { return points.matrix().cwiseAbs().maxCoeff(); }

// Walks down the old and the new model together, every node's details turned and scaled as its own polygon is. (Carried
// from frame to frame they would keep what they are told as, but frames are handed down from node to node: where a
// polygon is little like what its parent predicts, a small move of the root turns them far.)
ModelPtr followed(const Model& model, Points polygon) {
  ModelParts parts = model.parts();
  const Shape& shape = model.shape();
  const int n = shape.control_points();
  Points before = parts.polygon, after = polygon;
  std::vector<SmallMatrix> turns{identity(model.dimension())};
  for (int l = 0; l < model.levels(); ++l) {
    const Points& old = model.details(l);
    auto fresh = std::make_shared<Points>(old);
    const double rounding = 16 * epsilon * (largest(before) + largest(after));  // of n products, a level's worth
    std::vector<SmallMatrix> own;
    for (Index node = 0; node < shape.nodes(l); ++node) {
      const auto from = before.polygon(node * shape.polygon_step(), n),
                 to = after.polygon(node * shape.polygon_step(), n);
      const SmallMatrix& handed = turns[static_cast<std::size_t>(l == 0 ? 0 : node / shape.maps())];
      own.push_back(maps_onto(handed, from, to, rounding) ? handed : turn(from, to));
      if (own.back() != identity(model.dimension()))
        transform_node(old, *fresh, node, shape.details_per_node(), own.back());
    }
    turns = std::move(own);
    before = next_line(model.filter(), l, before, old);
    after = next_line(model.filter(), l, after, *fresh);
    parts.details[static_cast<std::size_t>(l)] = std::move(fresh);
  }
  parts.polygon = std::move(polygon);
  return std::make_shared<Model>(std::move(parts));
}

void require_finite_points(const Points& points, const char* argument) {
  for (Index axis = 0; axis < points.dimension(); ++axis)
    require_finite(points.plane(axis).data(), points.count(), argument);
}

void require_count(const Points& points, Index count, Index dimension, const char* argument) {
  if (points.count() == count && points.dimension() == dimension) return;
  throw Error(Status::shape, argument,
              std::string(argument) + " must hold " + std::to_string(count) + " points of dimension " +
                  std::to_string(dimension) + ".")
      .needs(count * dimension);
}

// A polygon from the centre. Coordinates that are given back as they were read keep their bits, which adding and
// subtracting the centre need not.
Points centred_polygon(const Model& model, const Points& polygon) {
  Points centred = to_center(polygon, model.parts().center);
  const Points read = control_points(model);
  for (Index axis = 0; axis < polygon.dimension(); ++axis)
    for (std::size_t i = 0; i < static_cast<std::size_t>(polygon.count()); ++i)
      if (polygon.plane(axis)[i] == read.plane(axis)[i]) centred.plane(axis)[i] = model.parts().polygon.plane(axis)[i];
  return centred;
}

}  // namespace

Points details(const Model& model, int level, Frame frame) {
  in_range(level, 0, model.levels() - 1, "level");
  if (frame == Frame::absolute) return model.details(level);
  FrameWalk walk(model.filter(), model.parts().polygon, identity(model.dimension()));
  for (int l = 0; l < level; ++l) walk.descend(model.details(l));
  return told_in_nodes(walk, model.details(level), model.shape().details_per_node());
}

Points in_frames(const Model& model, int level, const Points& told) {
  FrameWalk walk(model.filter(), model.parts().polygon, identity(model.dimension()));
  for (int l = 0; l < level; ++l) walk.descend(model.details(l));
  return told_absolutely(walk, told, model.shape().details_per_node());
}

ModelPtr with_control_points(const Model& model, const Points& polygon, Frame frame) {
  require_finite_points(polygon, "points");
  require_count(polygon, model.shape().control_points(), model.dimension(), "points");
  const Points centred = centred_polygon(model, polygon);
  if (model.closed() && model.shape().joined() && polygon.matrix().row(0) != polygon.matrix().bottomRows(1))
    throw Error(Status::shape, "points",
                "A closed joined curve ends where it begins; give its first and last control point the same place.");
  if (frame == Frame::node) return followed(model, centred);
  ModelParts parts = model.parts();
  parts.polygon = centred;
  return std::make_shared<Model>(std::move(parts));
}

ModelPtr with_details(const Model& model, int level, Points vectors, Frame frame) {
  in_range(level, 0, model.levels() - 1, "level");
  require_finite_points(vectors, "vectors");
  require_count(vectors, model.shape().detail_count(level), model.dimension(), "vectors");
  if (frame == Frame::node) return rebuilt(model, level, vectors);
  ModelParts parts = model.parts();
  parts.details[static_cast<std::size_t>(level)] = std::make_shared<Points>(std::move(vectors));
  return std::make_shared<Model>(std::move(parts));
}

}  // namespace ifsm::core
