// GeoJSON: every line and ring comes out, in order and whole; whatever is wrong is told with its place and the way out.
#include "geojson.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "failure.h"

namespace cli {
namespace {

using Points = std::vector<double>;

GeoCurves parsed(const std::string& text, bool flat = false) { return parse_geojson(text, "isles.geojson", flat); }

std::string refusal(const std::string& text) {
  try {
    parsed(text);
    return "accepted";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code, Exit::Input);
    return failure.what();
  }
}

std::string geometry(const std::string& type, const std::string& coordinates) {
  return R"({"type": ")" + type + R"(", "coordinates": )" + coordinates + "}";
}

const std::string square = "[[0,0],[1,0],[1,1],[0,1],[0,0]]";
const std::string inner = "[[0.2,0.2],[0.2,0.4],[0.4,0.4],[0.2,0.2]]";
const Points square_points{0, 0, 1, 0, 1, 1, 0, 1};

TEST(GeoJson, ALineIsOneOpenCurve) {
  const auto curves = parsed(geometry("LineString", "[[1,2],[3,4.5],[1,2]]")).all;
  ASSERT_EQ(curves.size(), 1u);
  EXPECT_EQ(curves[0].points, (Points{1, 2, 3, 4.5, 1, 2}));
  EXPECT_FALSE(curves[0].ring);
  EXPECT_EQ(curves[0].place, "coordinates");
}

TEST(GeoJson, EveryRingIsAClosedCurveHolesToo) {
  const auto curves = parsed(geometry("MultiPolygon", "[[" + square + "," + inner + "],[" + square + "]]")).all;
  ASSERT_EQ(curves.size(), 3u);
  for (const auto& curve : curves) EXPECT_TRUE(curve.ring);
  EXPECT_EQ(curves[0].points, square_points);
  EXPECT_EQ(curves[1].points.size(), 6u);
  EXPECT_EQ(curves[1].place, "coordinates[0][1]");
  EXPECT_EQ(parsed(geometry("Polygon", "[" + square + "]")).all[0].points, square_points);
  EXPECT_EQ(parsed(geometry("MultiLineString", "[" + square + "," + inner + "]")).all.size(), 2u);
}

TEST(GeoJson, FeaturesNameTheirCurves) {
  const auto line = geometry("LineString", "[[0,0],[1,1]]");
  const auto read = parsed(R"({"type": "FeatureCollection", "bbox": [0,0,1,1], "features": [
    {"type": "Feature", "id": 7, "properties": {"more": {"name": "no"}, "name": "Höfn"}, "geometry": )" +
                           line + R"(},
    {"geometry": {"type": "GeometryCollection", "geometries": [)" +
                           line + "," + line + R"(]}, "id": "B", "properties": null, "type": "Feature"},
    {"type": "Feature", "properties": {"id": 3}, "geometry": null},
    {"type": "Feature", "properties": {"id": 3}, "geometry": )" +
                           line + "}]}");
  std::vector<std::string> names, places;
  for (const auto& curve : read.all) names.push_back(curve.name), places.push_back(curve.place);
  EXPECT_EQ(names, (std::vector<std::string>{"Höfn", "B", "B", "3"}));
  EXPECT_EQ(places[2], "features[1].geometry.geometries[1].coordinates");
  EXPECT_EQ(read.notes, (std::vector<std::string>{"isles.geojson: 1 geometry is null and was passed over."}));
}

TEST(GeoJson, MembersMayComeInAnyOrderAndOthersArePassedOver) {
  EXPECT_EQ(parsed("\xEF\xBB\xBF \n"
                   R"({"crs": [[{"x": null}]], "coordinates": [)" +
                   square + R"(], "1e": 1e3, "type": "Polygon", "yes": true})")
                .all[0]
                .points,
            square_points);
}

TEST(GeoJson, AltitudesAreKeptWhenEveryPositionHasOne) {
  const auto high = geometry("LineString", "[[0,0,5],[1,1,6,99]]");
  EXPECT_EQ(parsed(high).all[0].dimension, 3);
  EXPECT_EQ(parsed(high).all[0].points, (Points{0, 0, 5, 1, 1, 6}));
  EXPECT_EQ(parsed(high, true).all[0].points, (Points{0, 0, 1, 1}));
  const auto mixed = parsed(geometry("LineString", "[[0,0,5],[1,1]]"));
  EXPECT_EQ(mixed.all[0].points, (Points{0, 0, 1, 1}));
  EXPECT_EQ(mixed.notes.size(), 1u);
}

TEST(GeoJson, ARingThatDoesNotCloseIsClosedAndTold) {
  const auto read = parsed(geometry("Polygon", "[[[0,0],[1,0],[1,1],[0,1]]]"));
  EXPECT_EQ(read.all[0].points, square_points);
  EXPECT_NE(read.notes.at(0).find("1 ring does not repeat its first position"), std::string::npos);
}

struct Misuse {
  const char* name;
  std::string text;
  std::string said;  // after "isles.geojson, "
};
void PrintTo(const Misuse& misuse, std::ostream* out) { *out << misuse.text; }

class MisusedGeoJson : public testing::TestWithParam<Misuse> {};

TEST_P(MisusedGeoJson, IsRefusedWithItsPlaceAndTheWayOut) {
  EXPECT_EQ(refusal(GetParam().text), "isles.geojson, " + GetParam().said);
}

const std::string feature_of_null = R"({"type": "Feature", "geometry": null})";

INSTANTIATE_TEST_SUITE_P(
    GeoJson, MisusedGeoJson,
    testing::Values(
        Misuse{"null_coordinate", geometry("LineString", "[[0,0],\n[1,null]]"),
               "line 2, coordinates[1][1]: is null; every coordinate must be a number: correct it, or take the "
               "position out."},
        Misuse{"text_coordinate", geometry("LineString", "[[0,0],[1,\"7\"]]"),
               "line 1, coordinates[1][1]: is \"7\"; every coordinate must be a number: correct it, or take the "
               "position out."},
        Misuse{"object_coordinate", geometry("LineString", "[[0,0],{}]"),
               "line 1, coordinates[1]: is an object; coordinates are arrays of numbers."},
        Misuse{"point", geometry("Point", "[1,2]"),
               "line 1: a Point is no curve; take it out of the file (lines and polygons are read, points are not "
               "guessed to be lines)."},
        Misuse{"points",
               R"({"type": "Feature", "geometry":
 )" + geometry("MultiPoint", "[[1,2],[3,4]]") +
                   "}",
               "line 2, geometry: a MultiPoint is no curve; take it out of the file (lines and polygons are read, "
               "points are not guessed to be lines)."},
        Misuse{"empty", geometry("Polygon", "[]"),
               "line 1, coordinates: is empty; take the geometry out, or make it null."},
        Misuse{"empty_ring", geometry("Polygon", "[" + square + ",[]]"),
               "line 1, coordinates[1]: is empty; take the geometry out, or make it null."},
        Misuse{"short_position", geometry("LineString", "[[0,0],[1]]"),
               "line 1, coordinates[1]: has one number; a position has at least 2, longitude and latitude."},
        Misuse{"short_line", geometry("LineString", "[[0,0]]"),
               "line 1, coordinates: a line of 1 position; a line has at least 2."},
        Misuse{
            "short_ring", geometry("Polygon", "[[[0,0],[1,1],[0,0]]]"),
            "line 1, coordinates[0]: a ring of 3 positions; a ring has at least 4, the last one repeating the first."},
        Misuse{"wrong_depth", geometry("Polygon", square),
               "line 1: the positions lie in 1 array; those of a Polygon lie in 2."},
        Misuse{
            "mixed_depth", geometry("LineString", "[[0,0],[[1,1]]]"),
            "line 1, coordinates[1][0]: is a position that lies in 2 arrays, others before it in 1; a geometry nests "
            "all of its positions alike."},
        Misuse{"number_beside_array", geometry("LineString", "[[0,0],1]"),
               "line 1, coordinates[1]: is a number beside arrays; a position is an array of numbers."},
        Misuse{"array_beside_number", geometry("LineString", "[[0,[0]]]"),
               "line 1, coordinates[0][1]: is an array beside numbers; a position holds numbers alone."},
        Misuse{"twice", R"({"type": "Polygon", "type": "LineString"})",
               "line 1, type: is there twice; keep one of them."},
        Misuse{"no_type", R"({"coordinates": [[0,0],[1,1]]})",
               "line 1: an object without a type; GeoJSON says what each is."},
        Misuse{"no_coordinates", R"({"type": "Polygon"})", "line 1: a Polygon without coordinates."},
        Misuse{"no_geometry", R"({"type": "Feature"})",
               "line 1: a Feature without geometry; nothing can be read from it."},
        Misuse{"unknown_type", geometry("Circle", "[1,2]"),
               "line 1: the type \"Circle\" is not known; curves are read from LineString, MultiLineString, Polygon, "
               "MultiPolygon, GeometryCollection, Feature and FeatureCollection."},
        Misuse{"topology", R"({"type": "Topology"})",
               "line 1: TopoJSON; turn it into GeoJSON first, e.g. with topo2geo of the topojson package."},
        Misuse{"model", R"({"format": "ifsm-model", "version": 1})",
               "line 1: a model, not a curve; ifsm synth writes the points of a model."},
        Misuse{"nothing_but_null", R"({"type": "FeatureCollection", "features": [)" + feature_of_null + "]}",
               "line 1: holds no curve: there is no geometry in it."},
        Misuse{"no_features", R"({"type": "FeatureCollection", "features": []})",
               "line 1: holds no curve: there is no geometry in it."},
        Misuse{"null_feature", R"({"type": "FeatureCollection", "features": [null]})",
               "line 1, features[0]: is null; it must be an object with a type."},
        Misuse{"features_object", R"({"type": "FeatureCollection", "features": {}})",
               "line 1, features: is an object; it must be an array."},
        Misuse{"array", "[1]", "line 1: is a JSON array; GeoJSON is an object with a type, e.g. a FeatureCollection."},
        Misuse{"too_large", geometry("LineString", "[[0,0],\n[1,1e999]]"),
               "line 2, coordinates[1][1]: is beyond the range of double precision (number overflow parsing '1e999'); "
               "use another unit."}),
    [](const auto& info) { return std::string(info.param.name); });

TEST(GeoJson, BrokenTextIsToldWithLineAndColumn) {
  const auto message = refusal("{\"type\": \"LineString\",\n \"coordinates\": [[0, NaN]]}");
  EXPECT_EQ(message.rfind("isles.geojson, line 2, column 22: ", 0), 0u) << message;
  EXPECT_NE(message.find("NaN does not exist in JSON"), std::string::npos) << message;
  EXPECT_NE(refusal(geometry("LineString", "[[0,0],[1,1]]") + "{}").find("one GeoJSON object"), std::string::npos);
  EXPECT_NE(refusal(std::string("{}\0", 3)).find("NUL byte"), std::string::npos);
}

TEST(GeoJson, DepthIsBounded) {
  const std::string deep(100000, '[');
  EXPECT_NE(refusal(R"({"coordinates": )" + deep).find("so deep nothing of GeoJSON lies"), std::string::npos);
  EXPECT_NE(refusal(R"({"other": )" + deep).find("so deep"), std::string::npos);
  std::string nested;
  for (int k = 0; k < 5000; ++k) nested += R"({"type": "GeometryCollection", "geometries": [)";
  EXPECT_NE(refusal(nested).find("so deep"), std::string::npos);
}

const std::string whole = R"({"type": "FeatureCollection", "features": [{"type": "Feature", "id": 1, "properties":
  {"name": "A"}, "geometry": {"type": "Polygon", "coordinates": [[[0,0],[1,0.5],[1,1e0],[-0.25,1],[0,0]]]}}]})";

