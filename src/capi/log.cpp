#include "capi/log.h"

#include <mutex>

namespace ifsm::core {
namespace {

struct Sink {
  ifsm_log_callback call = nullptr;
  void* user = nullptr;
};

constinit std::mutex sink_mutex;
constinit Sink sink;

Sink current_sink() {
  const std::lock_guard guard(sink_mutex);
  return sink;
}

}  // namespace

void log(LogLevel level, const char* text) noexcept try {
  const Sink to = current_sink();
  if (to.call != nullptr) to.call(to.user, static_cast<std::int32_t>(level), text);
} catch (...) {  // a sink written in C++ may throw; nothing depends on it
}

void set_log_sink(ifsm_log_callback call, void* user) {
  const std::lock_guard guard(sink_mutex);
  sink = {call, user};
}

}  // namespace ifsm::core
