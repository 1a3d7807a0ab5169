// ifsm.h for every language, through SWIG: functions, one to one, under their C names.
//
//     swig -python -c++ -builtin -Iinclude -Ibindings -module native bindings/ifsm.i
//
// A language brings a file of typemaps, which say how it tells handles, arrays, curves and callbacks; everything else
// is here, so that all languages call the same functions with the same arguments. Three things differ from C:
//   statuses   become exceptions, and what C writes to its last arguments becomes the result;
//   options    are arguments (options.h), in the order of their structs' fields: a language has no struct that borrows
//              arrays. All must be given: defaults are the affair of the thin layer above, which knows what its users
//              expect (overloads and default arguments hide the real error in several languages);
//   handles    own what they name: what is created is destroyed when the language lets go of it. Ids are never numbers
//              (some languages have doubles alone), so _destroy functions are not there.
%module native

%include <stdint.i>
%{
#include <ifsm.h>

#include "options.h"
%}

// What typemaps are asked for, by the parameters' types and names in C:
//   in    ifsm_filter, ifsm_model, …           a handle; nothing means {0}
//   out   ifsm_filter *, ifsm_model *, …       a new one, owned
//   in    (const double *DOUBLES, int64_t DOUBLE_COUNT), and so int32_t, int64_t, uint8_t, uint32_t
//   out   (double *OUTPUT, int64_t capacity, int64_t *count), and so int32_t, uint8_t, uint32_t
//   in    const ifsm_curve *CURVE; (const ifsm_curve *CURVES, int64_t CURVE_COUNT); KnownSamples
//   in    (ifsm_progress_callback progress, void *user); (ifsm_log_callback sink, void *user)
//   out   int32_t *TOLD, and so int64_t, double: one number
//   out   …_info *, …_report *, …: structs of numbers and names
//   in    const char *; const ifsm_curve *: of a few functions NULL is an answer, which typemaps must know
#if defined(SWIGPYTHON)
%include "python/typemaps.i"
#endif

%apply (const double *DOUBLES, int64_t DOUBLE_COUNT) {
  (const double *matrix, int64_t count), (const double *points, int64_t count), (const double *vectors, int64_t count),
  (const double *parameters, int64_t parameter_count), (const double *queries, int64_t query_count),
  (const double *vectors, int64_t vector_count), (const double *places, int64_t place_count),
  (const double *maps, int64_t count), (const double *parameters, int64_t count),
  (const double *probabilities, int64_t probability_count), (const double *point, int64_t point_count),
  (const double *about, int64_t about_count)
};
%apply (const int32_t *INTS, int64_t INT_COUNT) { (const int32_t *symbols, int64_t symbol_count) };
%apply (const int64_t *WIDE_INTS, int64_t WIDE_INT_COUNT) {
  (const int64_t *handles, int64_t handle_count), (const int64_t *budgets, int64_t budget_count)
};
%apply (const uint8_t *BYTES, int64_t BYTE_COUNT) {
  (const uint8_t *bytes, int64_t count), (const uint8_t *bytes, int64_t byte_count),
  (const uint8_t *stops, int64_t stop_count)
};
%apply (const uint32_t *COUNTS, int64_t COUNT_COUNT) { (const uint32_t *counts, int64_t pixel_count) };
%apply (double *OUTPUT, int64_t capacity, int64_t *count) {
  (double *matrix, int64_t capacity, int64_t *count), (double *points, int64_t capacity, int64_t *count),
  (double *parameters, int64_t capacity, int64_t *count), (double *vectors, int64_t capacity, int64_t *count),
  (double *values, int64_t capacity, int64_t *count), (double *rows, int64_t capacity, int64_t *count),
  (double *curvatures, int64_t capacity, int64_t *count), (double *covariance, int64_t capacity, int64_t *count),
  (double *maps, int64_t capacity, int64_t *count), (double *map, int64_t capacity, int64_t *count),
  (double *probabilities, int64_t capacity, int64_t *count), (double *point, int64_t capacity, int64_t *count),
  (double *box, int64_t capacity, int64_t *count), (double *ball, int64_t capacity, int64_t *count),
  (double *moments, int64_t capacity, int64_t *count), (double *distances, int64_t capacity, int64_t *count)
};
%apply (int32_t *OUTPUT, int64_t capacity, int64_t *count) { (int32_t *symbols, int64_t capacity, int64_t *count) };
%apply (uint8_t *OUTPUT, int64_t capacity, int64_t *count) {
  (uint8_t *bytes, int64_t capacity, int64_t *count), (uint8_t *names, int64_t capacity, int64_t *count),
  (uint8_t *pixels, int64_t capacity, int64_t *count), (uint8_t *rgba, int64_t capacity, int64_t *count)
};
%apply (uint32_t *OUTPUT, int64_t capacity, int64_t *count) { (uint32_t *counts, int64_t capacity, int64_t *count) };
%apply int32_t *TOLD { int32_t *threads, int32_t *requested };
%apply int64_t *TOLD { int64_t *first, int64_t *number };
%apply double *TOLD { double *length, double *first, double *last, double *diameter, double *dimension };
%apply const ifsm_curve *CURVE { const ifsm_curve *curve, const ifsm_curve *polygon };
%apply (const ifsm_curve *CURVES, int64_t CURVE_COUNT) { (const ifsm_curve *curves, int64_t curve_count) };

