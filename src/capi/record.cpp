#include "capi/record.h"

#include <pthread.h>

#include <cstddef>
#include <exception>
#include <limits>
#include <memory>
#include <new>
#include <string>
#include <utility>

#include "base/cancel.h"
#include "base/error.h"
#include "capi/log.h"

namespace ifsm::core {
namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

constexpr ifsm_error fixed_record(ifsm_status status, const char* function, const char* message) {
  return {sizeof(ifsm_error), status, function, "", -1, no_value, -1, message};
}

// Plain data, so that a thread's first failure neither constructs nor registers anything: either may need memory, and
// the C library ends the process when it has none (that is also why the strings hang on a pthread key, below, and not
// on a thread_local of their own). Constant strings or the thread's own; nothing else.
constinit thread_local ifsm_error current = fixed_record(IFSM_OK, "", "No call has failed on this thread.");

struct Strings {
  std::string argument;
  std::string message;
};

void drop_strings(void* strings) {
  current = fixed_record(IFSM_OK, "", "This thread is ending.");
  delete static_cast<Strings*>(strings);
}

pthread_key_t strings_key() {
  static const pthread_key_t key = [] {
    pthread_key_t made{};
    if (pthread_key_create(&made, drop_strings) != 0) throw std::bad_alloc();
    return made;
  }();
  return key;
}

// This thread's strings, made at its first failure and deleted when it ends.
Strings& own_strings() {
  if (void* made = pthread_getspecific(strings_key())) return *static_cast<Strings*>(made);
  auto strings = std::make_unique<Strings>();
  if (pthread_setspecific(strings_key(), strings.get()) != 0) throw std::bad_alloc();
  return *strings.release();
}

ifsm_status record_fixed(ifsm_status status, const char* function, const char* message) noexcept {
  current = fixed_record(status, function, message);
  return status;
}

ifsm_status record_memory(const char* function) noexcept {
  return record_fixed(IFSM_ERROR_MEMORY, function,
                      "An allocation failed and everything is as it was before the call; free memory or ask for less.");
}

ifsm_status record_error(const char* function, const Error& error) noexcept try {
  Strings told{error.argument(), error.what()};  // made aside: the old record stays whole until nothing can fail
  Strings& strings = own_strings();
  strings = std::move(told);
  current = {sizeof(ifsm_error), static_cast<ifsm_status>(error.status()),
             function,           strings.argument.c_str(),
             error.index(),      error.value(),
             error.required(),   strings.message.c_str()};
  return current.status;
} catch (...) {
  return record_memory(function);
}

ifsm_status record_internal(const char* function, const char* what) noexcept try {
  const auto message =
      std::string("The library failed inside: ") + what + ". This is a fault of ifsm: please report it.";
  log(LogLevel::warning, message.c_str());
  return record_error(function, Error(Status::internal, "", message));
} catch (...) {
  return record_memory(function);
}

}  // namespace

const ifsm_error& last_record() noexcept { return current; }

ifsm_status record_failure(const char* function) noexcept {
  try {
    throw;
  } catch (const Error& error) {
    return record_error(function, error);
  } catch (const Cancelled&) {
    return record_fixed(IFSM_ERROR_CANCELLED, function,
                        "The call was cancelled by its progress callback or its cancel token; nothing was made.");
  } catch (const std::bad_alloc&) {
    return record_memory(function);
  } catch (const std::exception& other) {
    return record_internal(function, other.what());
  } catch (...) {
    return record_internal(function, "an exception of an unknown type");
  }
}

}  // namespace ifsm::core
