// Pictures of systems: small ones, of few points.
#include "script.h"

namespace conformance {
namespace {

// Arguments with some of them replaced; their order stays.
Json with(Json arguments, const Json& instead) {
  for (const auto& [name, value] : instead.items()) arguments.at(name) = value;
  return arguments;
}

Json window() {
  return {{"system", handle("gasket")}, {"width", 6},           {"height", 5},        {"threads", 1},
          {"left", real(-.25)},         {"bottom", real(-.25)}, {"right", real(1.1)}, {"top", real(1.2)}};
}

// All four sides 0: around the attractor.
const Json around = {{"left", "0x0p+0"}, {"bottom", "0x0p+0"}, {"right", "0x0p+0"}, {"top", "0x0p+0"}};

Json watched(Json arguments, const Json& last) {
  arguments["cancel"] = nullptr;
  arguments["progress"] = nullptr;
  for (const auto& [name, value] : last.items()) arguments[name] = value;
  return arguments;
}

// What is wrong with each picture's window and watch.
void refuse_pictures(Script& script, const std::string& name, const Json& draw) {
  script.wrongs(name, draw, {"stops"});
  script.wrong(name, draw, {{"right", real(-.25)}});
  script.wrong(name, draw, {{"top", real(-3)}});
  script.wrong(name, draw, {{"left", real(1e17)}, {"right", real(1e17 + 32)}});
  for (const char* system : {"growing", "undecided"}) script.wrong(name, draw, {{"system", handle(system)}});
  script.wrong(name, draw, {{"cancel", handle("cancelled")}});
  script.wrong(name, draw, {{"progress", {{"callback", "stop"}}}});
}

void add_histograms(Script& script) {
  Json draw = window();
  draw["seed"] = "18446744073709551615";
  draw["points"] = 2000;
  draw = watched(draw, {{"counts", output("uint32")}});
  script.right("ifsm_system_histogram", draw);
  script.right("ifsm_system_histogram", with(draw, around));
  script.right("ifsm_system_histogram", with(draw, {{"points", 0}, {"height", 0}, {"seed", 7}}));
  script.right("ifsm_system_histogram", with(draw, {{"system", handle("fern")}, {"top", real(3)}, {"threads", 2}}));
  script.right("ifsm_system_histogram", with(draw, {{"left", real(9)}, {"right", real(10)}}));  // misses it
  script.right("ifsm_system_histogram",
               with(draw, {{"cancel", handle("cancel")}, {"progress", {{"callback", "continue"}}}}));
  refuse_pictures(script, "ifsm_system_histogram", draw);
  script.wrong("ifsm_system_histogram", draw, {{"system", handle("tetrahedron")}});
}

void add_sets_and_distances(Script& script) {
  struct Drawing {
    const char *function, *array, *type;
  };
  for (const Drawing& drawing :
       {Drawing{"ifsm_system_set", "pixels", "uint8"}, Drawing{"ifsm_system_distances", "distances", "double"}}) {
    Json draw = window();
    draw["tolerance"] = real(0);
    draw = watched(draw, {{drawing.array, output(drawing.type)}});
    script.right(drawing.function, draw);
    script.right(drawing.function, with(draw, around));
    script.right(drawing.function, with(draw, {{"tolerance", real(1)}, {"height", 0}, {"threads", 2}}));
    script.right(drawing.function, with(draw, {{"system", handle("fern")}, {"left", real(5)}, {"right", real(7)}}));
    script.right(drawing.function,
                 with(draw, {{"cancel", handle("cancel")}, {"progress", {{"callback", "continue"}}}}));
    refuse_pictures(script, drawing.function, draw);
    for (const double tolerance : {-1.0, 1.5, 1e-15})
      script.wrong(drawing.function, draw, {{"tolerance", real(tolerance)}});
    script.wrong(drawing.function, draw, {{"system", handle("tetrahedron")}});
  }
}

void add_renderings(Script& script) {
  Json draw = window();
  draw.update({{"seed", 3},
               {"points", 500},
               {"tolerance", real(0)},
               {"colour", 0},
               {"palette", 0},
               {"stops", {{"bytes", ""}}},
               {"symbols", 0},
               {"oversample", 1},
               {"background", 0},
               {"azimuth", real(0)},
               {"elevation", real(0)},
               {"field", real(0)}});
  draw = watched(draw, {{"rgba", output("uint8")}});
  for (int colour = 0; colour <= 4; ++colour) {
    script.right("ifsm_system_render", with(draw, {{"colour", colour}, {"palette", colour}}));
    script.right("ifsm_system_render", with(draw, {{"colour", colour}, {"oversample", 0}, {"background", 4278190335}}));
  }
  script.right("ifsm_system_render",
               with(draw, {{"colour", 2}, {"symbols", 2}, {"stops", {{"bytes", "ffffff000000"}}}}));
  script.right("ifsm_system_render", with(with(draw, around), {{"points", 0}, {"height", 0}}));
  const Json space = with(with(draw, around), {{"system", handle("tetrahedron")}});
  for (int colour = 0; colour <= 2; ++colour) script.right("ifsm_system_render", with(space, {{"colour", colour}}));
  script.right("ifsm_system_render", with(draw, {{"left", real(9)}, {"right", real(10)}}));
  script.right("ifsm_system_render",
               with(draw, {{"cancel", handle("cancel")}, {"progress", {{"callback", "continue"}}}}));

  refuse_pictures(script, "ifsm_system_render", draw);
  script.wrong("ifsm_system_render", draw, {{"stops", {{"bytes", "ffff"}}}});
  script.wrong("ifsm_system_render", draw, {{"stops", {{"bytes", std::string(std::size_t{6} * 257, '0')}}}});
  script.wrong("ifsm_system_render", draw, {{"width", 32768}, {"oversample", 2}});
  for (const double field : {-1.0, 3.5}) script.wrong("ifsm_system_render", draw, {{"field", real(field)}});
  for (const double tolerance : {-1.0, 1.5}) script.wrong("ifsm_system_render", draw, {{"tolerance", real(tolerance)}});
  for (const int colour : {3, 4}) script.wrong("ifsm_system_render", space, {{"colour", colour}});

  const Json tone = {{"counts", {{"uint32", {0, 1, 7, 4294967295}}}},
                     {"palette", 3},
                     {"stops", {{"bytes", ""}}},
                     {"background", 0},
                     {"rgba", output("uint8")}};
  script.right("ifsm_tone_map", tone);
  script.right("ifsm_tone_map", with(tone, {{"background", 4294967295}}));
  script.right("ifsm_tone_map", with(tone, {{"stops", {{"bytes", "204080"}}}, {"background", 1}}));
  script.right("ifsm_tone_map", with(tone, {{"counts", {{"uint32", Json::array()}}}}));
  script.wrongs("ifsm_tone_map", tone, {"stops"});
  script.wrong("ifsm_tone_map", tone, {{"stops", {{"bytes", "2040"}}}});
}

void add_samples(Script& script) {
  Json sample = {{"system", handle("gasket")}, {"threads", 1}, {"seed", 5}, {"point_count", 9}};
  const Json addresses = [&] {
    Json all = watched(sample, Json::object());
    all["length"] = 4;
    all["symbols"] = output("int32");
    return all;
  }();
  sample = watched(sample, {{"points", output("double")}});
  for (const char* system : {"gasket", "fern", "tetrahedron", "solid"}) {
    script.right("ifsm_system_sample", with(sample, {{"system", handle(system)}}));
    script.right("ifsm_system_sample_addresses", with(addresses, {{"system", handle(system)}}));
  }
  for (const auto& [name, arguments] :
       {std::pair<std::string, Json>{"ifsm_system_sample", sample}, {"ifsm_system_sample_addresses", addresses}}) {
    script.right(name, with(arguments, {{"threads", 2}, {"point_count", 3}, {"seed", "18446744073709551615"}}));
    script.right(name, with(arguments, {{"cancel", handle("cancel")}, {"progress", {{"callback", "continue"}}}}));
    script.wrongs(name, arguments);
    for (const char* system : {"growing", "undecided"}) script.wrong(name, arguments, {{"system", handle(system)}});
    script.wrong(name, arguments, {{"cancel", handle("cancelled")}});
    script.wrong(name, arguments, {{"progress", {{"callback", "stop"}}}});
  }
}

}  // namespace

void add_pictures(Script& script) {
  add_histograms(script);
  add_sets_and_distances(script);
  add_renderings(script);
  add_samples(script);
}

}  // namespace conformance