// Results: structs of numbers and names, read only.
%immutable;
%ignore struct_size;
%ignore reserved;

%warnfilter(314) from;  // a field of options, which no language sees

// What is not for languages: memory, structs that borrow, the record behind exceptions.
%ignore ifsm_last_error;
%ignore ifsm_set_interrupt;  // the affair of a language's typemaps, which know its Ctrl-C
%ignore ifsm_error;
%ignore ifsm_curve;
%ignore ifsm_fit_samples;
%rename("$ignore", regextarget = 1) "^ifsm_.*_options(_init)?$";
%ignore ifsm_bindings::defaults;
%ignore ifsm_bindings::KnownSamples;
%rename("$ignore", regextarget = 1) "^ifsm_.*_destroy$";
%rename("$ignore", %$isclass) ifsm_filter;
%rename("$ignore", %$isclass) ifsm_model;
%rename("$ignore", %$isclass) ifsm_fit;
%rename("$ignore", %$isclass) ifsm_deformer;
%rename("$ignore", %$isclass) ifsm_cancel;
%rename("$ignore", %$isclass) ifsm_system;

// Functions with options: the header's own are hidden by those of options.h, which have their names.
%define IFSM_WITH_OPTIONS(FUNCTION)
%ignore ::FUNCTION;
%rename("%s") ifsm_bindings::FUNCTION;
%enddef
IFSM_WITH_OPTIONS(ifsm_model_create)
IFSM_WITH_OPTIONS(ifsm_model_keep)
IFSM_WITH_OPTIONS(ifsm_model_dimension)
IFSM_WITH_OPTIONS(ifsm_model_refine)
IFSM_WITH_OPTIONS(ifsm_fit_sparse)
IFSM_WITH_OPTIONS(ifsm_fit_curve)
IFSM_WITH_OPTIONS(ifsm_fit_filter)
IFSM_WITH_OPTIONS(ifsm_train)
IFSM_WITH_OPTIONS(ifsm_deformer_create)
IFSM_WITH_OPTIONS(ifsm_deformer_move)
IFSM_WITH_OPTIONS(ifsm_deformer_restyle)
IFSM_WITH_OPTIONS(ifsm_deformer_texture)
IFSM_WITH_OPTIONS(ifsm_system_histogram)
IFSM_WITH_OPTIONS(ifsm_system_set)
IFSM_WITH_OPTIONS(ifsm_system_distances)
IFSM_WITH_OPTIONS(ifsm_system_render)
IFSM_WITH_OPTIONS(ifsm_tone_map)
IFSM_WITH_OPTIONS(ifsm_system_sample)
IFSM_WITH_OPTIONS(ifsm_system_sample_addresses)

// What these are made of.
%ignore ifsm_bindings::watched;
%ignore ifsm_bindings::picture;

%include "ifsm.h"
%include "options.h"
