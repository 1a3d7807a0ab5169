#include <ifsm.h>

#include "base/error.h"
#include "base/parallel.h"
#include "capi/arguments.h"
#include "capi/guarded.h"
#include "capi/log.h"
#include "capi/nouns.h"

namespace ifsm::core {
namespace {

constexpr int most_threads = 1024;

constexpr bool agrees(Status status, int published) { return static_cast<int>(status) == published; }
static_assert(agrees(Status::ok, IFSM_OK) && agrees(Status::invalid_handle, IFSM_ERROR_INVALID_HANDLE) &&
              agrees(Status::null, IFSM_ERROR_NULL) && agrees(Status::range, IFSM_ERROR_RANGE) &&
              agrees(Status::not_finite, IFSM_ERROR_NOT_FINITE) && agrees(Status::shape, IFSM_ERROR_SHAPE) &&
              agrees(Status::singular, IFSM_ERROR_SINGULAR) && agrees(Status::capacity, IFSM_ERROR_CAPACITY) &&
              agrees(Status::options, IFSM_ERROR_OPTIONS) && agrees(Status::format, IFSM_ERROR_FORMAT) &&
              agrees(Status::version, IFSM_ERROR_VERSION) && agrees(Status::limit, IFSM_ERROR_LIMIT) &&
              agrees(Status::cancelled, IFSM_ERROR_CANCELLED) && agrees(Status::busy, IFSM_ERROR_BUSY) &&
              agrees(Status::memory, IFSM_ERROR_MEMORY) && agrees(Status::numerical, IFSM_ERROR_NUMERICAL) &&
              agrees(Status::internal, IFSM_ERROR_INTERNAL));

// Usable from the first instruction of the process to its last: threads may still be in calls while main returns.
union Immortal {
  constexpr Immortal() : table() {}
  ~Immortal() {}
  HandleTable table;
};
constinit Immortal process_handles;

}  // namespace

HandleTable& handles() { return process_handles.table; }

}  // namespace ifsm::core

using namespace ifsm::core;

ifsm_status ifsm_last_error(ifsm_error* error) {
  // Not behind the barrier, which would change the record.
  if (error == nullptr) return IFSM_ERROR_NULL;
  try {
    Report(error, "error").write(last_record());
    return IFSM_OK;
  } catch (...) {
    return IFSM_ERROR_OPTIONS;
  }
}

const char* ifsm_status_name(ifsm_status status) {
  switch (status) {
    case IFSM_OK: return "IFSM_OK";
    case IFSM_ERROR_INVALID_HANDLE: return "IFSM_ERROR_INVALID_HANDLE";
    case IFSM_ERROR_NULL: return "IFSM_ERROR_NULL";
    case IFSM_ERROR_RANGE: return "IFSM_ERROR_RANGE";
    case IFSM_ERROR_NOT_FINITE: return "IFSM_ERROR_NOT_FINITE";
    case IFSM_ERROR_SHAPE: return "IFSM_ERROR_SHAPE";
    case IFSM_ERROR_SINGULAR: return "IFSM_ERROR_SINGULAR";
    case IFSM_ERROR_CAPACITY: return "IFSM_ERROR_CAPACITY";
    case IFSM_ERROR_OPTIONS: return "IFSM_ERROR_OPTIONS";
    case IFSM_ERROR_FORMAT: return "IFSM_ERROR_FORMAT";
    case IFSM_ERROR_VERSION: return "IFSM_ERROR_VERSION";
    case IFSM_ERROR_LIMIT: return "IFSM_ERROR_LIMIT";
    case IFSM_ERROR_CANCELLED: return "IFSM_ERROR_CANCELLED";
    case IFSM_ERROR_BUSY: return "IFSM_ERROR_BUSY";
    case IFSM_ERROR_MEMORY: return "IFSM_ERROR_MEMORY";
    case IFSM_ERROR_NUMERICAL: return "IFSM_ERROR_NUMERICAL";
    case IFSM_ERROR_INTERNAL: return "IFSM_ERROR_INTERNAL";
    default: return "unknown status";
  }
}

int32_t ifsm_version(void) { return 10000 * IFSM_VERSION_MAJOR + 100 * IFSM_VERSION_MINOR + IFSM_VERSION_PATCH; }

const char* ifsm_version_text(void) { return IFSM_VERSION_TEXT; }

ifsm_status ifsm_set_threads(int32_t threads) {
  return guarded(__func__,
                 [&] { set_default_threads(static_cast<int>(in_range(threads, 0, most_threads, "threads"))); });
}

ifsm_status ifsm_threads(int32_t* threads) {
  return guarded(__func__, [&] { required(threads, "threads") = default_threads(); });
}

ifsm_status ifsm_set_log(ifsm_log_callback sink, void* user) {
  return guarded(__func__, [&] { set_log_sink(sink, user); });
}
