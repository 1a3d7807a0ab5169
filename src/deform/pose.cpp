#include "deform/pose.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/parallel.h"
#include "curve/kernel.h"
#include "curve/transform.h"
#include "deform/handles.h"
#include "linalg/spectrum.h"

namespace ifsm::core {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

// out = L x, coordinate by coordinate and in one order, so that every way to a place gives it the same bits.
void turned(const SmallMatrix& turn, const std::vector<const double*>& x, Index axis, Index count, double* out) {
  for (Index i = 0; i < count; ++i) out[i] = turn(axis, 0) * x[0][i];
  for (Index b = 1; b < turn.cols(); ++b)
    for (Index i = 0; i < count; ++i) out[i] += turn(axis, b) * x[static_cast<std::size_t>(b)][i];
}

std::vector<const double*> planes(const Points& points, Index first) {
  std::vector<const double*> all;
  for (Index axis = 0; axis < points.dimension(); ++axis) all.push_back(points.plane(axis).data() + first);
  return all;
}

std::vector<const double*> planes(const PolygonView& polygon) {
  std::vector<const double*> all;
  for (Index axis = 0; axis < polygon.cols(); ++axis) all.push_back(polygon.col(axis).data());
  return all;
}

Eigen::MatrixXd turned(const SmallMatrix& turn, const PolygonView& polygon) {
  Eigen::MatrixXd result(polygon.rows(), polygon.cols());
  for (Index axis = 0; axis < polygon.cols(); ++axis)
    turned(turn, planes(polygon), axis, polygon.rows(), result.col(axis).data());
  return result;
}

// Synthesis without details, a level down: the polygons of neighbouring nodes to their children's.
class Spread {
 public:
  explicit Spread(const Filter& filter)
      : shape_(filter.shape()), product_(filter.matrix().topRows(shape_.control_points()), columns(shape_)) {}

  Points operator()(const Points& coarse, Index nodes) const {
    Points fine(coarse.dimension(), nodes * shape_.children_step() + (shape_.joined() ? 1 : 0));
    for (Index axis = 0; axis < coarse.dimension(); ++axis) {
      const auto from = coarse.plane(axis);
      const auto to = fine.plane(axis);
      product_(nodes, {from.data(), shape_.control_points(), shape_.polygon_step()}, {nullptr, 0, 0}, to.data(),
               nullptr);
      if (shape_.joined()) to.back() = from.back();
    }
    return fine;
  }

 private:
  static std::vector<int> columns(const Shape& shape) {
    std::vector<int> all;
    for (int column = 0; column < shape.children_step(); ++column) all.push_back(column);
    return all;
  }

  Shape shape_;
  kernel::Product product_;
};

Points as_points(const Eigen::MatrixXd& polygon) {
  Points points(polygon.cols(), polygon.rows());
  points.matrix() = polygon;
  return points;
}

// Has the map a key in the run, which may pass a ring's end?
template <class Map>
bool holds_any(const Map& map, Index first, Index count, Index all) {
  if (map.empty()) return false;
  const auto any = [&](Index from, Index to) {
    const auto found = map.lower_bound(from);
    return found != map.end() && found->first < to;
  };
  return any(first, first + count) || any(first - all, first + count - all);
}

template <class Map>
const Vector* found(const Map& map, Index key) {
  const auto at = map.find(key);
  return at == map.end() ? nullptr : &at->second;
}

// Values of a line that the polygons of `nodes` neighbouring nodes hold.
Index length(const Shape& shape, Index nodes) { return nodes * shape.polygon_step() + (shape.joined() ? 1 : 0); }

}  // namespace

Posed::Posed(const Base& base, const Pose& pose, Manner manner) : base_(base), pose_(pose), manner_(manner) {
  for (std::size_t level = 0; level < pose.moves.size(); ++level) {
    if (level > 0 && pose.moves[level].moves_handles()) deepest_ = static_cast<int>(level);
    if (!pose.moves[level].details.empty()) deepest_ = static_cast<int>(level) + 1;
  }
  find_whole_turns();
}

PolygonView Posed::base_polygon(int level, Index node) const {
  const Points& line = base_.line(level);
  return line.polygon(node * shape().polygon_step(), shape().control_points());
}

bool Posed::is_still(const Node& node) const {
  return node.turn == identity(dimension()) && node.polygon == base_polygon(node.level, node.node);
}

