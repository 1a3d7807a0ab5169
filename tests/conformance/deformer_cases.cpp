// Deformers: edits, states, time, and what they tell.
#include "script.h"

namespace conformance {
namespace {

const char* const made = "deformer";

Json on(const Json& rest = {}, const std::string& deformer = made) {
  Json arguments = {{"deformer", handle(deformer)}};
  if (!rest.is_null()) arguments.update(rest);
  return arguments;
}

Json move(int level, const std::vector<std::int64_t>& handles, const std::vector<double>& vectors,
          const Json& how = {}) {
  Json arguments = on({{"level", level},
                       {"handles", wide(handles)},
                       {"vectors", reals(vectors)},
                       {"places", 0},
                       {"reach", 0},
                       {"falloff", 0},
                       {"ruler", 0},
                       {"radius", real(0)}});
  if (!how.is_null()) arguments.update(how);
  return arguments;
}

Json restyle(int first, int last, double scale) {
  return on({{"first", first}, {"last", last}, {"scale", real(scale)}, {"fade", 0}, {"mirror", 0}, {"angle", real(0)}});
}

Json texture(int first, int last) {
  return on({{"first", first},
             {"last", last},
             {"fade", 0},
             {"from", nullptr},
             {"roughness", real(0)},
             {"size", real(0)},
             {"seed", 7}});
}

Json drag(int level, int lead) {
  return on({{"level", level}, {"lead", lead}, {"parameters", reals({0.25, 0.75})}, {"places", reals({3, 5, 12, -2})}});
}

void tell(Script& script, const std::string& deformer = made) {
  script.right("ifsm_deformer_describe", on({}, deformer));
  script.right("ifsm_deformer_changed", on({{"level", 3}}, deformer));
  script.right("ifsm_deformer_samples", on({{"points", output("double")}}, deformer));
}

void add_making(Script& script) {
  const Json create = {{"model", handle("model")}, {"turning", 0}, {"follow", 0}};
  script.right("ifsm_deformer_create", create, made);
  script.right("ifsm_deformer_create", {{"model", handle("model")}, {"turning", 2}, {"follow", 1}}, "linear");
  script.wrongs("ifsm_deformer_create", create);
  tell(script);
}

void add_edits(Script& script) {
  script.right("ifsm_deformer_time", on({{"begin", real(0)}, {"end", real(2)}, {"easing", 1}}));
  script.right("ifsm_deformer_move", move(1, {1, 2}, {0.5, 1, -0.25, 2}));
  tell(script);
  script.right("ifsm_deformer_time", on({{"begin", real(1)}, {"end", real(3)}, {"easing", 0}}));
  script.right("ifsm_deformer_move", move(0, {0}, {-2, 4}, {{"places", 1}, {"falloff", 2}, {"radius", real(2)}}));
  tell(script);
  script.right("ifsm_deformer_pin", on({{"level", 1}, {"handles", wide({0})}, {"hold", 1}}));
  script.right("ifsm_deformer_drag", drag(2, 0));
  tell(script);
  script.right("ifsm_deformer_keep_as", on({{"name", text("kept")}}));
  script.right("ifsm_deformer_move", {{"deformer", handle("linear")},
                                      {"level", 0},
                                      {"handles", wide({1})},
                                      {"vectors", reals({3, 3})},
                                      {"places", 0},
                                      {"reach", 0},
                                      {"falloff", 0},
                                      {"ruler", 0},
                                      {"radius", real(0)}});
  tell(script, "linear");

  script.wrongs("ifsm_deformer_move", move(1, {1, 2}, {0.5, 1, -0.25, 2}));
  script.wrong("ifsm_deformer_move", move(1, {1, 1}, {0.5, 1, -0.25, 2}));          // one twice
  script.wrong("ifsm_deformer_move", move(1, {0}, {1, 1}));                         // a pinned one
  script.wrong("ifsm_deformer_move", move(1, {2}, {1, 1}, {{"radius", real(1)}}));  // without a falloff
  script.wrong("ifsm_deformer_move", move(1, {2}, {1, 1}, {{"falloff", 1}}));       // without a radius
  script.wrongs("ifsm_deformer_pin", on({{"level", 1}, {"handles", wide({1, 2})}, {"hold", 1}}));
  script.wrongs("ifsm_deformer_drag", drag(2, 0));
  script.wrong("ifsm_deformer_drag", drag(2, 0), {{"parameters", reals({0.25, 0.25})}});
}

void add_states(Script& script) {
  const std::vector<const char*> back_and_forth = {"ifsm_deformer_undo", "ifsm_deformer_redo"};
  for (const char* step : back_and_forth) {
    script.right(step, on());
    tell(script);
    script.wrongs(step, on());
  }
  script.wrong("ifsm_deformer_redo", on());  // nothing is left to redo
  script.right("ifsm_deformer_undo", on());
  script.right("ifsm_deformer_go_to", on({{"name", text("kept")}}));
  tell(script);
  script.wrongs("ifsm_deformer_go_to", on({{"name", text("kept")}}));
  script.wrong("ifsm_deformer_keep_as", on({{"name", text("")}}));
  script.wrong("ifsm_deformer_keep_as", on({{"name", text(std::string(256, 'x'))}}));
  script.wrong("ifsm_deformer_keep_as", {{"deformer", nullptr}, {"name", text("kept")}});
}

void add_time(Script& script) {
  for (const double time : {0.0, 1.5, 3.0}) {
    script.right("ifsm_deformer_at_time", on({{"time", real(time)}}), "frame");
    script.right("ifsm_deformer_samples", on({{"points", output("double")}}, "frame"));
  }
  script.wrongs("ifsm_deformer_at_time", on({{"time", real(0.5)}}));
  const Json time = on({{"begin", real(0)}, {"end", real(2)}, {"easing", 1}});
  script.wrongs("ifsm_deformer_time", time);
  script.wrong("ifsm_deformer_time", time, {{"begin", real(3)}});
}

void add_telling(Script& script) {
  script.let("H-1", 4);
  const Json points = on({{"level", 1}, {"first", 1}, {"number", 2}, {"points", output("double")}});
  script.right("ifsm_deformer_points", points);
  script.wrongs("ifsm_deformer_points", points);
  script.right("ifsm_deformer_evaluate", on({{"parameters", reals({0, 0.3, 1})}, {"points", output("double")}}));
  script.wrongs("ifsm_deformer_evaluate", on({{"parameters", reals({0, 0.3, 1})}, {"points", output("double")}}));
  script.right("ifsm_deformer_crossings", on({{"rows", output("double")}}));
  script.wrongs("ifsm_deformer_crossings", {{"deformer", nullptr}, {"rows", output("double")}}, {"rows"});
  script.wrongs("ifsm_deformer_samples", on({{"points", output("double")}}));
  script.wrongs("ifsm_deformer_changed", on({{"level", 1}}));
  script.wrongs("ifsm_deformer_describe", on());
  script.right("ifsm_deformer_snapshot", on(), "snapshot");
  script.right("ifsm_model_samples", {{"model", handle("snapshot")}, {"points", output("double")}});
  script.wrongs("ifsm_deformer_snapshot", on());
}

void add_files(Script& script) {
  const Json save = on({{"format", 0}, {"bytes", output("uint8")}});
  script.right("ifsm_deformer_save", save);
  script.wrongs("ifsm_deformer_save", save);
  const Json bytes = script.right("ifsm_deformer_save", on({{"format", 1}, {"bytes", output("uint8")}})).at("bytes");
  script.right("ifsm_deformer_create", {{"model", handle("model")}, {"turning", 0}, {"follow", 0}}, "again");
  script.right("ifsm_deformer_replay", on({{"bytes", bytes}}, "again"));
  tell(script, "again");
  script.wrongs("ifsm_deformer_replay", on({{"bytes", bytes}}, "again"));
  script.wrong("ifsm_deformer_replay", on({{"bytes", bytes}}, "linear"));  // of other options
  script.right("ifsm_deformer_create", {{"model", handle("ring")}, {"turning", 0}, {"follow", 0}}, "another");
  script.wrong("ifsm_deformer_replay", on({{"bytes", bytes}}, "another"));  // of another model
}

// Last, since from here on its numbers go through libm.
void add_looks(Script& script) {
  script.wrongs("ifsm_deformer_restyle", restyle(0, 1, 0.5));
  script.wrong("ifsm_deformer_restyle", restyle(2, 1, 0.5));
  script.wrong("ifsm_deformer_restyle", restyle(0, 1, 1e13));
  script.wrongs("ifsm_deformer_texture", texture(0, 1));
  script.wrong("ifsm_deformer_texture", texture(0, 1), {{"roughness", real(9)}});
  script.wrong("ifsm_deformer_texture", texture(0, 1), {{"size", real(-1)}});
  script.wrong("ifsm_deformer_texture", texture(0, 1), {{"from", handle("graph")}});
  Json turned = restyle(1, 2, 0.5);
  turned.update({{"fade", 1}, {"mirror", 1}, {"angle", real(0.5)}});
  script.right("ifsm_deformer_restyle", turned);
  tell(script);
  script.right("ifsm_deformer_texture", texture(1, 2));
  tell(script);
  Json borrowed = texture(2, 2);
  borrowed.at("from") = handle("moved");
  script.right("ifsm_deformer_texture", borrowed);
  tell(script);
}

}  // namespace

void add_deformers(Script& script) {
  script.let("H-1", 4);  // handles of level 1
  add_making(script);
  add_edits(script);
  add_states(script);
  add_time(script);
  add_telling(script);
  add_files(script);
  add_looks(script);
}

}  // namespace conformance
