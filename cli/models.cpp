#include "models.h"

#include "csv.h"
#include "failure.h"
#include "files.h"
#include "geojson.h"

namespace cli {
namespace {

template <class Parse>
bool succeeds(const Parse& parse) {
  try {
    parse();
    return true;
  } catch (const Failure&) {
    return false;
  }
}

// Points where a model is wanted are a step left out, not a broken file.
void refuse_points(std::string_view bytes, const std::string& source) {
  const auto refuse = [&](const char* kind) {
    throw Failure(Exit::Input, source + " is " + kind + ", not a model; fit it first: ifsm fit " +
                                   (source == input_name("-") ? "-" : source) + " -o model.ifsm.");
  };
  if (succeeds([&] { parse_csv(bytes, source, {{}, true}); })) refuse("a table of points");
  if (looks_like_json(bytes) && succeeds([&] { parse_geojson(bytes, source, false); })) refuse("GeoJSON");
}

}  // namespace

ifsm::Model load_model(const std::string& path) { return parse_model(read_file(path), input_name(path)); }

ifsm::Model parse_model(std::string_view bytes, const std::string& source) {
  if (bytes.empty()) throw Failure(Exit::Input, source + " is empty; expected a model written by ifsm fit.");
  try {
    return ifsm::Model::load({bytes.begin(), bytes.end()});
  } catch (const ifsm::Error& error) {
    refuse_points(bytes, source);
    const bool its_fault = error.status != IFSM_ERROR_MEMORY && error.status != IFSM_ERROR_INTERNAL;
    throw Failure(its_fault ? Exit::Input : Exit::Computing, source + ": " + error.what());
  }
}

bool looks_like_model(std::string_view bytes) {
  constexpr unsigned map_of_cbor = 5;  // the major type, docs/format.md
  const bool cbor = !bytes.empty() && static_cast<unsigned char>(bytes.front()) >> 5 == map_of_cbor;
  return cbor || (looks_like_json(bytes) && bytes.find("\"ifsm-model\"") != bytes.npos);
}

namespace {

// A name has neither a point nor a slash in it.
bool is_path(const std::string& filter) { return filter.find_first_of("./") != std::string::npos; }

ifsm::Filter filter_of_file(const std::string& path, int control_points, int maps) {
  ifsm::Filter filter = load_model(path).filter();
  const auto info = filter.describe();
  const auto check = [&](const char* option, int asked, int has) {
    if (asked != 0 && asked != has)
      throw Failure(Exit::Usage, std::string(option) + " " + std::to_string(asked) + ", but the filter of " + path +
                                     " has " + std::to_string(has) + "; leave the option away.");
  };
  check("--control-points", control_points, info.control_points);
  check("--maps", maps, info.maps);
  return filter;
}

// A 0 that the library asks for is an option that is left out.
std::string in_options(std::string advice) {
  constexpr std::string_view zero = "give 0 for its own numbers";
  if (const auto at = advice.find(zero); at != advice.npos)
    advice.replace(at, zero.size(), "leave --control-points and --maps out for its own numbers");
  return advice;
}

// As a fit starts: coast where it has that shape.
ifsm::Filter default_filter(int control_points, int maps) {
  try {
    return ifsm::Filter::named("coast", ifsm::Topology::joined, control_points, maps);
  } catch (const ifsm::Error&) {
    return ifsm::Filter::named("casteljau", ifsm::Topology::joined, control_points, maps);
  }
}

}  // namespace

ifsm::Filter start_filter(const std::string& name, int control_points, int maps) {
  if (is_path(name)) return filter_of_file(name, control_points, maps);
  if (name.empty()) return default_filter(control_points, maps);
  try {
    return ifsm::Filter::named(name, ifsm::Topology::joined, control_points, maps);
  } catch (const ifsm::Error&) {
  }
  try {
    return ifsm::Filter::named(name, ifsm::Topology::square, control_points, maps);
  } catch (const ifsm::Error& error) {
    throw Failure(Exit::Usage, "--filter: " + in_options(error.what()));
  }
}

std::string file_of_filter(const std::string& filter) { return is_path(filter) ? filter : std::string(); }

void refuse_budget(const ifsm::Error& error) {
  if (error.status != IFSM_ERROR_RANGE || error.argument != "budgets") return;
  const std::string asked = "--budget: " + shortest(error.value), needed = std::to_string(error.required);
  if (error.value > static_cast<double>(error.required))
    throw Failure(Exit::Usage, asked + " is more than the curve's model holds, " + needed +
                                   " control points and details; give at most that.");
  throw Failure(Exit::Usage,
                asked + " is too few: a sketch holds the " + needed + " control points at least; give that or more.");
}

void refuse_shape(const ifsm::Error& error) {
  for (const auto& [argument, option] : {std::pair{"control_points", "--control-points"}, {"maps", "--maps"}})
    if (error.status == IFSM_ERROR_RANGE && error.argument == argument)
      throw Failure(Exit::Usage, option + (": it" + std::string(error.what()).substr(error.argument.size())));
  if (error.status == IFSM_ERROR_LIMIT && error.argument == "start")
    throw Failure(Exit::Usage, std::string("--control-points, --maps: ") + error.what());
}

ifsm::Model kept_within(const ifsm::Model& model, const ifsm::Keep& rule) {
  try {
    return model.keep(rule);
  } catch (const ifsm::Cancelled&) {
    throw;
  } catch (const ifsm::Error& error) {
    refuse_bound(error);
    throw;
  }
}

void refuse_bound(const ifsm::Error& error) {
  if (error.status != IFSM_ERROR_RANGE || (error.argument != "threshold" && error.argument != "within")) return;
  const std::string text = error.what();
  throw Failure(Exit::Usage, "--within: it " + text.substr(error.argument.size() + 1));
}

void require_joined(const ifsm::Filter& filter, const std::string& name) {
  if (filter.describe().topology != IFSM_TOPOLOGY_JOINED)
    throw Failure(Exit::Usage, "--filter: '" + name +
                                   "' is a square filter, and a fit starts from a joined one; use "
                                   "casteljau, or fit with --no-fit to use the filter as it is.");
}

}  // namespace cli