bool Posed::is_moved_below(int level, Index node, int deepest) const {
  Index first = node, last = node;
  const Index d = shape().details_per_node();
  for (int l = level + 1; l <= std::min(deepest, deepest_); ++l) {
    const auto& details = pose_.moves[static_cast<std::size_t>(l) - 1].details;
    if (const auto at = details.lower_bound(first * d); at != details.end() && at->first < (last + 1) * d) return true;
    first *= shape().maps();
    last = last * shape().maps() + shape().maps() - 1;
    const Moves& moves = pose_.moves[static_cast<std::size_t>(l)];
    if (!moves.moves_handles()) continue;
    if (!moves.field.empty()) return true;
    const Handles handles(shape(), base_.model()->closed(), l);
    const auto run = handles.held_by(first, last);
    if (holds_any(moves.own, run.first, run.count, handles.count()) ||
        holds_any(moves.pins, run.first, run.count, handles.count()))
      return true;
  }
  return false;
}

Posed::Node Posed::root() const {
  Node root{0, 0, identity(dimension()), pose_.polygon.matrix(), {}};
  root.turn = own_turn(root, root.turn);
  find_off(root);
  return root;
}

void Posed::find_off(Node& node) const {
  node.off = node.polygon - turned(node.turn, base_polygon(node.level, node.node));
}

SmallMatrix Posed::own_turn(const Node& node, const SmallMatrix& handed) const {
  if (manner_.follow == Follow::none) return handed;
  const PolygonView from = base_polygon(node.level, node.node);
  // Of n products, a level's worth.
  const double rounding = 16 * epsilon * (from.cwiseAbs().maxCoeff() + node.polygon.cwiseAbs().maxCoeff());
  if (maps_onto(handed, from, node.polygon, rounding)) return handed;
  return turn(from, node.polygon, manner_.turning);
}

// A curve's field moves its root as analysis of the moved handles does.
void Posed::find_whole_turns() {
  Node whole = root();
  const SmallMatrix frame = whole.turn;
  whole_turns_.assign(static_cast<std::size_t>(deepest_) + 1, whole.turn);
  for (int level = 1; level <= deepest_; ++level) {
    const auto& field = pose_.moves[static_cast<std::size_t>(level)].field;
    if (!field.empty()) {
      const Handles handles(shape(), base_.model()->closed(), level);
      Points shift(dimension(), shape().line_length(level));
      for (const auto& [handle, told] : field)
        for (const Seat& seat : handles.seats(handle))
          shift.matrix().row(seat.node * shape().polygon_step() + seat.point) = (frame * told).transpose();
      for (int l = level - 1; l >= 0; --l) {
        Points coarse(dimension(), shape().line_length(l));
        for (Index axis = 0; axis < dimension(); ++axis)
          coarsen_level(shape(), base_.model()->filter().inverse(), shift.plane(axis), coarse.plane(axis));
        shift = std::move(coarse);
      }
      whole.polygon += shift.matrix();
      whole.turn = own_turn(whole, whole.turn);
    }
    whole_turns_[static_cast<std::size_t>(level)] = whole.turn;
  }
}

// What has turned otherwise than the curve as a whole keeps its own turn before the whole's.
SmallMatrix Posed::whole_turn(int level, const SmallMatrix& handed) const {
  const SmallMatrix& before = whole_turns_[static_cast<std::size_t>(level) - 1];
  const SmallMatrix& now = whole_turns_[static_cast<std::size_t>(level)];
  if (handed == before || !(std::abs(determinant(before)) > 0)) return now;
  return now * inverse(before) * handed;
}

void Posed::move(Node& node, const std::vector<SmallMatrix>& path) const {
  const SmallMatrix handed = node.turn;
  const Polygon came = node.polygon;
  if (node.level <= deepest_) {
    const Moves& moves = pose_.moves[static_cast<std::size_t>(node.level)];
    if (!moves.field.empty()) node.turn = whole_turn(node.level, handed);
    const Handles handles(shape(), base_.model()->closed(), node.level);
    bool moved = false;
    for (int point = 0; point < shape().control_points() && moves.moves_handles(); ++point) {
      const Index handle = handles.handle({node.node, point});
      auto place = node.polygon.row(point);
      if (const Vector* told = found(moves.field, handle)) place += (path.front() * *told).transpose();
      const Eigen::RowVectorXd before = place;
      if (const Vector* told = found(moves.own, handle))
        place += (path[static_cast<std::size_t>(handles.holder(handle).level)] * *told).transpose();
      if (const Vector* pin = found(moves.pins, handle)) place = pin->transpose();
      moved = moved || place != before;
    }
    if (moved) node.turn = own_turn(node, node.turn);
  }
  if (manner_.follow == Follow::each) node.turn = own_turn(node, node.turn);
  if (node.turn != handed || node.polygon != came) find_off(node);
}

