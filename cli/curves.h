// Measured curves, as they come out of files.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <ifsm.hpp>

#include "gaps.h"
#include "projection.h"

namespace cli {

struct Samples {
  std::vector<double> points;  // point-major
  int dimension = 0;
  bool closed = false;
  std::string name = {};               // what the file calls it: may be empty, may be any text
  std::string place = {};              // where in the file it stands; empty when it is all of it
  std::optional<Degrees> middle = {};  // of the plane it was projected to

  ifsm::Curve curve() const { return {points, dimension, closed}; }  // refers to these samples
};

// From degrees to kilometres about a middle: one for all curves, or each curve's own.
struct ToPlane {
  std::optional<Degrees> middle = {};
};

// How to read them.
struct Reading {
  std::vector<std::string> columns = {};  // of a table; empty for all
  bool closed = false;                    // lines are rings
  Gaps gaps = Gaps::Refused;
  std::optional<ToPlane> project = {};
  bool flat = false;  // altitudes of GeoJSON are left out
};

struct Curves {
  std::vector<Samples> all;        // one or more
  std::vector<std::string> notes;  // what the user should know about how they were read
};

// A table of 1 to 4 columns is one curve, or as many as there are pieces between gaps. GeoJSON is told by its first
// character and holds as many as there are lines and rings. A closed curve's repeated last point is dropped.
// Throws Failure{Input, Usage}.
Curves read_curves(const std::string& path, const Reading& reading);

// The same of text that was read from `source`.
Curves parse_curves(std::string_view text, const std::string& source, const Reading& reading);

// Root of the sum of squares over `count`, of numbers of any size.
double root_of_squares(const std::vector<double>& values, double count);

// How far two rows of points of the same length are apart, in their units.
struct Distance {
  double rms = 0;
  double max = 0;
};
Distance distance(const std::vector<double>& a, const std::vector<double>& b, int dimension);

// "x", "y", "z", "w": the columns of points that are written.
std::vector<std::string> coordinate_names(int dimension);

}  // namespace cli
