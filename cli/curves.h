// Curves and models as files.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <ifsm.hpp>

namespace cli {

struct Samples {
  std::vector<double> points;  // point-major
  int dimension = 0;
  bool closed = false;
  std::vector<std::string> notes;  // what the user should know about how the table was read

  ifsm::Curve curve() const { return {points, dimension, closed}; }  // refers to these samples
};

// A table of 1 to 4 columns. A closed curve's repeated last point is dropped. Throws Failure{Input, Usage}.
Samples read_samples(const std::string& path, const std::vector<std::string>& columns, bool closed);

// A model file of either format. Throws Failure{Input}.
ifsm::Model load_model(const std::string& path);

// In one step, see write_file. Gives back how many bytes it took.
std::size_t save_model(const ifsm::Model& model, ifsm::Format format, const std::string& path);

// What `--filter` names. A name: joined where it has that form, else square. A path (with a point or a slash in it):
// the filter of that model. 0 chooses the filter's own numbers. Throws Failure{Usage, Input}.
ifsm::Filter start_filter(const std::string& filter, int control_points, int maps);
void require_joined(const ifsm::Filter& filter, const std::string& name);

// How far two rows of points of the same length are apart, in their units.
struct Distance {
  double rms = 0;
  double max = 0;
};
Distance distance(const std::vector<double>& a, const std::vector<double>& b, int dimension);

// "x", "y", "z", "w": the columns of points that are written.
std::vector<std::string> coordinate_names(int dimension);

}  // namespace cli
