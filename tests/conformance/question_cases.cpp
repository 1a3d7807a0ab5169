// What people ask of a curve.
#include "script.h"

namespace conformance {
namespace {

void add_lengths(Script& script) {
  const Json length = {{"model", handle("model")}, {"from", real(0.25)}, {"to", real(1)}};
  script.right("ifsm_model_length", length);
  script.right("ifsm_model_length", {{"model", handle("ring")}, {"from", real(2)}, {"to", real(-0.5)}});
  script.wrongs("ifsm_model_length", length);
  script.wrong("ifsm_model_length", length, {{"to", real(1.5)}});
  script.wrong("ifsm_model_length", length, {{"from", real(-0.5)}});

  const Json spaced = {
      {"model", handle("model")}, {"points", 5}, {"spacing", real(0)}, {"parameters", output("double")}};
  script.right("ifsm_model_spaced", spaced);
  script.right("ifsm_model_spaced",
               {{"model", handle("ring")}, {"points", 0}, {"spacing", real(8)}, {"parameters", output("double")}});
  script.wrongs("ifsm_model_spaced", spaced);
  script.wrong("ifsm_model_spaced", spaced, {{"points", 0}});
  script.wrong("ifsm_model_spaced", spaced, {{"spacing", real(1)}});
  script.wrong("ifsm_model_spaced", spaced, {{"points", 0}, {"spacing", real(-1)}});
}

void add_distances(Script& script) {
  const Json nearest = {
      {"model", handle("model")}, {"queries", reals({0, 1, 4.5, 2, 20, -3})}, {"rows", output("double")}};
  script.right("ifsm_model_nearest", nearest);
  script.wrongs("ifsm_model_nearest", nearest);
  const Json distance = {{"model", handle("model")}, {"other", handle("sketch")}};
  script.right("ifsm_model_distance", distance);
  script.right("ifsm_model_distance", {{"model", handle("model")}, {"other", handle("model")}});
  script.wrongs("ifsm_model_distance", distance);
  script.wrong("ifsm_model_distance", distance, {{"other", handle("graph")}});
  script.wrong("ifsm_model_distance", distance, {{"other", handle("ring")}});
}

void add_shapes(Script& script) {
  const Json curvature = {{"model", handle("model")},
                          {"scale", real(3)},
                          {"parameters", reals({0, 0.25, 0.5, 1})},
                          {"curvatures", output("double")}};
  script.right("ifsm_model_curvature", curvature);
  script.wrongs("ifsm_model_curvature", curvature);
  for (const double scale : {-1.0, 0.0, 1000.0})
    script.wrong("ifsm_model_curvature", curvature, {{"scale", real(scale)}});
  script.wrong("ifsm_model_curvature", curvature, {{"model", handle("graph")}});

  script.right("ifsm_model_crossings", {{"model", handle("model")}, {"rows", output("double")}});
  script.right("ifsm_model_crossings", {{"model", handle("from polygon")}, {"rows", output("double")}});  // none
  script.wrongs("ifsm_model_crossings", {{"model", handle("model")}, {"rows", output("double")}});
  script.wrong("ifsm_model_crossings", {{"model", handle("space")}, {"rows", output("double")}});
}

void add_roughness(Script& script) {
  const Json dimension = {{"model", handle("model")}, {"method", 0},        {"scales", 5},
                          {"smallest", real(0)},      {"largest", real(0)}, {"rows", output("double")}};
  for (const int method : {0, 1}) {
    Json asked = dimension;
    asked.at("method") = method;
    script.right("ifsm_model_dimension", asked);
  }
  script.wrongs("ifsm_model_dimension", dimension);
  script.wrong("ifsm_model_dimension", dimension, {{"scales", 2}});
  script.wrong("ifsm_model_dimension", dimension, {{"smallest", real(4)}, {"largest", real(2)}});
  script.wrong("ifsm_model_dimension", dimension, {{"smallest", real(-1)}});

  script.right("ifsm_model_spectrum", {{"model", handle("model")}, {"rows", output("double")}});
  script.wrongs("ifsm_model_spectrum", {{"model", handle("model")}, {"rows", output("double")}});

  const Json refine = {{"model", handle("model")},
                       {"levels", 1},
                       {"seed", "18446744073709551615"},
                       {"learned", 0},
                       {"roughness", real(0.5)}};
  script.right("ifsm_model_refine", refine, "refined");
  script.right("ifsm_model_samples", {{"model", handle("refined")}, {"points", output("double")}});
  script.wrongs("ifsm_model_refine", refine);
  script.wrong("ifsm_model_refine", refine, {{"model", handle("square model")}});
}

}  // namespace

void add_questions(Script& script) {
  add_lengths(script);
  add_distances(script);
  add_shapes(script);
  add_roughness(script);
}

}  // namespace conformance
