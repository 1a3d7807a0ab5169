// What a GeoJSON text says (RFC 7946), before it is known what it means: objects, their types and their coordinates.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

// Where in the text: the path of a member, e.g. "features[3].geometry", and the line.
struct GeoPlace {
  std::string path;
  std::size_t line = 1;
};

// An array of positions: a line, a ring, the points of a MultiPoint.
struct GeoPositions {
  GeoPlace place;
  std::vector<double> numbers;    // longitude, latitude, altitude; NaN where a position has no altitude
  std::size_t with_altitude = 0;  // positions

  std::size_t count() const { return numbers.size() / 3; }
};

struct GeoObject {
  GeoPlace place;
  bool null = false;   // null stands where an object may
  std::string type;    // empty when there is none
  std::string format;  // of a model that was taken for a curve
  std::string name;    // of a Feature: properties.name, else properties.id, else id

  bool has_coordinates = false;
  int depth = 0;  // how many arrays lie around a number: 1 for a Point; 0 without any number
  std::vector<GeoPositions> lines;
  std::string empty;  // the path of the first array in them that holds nothing

  bool has_members = false;          // geometry, geometries or features
  std::vector<GeoObject> members{};  // what they hold
};

// Reads one GeoJSON object of bounded depth; members that mean nothing here are passed over. Memory: in proportion to
// the text. Throws Failure{Input}, which names `source`, line, member, value and the way out.
GeoObject read_geojson(std::string_view text, const std::string& source);

}  // namespace cli
