// Models as bytes: docs/format.md.
#pragma once

#include "io/emitter.h"

namespace ifsm::core {

// The file of a model; the reader gives every double of it back bit for bit. A limit error for a sketch whose tree the
// reader would refuse as too large for so short a file, a numerical error for a model with infinite numbers.
Bytes write_model(const Model& model, Format format);

}  // namespace ifsm::core
