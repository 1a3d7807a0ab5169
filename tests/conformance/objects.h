// The objects that calls make, by the names that the file gives them.
#pragma once

#include <ifsm.h>

#include <functional>
#include <map>
#include <string>

namespace conformance {

inline ifsm_status destroy(ifsm_filter handle) { return ifsm_filter_destroy(handle); }
inline ifsm_status destroy(ifsm_model handle) { return ifsm_model_destroy(handle); }
inline ifsm_status destroy(ifsm_fit handle) { return ifsm_fit_destroy(handle); }
inline ifsm_status destroy(ifsm_deformer handle) { return ifsm_deformer_destroy(handle); }
inline ifsm_status destroy(ifsm_system handle) { return ifsm_system_destroy(handle); }
inline ifsm_status destroy(ifsm_cancel handle) { return ifsm_cancel_destroy(handle); }

class Objects {
 public:
  Objects() = default;
  ~Objects() {
    while (!kept_.empty()) release(kept_.begin()->first);
  }
  Objects(const Objects&) = delete;
  Objects& operator=(const Objects&) = delete;

  template <class Handle>
  void keep(const std::string& name, Handle handle) {
    if (kept_.contains(name)) release(name);
    kept_[name] = {handle.id, [handle] { static_cast<void>(destroy(handle) == IFSM_OK); }};
  }
  void release(const std::string& name) {
    kept_.at(name).destroy();
    kept_.erase(name);
  }
  std::uint64_t id(const std::string& name) const { return kept_.at(name).id; }

 private:
  struct Kept {
    std::uint64_t id;
    std::function<void()> destroy;
  };
  std::map<std::string, Kept> kept_;
};

}  // namespace conformance
