// Logs of edits as bytes: docs/format.md.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "deform/deformer.h"
#include "io/emitter.h"

namespace ifsm::core {

// The log of a deformer's present state. Borrowed textures are stored as the details that they gave.
Bytes write_edits(const Deformer& deformer, Format format);

// The edits that a file tells, to be replayed by a deformer of the same model and manner; a file of another model is
// refused as that ("model"), one of another manner too ("turning", "follow"). Errors name the entry
// ("edits[3].move.vectors") or the byte ("bytes"): format, version, limit, not finite, shape. Whether the edits can be
// made is for Deformer::replay to say.
std::vector<Timed> read_edits(std::span<const std::uint8_t> bytes, const Deformer& deformer);

}  // namespace ifsm::core
