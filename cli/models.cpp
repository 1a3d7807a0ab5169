#include "models.h"

#include "failure.h"
#include "files.h"
#include "geojson.h"

namespace cli {

ifsm::Model load_model(const std::string& path) { return parse_model(read_file(path), input_name(path)); }

ifsm::Model parse_model(std::string_view bytes, const std::string& source) {
  if (bytes.empty()) throw Failure(Exit::Input, source + " is empty; expected a model written by ifsm fit.");
  try {
    return ifsm::Model::load({bytes.begin(), bytes.end()});
  } catch (const ifsm::Error& error) {
    const bool its_fault = error.status != IFSM_ERROR_MEMORY && error.status != IFSM_ERROR_INTERNAL;
    throw Failure(its_fault ? Exit::Input : Exit::Computing, source + ": " + error.what());
  }
}

bool looks_like_model(std::string_view bytes) {
  constexpr unsigned map_of_cbor = 5;  // the major type, docs/format.md
  const bool cbor = !bytes.empty() && static_cast<unsigned char>(bytes.front()) >> 5 == map_of_cbor;
  return cbor || (looks_like_json(bytes) && bytes.find("\"ifsm-model\"") != bytes.npos);
}

ifsm::Filter named_filter(const std::string& name, int control_points, int maps) {
  try {
    return ifsm::Filter::named(name, ifsm::Topology::joined, control_points, maps);
  } catch (const ifsm::Error&) {
  }
  try {
    return ifsm::Filter::named(name, ifsm::Topology::square, control_points, maps);
  } catch (const ifsm::Error& error) {
    throw Failure(Exit::Usage, std::string("--filter: ") + error.what());
  }
}

}  // namespace cli
