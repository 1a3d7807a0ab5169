// What the typemaps for Python are made of: errors, handles, buffers, curves, callbacks. Every object here lives in the
// wrapper of one call; what it borrows it gives back at that call's end, whichever way it ends. Locks and callbacks:
// lock.h.
#pragma once

#include <Python.h>
#include <ifsm.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <new>
#include <vector>

#include "../options.h"

namespace ifsm_python {

// ------------------------------------------------------------------------------------------------------------------
// Errors: exceptions are made by a function of ifsm/_errors.py, from what ifsm_error holds

inline PyObject *&error_maker() {
  static PyObject *maker = nullptr;  // owned
  return maker;
}

inline void set_error_maker(PyObject *maker) {
  Py_INCREF(maker);
  Py_XDECREF(error_maker());
  error_maker() = maker;
}

constexpr int wrong_type = -1;  // Python's affair alone: C has types

inline void raise_error(int status, const char *function, const char *argument, long long index, double value,
                        long long required, const char *message) {
  if (error_maker() == nullptr) {
    PyErr_SetString(PyExc_RuntimeError, message);
    return;
  }
  PyObject *error =
      PyObject_CallFunction(error_maker(), "issLdLs", status, function, argument, index, value, required, message);
  if (error == nullptr) return;  // whatever went wrong there is raised
  PyErr_SetObject(reinterpret_cast<PyObject *>(Py_TYPE(error)), error);
  Py_DECREF(error);
}

// What was raised while C was at work, until C has returned.
struct Kept {
  PyObject *type = nullptr, *value = nullptr, *traceback = nullptr;

  bool is_empty() const { return type == nullptr; }
  void fetch() { PyErr_Fetch(&type, &value, &traceback); }
  void raise() {
    PyErr_Restore(type, value, traceback);
    type = value = traceback = nullptr;
  }
  void drop() {
    Py_XDECREF(type);
    Py_XDECREF(value);
    Py_XDECREF(traceback);
    type = value = traceback = nullptr;
  }
};

// What this thread's interrupt raised: KeyboardInterrupt, mostly.
inline Kept &interrupted() {
  thread_local Kept kept;
  return kept;
}

// What the C call that has just failed on this thread told.
inline void raise_last_error() {
  if (!interrupted().is_empty()) return interrupted().raise();
  ifsm_error told{};
  told.struct_size = sizeof told;
  if (ifsm_last_error(&told) != IFSM_OK) return PyErr_SetString(PyExc_SystemError, "ifsm_last_error failed.");
  raise_error(told.status, told.function, told.argument, told.index, told.value, told.required, told.message);
}

// One argument of one call: what refusals name. Refusals return false, with the exception set.
struct Argument {
  const char *function, *name;

