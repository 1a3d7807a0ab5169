// What each C handle type stands for, and the way in and out of the handle table.
#pragma once

#include <ifsm.h>

#include <memory>
#include <type_traits>

#include "capi/handles.h"

namespace ifsm::core {

class CancelToken;
struct Deforming;
class Filter;
class Model;
struct FitResult;
class System;

template <class Handle>
struct Noun;

template <>
struct Noun<ifsm_cancel> {
  using Object = CancelToken;  // not const: its one flag is atomic
  static constexpr Kind kind = Kind::cancel;
};
template <>
struct Noun<ifsm_filter> {
  using Object = const Filter;
  static constexpr Kind kind = Kind::filter;
};
template <>
struct Noun<ifsm_model> {
  using Object = const Model;
  static constexpr Kind kind = Kind::model;
};
template <>
struct Noun<ifsm_fit> {
  using Object = const FitResult;
  static constexpr Kind kind = Kind::fit;
};

template <>
struct Noun<ifsm_deformer> {
  using Object = Deforming;  // not const: its flag says who may use it
  static constexpr Kind kind = Kind::deformer;
};

template <>
struct Noun<ifsm_system> {
  using Object = const System;
  static constexpr Kind kind = Kind::system;
};

template <class Handle>
using ObjectOf = typename Noun<Handle>::Object;

// The handles of this process.
HandleTable& handles();

// The object of a handle, alive while the result is. Header parameters are called what their type is called, so the
// argument's name follows from the kind; a field has its own.
template <class Handle>
std::shared_ptr<ObjectOf<Handle>> borrow(Handle handle, const char* argument = kind_name(Noun<Handle>::kind)) {
  return std::static_pointer_cast<ObjectOf<Handle>>(handles().borrow(Noun<Handle>::kind, handle.id, argument));
}

// The same, where {0} means none.
template <class Handle>
std::shared_ptr<ObjectOf<Handle>> borrow_if_any(Handle handle, const char* argument) {
  if (handle.id == 0) return nullptr;
  return borrow(handle, argument);
}

// Gives `object` a handle: the last step of a call, and nothing has changed when it throws.
template <class Handle>
void issue(std::shared_ptr<ObjectOf<Handle>> object, Handle& handle) {
  auto shared = std::const_pointer_cast<std::remove_const_t<ObjectOf<Handle>>>(std::move(object));
  handle.id = handles().insert(Noun<Handle>::kind, std::move(shared));
}

template <class Handle>
void destroy(Handle handle) {
  handles().remove(Noun<Handle>::kind, handle.id, kind_name(Noun<Handle>::kind));
}

}  // namespace ifsm::core
