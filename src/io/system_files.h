// Systems from files of any of the formats that are known; what is at their beginning tells which.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "system/system.h"

namespace ifsm::core {

struct NamedFileSystem {
  std::string name;  // "" in formats of a single system, which has none
  SystemPtr system;  // none, when it
  std::optional<Error> refused;
};

// JSON and CBOR hold one system; Fractint's text and flam3's XML any number, of which flames that are not affine are
// refused one by one. Errors are those of the formats' readers.
std::vector<NamedFileSystem> read_systems(std::span<const std::uint8_t> bytes);

// The one of that name, or the only one, unless it is refused. A range error, argument "name", lists those that there
// are.
SystemPtr read_system_named(std::span<const std::uint8_t> bytes, std::optional<std::string_view> name);

}  // namespace ifsm::core
