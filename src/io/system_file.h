// Systems as JSON and CBOR: docs/format.md.
#pragma once

#include <span>

#include "io/emitter.h"
#include "system/system.h"

namespace ifsm::core {

Bytes write_system(const System& system, Format format);

// Errors name the entry of the file, or the byte.
SystemPtr read_system(std::span<const std::uint8_t> bytes);

}  // namespace ifsm::core
