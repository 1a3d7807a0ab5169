#include "curve/evaluate.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "base/cancel.h"

namespace ifsm::core {
namespace {

constexpr double epsilon = 2.220446049250313e-16;

// The polygon of child i of a node, rows summed in the order of the fast transform.
Eigen::MatrixXd child_polygon(const Filter& filter, const Eigen::MatrixXd& polygon, const Eigen::MatrixXd& details,
                              int child) {
  const Shape& shape = filter.shape();
  const int n = shape.control_points();
  Eigen::MatrixXd result(n, polygon.cols());
  for (Index axis = 0; axis < polygon.cols(); ++axis)
    for (int c = 0; c < n; ++c) {
      const auto column = filter.matrix().col(first_column(shape, child) + c);
      double sum = 0;
      for (int r = 0; r < n; ++r) sum += polygon(r, axis) * column(r);
      for (Index r = 0; r < details.rows(); ++r) sum += details(r, axis) * column(n + r);
      result(c, axis) = sum;
    }
  return result;
}

std::vector<int> digits(Index value, int base, int count) {
  std::vector<int> symbols(static_cast<std::size_t>(count));
  for (int i = count - 1; i >= 0; --i, value /= base)
    symbols[static_cast<std::size_t>(i)] = static_cast<int>(value % base);
  return symbols;
}

Eigen::MatrixXd node_polygon(const Model& model, int level, Index node) {
  const Index d = model.shape().details_per_node();
  Eigen::MatrixXd polygon = model.parts().polygon.matrix();
  Index at = 0;
  const std::vector<int> symbols = digits(node, model.shape().maps(), level);
  for (int l = 0; l < level; ++l) {
    const int child = symbols[static_cast<std::size_t>(l)];
    polygon = child_polygon(model.filter(), polygon, model.details(l).polygon(at * d, d), child);
    at = at * model.shape().maps() + child;
  }
  return polygon;
}

// A leaf of the tree, and how far into it.
struct Location {
  Index leaf;
  double within;     // 0 … 1; 1 only at the end of an open curve
  double doubt = 0;  // what rounding may have done to `within`
};

Location locate(const Model& model, double parameter) {
  const auto leaves = model.shape().nodes(model.levels());
  const auto count = static_cast<double>(leaves);
  const double t = model.closed() ? parameter - std::floor(parameter) : parameter;
  const double rounding = 2 * epsilon * count;  // of a joint's parameter k / count, and of the product here
  double position = t * count;
  const double nearest = std::round(position);
  if (std::abs(position - nearest) <= rounding) position = nearest;  // joints, whatever way they came
  if (position >= count) return model.closed() ? Location{0, 0.0} : Location{leaves - 1, 1.0};
  const double leaf = std::floor(position);
  const bool exact = std::has_single_bit(static_cast<unsigned>(model.shape().maps()));  // then all joints are doubles
  return {static_cast<Index>(leaf), position - leaf, exact ? 0.0 : rounding};
}

// The next symbol of what lies within a node; 1 stays at the end. Joints below the leaves are met as those above.
int next_symbol(Location& location, int maps) {
  if (location.within == 1) return maps - 1;
  constexpr double known = 0.25;  // beyond, the parameter has no digits left
  double scaled = location.within * maps;
  location.doubt *= maps;
  const double nearest = std::round(scaled);
  if (location.doubt < known && std::abs(scaled - nearest) <= location.doubt) scaled = nearest;
  const int symbol = std::min(static_cast<int>(scaled), maps - 1);
  location.within = scaled - symbol;
  return symbol;
}

double extent(const Eigen::MatrixXd& polygon) {
  return (polygon.colwise().maxCoeff() - polygon.colwise().minCoeff()).maxCoeff();
}

// P_θ T_θ1 T_θ2 … until the polygon is a point. T keeps constants, so each polygon is told from its first point:
// rounding shrinks with the polygon, where it would else be that of the place it lies at.
Eigen::RowVectorXd limit_point(const Model& model, double parameter) {
  constexpr int most = 100000;
  Location location = locate(model, parameter);
  Eigen::MatrixXd polygon = node_polygon(model, model.levels(), location.leaf);
  const Eigen::MatrixXd no_details(0, polygon.cols());
  const double enough = epsilon * extent(polygon);
  Eigen::RowVectorXd point = Eigen::RowVectorXd::Zero(polygon.cols());
  for (int step = 0;; ++step) {
    const Eigen::RowVectorXd first = polygon.row(0);
    point += first;
    polygon.rowwise() -= first;
    if (extent(polygon) <= enough) return point + polygon.colwise().mean();
    if (step == most || !std::isfinite(extent(polygon)))
      throw Error(Status::numerical, "curve",
                  "The limit of the curve was not reached at parameter " + text_of(parameter) +
                      ": the filter's maps do not contract; evaluate the polyline instead.")
          .with(parameter);
    polygon = child_polygon(model.filter(), polygon, no_details, next_symbol(location, model.shape().maps()));
  }
}

// One place of the finest level, from the centre.
Eigen::RowVectorXd place_point(const Model& model, Index place) {
  const Shape& shape = model.shape();
  const Index nodes = shape.nodes(model.levels());
  if (shape.joined()) {
    const Index leaf = std::min(place / shape.polygon_step(), nodes - 1);
    return node_polygon(model, model.levels(), leaf).row(place - leaf * shape.polygon_step());
  }
  Eigen::RowVectorXd mean = Eigen::RowVectorXd::Zero(model.dimension());
  double readings = 0;
  const Index places = model.placement().places();
  const Index back = shape.control_points() / shape.stride() + 1;
  std::vector<std::pair<Index, Index>> reads;  // leaf, column
  for (Index q = place / shape.stride() - back; q <= place / shape.stride(); ++q)
    for (Index c = 0; c < shape.control_points(); ++c) {
      const Index leaf = model.closed() ? ((q % nodes) + nodes) % nodes : q;
      if (leaf < 0 || leaf >= nodes || (leaf * shape.stride() + c) % places != place) continue;
      if (std::ranges::find(reads, std::pair{leaf, c}) == reads.end()) reads.emplace_back(leaf, c);
    }
  std::ranges::sort(reads);
  for (const auto& [leaf, column] : reads) {
    readings += 1;
    mean += (node_polygon(model, model.levels(), leaf).row(column) - mean) / readings;
  }
  return mean;
}

// Places by index: all synthesised at once when many are asked for, else one path each.
class Places {
 public:
  Places(const Model& model, std::size_t asked) : model_(model) {
    if (static_cast<Index>(asked) * 16 > model.placement().places())
      all_ = lay(model.shape(), model.closed(), line(model, model.levels()), model.levels());
  }
  Eigen::RowVectorXd operator()(Index place) const {
    if (all_.count() > 0) return all_.matrix().row(place);
    return place_point(model_, place);
  }

