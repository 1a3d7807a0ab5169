// What a fuzz target holds a reader to.
#pragma once

#include <cstdlib>

#include "base/error.h"

inline void require(bool holds) {
  if (!holds) std::abort();
}

// Of readers of text: the line is told, and nothing is the library's own fault.
inline void require_line(const ifsm::core::Error& error) {
  require(error.status() != ifsm::core::Status::internal && error.index() >= 1);
}
