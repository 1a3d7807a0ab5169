// What a file of edits knows its model by.
#pragma once

#include <string>

#include "curve/model.h"

namespace ifsm::core {

// 16 hexadecimal digits of everything that edits build on: shape, filter, control points and details, to the bit, and
// how many samples there are. FNV-1a of 64 bits (Fowler, Noll, Vo): against mistakes, not against malice.
std::string fingerprint(const Model& model);

}  // namespace ifsm::core
