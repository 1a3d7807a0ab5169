// Systems: made, told, asked, saved.
#include "script.h"

namespace conformance {
namespace {

Json of(const char* system) { return {{"system", handle(system)}}; }

// Arguments in C's order: `first`, then `rest`.
Json after(Json first, const Json& rest) {
  for (const auto& [name, value] : rest.items()) first[name] = value;
  return first;
}

std::vector<double> gasket() { return {.5, 0, 0, 0, .5, 0, .5, 0, .5, 0, .5, 0, .5, 0, 0, 0, .5, .5}; }

void add_making(Script& script) {
  const Json create = {{"dimension", 2}, {"maps", reals(gasket())}, {"probabilities", reals({1, 1, 2})}};
  script.right("ifsm_system_create", create, "weighted");
  script.right("ifsm_system_create", after(create, {{"probabilities", Json::array()}}), "gasket");
  script.right("ifsm_system_create",
               {{"dimension", 3},
                {"maps", reals({.5, 0, 0, 1, 0, .5, 0, 2, 0, 0, .25, 3, .25, 0, 0, 0, 0, .5, 0, 0, 0, 0, .5, 0})},
                {"probabilities", reals({1, 0})}},
               "solid");
  // Neither map grows in itself, the word of both does.
  script.right(
      "ifsm_system_create",
      {{"dimension", 2}, {"maps", reals({0, 2, 0, 0, 0, 0, 0, 0, 0, 2, 0, 1})}, {"probabilities", Json::array()}},
      "growing");
  // Shorter than 1 by less than any word that is tried can tell.
  script.right("ifsm_system_create",
               {{"dimension", 2}, {"maps", reals({1 - 1e-12, 0, 0, 0, .5, 0})}, {"probabilities", Json::array()}},
               "undecided");
  script.wrongs("ifsm_system_create", create);
  script.wrong("ifsm_system_create", create, {{"maps", Json::array()}});
  script.wrong("ifsm_system_create", create, {{"dimension", 3}});
  script.wrong("ifsm_system_create", create, {{"probabilities", reals({1, -1, 1})}});
  script.wrong("ifsm_system_create", create, {{"probabilities", reals({0, 0, 0})}});

  const Json parameters = {{"dimension", 2},
                           {"parameters", reals({.5, .5, .25, .125, 1, 2, -1, .5, -.5, 0, 0, 0})},
                           {"probabilities", reals({1, 3})}};
  script.right("ifsm_system_from_parameters", parameters, "from parameters");
  script.right("ifsm_system_maps", after(of("from parameters"), {{"maps", output("double")}}));
  script.wrongs("ifsm_system_from_parameters", parameters, {"parameters"});
  for (const char* bad : {"nan", "-inf"}) {
    Json given = parameters.at("parameters");
    given.at(7) = bad;
    script.wrong("ifsm_system_from_parameters", parameters, {{"parameters", given}});
  }
  script.wrong("ifsm_system_from_parameters", parameters, {{"parameters", reals({1, 2, 3})}});

  for (const char* name : {"fern", "koch-curve", "tetrahedron", "heighway_dragon"})
    script.right("ifsm_system_named", {{"name", text(name)}}, name);
  script.wrongs("ifsm_system_named", {{"name", text("fern")}});

  ifsm_system_entry entry{};
  entry.struct_size = sizeof entry;
  std::int64_t last = -1;
  while (ifsm_system_catalog(last + 1, &entry) == IFSM_OK) ++last;
  script.let("systems-1", last);
  for (const std::int64_t index : {std::int64_t{0}, last}) script.right("ifsm_system_catalog", {{"index", index}});
  script.wrongs("ifsm_system_catalog", {{"index", 0}});
}

void add_systems_of_models(Script& script) {
  script.right("ifsm_system_from_model", {{"model", handle("from polygon")}}, "of a model");
  script.right("ifsm_system_maps", after(of("of a model"), {{"maps", output("double")}}));
  script.wrongs("ifsm_system_from_model", {{"model", handle("from polygon")}});
  script.wrong("ifsm_system_from_model", {{"model", handle("graph")}});

  const Json back = {{"system", handle("koch-curve")}, {"topology", 0}, {"polygon", nullptr}, {"levels", 2}};
  const Json polygon = curve({0, 0, 1, 0, 0, 1});
  script.right("ifsm_model_from_system", back, "of a system");
  script.right("ifsm_model_control_points", {{"model", handle("of a system")}, {"points", output("double")}});
  const Json square = {{"system", handle("gasket")}, {"topology", 1}, {"polygon", polygon}, {"levels", 2}};
  script.right("ifsm_model_from_system", square, "of the gasket");
  script.right("ifsm_model_samples", {{"model", handle("of the gasket")}, {"points", output("double")}});
  script.wrongs("ifsm_model_from_system", square);
  script.wrong("ifsm_model_from_system", square, {{"topology", 0}});  // no chain
  script.wrong("ifsm_model_from_system", square, {{"polygon", curve({0, 0, 1, 1, 2, 2})}});
  script.wrong("ifsm_model_from_system", square, {{"polygon", curve({0, 0, 1, 0, 0, 1}, 2, true)}});
  script.wrong("ifsm_model_from_system", square, {{"system", handle("growing")}});
  script.wrong("ifsm_model_from_system", square, {{"system", handle("undecided")}});
}

void add_parts(Script& script) {
  struct Part {
    const char *function, *array;
  };
  const std::initializer_list<Part> parts = {{"ifsm_system_maps", "maps"},
                                             {"ifsm_system_parameters", "parameters"},
                                             {"ifsm_system_probabilities", "probabilities"},
                                             {"ifsm_system_fixed_points", "points"}};
  for (const char* name : {"weighted", "gasket", "solid", "growing", "undecided", "fern", "tetrahedron"}) {
    script.right("ifsm_system_describe", of(name));
    for (const Part& part : parts) script.right(part.function, after(of(name), {{part.array, output("double")}}));
    script.right("ifsm_system_witness", after(of(name), {{"symbols", output("int32")}}));
  }
  script.wrongs("ifsm_system_describe", of("gasket"));
  for (const Part& part : parts) script.wrongs(part.function, after(of("gasket"), {{part.array, output("double")}}));
  script.wrongs("ifsm_system_witness", after(of("growing"), {{"symbols", output("int32")}}));
}

void add_addresses(Script& script) {
  const Json word = {{"system", handle("gasket")}, {"symbols", symbols({0, 1, 2})}, {"map", output("double")}};
  script.right("ifsm_system_word", word);
  script.right("ifsm_system_word", after(word, {{"symbols", symbols({})}}));
  script.right("ifsm_system_word", after(word, {{"system", handle("fern")}, {"symbols", symbols({3, 0, 0})}}));
  script.wrongs("ifsm_system_word", word);

  const Json point = {
      {"system", handle("gasket")}, {"symbols", symbols({0, 1, 2})}, {"period", 2}, {"point", output("double")}};
  script.right("ifsm_system_point", point);
  script.right("ifsm_system_point", after(point, {{"system", handle("tetrahedron")}}));
  script.wrongs("ifsm_system_point", point);
  script.wrong("ifsm_system_point", point, {{"symbols", symbols({})}});
  script.wrong("ifsm_system_point", point, {{"system", handle("growing")}, {"symbols", symbols({0, 1, 1})}});
  script.wrong("ifsm_system_point", point, {{"system", handle("solid")}, {"symbols", symbols({0, 0, 1})}});

  const Json addresses = {{"system", handle("gasket")},
                          {"point", reals({.5, 0})},
                          {"length", 3},
                          {"tolerance", real(0)},
                          {"symbols", output("int32")}};
  script.right("ifsm_system_addresses", addresses);
  script.right("ifsm_system_addresses", after(addresses, {{"point", reals({.3, .3})}}));  // none
  script.right("ifsm_system_addresses", after(addresses, {{"length", 1}, {"tolerance", real(.5)}}));
  script.wrongs("ifsm_system_addresses", addresses);
  script.wrong("ifsm_system_addresses", addresses, {{"tolerance", real(-1)}});
  script.wrong("ifsm_system_addresses", addresses, {{"tolerance", real(1e-16)}});
  script.wrong("ifsm_system_addresses", addresses, {{"length", 30}, {"tolerance", real(1)}});
  script.wrong("ifsm_system_addresses", addresses, {{"system", handle("growing")}});
}

void add_places(Script& script) {
  struct Place {
    const char *function, *array;
  };
  for (const Place& place : {Place{"ifsm_system_box", "box"}, Place{"ifsm_system_ball", "ball"}}) {
    const Json ask = {{"system", handle("gasket")}, {"tolerance", real(.001)}, {place.array, output("double")}};
    for (const char* name : {"gasket", "fern", "tetrahedron"})
      script.right(place.function, after(ask, {{"system", handle(name)}}));
    script.right(place.function, after(ask, {{"tolerance", real(0)}}));
    script.wrongs(place.function, ask);
    for (const double tolerance : {-1.0, 1e-16, 100.0})
      script.wrong(place.function, ask, {{"tolerance", real(tolerance)}});
    script.wrong(place.function, ask, {{"system", handle("growing")}});
    script.wrong(place.function, ask, {{"system", handle("undecided")}});
  }
  const Json across = {{"system", handle("gasket")}, {"tolerance", real(.001)}};
  for (const char* name : {"gasket", "fern", "tetrahedron"})
    script.right("ifsm_system_diameter", after(across, {{"system", handle(name)}}));
  script.wrongs("ifsm_system_diameter", across);
  script.wrong("ifsm_system_diameter", across, {{"tolerance", real(-1)}});
  script.wrong("ifsm_system_diameter", across, {{"system", handle("growing")}});
}

void add_numbers(Script& script) {
  const Json moments = {
      {"system", handle("weighted")}, {"degree", 2}, {"about", reals({.25, .5})}, {"moments", output("double")}};
  script.right("ifsm_system_moments", moments);
  script.right("ifsm_system_moments", after(moments, {{"degree", 8}, {"about", Json::array()}}));
  script.right("ifsm_system_moments", after(moments, {{"system", handle("tetrahedron")}, {"about", reals({1, 2, 3})}}));
  script.wrongs("ifsm_system_moments", moments);
  script.wrong("ifsm_system_moments", moments, {{"system", handle("growing")}});

  for (const char* name : {"gasket", "koch-curve", "heighway_dragon"})
    script.right("ifsm_system_similarity_dimension", of(name));
  script.wrongs("ifsm_system_similarity_dimension", of("gasket"));
  script.wrong("ifsm_system_similarity_dimension", of("fern"));
  script.wrong("ifsm_system_similarity_dimension", of("growing"));

  const Json boxes = {{"system", handle("gasket")}, {"finest", 6}, {"rows", output("double")}};
  script.right("ifsm_system_box_dimension", boxes);
  script.right("ifsm_system_box_dimension", after(boxes, {{"system", handle("tetrahedron")}}));
  script.wrongs("ifsm_system_box_dimension", boxes);
  script.wrong("ifsm_system_box_dimension", boxes, {{"finest", 5}});
  script.wrong("ifsm_system_box_dimension", boxes, {{"system", handle("tetrahedron")}, {"finest", 10}});
  script.wrong("ifsm_system_box_dimension", boxes, {{"system", handle("solid")}});  // a point
}

void add_files(Script& script) {
  for (const int format : {0, 1, 2}) {
    const Json name = format == 2 ? text("two words") : Json(nullptr);
    const Json save = {{"system", handle("weighted")}, {"format", format}, {"name", name}, {"bytes", output("uint8")}};
    const Json bytes = script.right("ifsm_system_save", save).at("bytes");
    const Json load = {{"bytes", bytes}, {"name", nullptr}};
    script.right("ifsm_system_load", load, "loaded system");
    script.right("ifsm_system_maps", after(of("loaded system"), {{"maps", output("double")}}));
    script.right("ifsm_system_probabilities", after(of("loaded system"), {{"probabilities", output("double")}}));
    script.right("ifsm_system_file_names", {{"bytes", bytes}, {"names", output("uint8")}});
    script.wrongs("ifsm_system_save", save, {"name"});
    if (format == 0) script.wrongs("ifsm_system_load", load, {"name"});
    if (format != 2) continue;
    script.right("ifsm_system_load", after(load, {{"name", text("two_words")}}), "loaded system");
    script.wrong("ifsm_system_load", load, {{"name", text("three_words")}});
    script.wrongs("ifsm_system_file_names", {{"bytes", bytes}, {"names", output("uint8")}});
  }
  const std::string two = "one { .5 0 0 .5 1 2 1 }\ntwo { .25 0 0 .25 0 0 1 }\n";
  const Json bytes = json_of(std::vector<std::uint8_t>(two.begin(), two.end()));
  script.right("ifsm_system_file_names", {{"bytes", bytes}, {"names", output("uint8")}});
  script.right("ifsm_system_load", {{"bytes", bytes}, {"name", text("two")}}, "loaded system");
  script.right("ifsm_system_maps", after(of("loaded system"), {{"maps", output("double")}}));
  script.wrong("ifsm_system_load", {{"bytes", bytes}, {"name", nullptr}});  // which one?
  const std::string flame = "<flame name=\"f\"><xform weight=\"1\" linear=\"1\" coefs=\".5 0 0 .5 1 0\"/></flame>";
  script.right("ifsm_system_load",
               {{"bytes", json_of(std::vector<std::uint8_t>(flame.begin(), flame.end()))}, {"name", text("f")}},
               "loaded system");
  script.right("ifsm_system_maps", after(of("loaded system"), {{"maps", output("double")}}));
}

}  // namespace

void add_systems(Script& script) {
  add_making(script);
  add_systems_of_models(script);
  add_parts(script);
  add_addresses(script);
  add_places(script);
  add_numbers(script);
  add_files(script);
}

}  // namespace conformance
