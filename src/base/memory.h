// How much memory there is, for sizes that a caller names by a small number. Linux hands out more than there is and
// ends the process later, so an allocation alone does not tell.
#pragma once

#include <cstdint>

namespace ifsm::core {

// Of this machine, in bytes.
std::int64_t physical_memory();

// A memory error that names the argument when so many doubles are more than the machine can hold.
void require_memory(std::int64_t doubles, const char* argument);

}  // namespace ifsm::core
