#include "curve/named.h"

#include <vector>

#include "curve/coast.h"
#include "curve/complement.h"

namespace ifsm::core {
namespace {

// T_0 | … | T_N-1 side by side, row by row, times a common denominator: math.md section 5, exact examples.
struct Known {
  std::string_view name;
  int control_points;
  int maps;
  int stride;
  bool joined_too;
  double denominator;
  std::vector<double> entries;
};

const std::vector<Known>& known_filters() {
  static const std::vector<Known> known = {
      {"haar", 1, 2, 1, false, 1, {1, 1}},
      {"bspline", 4, 2, 1, false, 8, {4, 1, 0, 0, 1, 0, 0, 0,  //
                                      4, 6, 4, 1, 6, 4, 1, 0,  //
                                      0, 1, 4, 6, 1, 4, 6, 4,  //
                                      0, 0, 0, 1, 0, 0, 1, 4}},
      {"four-point", 6, 2, 1, false, 16, {0,  -1, 0,  0,  0,  0,  -1, 0,  0,  0,  0,  0,   //
                                          16, 9,  0,  -1, 0,  0,  9,  0,  -1, 0,  0,  0,   //
                                          0,  9,  16, 9,  0,  -1, 9,  16, 9,  0,  -1, 0,   //
                                          0,  -1, 0,  9,  16, 9,  -1, 0,  9,  16, 9,  0,   //
                                          0,  0,  0,  -1, 0,  9,  0,  0,  -1, 0,  9,  16,  //
                                          0,  0,  0,  0,  0,  -1, 0,  0,  0,  0,  -1, 0}},
      {"koch", 3, 4, 2, true, 6, {6, 4, 4, 4, 2, 0, 0, 0, 2, 2, 0, 0,  //
                                  0, 2, 0, 0, 4, 6, 6, 4, 0, 0, 2, 0,  //
                                  0, 0, 2, 2, 0, 0, 0, 2, 4, 4, 4, 6}},
      {"takagi",
       3,
       2,
       2,
       true,
       4,
       {4, 1, 0, 0, -1, 0,  //
        0, 4, 4, 4, 4, 0,   //
        0, -1, 0, 0, 1, 4}},
  };
  return known;
}

// One column of T: the blossom of the Bernstein basis, `late` arguments (i+1)/N and the others i/N.
Eigen::VectorXd blossom(int n, int maps, int piece, int late) {
  Eigen::MatrixXd triangle = Eigen::MatrixXd::Identity(n, n);
  for (int step = 0; step < n - 1; ++step) {
    const double t = static_cast<double>(piece + (step < late ? 1 : 0)) / maps;
    for (int c = 0; c < n - 1 - step; ++c) triangle.col(c) = (1 - t) * triangle.col(c) + t * triangle.col(c + 1);
  }
  return triangle.col(0);
}

// Side by side to joined: the shared columns once.
RowMatrix joined_columns(const Shape& shape, const RowMatrix& side_by_side) {
  const int n = shape.control_points();
  RowMatrix joined(n, shape.rows());
  for (int i = 0; i < shape.maps(); ++i)
    joined.middleCols(first_column(shape, i), n) = side_by_side.middleCols(i * n, n);
  return joined;
}

FilterPtr from_known(const Known& known, Topology topology, int control_points, int maps) {
  const bool fits = (control_points == 0 || control_points == known.control_points) &&
                    (maps == 0 || maps == known.maps) && (topology == Topology::square || known.joined_too);
  if (!fits) {
    const bool other_points = control_points != 0 && control_points != known.control_points;
    const bool other_maps = maps != 0 && maps != known.maps;
    throw Error(Status::range,
                other_points ? "control_points"
                : other_maps ? "maps"
                             : "topology",
                "The filter \"" + std::string(known.name) + "\" has " + std::to_string(known.control_points) +
                    (known.control_points == 1 ? " control point and " : " control points and ") +
                    std::to_string(known.maps) + " maps and is " +
                    (known.joined_too ? "joined or square" : "square only") +
                    (other_points || other_maps ? "; give 0 for its own numbers." : "; ask for the square topology."));
  }
  const Shape shape(topology, known.control_points, known.maps, known.stride);
  RowMatrix t =
      Eigen::Map<const RowMatrix>(known.entries.data(), known.control_points, known.control_points * known.maps) /
      known.denominator;
  if (shape.joined()) t = joined_columns(shape, RowMatrix(t));
  return std::make_shared<Filter>(shape, with_complement(shape, t));
}

const Trained* coast_of(int control_points, int maps) {
  for (const Trained& one : coast_filters())
    if ((control_points == 0 || control_points == one.control_points) && (maps == 0 || maps == one.maps)) return &one;
  return nullptr;
}

FilterPtr from_coast(Topology topology, int control_points, int maps) {
  const Trained* trained = coast_of(control_points, maps);
  if (topology == Topology::joined && trained != nullptr) {
    const Shape shape(topology, trained->control_points, trained->maps);
    const Eigen::Map<const Eigen::Matrix<std::int32_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> entries(
        trained->entries.data(), shape.rows(), shape.rows());
    return std::make_shared<Filter>(shape, entries.cast<double>() * Trained::unit);
  }
  std::string shapes;
  for (const Trained& one : coast_filters())
    shapes += (shapes.empty() ? "" : "; ") + std::to_string(one.control_points) + " control points and " +
              std::to_string(one.maps) + " maps";
  throw Error(Status::range, topology != Topology::joined ? "topology" : "control_points",
              "The filter \"coast\" is joined and trained for " + shapes + "; give 0 for its own numbers.");
}

}  // namespace

FilterPtr default_filter(int control_points, int maps) {
  return named_filter(coast_of(control_points, maps) != nullptr ? "coast" : "casteljau", Topology::joined,
                      control_points, maps);
}

RowMatrix de_casteljau_maps(const Shape& shape) {
  const int n = shape.control_points();
  RowMatrix t(n, shape.rows());
  for (int i = 0; i < shape.maps(); ++i)
    for (int c = 0; c < n; ++c) t.col(first_column(shape, i) + c) = blossom(n, shape.maps(), i, c);
  return t;
}

FilterPtr named_filter(std::string_view name, Topology topology, int control_points, int maps) {
  if (name == "casteljau") {
    const Shape shape(topology, control_points == 0 ? 5 : control_points, maps == 0 ? 2 : maps);
    return std::make_shared<Filter>(shape, with_complement(shape, de_casteljau_maps(shape)));
  }
  if (name == "coast") return from_coast(topology, control_points, maps);
  std::string names = "casteljau, coast";
  for (const Known& known : known_filters()) {
    if (known.name == name) return from_known(known, topology, control_points, maps);
    names += ", " + std::string(known.name);
  }
  throw Error(Status::range, "name",
              "There is no filter named \"" + std::string(name.substr(0, 64)) + "\"; the names are " + names + ".");
}

}  // namespace ifsm::core
