// What is wrong with the rings of GeoJSON's polygons. None of it keeps a curve from being fitted, so it is told in
// notes.
#pragma once

#include <string>
#include <vector>

#include "geojson.h"

namespace cli {

// Rings that meet themselves; holes outside their shell, or only partly in it; holes that overlap, and polygons of one
// MultiPolygon that do, one within the other or partly. Seen from above, in the coordinates as they are, but for
// degrees: a ring goes on across the 180th meridian.
std::vector<std::string> notes_on_rings(const std::vector<GeoCurve>& curves, const std::string& source, bool degrees);

}  // namespace cli
