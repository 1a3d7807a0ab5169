#include "projection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace cli {
namespace {

constexpr double earth_radius = 6371.0088;  // km: (2a + b) / 3 of WGS 84
constexpr double turn = 360;

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

// Whole turns that bring `longitude` within half a turn of `about`.
double turns_to(double longitude, double about) { return -turn * std::round((longitude - about) / turn); }

// About ten metres: any middle near the true one will do, and this one can be typed.
double to_four_decimals(double degrees) { return std::round(degrees * 1e4) / 1e4; }

struct Bounds {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

Bounds bounds(const std::vector<double>& points, std::size_t dimension, std::size_t coordinate) {
  Bounds bounds;
  for (std::size_t i = coordinate; i < points.size(); i += dimension) {
    bounds.low = std::fmin(bounds.low, points[i]);  // fmin and fmax pass NaN over
    bounds.high = std::fmax(bounds.high, points[i]);
  }
  return bounds;
}

}  // namespace

std::optional<std::size_t> first_off_the_earth(const std::vector<double>& points, std::size_t dimension) {
  for (std::size_t k = 0; k < points.size(); k += dimension)
    if (std::abs(points[k]) > turn || std::abs(points[k + 1]) > 90) return k / dimension;
  return std::nullopt;
}

void unwrap(std::vector<double>& points, std::size_t dimension) {
  double before = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = 0; k < points.size(); k += dimension) {
    if (std::isnan(points[k])) continue;
    if (!std::isnan(before) && std::abs(points[k] - before) > turn / 2) points[k] += turns_to(points[k], before);
    before = points[k];
  }
}

bool runs_round_a_pole(const std::vector<double>& points, std::size_t dimension) {
  double first = std::numeric_limits<double>::quiet_NaN(), last = first;
  for (std::size_t k = 0; k < points.size(); k += dimension) {
    if (std::isnan(points[k])) continue;
    if (std::isnan(first)) first = points[k];
    last = points[k];
  }
  return std::abs(last - first) > turn / 2;
}

Degrees middle_of(const std::vector<double>& points, std::size_t dimension) {
  const auto longitudes = bounds(points, dimension, 0), latitudes = bounds(points, dimension, 1);
  const double longitude = std::midpoint(longitudes.low, longitudes.high);
  return {to_four_decimals(longitude + (std::abs(longitude) > turn / 2 ? turns_to(longitude, 0) : 0)),
          to_four_decimals(std::midpoint(latitudes.low, latitudes.high))};
}

double stretch(const std::vector<double>& points, std::size_t dimension, Degrees middle) {
  const auto latitudes = bounds(points, dimension, 1);
  const double at_middle = std::cos(radians(middle.latitude));
  double largest = 1;
  for (const double latitude : {latitudes.low, std::clamp(0.0, latitudes.low, latitudes.high), latitudes.high}) {
    const double factor =
        std::abs(latitude) < 90 ? at_middle / std::cos(radians(latitude)) : std::numeric_limits<double>::infinity();
    largest = std::max({largest, factor, 1 / factor});
  }
  return largest;
}

void project(std::vector<double>& points, std::size_t dimension, Degrees middle) {
  const auto longitudes = bounds(points, dimension, 0);
  const double shift = turns_to(std::midpoint(longitudes.low, longitudes.high), middle.longitude);  // the whole curve's
  const double unit = earth_radius * std::cos(radians(middle.latitude));
  for (std::size_t k = 0; k < points.size(); k += dimension) {
    points[k] = unit * radians(points[k] + shift - middle.longitude);
    points[k + 1] = earth_radius * radians(points[k + 1] - middle.latitude);
  }
}

void unproject(std::vector<double>& points, std::size_t dimension, Degrees middle) {
  const double unit = earth_radius * std::cos(radians(middle.latitude));
  for (std::size_t k = 0; k < points.size(); k += dimension) {
    points[k] = middle.longitude + points[k] / unit * 180 / std::numbers::pi;
    points[k + 1] = middle.latitude + points[k + 1] / earth_radius * 180 / std::numbers::pi;
  }
}

}  // namespace cli
