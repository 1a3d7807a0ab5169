#include "base/cancel.h"

#include <ifsm.h>

#include "capi/arguments.h"
#include "capi/guarded.h"
#include "capi/nouns.h"

using namespace ifsm::core;

ifsm_status ifsm_set_interrupt(ifsm_interrupt_callback ask, void* user) {
  return guarded(__func__, [&] { set_interrupt(ask, user); });
}

ifsm_status ifsm_cancel_create(ifsm_cancel* cancel) {
  return guarded(__func__, [&] { issue(std::make_shared<CancelToken>(), required(cancel, "cancel")); });
}

ifsm_status ifsm_cancel_request(ifsm_cancel cancel) {
  return guarded(__func__, [&] { borrow(cancel)->request(); });
}

ifsm_status ifsm_cancel_requested(ifsm_cancel cancel, int32_t* requested) {
  return guarded(__func__, [&] { required(requested, "requested") = borrow(cancel)->requested() ? 1 : 0; });
}

ifsm_status ifsm_cancel_destroy(ifsm_cancel cancel) {
  return guarded(__func__, [&] { destroy(cancel); });
}
