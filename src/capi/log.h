// The process's log sink: where diagnosis goes that is not an error. Off by default; the library never prints.
#pragma once

#include <ifsm.h>

#include <cstdint>

namespace ifsm::core {

enum class LogLevel : std::int32_t { info = 0, warning = 1 };

// Hands one line to the sink, on this thread and under no lock. What the sink throws is dropped.
void log(LogLevel level, const char* text) noexcept;

void set_log_sink(ifsm_log_callback call, void* user);

}  // namespace ifsm::core
