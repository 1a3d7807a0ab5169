// Filters: by name, from matrices, and what they tell.
#include "script.h"

namespace conformance {
namespace {

Json named(const char* name, int topology, int control_points, int maps) {
  return {{"name", text(name)}, {"topology", topology}, {"control_points", control_points}, {"maps", maps}};
}

void add_names(Script& script) {
  script.right("ifsm_filter_named", named("casteljau", 0, 3, 2), "filter");
  script.right("ifsm_filter_named", named("coast", 0, 0, 0), "coast");
  script.right("ifsm_filter_named", named("casteljau", 1, 2, 3), "square");
  for (const char* name : {"haar", "bspline", "four-point", "koch", "takagi"}) {
    script.right("ifsm_filter_named", named(name, 1, 0, 0), name);
    script.right("ifsm_filter_describe", {{"filter", handle(name)}});
  }
  for (const char* name : {"filter", "coast", "square"}) {
    script.right("ifsm_filter_describe", {{"filter", handle(name)}});
    script.right("ifsm_filter_matrix", {{"filter", handle(name)}, {"matrix", output("double")}});
  }
  script.wrongs("ifsm_filter_named", named("casteljau", 0, 3, 2));
  script.wrong("ifsm_filter_named", named("coast", 1, 0, 0));
  script.wrong("ifsm_filter_named", named("coast", 0, 4, 0));
  script.wrong("ifsm_filter_named", named("haar", 0, 0, 0));
  script.wrong("ifsm_filter_named", named("casteljau", 0, 1, 2));
  script.wrong("ifsm_filter_named", named("casteljau", 0, 3, 1));
  script.wrongs("ifsm_filter_describe", {{"filter", handle("filter")}});
  script.wrongs("ifsm_filter_matrix", {{"filter", handle("filter")}, {"matrix", output("double")}});
}

Json shaped(int topology, int control_points, int maps, int stride, const Json& matrix) {
  return {{"topology", topology},
          {"control_points", control_points},
          {"maps", maps},
          {"stride", stride},
          {"matrix", matrix}};
}

void add_matrices(Script& script, const std::string& from, std::size_t count, const std::string& as) {
  const Json all =
      script.right("ifsm_filter_matrix", {{"filter", handle("filter")}, {"matrix", output("double")}}).at("matrix");
  const Json matrix(Json::array_t(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count)));
  script.right(from, shaped(0, 3, 2, 0, matrix), as);
  script.right("ifsm_filter_matrix", {{"filter", handle(as)}, {"matrix", output("double")}});
  script.wrongs(from, shaped(0, 3, 2, 0, matrix));
  script.wrong(from, shaped(0, 4, 2, 0, matrix));
  script.wrong(from, shaped(0, 3, 2, 1, matrix));
  script.wrong(from, shaped(0, 3, 2, 0, Json::array()));
  Json unequal = matrix;
  unequal.at(1) = real(0.75);
  script.wrong(from, shaped(0, 3, 2, 0, unequal));  // a column whose sum is not 1
}

}  // namespace

void add_filters(Script& script) {
  add_names(script);
  add_matrices(script, "ifsm_filter_from_matrix", 25, "from matrix");
  add_matrices(script, "ifsm_filter_from_maps", 15, "from maps");
  const std::vector<double> halves = {1, 0.5, 0.5, 0, 0, 0.5, 0.5, 1};  // n = 2: a segment's halves
  script.right("ifsm_filter_from_maps", shaped(1, 2, 2, 1, reals(halves)), "halves");
  script.right("ifsm_filter_matrix", {{"filter", handle("halves")}, {"matrix", output("double")}});
  script.wrong("ifsm_filter_from_matrix",
               shaped(1, 2, 2, 1, reals({1, .5, .5, 0, 0, .5, .5, 1, 0, 0, 0, 0, 0, 0, 0, 0})));
}

}  // namespace conformance
