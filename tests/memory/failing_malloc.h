// This program's malloc and its kin (operator new stands on them), which can be told to fail.
#pragma once

#include <cstdint>

namespace failing_malloc {

// From now on, the `which`-th allocation of the whole process (counted from 1) gives NULL; that one alone.
void arm(std::int64_t which);

// Ends that. True when an allocation was made to fail.
bool disarm();

// Allocations counted since arm().
std::int64_t counted();

// Blocks in use, as far as they were allocated and freed in this process.
std::int64_t live();

}  // namespace failing_malloc