 private:
  const Model& model_;
  Points all_;
};

Eigen::RowVectorXd polyline_point(const Model& model, const Places& places, double parameter) {
  const auto [place, next, part] = model.placement().between(parameter);
  if (part == 0) return places(place);
  return (1 - part) * places(place) + part * places(next);
}

}  // namespace

void require_parameters(const Model& model, std::span<const double> parameters) {
  require_finite(parameters.data(), static_cast<Index>(parameters.size()), "parameters");
  if (model.closed()) return;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (!(parameters[i] >= 0 && parameters[i] <= 1))
      throw Error(
          Status::range, "parameters",
          "parameters[" + std::to_string(i) + "] is " + text_of(parameters[i]) + "; an open curve's run from 0 to 1.")
          .at(static_cast<Index>(i))
          .with(parameters[i]);
}

Points evaluate(const Model& model, Curve curve, std::span<const double> parameters) {
  require_parameters(model, parameters);
  if (curve == Curve::limit && model.filter().contractivity() == Contractivity::refuted)
    throw Error(Status::range, "curve",
                "The filter's maps do not contract, so the curve has no limit; evaluate the polyline instead.");
  Points result(model.dimension(), static_cast<Index>(parameters.size()));
  const Places places(model, curve == Curve::polyline ? parameters.size() : 0);
  Polled polled;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    polled.step();
    result.matrix().row(static_cast<Index>(i)) =
        curve == Curve::limit ? limit_point(model, parameters[i]) : polyline_point(model, places, parameters[i]);
  }
  return from_center(std::move(result), model.parts().center);
}

Points polygon_of(const Model& model, int level, Index node) {
  const Eigen::MatrixXd rows = node_polygon(model, level, node);
  Points polygon(rows.cols(), rows.rows());
  polygon.matrix() = rows;
  return polygon;
}

std::vector<std::int32_t> address(const Model& model, double parameter, int length) {
  in_range(length, 1, 1024, "length");
  const double one[] = {parameter};
  require_parameters(model, one);
  Location location = locate(model, parameter);
  const std::vector<int> stored = digits(location.leaf, model.shape().maps(), model.levels());
  std::vector<std::int32_t> symbols;
  for (int i = 0; i < length; ++i)
    symbols.push_back(i < model.levels() ? stored[static_cast<std::size_t>(i)]
                                         : next_symbol(location, model.shape().maps()));
  return symbols;
}

Interval interval(const Model& model, std::span<const std::int32_t> symbols) {
  for (std::size_t i = 0; i < symbols.size(); ++i)
    if (symbols[i] < 0 || symbols[i] >= model.shape().maps())
      throw Error(Status::range, "symbols",
                  "symbols[" + std::to_string(i) + "] is " + std::to_string(symbols[i]) + "; give a symbol from 0 to " +
                      std::to_string(model.shape().maps() - 1) + ".")
          .at(static_cast<Index>(i))
          .with(symbols[i]);
  // From the last symbol on: rounding shrinks by N a step, and an interval ends where the next begins, bit for bit.
  Interval covered{0, 1};
  for (std::size_t i = symbols.size(); i-- > 0;) {
    covered.first = (symbols[i] + covered.first) / model.shape().maps();
    covered.last = (symbols[i] + covered.last) / model.shape().maps();
  }
  return covered;
}

}  // namespace ifsm::core
