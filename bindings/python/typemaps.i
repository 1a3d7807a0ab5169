// How Python tells what the C ABI takes and gives; support.h and lock.h do the work.

%begin %{
#define PY_SSIZE_T_CLEAN
%}
%{
#include "python/lock.h"
%}

%define IFSM_ARGUMENT ifsm_python::Argument{"$symname", "$1_name"} %enddef

// Statuses. The interpreter's lock is free while the library works, but where that takes less than giving it away.
%typemap(out) ifsm_status {
  if ($1 != IFSM_OK || !ifsm_python::interrupted().is_empty()) {
    ifsm_python::raise_last_error();
    SWIG_fail;
  }
  $result = SWIG_Py_Void();
}
%exception {
  {
    const ifsm_python::Released released;
    $action
  }
}
%define IFSM_QUICK(FUNCTION) %exception FUNCTION { $action } %enddef
IFSM_QUICK(ifsm_status_name)
IFSM_QUICK(ifsm_version)
IFSM_QUICK(ifsm_version_text)
IFSM_QUICK(ifsm_threads)
IFSM_QUICK(ifsm_set_threads)
IFSM_QUICK(ifsm_cancel_create)
IFSM_QUICK(ifsm_cancel_request)
IFSM_QUICK(ifsm_cancel_requested)
IFSM_QUICK(ifsm_filter_describe)
IFSM_QUICK(ifsm_filter_matrix)
IFSM_QUICK(ifsm_model_describe)
IFSM_QUICK(ifsm_model_filter)
IFSM_QUICK(ifsm_model_control_points)
IFSM_QUICK(ifsm_model_interval)
IFSM_QUICK(ifsm_fit_describe)
IFSM_QUICK(ifsm_fit_describe_budget)
IFSM_QUICK(ifsm_deformer_describe)
IFSM_QUICK(ifsm_system_describe)
IFSM_QUICK(ifsm_system_catalog)

// Numbers and names.
%typemap(in) int32_t, int64_t, uint32_t, uint64_t, double { if (!ifsm_python::take($input, IFSM_ARGUMENT, $1)) SWIG_fail; }
%typemap(in) const char * {
  const char *text = nullptr;
  if (!ifsm_python::take($input, IFSM_ARGUMENT, text)) SWIG_fail;
  $1 = const_cast<char *>(text);
}
%typemap(freearg) const char * ""
%define IFSM_NUMBER_OUT(TYPE, MAKE)
%typemap(in, numinputs = 0) TYPE *TOLD (TYPE told) { told = 0; $1 = &told; }
%typemap(argout) TYPE *TOLD { %append_output(MAKE(*$1)); }
%enddef
IFSM_NUMBER_OUT(int32_t, PyLong_FromLongLong)
IFSM_NUMBER_OUT(int64_t, PyLong_FromLongLong)
IFSM_NUMBER_OUT(double, PyFloat_FromDouble)

// Handles.
%define IFSM_HANDLE(HANDLE)
%typemap(in) HANDLE { if (!ifsm_python::take_handle($input, IFSM_ARGUMENT, $1)) SWIG_fail; }
%typemap(in, numinputs = 0) HANDLE * (ifsm_python::Made<HANDLE> made) { $1 = made.out(); }
%typemap(argout) HANDLE * {
  PyObject *capsule = made$argnum.capsule();
  if (capsule == nullptr) SWIG_fail;
  %append_output(capsule);
}
%enddef
IFSM_HANDLE(ifsm_filter)
IFSM_HANDLE(ifsm_model)
IFSM_HANDLE(ifsm_fit)
IFSM_HANDLE(ifsm_deformer)
IFSM_HANDLE(ifsm_cancel)
IFSM_HANDLE(ifsm_system)

// Arrays. Output arrays are the caller's, too; None asks for the count, which is what a call returns.
%define IFSM_ARRAY_IN(TYPE, DATA, COUNT)
%typemap(in) (const TYPE *DATA, int64_t COUNT) (ifsm_python::View<TYPE> view) {
  if (!view.take($input, IFSM_ARGUMENT, false)) SWIG_fail;
  $1 = view.data();
  $2 = view.size();
}
%enddef
IFSM_ARRAY_IN(double, DOUBLES, DOUBLE_COUNT)
IFSM_ARRAY_IN(int32_t, INTS, INT_COUNT)
IFSM_ARRAY_IN(int64_t, WIDE_INTS, WIDE_INT_COUNT)
IFSM_ARRAY_IN(uint8_t, BYTES, BYTE_COUNT)
IFSM_ARRAY_IN(uint32_t, COUNTS, COUNT_COUNT)

