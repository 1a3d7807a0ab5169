// Systems by name: those of the papers, and the classics.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "system/system.h"

namespace ifsm::core {

struct NamedSystem {
  std::string_view name;
  std::string_view source;  // a paper and its figure or table, or where it is found
  int dimension;
};

// All of them; aliases ("fern", "dragon", …) are not among them.
std::span<const NamedSystem> named_systems();

// "-" and "_" are the same in a name. A range error lists the names.
SystemPtr named_system(std::string_view name);

}  // namespace ifsm::core
