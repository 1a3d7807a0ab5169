#include "geojson.h"

#include <algorithm>
#include <map>

#include "failure.h"
#include "geojson_tree.h"

namespace cli {
namespace {

constexpr std::size_t fewest_in_ring = 4;  // positions, the repeated first one counted (RFC 7946, section 3.1.6)
constexpr std::size_t fewest_in_line = 2;

struct Shape {
  int depth = 0;  // of its coordinates
  bool rings = false;
};
const std::map<std::string, Shape> shapes{
    {"LineString", {2, false}}, {"MultiLineString", {3, false}}, {"Polygon", {3, true}}, {"MultiPolygon", {4, true}}};

std::string a_or_an(const std::string& word) {
  return (std::string_view("AEIOU").find(word.front()) == std::string_view::npos ? "a " : "an ") + word;
}

class CurveCollector {
 public:
  CurveCollector(const std::string& source, bool flat) : source_(source), flat_(flat) {}

  GeoCurves collect(const GeoObject& root) {
    visit(root, root.name);
    if (curves_.all.empty()) fail(root.place, "holds no curve: there is no geometry in it");
    note(null_geometries_, "geometry is null and was passed over", "geometries are null and were passed over");
    note(unclosed_, "ring does not repeat its first position at the end; it was closed all the same",
         "rings do not repeat their first position at the end; they were closed all the same");
    note(half_high_, "curve has altitudes at some positions only; they were left out",
         "curves have altitudes at some positions only; they were left out");
    return std::move(curves_);
  }

 private:
  [[noreturn]] void fail(const GeoPlace& place, const std::string& what) const {
    throw Failure(Exit::Input, source_ + ", line " + std::to_string(place.line) +
                                   (place.path.empty() ? "" : ", " + place.path) + ": " + what + ".");
  }

  void note(std::size_t number, const std::string& one, const std::string& several) {
    if (number > 0)
      curves_.notes.push_back(source_ + ": " + std::to_string(number) + " " + (number == 1 ? one : several) + ".");
  }

  void visit(const GeoObject& object, const std::string& name) {
    if (object.null) {
      ++null_geometries_;
    } else if (const auto shape = shapes.find(object.type); shape != shapes.end()) {
      take_geometry(object, shape->second, name);
    } else if (object.type == "FeatureCollection" || object.type == "GeometryCollection") {
      visit_members(object, object.type == "FeatureCollection" ? "features" : "geometries", name);
    } else if (object.type == "Feature") {
      visit_members(object, "geometry", object.name);
    } else {
      refuse_type(object);
    }
  }

  void visit_members(const GeoObject& object, const std::string& member, const std::string& name) {
    if (!object.has_members)
      fail(object.place, a_or_an(object.type) + " without " + member + "; nothing can be read from it");
    for (const auto& inner : object.members) visit(inner, name);
  }

  [[noreturn]] void refuse_type(const GeoObject& object) const {
    if (object.format == "ifsm-model")
      fail(object.place, "a model, not a curve; ifsm synth writes the points of a model");
    if (object.type == "Topology")
      fail(object.place, "TopoJSON; turn it into GeoJSON first, e.g. with topo2geo of the topojson package");
    if (object.type == "Point" || object.type == "MultiPoint")
      fail(object.place, "a " + object.type +
                             " is no curve; take it out of the file (lines and polygons are read, points are not "
                             "guessed to be lines)");
    if (object.type.empty()) fail(object.place, "an object without a type; GeoJSON says what each is");
    fail(object.place, "the type \"" + printable(object.type) +
                           "\" is not known; curves are read from LineString, MultiLineString, Polygon, MultiPolygon, "
                           "GeometryCollection, Feature and FeatureCollection");
  }

  void take_geometry(const GeoObject& object, const Shape& shape, const std::string& name) {
    if (!object.has_coordinates) fail(object.place, a_or_an(object.type) + " without coordinates");
    if (!object.empty.empty())
      fail({object.empty, object.place.line}, "is empty; take the geometry out, or make it null");
    if (object.depth != shape.depth)
      fail(object.place, "the positions lie in " + counted(static_cast<std::size_t>(object.depth - 1), "array") +
                             "; those of " + a_or_an(object.type) + " lie in " + std::to_string(shape.depth - 1));
    for (const auto& line : object.lines) take_line(line, shape.rings, name);
  }

  void take_line(const GeoPositions& line, bool ring, const std::string& name) {
    const auto fewest = ring ? fewest_in_ring : fewest_in_line;
    if (line.count() < fewest)
      fail(line.place,
           std::string(ring ? "a ring of " : "a line of ") + counted(line.count(), "position") + "; " +
               (ring ? "a ring has at least 4, the last one repeating the first" : "a line has at least 2"));
    const bool high = !flat_ && line.with_altitude == line.count();
    half_high_ += !flat_ && !high && line.with_altitude > 0;
    GeoCurve curve{{}, high ? 3 : 2, ring, name, line.place.path};
    std::size_t count = line.count();
    if (ring && repeats_first(line, curve.dimension))
      --count;
    else
      unclosed_ += ring;
    for (std::size_t k = 0; k < count; ++k)
      for (std::size_t i = 0; i < static_cast<std::size_t>(curve.dimension); ++i)
        curve.points.push_back(line.numbers[3 * k + i]);
    curves_.all.push_back(std::move(curve));
  }

  static bool repeats_first(const GeoPositions& line, int dimension) {
    return std::equal(line.numbers.begin(), line.numbers.begin() + dimension, line.numbers.end() - 3);
  }

  const std::string& source_;
  bool flat_;
  GeoCurves curves_;
  std::size_t null_geometries_ = 0, unclosed_ = 0, half_high_ = 0;
};

// Twice the area of a ring seen from above, positive when it runs counterclockwise.
double turn(const std::vector<double>& points, std::size_t d) {
  double sum = 0;
  const std::size_t count = points.size() / d;
  for (std::size_t k = 0; k < count; ++k) {
    const auto *a = &points[k * d], *b = &points[(k + 1) % count * d];
    sum += (a[0] - points[0]) * (b[1] - points[1]) - (b[0] - points[0]) * (a[1] - points[1]);
  }
  return sum;
}

}  // namespace

bool looks_like_json(std::string_view text) {
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  const auto first = text.find_first_not_of(" \t\r\n");
  return first != text.npos && (text[first] == '{' || text[first] == '[');
}

GeoCurves parse_geojson(std::string_view text, const std::string& source, bool flat) {
  return CurveCollector(source, flat).collect(read_geojson(text, source));
}

Json geojson_of(const std::vector<double>& points, int dimension, bool closed, const Json& properties) {
  const auto d = static_cast<std::size_t>(dimension);
  std::vector<Json> positions;
  for (std::size_t k = 0; k < points.size(); k += d) {
    const auto first = points.begin() + static_cast<std::ptrdiff_t>(k);
    positions.emplace_back(std::vector<double>(first, first + dimension));
  }
  if (closed && positions.size() > 1 && positions.back() == positions.front()) positions.pop_back();
  const bool polygon = closed && positions.size() + 1 >= fewest_in_ring;
  if (polygon && turn(points, d) < 0) std::reverse(positions.begin() + 1, positions.end());
  if (closed) positions.push_back(positions.front());
  const Json line(positions);
  return {{"type", "Feature"},
          {"properties", properties},
          {"geometry",
           {{"type", polygon ? "Polygon" : "LineString"}, {"coordinates", polygon ? Json::array({line}) : line}}}};
}

}  // namespace cli
