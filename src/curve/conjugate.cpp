#include "curve/conjugate.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>

#include "curve/resolve.h"
#include "curve/significance.h"
#include "curve/transform.h"

namespace ifsm::core {
namespace {

using Vector = Eigen::VectorXd;

// The linear map from the free values (control points, then kept details, of one coordinate) to what counts at the
// places.
class PlaceMap {
 public:
  PlaceMap(const Model& model, const Kept& kept)
      : model_(model), counted_(counted_distances(model).head(model.placement().places())) {
    for (std::size_t i = 0; i < kept.size(); ++i)
      if (kept[i]) kept_.push_back(static_cast<Index>(i));
    scale_unknowns();
    count_readings();
  }

  Index unknowns() const { return shape().control_points() + static_cast<Index>(kept_.size()); }

  Vector forward(const Vector& unknowns) const {
    const Vector values = unknowns.cwiseProduct(scale_);
    Vector line = values.head(shape().control_points());
    const Vector details = spread(values);
    for (int level = 0; level < model_.levels(); ++level) {
      Vector fine(shape().line_length(level + 1));
      synthesize_level(model_.filter(), span(line), level_of(details, level), {fine.data(), size(fine)});
      line = std::move(fine);
    }
    Vector places = Vector::Zero(readings_.size());
    for (Index i = 0; i < line.size(); ++i) places(place_of(i)) += line(i);
    places.array() /= readings_.array();
    return counted(places);
  }

  // What counts of values at the places.
  Vector counted(const Vector& places) const { return places.cwiseProduct(counted_); }

  Vector adjoint(const Vector& values) const {
    const Vector places = (values.array() * counted_.array() / readings_.array()).matrix();
    Vector line(shape().line_length(model_.levels()));
    for (Index i = 0; i < line.size(); ++i) line(i) = places(place_of(i));
    const int n = shape().control_points(), d = shape().details_per_node(), rows = shape().rows();
    Vector details(model_.details_total());
    for (int level = model_.levels() - 1; level >= 0; --level) {
      Vector coarse(shape().line_length(level));
      for (Index node = 0; node < shape().nodes(level); ++node) {
        const Vector both = model_.filter().matrix() * line.segment(node * rows, rows);
        coarse.segment(node * n, n) = both.head(n);
        details.segment((shape().first_node(level) + node) * d, d) = both.tail(d);
      }
      line = std::move(coarse);
    }
    Vector unknowns(this->unknowns());
    unknowns.head(n) = line;
    for (std::size_t i = 0; i < kept_.size(); ++i) unknowns(n + static_cast<Index>(i)) = details(kept_[i]);
    return unknowns.cwiseProduct(scale_);
  }

  // Adds a correction of one coordinate.
  void add(const Vector& unknowns, Index axis, ModelParts& parts, std::vector<Points>& details) const {
    const Vector values = unknowns.cwiseProduct(scale_);
    const int n = shape().control_points();
    parts.polygon.matrix().col(axis) += values.head(n);
    const Vector all = spread(values);
    Index first = 0;
    for (Points& level : details) {
      level.matrix().col(axis) += all.segment(first, level.count());
      first += level.count();
    }
  }

 private:
  const Shape& shape() const { return model_.shape(); }
  static std::size_t size(const Vector& v) { return static_cast<std::size_t>(v.size()); }
  static ConstLine span(const Vector& v) { return {v.data(), size(v)}; }
  ConstLine level_of(const Vector& details, int level) const {
    return {details.data() + shape().first_node(level) * shape().details_per_node(),
            static_cast<std::size_t>(shape().detail_count(level))};
  }
  Index place_of(Index i) const {
    const int n = shape().control_points();
    return (i / n * shape().stride() + i % n) % readings_.size();
  }

  Vector spread(const Vector& values) const {
    Vector details = Vector::Zero(model_.details_total());
    for (std::size_t i = 0; i < kept_.size(); ++i)
      details(kept_[i]) = values(shape().control_points() + static_cast<Index>(i));
    return details;
  }

  // Unknowns in units of what they do to the curve: Jacobi's preconditioner.
  void scale_unknowns() {
    const auto g = gains(model_.filter(), model_.levels());
    scale_ = Vector::Ones(unknowns());
    const Index d = shape().details_per_node();
    for (std::size_t i = 0; i < kept_.size(); ++i) {
      int level = 0;
      while (shape().first_node(level + 1) * d <= kept_[i]) ++level;
      const double gain = g[static_cast<std::size_t>(level)](kept_[i] % d);
      if (gain > 0) scale_(shape().control_points() + static_cast<Index>(i)) = 1 / gain;
    }
    scale_.head(shape().control_points()) /= std::sqrt(static_cast<double>(model_.placement().samples()));
  }

  void count_readings() {
    readings_ = Vector::Zero(model_.placement().places());
    const Index length = shape().line_length(model_.levels());
    for (Index i = 0; i < length; ++i) readings_(place_of(i)) += 1;
  }

  const Model& model_;
  Vector counted_;
  std::vector<Index> kept_;
  Vector scale_;
  Vector readings_;
};

// CGLS: the least-norm minimiser of |map x - b|, to rounding.
Vector least_squares(const PlaceMap& map, const Vector& b, const Watch& watch) {
  constexpr double enough = 1e-15;  // of |map| |residual|: what rounding leaves of a gradient that is zero
  Vector x = Vector::Zero(map.unknowns()), residual = b, gradient = map.adjoint(b), direction = gradient;
  double gamma = gradient.squaredNorm(), norm = 0;
  const Index most = 4 * map.unknowns() + 50;
  for (Index step = 0; step < most; ++step) {
    watch.poll();
    const Vector moved = map.forward(direction);
    norm = std::max(norm, moved.squaredNorm() / direction.squaredNorm());
    if (!(gamma > enough * enough * norm * residual.squaredNorm())) break;
    const double alpha = gamma / moved.squaredNorm();
    if (!std::isfinite(alpha)) break;
    const Vector nearer = residual - alpha * moved;
    if (!(nearer.squaredNorm() < residual.squaredNorm())) break;  // every step descends, until rounding has the word
    x += alpha * direction;
    residual = nearer;
    gradient = map.adjoint(residual);
    const double next = gradient.squaredNorm();
    direction = (gradient + next / gamma * direction).eval();
    gamma = next;
  }
  return x;
}

// The curve, from the centre: differences of such are exact to the curve's own size.
Points centred_places(const Model& model) {
  return lay(model.shape(), model.closed(), line(model, model.levels()), model.levels());
}

}  // namespace

ModelPtr conjugate_resolve(const Model& model, const Model& sketch, const Kept& kept, const Watch& watch) {
  const PlaceMap map(model, kept);
  const Points wanted = centred_places(model), now = centred_places(sketch);
  ModelParts parts = sketch.parts();
  std::vector<Points> details;
  for (const auto& level : parts.details) details.push_back(*level);
  for (Index axis = 0; axis < model.dimension(); ++axis) {
    const Vector missing = map.counted(wanted.matrix().col(axis) - now.matrix().col(axis));
    map.add(least_squares(map, missing, watch), axis, parts, details);
  }
  for (std::size_t level = 0; level < details.size(); ++level)
    parts.details[level] = std::make_shared<Points>(std::move(details[level]));
  return std::make_shared<Model>(std::move(parts));
}

}  // namespace ifsm::core
