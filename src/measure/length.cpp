#include "measure/length.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/cancel.h"

namespace ifsm::core {
namespace {

constexpr double epsilon = 2.220446049250313e-16;
constexpr double most_points = 1099511627776.0;  // 2^40

}  // namespace

ArcLength::ArcLength(const Polyline& polyline) : polyline_(polyline) {
  at_point_.reserve(static_cast<std::size_t>(polyline.segments()) + 1);
  at_point_.push_back(0);
  // Neumaier's sum: what each addition rounds away is kept, so the error does not grow with the number of segments.
  double sum = 0, lost = 0;
  Polled polled;
  for (Index segment = 0; segment < polyline.segments(); ++segment) {
    polled.step();
    const double length = polyline.length(segment);
    const double next = sum + length;
    lost += sum >= length ? (sum - next) + length : (length - next) + sum;
    sum = next;
    at_point_.push_back(std::max(sum + lost, at_point_.back()));
  }
}

double ArcLength::at(double parameter) const {
  if (polyline_.segments() == 0) return 0;
  const double turns = polyline_.closed() ? std::floor(parameter) : 0.0;
  const double position = polyline_.position(parameter);
  const Index segment = std::min(static_cast<Index>(position), polyline_.segments() - 1);
  const double within = position - static_cast<double>(segment);
  const double whole = turns * total();
  // A parameter a rounding below a whole turn is found at the ring's start: of the next turn.
  const bool over = polyline_.closed() && position == 0 && parameter - turns > 0.5;
  return whole + (over ? total() : at_point(segment) + within * (at_point(segment + 1) - at_point(segment)));
}

ArcLength::Spot ArcLength::spot(double length) const {
  const auto found = std::lower_bound(at_point_.begin(), at_point_.end(), length);
  const auto point = static_cast<Index>(found - at_point_.begin());
  if (point == 0) return {0, 0.0};
  if (found == at_point_.end()) return {polyline_.segments() - 1, 1.0};
  const double from = at_point(point - 1);
  return {point - 1, (length - from) / (*found - from)};
}

double ArcLength::parameter(double length) const {
  const Spot found = spot(length);
  return polyline_.parameter(found.segment, found.within);
}

double length_between(const Polyline& polyline, double from, double to) {
  require_parameters(polyline.closed(), &from, 1, "from");
  require_parameters(polyline.closed(), &to, 1, "to");
  const ArcLength lengths(polyline);
  return in_samples_units(lengths.at(to) - lengths.at(from), polyline.unit(), "The length");
}

std::vector<double> equally_spaced(const Polyline& polyline, Index count) {
  in_range(count, 1, static_cast<Index>(most_points), "points");
  const ArcLength lengths(polyline);
  const auto pieces = static_cast<double>(polyline.closed() || count == 1 ? count : count - 1);
  std::vector<double> parameters;
  parameters.reserve(static_cast<std::size_t>(count));
  Polled polled;
  for (Index k = 0; k < count; ++k) {
    polled.step();
    parameters.push_back(lengths.parameter(static_cast<double>(k) / pieces * lengths.total()));
  }
  if (!polyline.closed() && count > 1 && polyline.segments() > 0) parameters.back() = 1;
  return parameters;
}

Index spaced_count(const Polyline& polyline, double spacing) {
  require_finite(spacing, "spacing");
  if (!(spacing > 0))
    throw Error(Status::range, "spacing",
                "spacing is " + text_of(spacing) + "; give a positive distance in the samples' units.")
        .with(spacing);
  double pieces = ArcLength(polyline).total() / (spacing / polyline.unit());
  // The length is known to one rounding a segment's own and one of the sum; division by the unit is exact. So a spacing
  // that divides the length is met within 4 of them.
  if (std::abs(pieces - std::round(pieces)) <= 4 * epsilon * pieces) pieces = std::round(pieces);
  if (!(pieces < most_points))
    throw Error(Status::range, "spacing",
                "spacing is " + text_of(spacing) + ", so small that the points are more than 2^40; give a larger one.")
        .with(spacing);
  if (!polyline.closed()) return static_cast<Index>(pieces) + 1;
  return std::max(static_cast<Index>(std::ceil(pieces)), Index{1});
}

std::vector<double> spaced(const Polyline& polyline, double spacing) {
  const Index count = spaced_count(polyline, spacing);
  const ArcLength lengths(polyline);
  std::vector<double> parameters;
  parameters.reserve(static_cast<std::size_t>(count));
  parameters.push_back(0);
  Polled polled;
  for (Index k = 1; k < count; ++k) {
    polled.step();
    parameters.push_back(
        lengths.parameter(std::min(static_cast<double>(k) * (spacing / polyline.unit()), lengths.total())));
  }
  return parameters;
}

}  // namespace ifsm::core
