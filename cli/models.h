// Models and filters, as files and by name.
#pragma once

#include <string>
#include <string_view>

#include <ifsm.hpp>

namespace cli {

// A model file of either format. Throws Failure{Input}.
ifsm::Model load_model(const std::string& path);

// The same of bytes that were read from `source`.
ifsm::Model parse_model(std::string_view bytes, const std::string& source);

// Whether bytes mean to be a model, rather than a curve: CBOR, or JSON that says so.
bool looks_like_model(std::string_view bytes);

// By the name that `ifsm fit --filter` takes: joined where the name has that form, else square. 0 chooses the name's
// own numbers. Throws Failure{Usage}.
ifsm::Filter named_filter(const std::string& name, int control_points, int maps);

}  // namespace cli
