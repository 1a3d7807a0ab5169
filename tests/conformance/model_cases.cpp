// Models: made, told, changed, kept, saved.
#include "script.h"

namespace conformance {
namespace {

Json of(const Json& model) { return {{"model", model}}; }

// Arguments in C's order: `first`, then `rest`.
Json after(Json first, const Json& rest) {
  for (const auto& [name, value] : rest.items()) first[name] = value;
  return first;
}

void add_making(Script& script) {
  const Json create = {{"filter", handle("filter")}, {"curve", curve(walk())}, {"levels", 0}};
  script.right("ifsm_model_create", create, "model");
  script.right("ifsm_model_create", after(create, {{"levels", 4}}), "deeper");
  std::vector<double> ring = walk();
  ring.resize(ring.size() - 2);
  script.right("ifsm_model_create", after(create, {{"curve", curve(ring, 2, true)}}), "ring");
  script.right("ifsm_model_create", after(create, {{"curve", curve({1, 4, 2, 8, 5, 7, 1, 4, 2}, 1)}}), "graph");
  script.right("ifsm_model_create", after(create, {{"filter", handle("halves")}}), "square model");
  script.right("ifsm_model_create", after(create, {{"curve", curve({0, 0, 0, 1, 2, 3, 3, 1, 2, 2, 2, 1}, 3)}}),
               "space");
  script.wrongs("ifsm_model_create", create);
  script.wrong("ifsm_model_create", create, {{"levels", 2}});  // too few places
  script.wrong("ifsm_model_create", create, {{"levels", std::numeric_limits<std::int32_t>::max()}});

  const Json polygon = {{"filter", handle("filter")}, {"polygon", curve({0, 0, 1, 2, 3, 1})}, {"levels", 2}};
  script.right("ifsm_model_from_polygon", polygon, "from polygon");
  script.right("ifsm_model_samples", after(of(handle("from polygon")), {{"points", output("double")}}));
  script.wrongs("ifsm_model_from_polygon", polygon);
  script.wrong("ifsm_model_from_polygon", polygon, {{"polygon", curve({0, 0, 1, 2})}});
  script.wrong("ifsm_model_from_polygon", polygon, {{"polygon", curve({0, 0, 1, 2, 3, 1}, 2, true)}});
}

void add_telling(Script& script) {
  for (const char* name : {"model", "deeper", "ring", "graph", "square model", "space"}) {
    const Json model = of(handle(name));
    script.right("ifsm_model_describe", model);
    script.right("ifsm_model_samples", after(model, {{"points", output("double")}}));
    script.right("ifsm_model_parameters", after(model, {{"parameters", output("double")}}));
    script.right("ifsm_model_control_points", after(model, {{"points", output("double")}}));
    script.right("ifsm_model_points", after(model, {{"level", 1}, {"points", output("double")}}));
    script.right("ifsm_model_significance", after(model, {{"level", 0}, {"values", output("double")}}));
    script.right("ifsm_model_evaluate",
                 after(model, {{"curve", 0}, {"parameters", reals({0, 0.3, 0.5, 1})}, {"points", output("double")}}));
  }
  const Json model = of(handle("model"));
  for (const int level : {0, 1, 2})
    for (const int frame : {0, 1})
      script.right("ifsm_model_details",
                   after(model, {{"level", level}, {"frame", frame}, {"vectors", output("double")}}));
  const Json limit = {{"curve", 1}, {"parameters", reals({0.125, 0.7})}, {"points", output("double")}};
  script.right("ifsm_model_evaluate", after(model, limit));
  script.right(
      "ifsm_model_evaluate",
      after(of(handle("ring")), {{"curve", 0}, {"parameters", reals({-0.25, 7.75})}, {"points", output("double")}}));
  script.right("ifsm_model_evaluate",
               after(model, {{"curve", 0}, {"parameters", Json::array()}, {"points", output("double")}}));
  script.right("ifsm_model_filter", model, "filter again");
  script.right("ifsm_filter_matrix", {{"filter", handle("filter again")}, {"matrix", output("double")}});

  script.wrongs("ifsm_model_describe", model);
  script.wrongs("ifsm_model_filter", model);
  script.wrongs("ifsm_model_samples", after(model, {{"points", output("double")}}));
  script.wrongs("ifsm_model_parameters", after(model, {{"parameters", output("double")}}));
  script.wrongs("ifsm_model_control_points", after(model, {{"points", output("double")}}));
  script.wrongs("ifsm_model_points", after(model, {{"level", 1}, {"points", output("double")}}));
  script.wrongs("ifsm_model_significance", after(model, {{"level", 1}, {"values", output("double")}}));
  script.wrongs("ifsm_model_details", after(model, {{"level", 1}, {"frame", 1}, {"vectors", output("double")}}));
  script.wrongs("ifsm_model_evaluate",
                after(model, {{"curve", 0}, {"parameters", reals({0, 0.5, 1})}, {"points", output("double")}}));
}

void add_addresses(Script& script) {
  const Json address = {
      {"model", handle("model")}, {"parameter", real(0.3)}, {"length", 8}, {"symbols", output("int32")}};
  script.right("ifsm_model_address", address);
  script.right("ifsm_model_address", after(address, {{"parameter", real(1)}}));
  script.wrongs("ifsm_model_address", address);
  for (const double outside : {-0.5, 1.5}) script.wrong("ifsm_model_address", address, {{"parameter", real(outside)}});
  const Json interval = {{"model", handle("model")}, {"symbols", {{"int32", {0, 1, 1}}}}};
  script.right("ifsm_model_interval", interval);
  script.right("ifsm_model_interval", after(interval, {{"symbols", {{"int32", Json::array()}}}}));
  script.wrongs("ifsm_model_interval", interval);
}

void add_changing(Script& script) {
  const Json points = {{"model", handle("model")}, {"frame", 0}, {"points", reals({0, 0, 4, 9, 7, 1})}};
  for (const int frame : {0, 1}) {
    script.right("ifsm_model_with_control_points", after(points, {{"frame", frame}}), "moved");
    script.right("ifsm_model_samples", {{"model", handle("moved")}, {"points", output("double")}});
  }
  script.wrongs("ifsm_model_with_control_points", points);
  const Json details = {
      {"model", handle("model")}, {"level", 1}, {"frame", 0}, {"vectors", reals({1, 2, 3, 4, 5, 6, 7, 8})}};
  for (const int frame : {0, 1}) {
    script.right("ifsm_model_with_details", after(details, {{"frame", frame}}), "detailed");
    script.right("ifsm_model_samples", {{"model", handle("detailed")}, {"points", output("double")}});
  }
  script.wrongs("ifsm_model_with_details", details);
  const Json filter = {{"model", handle("model")}, {"filter", handle("from maps")}};
  script.right("ifsm_model_with_filter", filter, "refiltered");
  script.right("ifsm_model_samples", {{"model", handle("refiltered")}, {"points", output("double")}});
  script.wrongs("ifsm_model_with_filter", filter);
  script.wrong("ifsm_model_with_filter", filter, {{"filter", handle("coast")}});
}

void add_keeping(Script& script) {
  const Json keep = {{"model", handle("model")}, {"rule", 2},          {"kept_count", 5},
                     {"threshold", real(0)},     {"resolve", 0},       {"distance", 0},
                     {"cancel", nullptr},        {"progress", nullptr}};
  const Json within = {{"rule", 4}, {"kept_count", 0}, {"threshold", real(1.5)}};
  for (const Json& by : {Json{{"rule", 1}, {"kept_count", 2}}, Json{{"rule", 2}}, Json{{"resolve", 1}},
                         Json{{"resolve", 2}, {"cancel", handle("cancel")}, {"progress", {{"callback", "continue"}}}},
                         Json{{"rule", 3}, {"kept_count", 0}, {"threshold", real(2)}}, within}) {
    script.right("ifsm_model_keep", after(keep, by), "sketch");
    script.right("ifsm_model_describe", of(handle("sketch")));
    script.right("ifsm_model_samples", after(of(handle("sketch")), {{"points", output("double")}}));
  }
  script.wrongs("ifsm_model_keep", keep, {"threshold"});
  for (const char* bound : {"nan", "inf", "-inf"})  // other rules do not look at it
    script.wrong("ifsm_model_keep", keep, {{"rule", 3}, {"threshold", bound}});
  script.wrong("ifsm_model_keep", after(keep, within), {{"threshold", real(0)}});
  script.wrong("ifsm_model_keep", after(keep, within), {{"cancel", handle("cancelled")}});
  script.wrong("ifsm_model_keep", after(keep, within), {{"resolve", 2}, {"progress", {{"callback", "stop"}}}});
}

void add_files(Script& script) {
  for (const int format : {0, 1}) {
    const Json save = {{"model", handle("model")}, {"format", format}, {"bytes", output("uint8")}};
    const Json bytes = script.right("ifsm_model_save", save).at("bytes");
    script.right("ifsm_model_load", {{"bytes", bytes}}, "loaded");
    script.right("ifsm_model_describe", of(handle("loaded")));
    script.right("ifsm_model_samples", after(of(handle("loaded")), {{"points", output("double")}}));
    if (format == 0) script.wrongs("ifsm_model_save", save);
    if (format == 1) script.wrongs("ifsm_model_load", {{"bytes", bytes}});
  }
}

}  // namespace

void add_models(Script& script) {
  script.let("L", 3);  // of "model"
  script.let("L-1", 2);
  add_making(script);
  add_telling(script);
  add_addresses(script);
  add_changing(script);
  add_keeping(script);
  add_files(script);
  // What a model is made of lives on with it.
  script.right("ifsm_filter_named", {{"name", text("casteljau")}, {"topology", 0}, {"control_points", 3}, {"maps", 2}},
               "short-lived");
  script.right("ifsm_model_from_polygon",
               {{"filter", handle("short-lived")}, {"polygon", curve({0, 0, 1, 2, 3, 1})}, {"levels", 1}}, "heir");
  script.release("short-lived");
  script.right("ifsm_model_samples", after(of(handle("heir")), {{"points", output("double")}}));
}

}  // namespace conformance
