// The error record of each thread: what ifsm_last_error() tells.
#pragma once

#include <ifsm.h>

namespace ifsm::core {

// Turns the exception in flight into this thread's record and returns its status. Call it in a catch block only.
// Cannot fail: when there is no memory for the strings, the record says so, and that one needs none.
ifsm_status record_failure(const char* function) noexcept;

// This thread's record. Its strings stay until the next failure on this thread.
const ifsm_error& last_record() noexcept;

}  // namespace ifsm::core
