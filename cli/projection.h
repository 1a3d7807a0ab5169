// A piece of the earth on a plane: local equirectangular, degrees to kilometres about a middle and back.
//
//   x = R cos(φ0) (λ - λ0),  y = R (φ - φ0),  R = 6371.0088 km, the earth's mean radius
//
// North-south lengths are those on the sphere; east-west ones are cos(φ0) / cos(φ) of them, which stretch() tells. The
// sphere itself is off by up to 0.6 % of the ellipsoid.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace cli {

struct Degrees {
  double longitude = 0;
  double latitude = 0;
};

// Points are point-major; the first two coordinates are longitude and latitude. Coordinates that are NaN are passed
// over.

// The first point whose latitude is beyond 90 degrees, or longitude beyond 360.
std::optional<std::size_t> first_off_the_earth(const std::vector<double>& points, std::size_t dimension);

// Adds whole turns to longitudes so that no step goes further than half way round: a curve that crosses the 180th
// meridian stays in one piece.
void unwrap(std::vector<double>& points, std::size_t dimension);

// Whether the step from the last point to the first would go further than that: the curve runs round a pole.
bool runs_round_a_pole(const std::vector<double>& points, std::size_t dimension);

// Of the box about the points, to four decimals; the longitude from -180 to 180.
Degrees middle_of(const std::vector<double>& points, std::size_t dimension);

// The largest factor by which an east-west length is wrong, at least 1: infinite at a pole.
double stretch(const std::vector<double>& points, std::size_t dimension, Degrees middle);

// From unwrapped degrees to kilometres, and back to degrees. Further coordinates stay as they are.
void project(std::vector<double>& points, std::size_t dimension, Degrees middle);
void unproject(std::vector<double>& points, std::size_t dimension, Degrees middle);

}  // namespace cli
