// Models from bytes: docs/format.md.
#pragma once

#include <cstdint>
#include <span>

#include "curve/model.h"

namespace ifsm::core {

// The model that a file tells, JSON or CBOR. Everything is checked before anything is built; errors name the entry
// ("details[3].at[17]") or the byte ("bytes"), with the index: format, version, limit, not finite, shape, singular.
ModelPtr read_model(std::span<const std::uint8_t> bytes);

}  // namespace ifsm::core
