// Models and filters, as files and by name.
#pragma once

#include <string>

#include <ifsm.hpp>

namespace cli {

// A model file of either format. Throws Failure{Input}.
ifsm::Model load_model(const std::string& path);

// By the name that `ifsm fit --filter` takes: joined where the name has that form, else square. 0 chooses the name's
// own numbers. Throws Failure{Usage}.
ifsm::Filter named_filter(const std::string& name, int control_points, int maps);

}  // namespace cli
