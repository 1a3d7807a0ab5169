// The library itself, and cancel tokens.
#include "script.h"

namespace conformance {

void add_library(Script& script) {
  script.right("ifsm_version", Json::object());
  script.right("ifsm_version_text", Json::object());
  for (const std::int32_t status : {-1, 0, 1, 3, 16, 17}) script.right("ifsm_status_name", {{"status", status}});
  for (const std::int32_t threads : {1, 1024, 0}) {
    script.right("ifsm_set_threads", {{"threads", threads}});
    script.right("ifsm_threads", Json::object());
  }
  script.wrongs("ifsm_set_threads", {{"threads", 1}});
  script.right("ifsm_threads", Json::object());
  script.right("ifsm_set_log", {{"sink", {{"callback", "continue"}}}});
  script.right("ifsm_set_log", {{"sink", nullptr}});

  script.right("ifsm_cancel_create", Json::object(), "cancel");
  script.right("ifsm_cancel_requested", {{"cancel", handle("cancel")}});
  script.right("ifsm_cancel_create", Json::object(), "cancelled");
  script.right("ifsm_cancel_request", {{"cancel", handle("cancelled")}});
  script.right("ifsm_cancel_requested", {{"cancel", handle("cancelled")}});
  script.wrongs("ifsm_cancel_request", {{"cancel", handle("cancel")}});
  script.wrongs("ifsm_cancel_requested", {{"cancel", handle("cancel")}});
}

}  // namespace conformance