TEST(GeoJson, NoCutShortTextIsAccepted) {
  ASSERT_EQ(parsed(whole).all.size(), 1u);
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_NE(refusal(whole.substr(0, length)), "accepted") << length;
}

RC_GTEST_PROP(GeoJson, NoChangedTextCrashesTheReader, ()) {
  auto text = whole;
  for (const int times : {1, 2, 3}) {
    const auto at = *rc::gen::inRange<std::size_t>(0, text.size());
    const auto length = *rc::gen::inRange<std::size_t>(0, 12);
    text.replace(at, length,
                 *rc::gen::element<std::string>("[", "]", "{", "}", "null", "1", ",", "[]", "{}", "\"", "e"));
    static_cast<void>(times);
  }
  try {
    for (const auto& curve : parsed(text).all) {
      RC_ASSERT(curve.points.size() >= 2u * static_cast<std::size_t>(curve.dimension));
      for (const double value : curve.points) RC_ASSERT(std::isfinite(value));
    }
  } catch (const Failure& failure) {
    RC_ASSERT(failure.code == Exit::Input);
  }
}

RC_GTEST_PROP(GeoJson, WhatIsWrittenIsReadBack, (bool closed, bool high)) {
  const int d = high ? 3 : 2;
  const auto count = *rc::gen::inRange(closed ? 3 : 2, 20);
  Points points;
  for (int k = 0; k < count * d; ++k)
    points.push_back(k + static_cast<double>(*rc::gen::inRange(-1000000, 1000000)) / 7);
  const auto read = parsed(text_of(geojson_of(points, d, closed, {{"model", "a"}}))).all;
  RC_ASSERT(read.size() == 1u);
  RC_ASSERT(read[0].ring == closed);
  auto back = read[0].points;
  if (back != points)  // turned round: the first point stays the first
    for (int k = 1; k <= (count - 1) / 2; ++k)
      std::swap_ranges(back.begin() + k * d, back.begin() + (k + 1) * d, back.begin() + (count - k) * d);
  RC_ASSERT(back == points);
}

TEST(GeoJson, RingsAreWrittenCounterclockwise) {
  const auto written = [](const Points& points) { return geojson_of(points, 2, true, nullptr)["geometry"].dump(); };
  const std::string expected =
      R"({"type":"Polygon","coordinates":[[[0.0,0.0],[1.0,0.0],[1.0,1.0],[0.0,1.0],[0.0,0.0]]]})";
  EXPECT_EQ(written(square_points), expected);
  EXPECT_EQ(written({0, 0, 0, 1, 1, 1, 1, 0}), expected);
  EXPECT_EQ(written({0, 0, 1, 0, 1, 1, 0, 1, 0, 0}), expected);  // a control polygon repeats its first point
  EXPECT_EQ(written({0, 0, 1, 0}), R"({"type":"LineString","coordinates":[[0.0,0.0],[1.0,0.0],[0.0,0.0]]})");
}

}  // namespace
}  // namespace cli
