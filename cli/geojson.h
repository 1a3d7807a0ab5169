// Curves as GeoJSON (RFC 7946): lines and rings in, one Feature out.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "report.h"

namespace cli {

struct GeoCurve {
  std::vector<double> points;  // point-major
  int dimension = 2;           // 3: every position has an altitude
  bool ring = false;           // its first point is not repeated at the end
  std::string name;            // of its Feature; may be empty
  std::string place;           // e.g. "features[3].geometry.coordinates[0]"
};

struct GeoCurves {
  std::vector<GeoCurve> all;  // one or more
  std::vector<std::string> notes;
};

// Whether a text means to be JSON: its first character says so.
bool looks_like_json(std::string_view text);

// Every LineString and every ring of every Polygon, holes too, wherever they lie in Features and collections. `flat`
// leaves altitudes out. Throws Failure{Input}: for points, which are no curves, and for whatever the text gets wrong.
GeoCurves parse_geojson(std::string_view text, const std::string& source, bool flat);

// One Feature: a Polygon of a closed curve of three points or more, counterclockwise; else a LineString. The dimension
// is 2 or 3.
Json geojson_of(const std::vector<double>& points, int dimension, bool closed, const Json& properties);

}  // namespace cli
