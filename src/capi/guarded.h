// The one barrier: no exception leaves the library but as a status.
#pragma once

#include <ifsm.h>

#include "capi/record.h"

namespace ifsm::core {

// return guarded(__func__, [&] { … });   Every exported body, its argument checks included, is such a lambda.
template <class Body>
ifsm_status guarded(const char* function, const Body& body) noexcept {
  try {
    body();
    return IFSM_OK;
  } catch (...) {
    return record_failure(function);
  }
}

}  // namespace ifsm::core
