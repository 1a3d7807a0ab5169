#include "models.h"

#include "failure.h"
#include "files.h"

namespace cli {

ifsm::Model load_model(const std::string& path) {
  const auto bytes = read_file(path);
  if (bytes.empty()) throw Failure(Exit::Input, input_name(path) + " is empty; expected a model written by ifsm fit.");
  try {
    return ifsm::Model::load({bytes.begin(), bytes.end()});
  } catch (const ifsm::Error& error) {
    const bool its_fault = error.status != IFSM_ERROR_MEMORY && error.status != IFSM_ERROR_INTERNAL;
    throw Failure(its_fault ? Exit::Input : Exit::Computing, input_name(path) + ": " + error.what());
  }
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