  bool refuse(int status, PyObject *message, long long index = -1, double value = std::nan("")) const {
    if (message == nullptr) return false;
    if (const char *text = PyUnicode_AsUTF8(message)) raise_error(status, function, name, index, value, -1, text);
    Py_DECREF(message);
    return false;
  }
  bool wants(const char *what, PyObject *given) const {
    PyErr_Clear();
    if (given == Py_None) return refuse(wrong_type, PyUnicode_FromFormat("%s is None; give %s.", name, what));
    const char *type = Py_TYPE(given)->tp_name;
    const bool vowel = std::strchr("aeiouAEIOU", *type) != nullptr;
    return refuse(wrong_type, PyUnicode_FromFormat("%s is %s %s; give %s.", name, vowel ? "an" : "a", type, what));
  }
};

// Whether None is C's NULL for an argument, which stands for something there.
inline bool may_be_nothing(Argument argument) {
  constexpr const char *all[][2] = {
      {"ifsm_model_from_system", "polygon"}, {"ifsm_system_save", "name"}, {"ifsm_system_load", "name"}};
  for (const auto &[function, name] : all)
    if (std::strcmp(argument.function, function) == 0 && std::strcmp(argument.name, name) == 0) return true;
  return false;
}

// ------------------------------------------------------------------------------------------------------------------
// Numbers and names

inline bool take(PyObject *given, Argument argument, double &number) {
  number = PyFloat_AsDouble(given);
  if (number != -1.0 || !PyErr_Occurred()) return true;
  if (PyErr_ExceptionMatches(PyExc_OverflowError)) {  // an integer that no double is large enough for
    PyErr_Clear();
    return argument.refuse(IFSM_ERROR_RANGE, PyUnicode_FromFormat("%s is too large for a double.", argument.name));
  }
  return argument.wants("a number", given);
}

template <class Integer>
bool take(PyObject *given, Argument argument, Integer &number) {
  using Limits = std::numeric_limits<Integer>;
  PyObject *whole = PyNumber_Index(given);
  if (whole == nullptr) return argument.wants("an integer", given);
  bool fits = true;
  if constexpr (Limits::is_signed) {
    int beyond = 0;
    const long long value = PyLong_AsLongLongAndOverflow(whole, &beyond);
    fits = beyond == 0 && value >= Limits::min() && value <= Limits::max();
    number = static_cast<Integer>(value);
  } else {
    const unsigned long long value = PyLong_AsUnsignedLongLong(whole);
    fits = !PyErr_Occurred() && value <= Limits::max();
    number = static_cast<Integer>(value);
  }
  PyErr_Clear();
  if (!fits) {
    double value = PyLong_AsDouble(whole);  // for the record; may be too large even for that
    if (PyErr_Occurred()) PyErr_Clear(), value = std::nan("");
    argument.refuse(
        IFSM_ERROR_RANGE,
        PyUnicode_FromFormat("%s is %R; give a number from %lld to %llu.", argument.name, whole,
                             static_cast<long long>(Limits::min()), static_cast<unsigned long long>(Limits::max())),
        -1, value);
  }
  Py_DECREF(whole);
  return fits;
}

// Borrowed from the str, which the caller's tuple of arguments keeps.
inline bool take(PyObject *given, Argument argument, const char *&text) {
  if (given == Py_None && may_be_nothing(argument)) return true;
  if (!PyUnicode_Check(given)) return argument.wants("a str", given);
  Py_ssize_t length = 0;
  text = PyUnicode_AsUTF8AndSize(given, &length);
  if (text == nullptr || std::strlen(text) != static_cast<std::size_t>(length)) {
    PyErr_Clear();  // lone surrogates, say
    return argument.refuse(
        IFSM_ERROR_RANGE,
        PyUnicode_FromFormat("%s holds what no name can: a zero or half a character.", argument.name));
  }
  return true;
}

// ------------------------------------------------------------------------------------------------------------------
// Handles: capsules, named by their type, which destroy what they own when they go. The layer above closes an object by
// letting go of its capsule: a call that runs in another thread holds it until it ends.

template <class Handle>
struct Kind;  // name, destroy

template <>
struct Kind<ifsm_filter> {
  static constexpr const char *name = "ifsm_filter";
  static ifsm_status destroy(ifsm_filter handle) { return ifsm_filter_destroy(handle); }
};
template <>
struct Kind<ifsm_model> {
  static constexpr const char *name = "ifsm_model";
  static ifsm_status destroy(ifsm_model handle) { return ifsm_model_destroy(handle); }
};
template <>
struct Kind<ifsm_fit> {
  static constexpr const char *name = "ifsm_fit";
  static ifsm_status destroy(ifsm_fit handle) { return ifsm_fit_destroy(handle); }
};
template <>
struct Kind<ifsm_deformer> {
  static constexpr const char *name = "ifsm_deformer";
  static ifsm_status destroy(ifsm_deformer handle) { return ifsm_deformer_destroy(handle); }
};
template <>
struct Kind<ifsm_system> {
  static constexpr const char *name = "ifsm_system";
  static ifsm_status destroy(ifsm_system handle) { return ifsm_system_destroy(handle); }
};
template <>
struct Kind<ifsm_cancel> {
  static constexpr const char *name = "ifsm_cancel";
  static ifsm_status destroy(ifsm_cancel handle) { return ifsm_cancel_destroy(handle); }
};

// None is {0}, which C refuses or takes for nothing.
template <class Handle>
bool take_handle(PyObject *given, Argument argument, Handle &handle) {
  handle = Handle{};
  if (given == Py_None) return true;
  if (!PyCapsule_IsValid(given, Kind<Handle>::name)) return argument.wants(Kind<Handle>::name, given);
  handle = *static_cast<Handle *>(PyCapsule_GetPointer(given, Kind<Handle>::name));
  return true;
}

// Owns what a call makes until Python does.
template <class Handle>
class Made {
 public:
  Made() = default;
  Made(const Made &) = delete;
  Made &operator=(const Made &) = delete;
  ~Made() { static_cast<void>(Kind<Handle>::destroy(handle_) == IFSM_OK); }

