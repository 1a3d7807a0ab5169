#include "measure/dimension.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/cancel.h"
#include "measure/box_count.h"
#include "measure/length.h"

namespace ifsm::core {
namespace {

constexpr double finest = 0x1p-20;  // of the diagonal
constexpr Index most_visits = Index{1} << 26;
constexpr double most_steps = 0x1p31;

using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 4, 1>;
using Map = Eigen::Map<const Vector>;

void require_extent(const Polyline& polyline) {
  if (polyline.diagonal() > 0) return;
  throw Error(Status::shape, "model", "All points of the curve are one, which has no scales; give a curve that moves.");
}

double checked_scale(double given, double otherwise, double low, double high, const Polyline& polyline,
                     const char* argument) {
  require_finite(given, argument);
  if (given == 0) return otherwise;
  if (given / polyline.unit() >= low && given / polyline.unit() <= high) return given / polyline.unit();
  throw Error(Status::range, argument,
              std::string(argument) + " is " + text_of(given) + "; give a length from " +
                  text_of(low * polyline.unit()) + " to " + text_of(high * polyline.unit()) + ", or 0 for the default.")
      .with(given);
}

// In units of the polyline.
std::vector<double> scales_of(const Polyline& polyline, const ArcLength& lengths, const ScaleRange& range) {
  in_range(range.scales, 3, 256, "scales");
  const double diagonal = polyline.diagonal();
  const double largest =
      checked_scale(range.largest, diagonal / 4, 2 * finest * diagonal, diagonal, polyline, "largest");
  const double mean = lengths.total() / static_cast<double>(polyline.segments());
  const double smallest = checked_scale(range.smallest, std::clamp(2 * mean, finest * diagonal, largest / 4),
                                        finest * diagonal, largest / 2, polyline, "smallest");
  std::vector<double> scales;
  const double ratio = smallest / largest;
  for (int i = 0; i < range.scales; ++i)
    scales.push_back(largest * std::pow(ratio, static_cast<double>(i) / (range.scales - 1)));
  return scales;
}

[[noreturn]] void refuse_fineness(double scale, const Polyline& polyline, const char* what) {
  throw Error(
      Status::limit, "smallest",
      "At scale " + text_of(scale * polyline.unit()) + " the curve visits " + what + "; give a larger smallest scale.")
      .with(scale * polyline.unit());
}

// What remains of a segment after `within` it, when a pair of compasses stands at `from`: the share at which it is
// left.
double leaving(const Vector& from, const Vector& a, const Vector& b, double within, double step) {
  const Vector along = b - a, off = a - from;
  const double square = along.squaredNorm(), dot = off.dot(along);
  const double root = std::sqrt(std::max(dot * dot - square * (off.squaredNorm() - step * step), 0.0));
  return std::clamp((root - dot) / square, within, 1.0);
}

// From point to point, and the share of a step that is left.
double steps_of(const Polyline& polyline, double step) {
  const Index d = polyline.dimension();
  Vector from = Map(polyline.start(0), d);
  double steps = 0;
  Polled polled;
  for (Index segment = 0; segment < polyline.segments(); ++segment) {
    polled.step();
    const Vector a = Map(polyline.start(segment), d), b = Map(polyline.end(segment), d);
    double within = 0;
    while ((b - from).norm() >= step) {
      within = leaving(from, a, b, within, step);
      from = within == 1 ? b : Vector(a + within * (b - a));
      steps += 1;
      if (within == 1) break;
    }
  }
  const Vector end = Map(polyline.end(polyline.segments() - 1), d);
  return steps + (end - from).norm() / step;
}

Dimension fitted(Dimension told) {
  std::vector<double> x, y;
  for (std::size_t i = 0; i < told.scales.size(); ++i) {
    x.push_back(-std::log(told.scales[i]));
    y.push_back(std::log(told.counts[i]));
  }
  const Trend line = trend(x, y);
  told.dimension = line.slope;
  told.standard_error = line.standard_error;
  told.r_squared = line.r_squared;
  return told;
}

Dimension by_boxes(const Polyline& polyline, const std::vector<double>& scales) {
  if (polyline.dimension() != 2 && polyline.dimension() != 3)
    throw Error(Status::shape, "model",
                "Boxes are counted in two and three dimensions, and this curve has " +
                    std::to_string(polyline.dimension()) + "; use the divider.");
  const Lattice lattice(polyline);
  const double finest_scale = scales.back();
  if (lattice.visits_at_most(lattice.side_of(finest_scale)) > most_visits)
    refuse_fineness(finest_scale, polyline, "more than 2^26 boxes");
  Dimension told{};
  for (const double scale : scales) {
    const Index side = lattice.side_of(scale);
    told.scales.push_back(static_cast<double>(side) * lattice.step());
    told.counts.push_back(static_cast<double>(lattice.count(side)));
  }
  return told;
}

Dimension by_divider(const Polyline& polyline, const ArcLength& lengths, const std::vector<double>& scales) {
  if (lengths.total() / scales.back() > most_steps) refuse_fineness(scales.back(), polyline, "more than 2^31 steps");
  Dimension told{};
  for (const double scale : scales) {
    told.scales.push_back(scale);
    told.counts.push_back(steps_of(polyline, scale));
  }
  return told;
}

}  // namespace

Dimension measure_dimension(const Polyline& polyline, Counting counting, const ScaleRange& range) {
  require_extent(polyline);
  const ArcLength lengths(polyline);
  const std::vector<double> scales = scales_of(polyline, lengths, range);
  Dimension told =
      fitted(counting == Counting::boxes ? by_boxes(polyline, scales) : by_divider(polyline, lengths, scales));
  for (double& scale : told.scales) scale = in_samples_units(scale, polyline.unit(), "A scale");
  return told;
}

}  // namespace ifsm::core