%define IFSM_ARRAY_OUT(TYPE)
%typemap(in) (TYPE *OUTPUT, int64_t capacity, int64_t *count) (ifsm_python::View<TYPE> view, int64_t told) {
  if (!view.take($input, IFSM_ARGUMENT, true)) SWIG_fail;
  $1 = view.data();
  $2 = view.size();
  told = 0;
  $3 = &told;
}
%typemap(argout) (TYPE *OUTPUT, int64_t capacity, int64_t *count) { %append_output(PyLong_FromLongLong(told$argnum)); }
%enddef
IFSM_ARRAY_OUT(double)
IFSM_ARRAY_OUT(int32_t)
IFSM_ARRAY_OUT(uint8_t)
IFSM_ARRAY_OUT(uint32_t)

// Curves, and what is known about them.
%typemap(in) const ifsm_curve *CURVE (ifsm_python::Curves taken) {
  if (!taken.take_one($input, IFSM_ARGUMENT)) SWIG_fail;
  $1 = const_cast<ifsm_curve *>(taken.size() == 0 ? nullptr : taken.data());
}
%typemap(in) (const ifsm_curve *CURVES, int64_t CURVE_COUNT) (ifsm_python::Curves taken) {
  if (!taken.take_list($input, IFSM_ARGUMENT)) SWIG_fail;
  $1 = const_cast<ifsm_curve *>(taken.data());
  $2 = taken.size();
}
%typemap(in) ifsm_bindings::KnownSamples (ifsm_python::Known known) {
  if (!known.take($input, IFSM_ARGUMENT)) SWIG_fail;
  $1 = known.get();
}

// Callbacks.
%typemap(in) (ifsm_progress_callback progress, void *user) (ifsm_python::Progress told) {
  if (!told.take($input, IFSM_ARGUMENT)) SWIG_fail;
  $1 = ifsm_python::Progress::tell;
  $2 = &told;
}
%typemap(freearg) (ifsm_progress_callback progress, void *user) { told$argnum.raise_again(); }
%typemap(in) (ifsm_log_callback sink, void *user) {
  if ($input != Py_None && !PyCallable_Check($input)) {
    IFSM_ARGUMENT.wants("a callable or None", $input);
    SWIG_fail;
  }
  $1 = $input == Py_None ? nullptr : ifsm_python::log_line;
  $2 = nullptr;
  Py_INCREF($input);
  PyObject *before = ifsm_python::log_sink();
  ifsm_python::log_sink() = $input;
  Py_XDECREF(before);
}

// Structs that tell.
%define IFSM_TOLD(STRUCT, NAME)
%typemap(in, numinputs = 0) STRUCT *NAME (STRUCT told) { told = {}; told.struct_size = sizeof told; $1 = &told; }
%typemap(argout) STRUCT *NAME {
  %append_output(SWIG_NewPointerObj(new STRUCT(*$1), $descriptor(STRUCT *), SWIG_POINTER_OWN));
}
%enddef
IFSM_TOLD(ifsm_filter_info, info)
IFSM_TOLD(ifsm_model_info, info)
IFSM_TOLD(ifsm_fit_report, report)
IFSM_TOLD(ifsm_fit_budget, row)
IFSM_TOLD(ifsm_train_report, report)
IFSM_TOLD(ifsm_distances, distances)
IFSM_TOLD(ifsm_dimension_report, report)
IFSM_TOLD(ifsm_spectrum_report, report)
IFSM_TOLD(ifsm_deformer_info, info)
IFSM_TOLD(ifsm_system_entry, entry)
IFSM_TOLD(ifsm_system_info, info)
IFSM_TOLD(ifsm_picture_report, report)

// What makes exceptions: maker(status, function, argument, index, value, required, message).
%exception ifsm_python::set_error_maker { $action }
%exception ifsm_python::close_door { $action }
%typemap(out) std::uintptr_t { $result = PyLong_FromUnsignedLongLong($1); }
namespace ifsm_python {
std::uintptr_t address_of(const double *DOUBLES, int64_t DOUBLE_COUNT);
void set_error_maker(PyObject *maker);
void close_door();  // at exit
}
