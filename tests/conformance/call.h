// One call: its arguments read from JSON, its results written to JSON. The generated functions.cpp asks it for each
// argument by name; everything that it hands out lives as long as it does.
#pragma once

#include <ifsm.h>

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "functions.h"
#include "objects.h"
#include "options.h"
#include "values.h"

namespace conformance {

class Call {
 public:
  Call(const Function& function, const Json& arguments, Objects& objects)
      : function_(function), arguments_(arguments), objects_(objects) {}

  // Keeps what is made as `as`. Output arrays without a capacity are asked for their count first.
  ifsm_status run(const std::string& as);
  Json results() const;
  static Json error(const std::string& function);  // what this thread's last failing call, of that function, told

  template <class T>
  T integer(const char* name) {
    if constexpr (std::is_unsigned_v<T>)
      return static_cast<T>(unsigned_of(argument(name)));
    else
      return static_cast<T>(signed_of(argument(name)));
  }
  double real(const char* name) { return real_of(argument(name)); }
  const char* text(const char* name) {
    if (argument(name).is_null()) return nullptr;
    auto& text = stored<std::string>(name);
    text = argument(name).at("text").get<std::string>();
    return text.c_str();
  }
  template <class Handle>
  Handle handle(const char* name) {
    const Json& given = argument(name);
    return given.is_null() ? Handle{} : Handle{objects_.id(given.at("handle").get<std::string>())};
  }
  template <class T>
  const T* array(const char* name) {
    return read_array<T>(name).data();
  }
  template <class T>
  std::int64_t count(const char* name) {
    return static_cast<std::int64_t>(read_array<T>(name).size());
  }
  const ifsm_curve* curve(const char* name);
  const ifsm_curve* curves(const char* name);
  std::int64_t curve_count(const char* name) { return static_cast<std::int64_t>(argument(name).at("curves").size()); }
  ifsm_bindings::KnownSamples known(const char* name);
  template <class Callback>
  Callback callback(const char* name);
  void* user() { return &stops_; }

  template <class T>
  T* output(const char* name) {
    return array_out<T>(name).data();
  }
  template <class T>
  std::int64_t capacity(const char* name) {
    return static_cast<std::int64_t>(array_out<T>(name).size());
  }
  template <class T>
  std::int64_t* told_count(const char* name) {
    Output& output = outputs_[name];
    output.resize = [this, name](std::int64_t count) { stored<std::vector<T>>(name).resize(to_size(count)); };
    writers_[name] = [this, name] { return json_of(stored<std::vector<T>>(name)); };
    return &output.count;
  }
  template <class T>
  T* told(const char* name) {
    T& told = stored<T>(name);
    if constexpr (std::is_class_v<T>) told.struct_size = sizeof told;
    writers_[name] = [&told] { return json_of(told); };
    return &told;
  }
  template <class Handle>
  Handle* made() {
    auto& made = stored<Handle>("made");
    keep_ = [this, &made](const std::string& as) { objects_.keep(as, made); };
    return &made;
  }
  void returns(const char* text) { returned_ = json_of(text); }
  void returns(std::int32_t number) { returned_ = number; }

 private:
  struct Output {
    std::int64_t count = 0;
    std::function<void(std::int64_t)> resize;
  };

  static std::size_t to_size(std::int64_t count) { return static_cast<std::size_t>(count); }
  const Json& argument(const char* name) const { return arguments_.at(name); }
  template <class T>
  T& stored(const std::string& name) {
    auto& slot = stored_[name];
    if (!slot) slot = std::make_shared<T>();
    return *static_cast<T*>(slot.get());
  }
  template <class T>
  const std::vector<T>& read_array(const char* name) {
    const bool known = stored_.contains(name);
    auto& numbers = stored<std::vector<T>>(name);
    if (known) return numbers;
    numbers.reserve(1);  // that no empty array is NULL
    read(argument(name), numbers);
    return numbers;
  }
  template <class T>
  std::vector<T>& array_out(const char* name) {
    auto& room = stored<std::vector<T>>(name);
    if (argument(name).contains("capacity")) room.resize(argument(name).at("capacity").get<std::size_t>());
    return room;
  }
  const double* numbers(const Json& value, std::int64_t& count);
  ifsm_curve read_curve(const Json& given);

  const Function& function_;
  const Json& arguments_;
  Objects& objects_;
  std::map<std::string, std::shared_ptr<void>> stored_;
  std::map<std::string, Output> outputs_;
  std::map<std::string, std::function<Json()>> writers_;
  std::function<void(const std::string&)> keep_;
  Json returned_;
  std::deque<std::vector<double>> numbers_;
  bool stops_ = false;  // what the progress callback says
};

template <>
inline ifsm_progress_callback Call::callback(const char* name) {
  if (argument(name).is_null()) return nullptr;
  stops_ = argument(name).at("callback") == "stop";
  return [](void* user, double, const char*) -> std::int32_t { return *static_cast<bool*>(user) ? 1 : 0; };
}

template <>
inline ifsm_log_callback Call::callback(const char* name) {
  if (argument(name).is_null()) return nullptr;
  return [](void*, std::int32_t, const char*) {};
}

}  // namespace conformance
