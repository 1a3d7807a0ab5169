// Loops over large memory that Ctrl-C ends.
#pragma once

#include <algorithm>
#include <cstddef>

#include "base/cancel.h"

namespace ifsm::core {

// Pixels first … end - 1 of so many, part by part: what is large takes seconds, not without a poll.
template <class Body>
void for_parts(std::size_t count, const Watch& watch, const Body& body) {
  constexpr std::size_t part = 1 << 20;
  for (std::size_t first = 0; first < count; first += part) {
    watch.poll();
    body(first, std::min(count, first + part));
  }
}

}  // namespace ifsm::core