  Handle *out() { return &handle_; }

  PyObject *capsule() {
    auto *kept = new (std::nothrow) Handle(handle_);
    if (kept == nullptr) return PyErr_NoMemory();
    PyObject *capsule = PyCapsule_New(kept, Kind<Handle>::name, [](PyObject *dying) {
      auto *held = static_cast<Handle *>(PyCapsule_GetPointer(dying, Kind<Handle>::name));
      static_cast<void>(Kind<Handle>::destroy(*held) == IFSM_OK);
      delete held;
    });
    if (capsule == nullptr)
      delete kept;
    else
      handle_ = Handle{};
    return capsule;
  }

 private:
  Handle handle_{};
};

// ------------------------------------------------------------------------------------------------------------------
// Arrays: buffers, C-contiguous, of exactly the type; the layer above makes them so. Nothing is copied here.

template <class T>
struct Element;
template <>
struct Element<double> {
  static constexpr const char *formats = "d", *what = "an aligned C-contiguous array of float64";
};
template <>
struct Element<std::int32_t> {
  static constexpr const char *formats = "i", *what = "an aligned C-contiguous array of int32";
};
template <>
struct Element<std::int64_t> {
  static constexpr const char *formats = "lq", *what = "an aligned C-contiguous array of int64";
};
template <>
struct Element<std::uint32_t> {
  static constexpr const char *formats = "I", *what = "an aligned C-contiguous array of uint32";
};
template <>
struct Element<std::uint8_t> {
  static constexpr const char *formats = "Bbc", *what = "bytes, or a C-contiguous array of uint8";
};

template <class T>
class View {
 public:
  View() = default;
  View(const View &) = delete;
  View &operator=(const View &) = delete;
  View(View &&other) noexcept : buffer_(other.buffer_) { other.buffer_.obj = nullptr; }
  ~View() {
    if (buffer_.obj != nullptr) PyBuffer_Release(&buffer_);
  }

  // None is NULL and 0.
  bool take(PyObject *given, Argument argument, bool writable) {
    if (given == Py_None) return true;
    const int flags = PyBUF_C_CONTIGUOUS | PyBUF_FORMAT | (writable ? PyBUF_WRITABLE : 0);
    if (PyObject_GetBuffer(given, &buffer_, flags) != 0) {
      buffer_.obj = nullptr;
      return argument.wants(Element<T>::what, given);
    }
    if (reinterpret_cast<std::uintptr_t>(buffer_.buf) % alignof(T) != 0) return argument.wants(Element<T>::what, given);
    const char *format = buffer_.format == nullptr ? "B" : buffer_.format;
    if (std::strlen(format) == 1 && std::strchr(Element<T>::formats, *format) != nullptr) return true;
    return argument.wants(Element<T>::what, given);
  }

  T *data() const { return static_cast<T *>(buffer_.buf); }
  std::int64_t size() const { return buffer_.obj == nullptr ? 0 : buffer_.len / static_cast<Py_ssize_t>(sizeof(T)); }
  // Of an array of two dimensions.
  bool is_table() const { return buffer_.ndim == 2; }
  Py_ssize_t rows() const { return buffer_.shape[0]; }
  Py_ssize_t columns() const { return buffer_.shape[1]; }