Points Posed::off_of_children(const Node& node) const {
  const auto& changed = pose_.moves[static_cast<std::size_t>(node.level)].details;
  const Index first = node.node * shape().details_per_node(), end = first + shape().details_per_node();
  const Points off = as_points(node.off);
  auto at = changed.lower_bound(first);
  if (at == changed.end() || at->first >= end) return Spread(base_.model()->filter())(off, 1);
  Points details(dimension(), shape().details_per_node());
  for (; at != changed.end() && at->first < end; ++at)
    details.matrix().row(at->first - first) = (node.turn * at->second).transpose();
  Points fine(dimension(), shape().rows());
  for (Index axis = 0; axis < dimension(); ++axis)
    synthesize_level(base_.model()->filter(), off.plane(axis), details.plane(axis), fine.plane(axis));
  return fine;
}

std::vector<Posed::Node> Posed::children(const Node& node, int begin, int end) const {
  const int n = shape().control_points();
  const Points off = off_of_children(node);
  const bool still = is_still(node) && off.matrix().isZero(0);
  std::vector<Node> all;
  for (int i = begin; i < end; ++i) {
    const Index child = node.node * shape().maps() + i;
    const PolygonView own = base_polygon(node.level + 1, child);
    Polygon polygon = own, own_off = off.polygon(i * shape().polygon_step(), n);
    if (!still) polygon = turned(node.turn, own) + own_off;
    // Joined ends are their parents', to the bit.
    if (shape().joined() && i == 0) polygon.row(0) = node.polygon.row(0);
    if (shape().joined() && i + 1 == shape().maps()) polygon.row(n - 1) = node.polygon.row(n - 1);
    all.push_back({node.level + 1, child, node.turn, std::move(polygon), std::move(own_off)});
  }
  return all;
}

template <class Visit>
void Posed::walk(int level, Index first, Index end, const Visit& visit) const {
  std::vector<SmallMatrix> path;
  walk_below(root(), path, level, first, end, visit);
}

template <class Visit>
void Posed::walk_below(Node node, std::vector<SmallMatrix>& path, int level, Index first, Index end,
                       const Visit& visit) const {
  const Index below = shape().nodes(level - node.level);
  const Index begin = node.node * below * shape().polygon_step();
  if (begin >= end || begin + length(shape(), below) <= first) return;
  const bool parts =
      is_moved_below(node.level, node.node, level) || (manner_.follow == Follow::each && !is_still(node));
  if (node.level == level || !parts) return visit(node);
  path.push_back(node.turn);
  // Those that hold a value of the run: child i holds its values and, joined, the next one's first.
  const Index values = below / shape().maps() * shape().polygon_step();
  const auto child_of = [&](Index value) {
    return static_cast<int>(std::clamp<Index>((value - begin) / values, 0, shape().maps() - 1));
  };
  const int low = child_of(std::max<Index>(first - (shape().joined() ? 1 : 0), begin)), high = child_of(end - 1);
  for (Node& child : children(node, low, high + 1)) {
    move(child, path);
    walk_below(std::move(child), path, level, first, end, visit);
  }
  path.pop_back();
}

// The part of the line of `level` below a node, as far as `out`, which begins at `first`, has room for it.
void Posed::write(const Node& node, int level, Index first, Points& out) const {
  const Index below = shape().nodes(level - node.level), step = shape().polygon_step();
  const Index begin = node.node * below * step, end = begin + length(shape(), below);
  const Index out_end = first + out.count();
  // Values lo … hi - 1 of the line, if they are asked for.
  const auto clip = [&](Index& lo, Index& hi) { lo = std::max(lo, first), hi = std::min(hi, out_end); };
  const auto at = [&](Index axis, Index value) { return out.plane(axis).data() + (value - first); };
  const Points& base = base_.line(level);
  if (is_still(node)) {
    Index lo = begin, hi = end;
    clip(lo, hi);
    for (Index axis = 0; axis < dimension(); ++axis)
      if (lo < hi) std::copy_n(base.plane(axis).data() + lo, hi - lo, at(axis, lo));
    return;
  }
  if (node.level == level) {  // pins and moved handles, to the bit
    for (Index value = std::max(begin, first); value < std::min(end, out_end); ++value)
      for (Index axis = 0; axis < dimension(); ++axis) *at(axis, value) = node.polygon(value - begin, axis);
    return;
  }
  const Spread spread(base_.model()->filter());
  Points off = as_points(node.off);
  const auto combine = [&](const Points& offset, Index offset_begin, Index lo, Index hi) {
    clip(lo, hi);
    if (lo >= hi) return;
    const auto x = planes(base, lo);
    for (Index axis = 0; axis < dimension(); ++axis) {
      double* const to = at(axis, lo);
      turned(node.turn, x, axis, hi - lo, to);
      const double* const shift = offset.plane(axis).data() + (lo - offset_begin);
      for (Index i = 0; i < hi - lo; ++i) to[i] += shift[i];
    }
  };
  // Some levels at once, then block by block: a block's lines stay in the cache, and blocks share the threads.
  constexpr Index block = 1 << 13;
  int upper = node.level;
  Index nodes = 1;
  for (; upper < level && length(shape(), shape().nodes(level - upper)) > block; ++upper, nodes *= shape().maps())
    off = spread(off, nodes);
  const Index inside = shape().nodes(level - upper);  // of a block
  parallel_for(nodes, 0, [&](Index b) {
    Index lo = begin + b * inside * step, hi = begin + (b + 1) * inside * step;
    const Index own = lo;
    clip(lo, hi);
    if (lo >= hi) return;
    Points part(dimension(), shape().control_points());
    part.matrix() = off.polygon(b * step, shape().control_points());
    Index within = 1;
    for (int l = upper; l < level; ++l, within *= shape().maps()) part = spread(part, within);
    combine(part, own, lo, hi);
  });
  if (!shape().joined()) return;
  for (const auto& [value, row] : {std::pair{begin, Index{0}}, {end - 1, Index{shape().control_points() - 1}}})
    if (value >= first && value < out_end)
      for (Index axis = 0; axis < dimension(); ++axis) *at(axis, value) = node.polygon(row, axis);
}

