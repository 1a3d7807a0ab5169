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

// What `--filter` names. A name: joined where it has that form, else square. A path (with a point or a slash in it):
// the filter of that model. Empty: where a fit starts that is told nothing. 0 chooses the filter's own numbers. Throws
// Failure{Usage, Input}.
ifsm::Filter start_filter(const std::string& name, int control_points, int maps);
// The file that such a filter is read from; empty when it is a name.
std::string file_of_filter(const std::string& filter);
// Of what a fit or a training refused: a filter with too many entries. Throws Failure{Usage}, or nothing.
void refuse_shape(const ifsm::Error& error);
// The same for a budget that the curve, or the shape, cannot hold.
void refuse_budget(const ifsm::Error& error);
// model.keep(rule); a bound that is refused is called as the option is. Throws Failure{Usage}, ifsm::Error.
ifsm::Model kept_within(const ifsm::Model& model, const ifsm::Keep& rule);
void refuse_bound(const ifsm::Error& error);
void require_joined(const ifsm::Filter& filter, const std::string& name);

}  // namespace cli
