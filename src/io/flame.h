// Systems in flam3's XML files, `.flame`: those flames whose maps are affine. Of flam3 3.1.1; docs/format.md says what
// is read, what is ignored, and what is refused.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "system/system.h"

namespace ifsm::core {

struct FlameSystem {
  std::string name;
  SystemPtr system;              // none, when the flame
  std::optional<Error> refused;  // is no system: not affine, say
};

// All flames of a file, in its order, whatever elements are around them; one without a name has its number, from 1.
// A file that is no XML, or too large, is a format error. A flame that is no system, or not affine, has an error of its
// own, which names the flame and its transform ("xform 2 of the flame "x""); the line where the element begins, counted
// from 1, is in the text and the index.
std::vector<FlameSystem> read_flame(std::string_view text);

}  // namespace ifsm::core
