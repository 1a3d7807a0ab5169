#include "measure/curvature.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/parallel.h"
#include "measure/length.h"

namespace ifsm::core {
namespace {

constexpr double epsilon = 2.220446049250313e-16;

using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 4, 1>;

// x ≈ c0 + c1 P1(u) + c2 P2(u), Legendre's polynomials on the window -1 <= u <= 1.
struct Quadratic {
  Vector c1, c2;
  double extent = 0;  // of what was projected
};

// The window, as arc length from the curve's start; `from` is on the curve, `to` may be past a ring's end.
struct Window {
  double from, to;
};

Quadratic projected(const Polyline& polyline, const ArcLength& lengths, const Window& window) {
  using Map = Eigen::Map<const Vector>;
  const Index d = polyline.dimension();
  const auto spot = lengths.spot(window.from);
  Index segment = spot.segment;
  double within = spot.within, s = window.from;
  const Vector origin = Map(polyline.start(segment), d);  // near: what is summed is small
  const double scale = 2 / (window.to - window.from);
  Quadratic sum{Vector::Zero(d), Vector::Zero(d)};
  while (s < window.to) {
    const Vector a = Map(polyline.start(segment), d) - origin, b = Map(polyline.end(segment), d) - origin;
    const double length = lengths.at_point(segment + 1) - lengths.at_point(segment);
    const double until = std::min(s + (1 - within) * length, window.to);
    const double last = length > 0 ? within + (until - s) / length : 1.0;
    // Two points of Gauss integrate cubics exactly: a straight piece times P2.
    const double u0 = (s - window.from) * scale - 1, u1 = (until - window.from) * scale - 1;
    for (const double g : {-std::sqrt(1.0 / 3), std::sqrt(1.0 / 3)}) {
      const double u = (u0 + u1) / 2 + g * (u1 - u0) / 2, t = (within + last) / 2 + g * (last - within) / 2;
      const Vector x = (a + t * (b - a)) * ((u1 - u0) / 2);
      sum.c1 += 1.5 * u * x;
      sum.c2 += 2.5 * (1.5 * u * u - 0.5) * x;
    }
    sum.extent = std::max({sum.extent, a.norm(), b.norm()});
    s = until;
    within = 0;
    if (++segment < polyline.segments()) continue;
    if (!polyline.closed()) break;  // all but rounding is behind
    segment = 0;
  }
  return sum;
}

double bend(const Vector& first, const Vector& second) {
  const double speed = first.norm();
  if (first.size() == 2) return (first(0) * second(1) - first(1) * second(0)) / (speed * speed * speed);
  // |first x second| without cancelling: what of `second` is across `first`.
  const Vector across = second - first * (first.dot(second) / (speed * speed));
  return across.norm() / (speed * speed);
}

Window window_about(const Polyline& polyline, const ArcLength& lengths, double middle, double half) {
  if (!polyline.closed()) return {std::max(middle - half, 0.0), std::min(middle + half, lengths.total())};
  const double from = middle - half < 0 ? middle - half + lengths.total() : middle - half;
  return {from, from + 2 * half};
}

void require_scale(const Polyline& polyline, const ArcLength& lengths, double scale) {
  require_finite(scale, "scale");
  if (!(scale > 0))
    throw Error(Status::range, "scale",
                "scale is " + text_of(scale) + "; give a positive length in the samples' units.")
        .with(scale);
  const double most = polyline.closed() ? lengths.total() / 2 : lengths.total();
  // A curve without length has no direction either, which is told of its parameters.
  if (most > 0 && scale / polyline.unit() > most)
    throw Error(Status::range, "scale",
                "scale is " + text_of(scale) + ", more than " +
                    (polyline.closed() ? "half the ring's" : "the curve's") + " length, " +
                    text_of(most * polyline.unit()) + "; give a smaller one.")
        .with(scale);
}

// Not a number where the window's arc has no direction.
double curvature_at(const Polyline& polyline, const ArcLength& lengths, double parameter, double half) {
  const double turn = polyline.closed() ? parameter - std::floor(parameter) : parameter;
  const double middle = std::min(lengths.at(turn), lengths.total());
  const Window window = window_about(polyline, lengths, middle, half);
  const Quadratic arc = projected(polyline, lengths, window);
  // At the window's middle, unless an end of the curve has cut it.
  const double u = polyline.closed() ? 0.0 : (2 * middle - window.from - window.to) / (window.to - window.from);
  const Vector first = arc.c1 + 3 * u * arc.c2, second = 3 * arc.c2;
  // Sums of products whose weights add up to less than 8, each rounded a few times: what is left below is rounding.
  if (!(first.norm() > 64 * epsilon * arc.extent)) return std::numeric_limits<double>::quiet_NaN();
  return bend(first, second);
}

}  // namespace

std::vector<double> curvature(const Polyline& polyline, std::span<const double> parameters, double scale) {
  if (polyline.dimension() < 2)
    throw Error(Status::shape, "model",
                "A curve of one dimension does not bend; give its samples a second coordinate, such as time.");
  require_parameters(polyline.closed(), parameters.data(), static_cast<Index>(parameters.size()), "parameters");
  const ArcLength lengths(polyline);
  require_scale(polyline, lengths, scale);
  const double half = scale / polyline.unit();
  constexpr Index chunk = 16;
  const auto count = static_cast<Index>(parameters.size());
  std::vector<double> bends(parameters.size());
  parallel_for((count + chunk - 1) / chunk, 0, [&](Index part) {
    for (Index i = part * chunk; i < std::min((part + 1) * chunk, count); ++i) {
      const auto k = static_cast<std::size_t>(i);
      bends[k] = curvature_at(polyline, lengths, parameters[k], half);
    }
  });
  for (std::size_t i = 0; i < bends.size(); ++i) {
    if (std::isnan(bends[i]))
      throw Error(Status::numerical, "parameters",
                  "At parameters[" + std::to_string(i) + "], " + text_of(parameters[i]) +
                      ", the curve seen at this scale has no direction, hence no curvature; give another scale.")
          .at(static_cast<Index>(i))
          .with(parameters[i]);
    bends[i] = in_samples_units(bends[i] / polyline.unit(), 1, "The curvature");
  }
  return bends;
}

}  // namespace ifsm::core
