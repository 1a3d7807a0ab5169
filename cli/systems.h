// Systems, by name and as files of any format.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <ifsm.hpp>

namespace cli {

// A name has neither a point nor a slash in it, and is not "-"; a file that is called like no system is a file.
bool names_system(const std::string& source);

// By name; or a file: JSON, CBOR, Fractint's, flam3's, or a model with one control point more than dimensions. `name`:
// which of a file of several. Throws Failure{Usage, Input}.
ifsm::System load_system(const std::string& source, const std::optional<std::string>& name);

// The same of bytes that were read from `source`.
ifsm::System parse_system(std::string_view bytes, const std::string& source, const std::optional<std::string>& name);

// The names of the systems in bytes that were read from `source`; without names a single empty one. Throws
// Failure{Input}.
std::vector<std::string> names_in(std::string_view bytes, const std::string& source);

// Whether bytes mean to be a system, rather than a model or points: what they say, or how the file is called.
bool looks_like_system(std::string_view bytes, const std::string& source);

// What a system is called that came from there: its name, or the file's without its ending.
std::string title_of_system(const std::string& source, const std::optional<std::string>& name);

}  // namespace cli
