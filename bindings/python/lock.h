// The interpreter's lock, and callbacks: what the wrapper of a call does while the library works.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <thread>

#include "support.h"

namespace ifsm_python {

// The way to the interpreter's lock. CPython before 3.14 ends threads that ask for it while the interpreter ends, by
// unwinding them, through C++ frames: that aborts. So once `close` has run, at exit, other threads wait for the
// process's end instead; those that were on their way it lets through.
class Door {
 public:
  template <class Take>
  static void pass(const Take &take) {
    ++entering();
    if (closed() && closer() != std::this_thread::get_id()) {
      --entering();
      for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
    }
    take();
    --entering();
  }

  static void close() {
    closer() = std::this_thread::get_id();
    closed() = true;
    // A thread that a fork has lost never arrives.
    for (int patience = 0; entering() > 0 && patience < 200; ++patience) {
      PyThreadState *state = PyEval_SaveThread();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      PyEval_RestoreThread(state);
    }
  }

 private:
  static std::atomic<int> &entering() {
    static std::atomic<int> count{0};
    return count;
  }
  static std::atomic<bool> &closed() {
    static std::atomic<bool> yes{false};
    return yes;
  }
  static std::thread::id &closer() {
    static std::thread::id thread;
    return thread;
  }
};

class Locked {
 public:
  Locked() {
    Door::pass([this] { state_ = PyGILState_Ensure(); });
  }
  Locked(const Locked &) = delete;
  Locked &operator=(const Locked &) = delete;
  ~Locked() { PyGILState_Release(state_); }

 private:
  PyGILState_STATE state_;
};

// Without the lock, while the library works; calls without a progress callback ask meanwhile whether Ctrl-C was
// pressed.
class Released {
 public:
  Released() : outer_(inside()) {
    inside() = true;
    static_cast<void>(ifsm_set_interrupt(ask, nullptr) == IFSM_OK);
    state_ = PyEval_SaveThread();
  }
  Released(const Released &) = delete;
  Released &operator=(const Released &) = delete;
  ~Released() {
    Door::pass([this] { PyEval_RestoreThread(state_); });
    inside() = outer_;
    static_cast<void>(ifsm_set_interrupt(outer_ ? ask : nullptr, nullptr) == IFSM_OK);
  }

 private:
  static std::int32_t ask(void *) {
    const Locked locked;
    if (interrupted().is_empty() && PyErr_CheckSignals() == 0) return 0;
    if (interrupted().is_empty()) interrupted().fetch();
    return 1;
  }
  // Is this call made by a callback of another one of this thread?
  static bool &inside() {
    thread_local bool yes = false;
    return yes;
  }

  PyThreadState *state_;
  bool outer_;
};

// Stands between the library and a callable (or None): what that raises, or Ctrl-C, waits here until the library has
// returned. The library asks at least every 50 ms, so that Ctrl-C is answered even without a callable.
class Progress {
 public:
  Progress() = default;
  Progress(const Progress &) = delete;
  Progress &operator=(const Progress &) = delete;
  ~Progress() { kept_.drop(); }

  bool take(PyObject *given, Argument argument) {
    if (given != Py_None && !PyCallable_Check(given)) return argument.wants("a callable or None", given);
    callable_ = given;  // borrowed: the caller's tuple of arguments keeps it
    return true;
  }

  static std::int32_t tell(void *user, double fraction, const char *stage) {
    const Locked locked;
    return static_cast<Progress *>(user)->ask(fraction, stage);
  }

  // In place of the error that cancelling led to, what was raised.
  void raise_again() {
    if (kept_.is_empty() || !PyErr_Occurred()) return;
    PyErr_Clear();
    kept_.raise();
  }

 private:
  std::int32_t ask(double fraction, const char *stage) {
    if (!kept_.is_empty()) return 1;
    int stop = PyErr_CheckSignals();
    if (stop == 0 && callable_ != Py_None) {
      PyObject *answer = PyObject_CallFunction(callable_, "ds", fraction, stage);
      stop = answer == nullptr ? -1 : PyObject_IsTrue(answer);
      Py_XDECREF(answer);
    }
    if (stop < 0) kept_.fetch();
    return stop == 0 ? 0 : 1;
  }

  PyObject *callable_ = Py_None;
  Kept kept_;
};

// The process's log: a callable that is kept. What it raises is told and goes no further.
inline PyObject *&log_sink() {
  static PyObject *sink = nullptr;  // owned
  return sink;
}

inline void log_line(void *, std::int32_t level, const char *text) {
  const Locked locked;
  if (PyObject *sink = log_sink()) {
    Py_INCREF(sink);
    PyObject *answer = PyObject_CallFunction(sink, "is", static_cast<int>(level), text);
    if (answer == nullptr) PyErr_WriteUnraisable(sink);
    Py_XDECREF(answer);
    Py_DECREF(sink);
  }
}

inline void close_door() { Door::close(); }

}  // namespace ifsm_python