 private:
  Py_buffer buffer_{};
};

// Where C sees an array that it is handed: that of the array itself, since nothing is copied. For tests.
inline std::uintptr_t address_of(const double *data, std::int64_t) { return reinterpret_cast<std::uintptr_t>(data); }

// ------------------------------------------------------------------------------------------------------------------
// Curves: (array of shape (count, dimension), closed)

class Curves {
 public:
  // None adds nothing, where C takes NULL.
  bool take_one(PyObject *given, Argument argument) {
    if (given == Py_None && may_be_nothing(argument)) return true;
    if (!PyTuple_Check(given) || PyTuple_GET_SIZE(given) != 2)
      return argument.wants("a curve: a tuple of an array and whether it is closed", given);
    views_.emplace_back();
    View<double> &view = views_.back();
    const int closed = PyObject_IsTrue(PyTuple_GET_ITEM(given, 1));
    if (closed < 0 || !view.take(PyTuple_GET_ITEM(given, 0), argument, false)) return false;
    if (!view.is_table())
      return argument.wants("a curve whose array has the shape (points, dimension)", PyTuple_GET_ITEM(given, 0));
    constexpr Py_ssize_t most = std::numeric_limits<std::int32_t>::max();
    const auto dimension = static_cast<std::int32_t>(view.columns() < most ? view.columns() : most);
    curves_.push_back({view.data(), view.rows(), dimension, closed});
    return true;
  }
  bool take_list(PyObject *given, Argument argument) {
    if (!PyList_Check(given)) return argument.wants("a list of curves", given);
    for (Py_ssize_t i = 0; i < PyList_GET_SIZE(given); ++i)
      if (!take_one(PyList_GET_ITEM(given, i), argument)) return false;
    return true;
  }

  const ifsm_curve *data() const { return curves_.data(); }
  std::int64_t size() const { return static_cast<std::int64_t>(curves_.size()); }

 private:
  std::vector<View<double>> views_;
  std::vector<ifsm_curve> curves_;
};

// What is known about samples: a list, for each curve (parameters, weights, covariances, kinds of constraints, their
// parameters, their values, whether ends are fixed), arrays or None.
class Known {
 public:
  bool take(PyObject *given, Argument argument) {
    if (!PyList_Check(given)) return argument.wants("a list, one entry a curve", given);
    for (Py_ssize_t i = 0; i < PyList_GET_SIZE(given); ++i)
      if (!take_one(PyList_GET_ITEM(given, i), argument)) return false;
    return true;
  }
  ifsm_bindings::KnownSamples get() const { return {samples_.data(), static_cast<std::int64_t>(samples_.size())}; }

 private:
  bool take_one(PyObject *given, Argument argument) {
    if (!PyTuple_Check(given) || PyTuple_GET_SIZE(given) != 7) return argument.wants("a tuple of seven", given);
    const auto item = [&](Py_ssize_t k) { return PyTuple_GET_ITEM(given, k); };
    ifsm_fit_samples known{};
    std::int64_t kinds = 0, at = 0, values = 0;
    if (!take_array(item(0), argument, known.parameters, known.parameter_count) ||
        !take_array(item(1), argument, known.weights, known.weight_count) ||
        !take_array(item(2), argument, known.covariances, known.covariance_count) ||
        !take_array(item(4), argument, known.constraint_parameters, at) ||
        !take_array(item(5), argument, known.constraint_values, values))
      return false;
    kinds_.emplace_back();
    if (!kinds_.back().take(item(3), argument, false)) return false;
    known.constraint_kinds = kinds_.back().data();
    kinds = kinds_.back().size();
    if (kinds != at || (kinds > 0 && values % kinds != 0)) return argument.wants("constraints of equal numbers", given);
    known.constraint_count = kinds;
    known.fixed_ends = PyObject_IsTrue(item(6));
    if (known.fixed_ends < 0) return false;
    samples_.push_back(known);
    return true;
  }
  bool take_array(PyObject *given, Argument argument, const double *&data, std::int64_t &count) {
    arrays_.emplace_back();
    if (!arrays_.back().take(given, argument, false)) return false;
    data = arrays_.back().data();
    count = arrays_.back().size();
    return true;
  }

  std::vector<View<double>> arrays_;
  std::vector<View<std::int32_t>> kinds_;
  std::vector<ifsm_fit_samples> samples_;
};

}  // namespace ifsm_python