Points Posed::line(int level, Index first, Index end) const {
  Points out(dimension(), end - first);
  walk(level, first, end, [&](const Node& node) { write(node, level, first, out); });
  return out;
}

Points Posed::places(int level, Index first, Index count) const {
  if (shape().joined()) return line(level, first, first + count);
  const Points laid = lay(shape(), base_.model()->closed(), line(level, 0, shape().line_length(level)), level);
  Points window(dimension(), count);
  window.matrix() = laid.matrix().middleRows(first, count);
  return window;
}

SmallMatrix Posed::frame(int level, Index handle) const {
  const auto holder = Handles(shape(), base_.model()->closed(), level).holder(handle);
  return turn_at(holder.level, holder.node);
}

SmallMatrix Posed::turn_at(int level, Index node) const {
  Node at = root();
  std::vector<SmallMatrix> path;
  while (at.level < level) {
    path.push_back(at.turn);
    const auto child = static_cast<int>(node / shape().nodes(level - at.level - 1) % shape().maps());
    at = children(at, child, child + 1).front();
    move(at, path);
  }
  return at.turn;
}

SmallMatrix Posed::whole() const { return whole_turns_.front(); }

ModelPtr Posed::snapshot() const {
  const Model& model = *base_.model();
  const int level = manner_.follow == Follow::each ? model.levels() : deepest_;
  ModelParts parts = model.parts();
  const int d = shape().details_per_node();
  // Below `level`: the base's details, turned.
  std::vector<std::shared_ptr<Points>> details;
  for (int l = level; l < model.levels(); ++l) details.push_back(std::make_shared<Points>(model.details(l)));
  Points fine(dimension(), shape().line_length(level));
  walk(level, 0, fine.count(), [&](const Node& node) {
    write(node, level, 0, fine);
    if (node.turn == identity(dimension())) return;
    for (int l = level; l < model.levels(); ++l) {
      const Index below = shape().nodes(l - node.level) * d;
      const auto from = model.details(l).matrix().middleRows(node.node * below, below);
      details[static_cast<std::size_t>(l - level)]->matrix().middleRows(node.node * below, below) =
          from * node.turn.transpose();
    }
  });
  for (int l = level; l < model.levels(); ++l)
    parts.details[static_cast<std::size_t>(l)] = std::move(details[static_cast<std::size_t>(l - level)]);
  // Above: what analysis of the moved line finds.
  for (int l = level - 1; l >= 0; --l) {
    Points coarse(dimension(), shape().line_length(l));
    auto own = std::make_shared<Points>(dimension(), shape().detail_count(l));
    for (Index axis = 0; axis < dimension(); ++axis)
      analyze_level(model.filter(), fine.plane(axis), coarse.plane(axis), own->plane(axis));
    parts.details[static_cast<std::size_t>(l)] = std::move(own);
    fine = std::move(coarse);
  }
  parts.polygon = std::move(fine);
  close_ends(parts);
  const ModelPtr whole = std::make_shared<Model>(parts);
  parts.diagonal = diagonal(samples(*whole));
  return std::make_shared<Model>(std::move(parts));
}

}  // namespace ifsm::core
