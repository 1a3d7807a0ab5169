/* ifsm.h — fractal detail models of measured curves, and iterated function systems, behind a stable C ABI.
 *
 * A complete program: fit a model to samples, keep its 32 most significant details, read the curve back.
 *
 *     #include <ifsm.h>
 *     #include <stdio.h>
 *
 *     int main(void) {
 *       double samples[257 * 2];                       // x0 y0 x1 y1 …: ordered points, any finite doubles
 *       for (int k = 0; k < 257; ++k) { samples[2*k] = k; samples[2*k + 1] = (k * k) % 101; }
 *       ifsm_curve curve = {samples, 257, 2, 0};       // borrowed while the call runs
 *       ifsm_fit fit = {0};
 *       ifsm_model model = {0}, sketch = {0};
 *       ifsm_keep_options keep;
 *       double points[257 * 2];
 *       int64_t count = 0;
 *       if (ifsm_keep_options_init(&keep, sizeof keep)) return 1;
 *       keep.rule = IFSM_KEEP_COUNT, keep.count = 32, keep.resolve = IFSM_RESOLVE_CHOICE;
 *       if (ifsm_fit_sparse(&curve, 1, NULL, &fit) || ifsm_fit_model(fit, 0, &model) ||
 *           ifsm_model_keep(model, &keep, &sketch) || ifsm_model_samples(sketch, points, 257 * 2, &count)) {
 *         ifsm_error error = {.struct_size = sizeof error};
 *         if (ifsm_last_error(&error) == IFSM_OK) fprintf(stderr, "%s\n", error.message);
 *       }
 *       int failed = count == 0;
 *       failed |= ifsm_model_destroy(sketch) | ifsm_model_destroy(model) | ifsm_fit_destroy(fit);
 *       return failed;
 *     }
 *
 * What holds everywhere
 *   Results    Every function that can fail returns an ifsm_status. Outputs come last and are written only on
 *              IFSM_OK. After a failure, ifsm_last_error() tells the function, the argument, the index, the value
 *              and the way out.
 *   Handles    are small values; copy them freely. A stale, doubly destroyed, forged or wrong-kind handle gives
 *              IFSM_ERROR_INVALID_HANDLE, never undefined behaviour. The null handle {0} may be destroyed.
 *   Lifetimes  Filters, models and fits are immutable: share them between threads. Destroying one while another
 *              thread is inside a call with it kills the handle; the object lives until that call ends. A handle
 *              that a function *creates* is owned by the caller, who destroys it. *Borrowed*: used during the call
 *              only. *Copied*: taken during the call; the caller may free the original afterwards.
 *   Arrays     are a pointer and a count; points are interleaved (x0 y0 x1 y1 …), doubles, finite or refused with
 *              the index of the first bad one. Output arrays are the caller's: `NULL, 0` asks for the count alone;
 *              one that is too small gives IFSM_ERROR_CAPACITY with the count needed in the error record and stays
 *              untouched. Counts and capacities of arrays of doubles count doubles, unless a comment says points.
 *   Options    start with struct_size; ifsm_…_options_init(&o, sizeof o) sets it and zeroes the rest, and a field
 *              that is zero means its default. A NULL pointer means all defaults. A larger struct from a newer
 *              header is accepted when the tail that this library does not know is zero, a smaller one from an
 *              older header always. Result structs (`…_info`, `…_report`) want struct_size set, likewise; fields
 *              that this library is too old to know are left alone. Sizes that no header has (below 8, above 4096, not
 *              a multiple of 4) give IFSM_ERROR_OPTIONS.
 *   Callbacks  run on the calling thread, never two at once, never under a lock; they may call the library.
 *   Threads    Every function may be called from any thread. Results have the same bits for any number of threads.
 *   Honest limit: a pointer and a length cannot be verified. Misuse of a handle is an error code; misuse of memory
 *              is not.
 *
 * The names: a curve is cut into maps^levels *nodes*; each node has a *control polygon* of n points; the *filter*
 * R = (T over U) makes the polygons of its children out of a polygon and a few *detail* vectors (synthesis), and
 * R^-1 takes them apart (analysis). Source of the model: "projected IFS with details", paper 002 of docs/papers.md.
 */
#ifndef IFSM_H
#define IFSM_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define IFSM_API __attribute__((visibility("default")))
#define IFSM_MUST_USE __attribute__((warn_unused_result))
#else
#define IFSM_API
#define IFSM_MUST_USE
#endif

/* ------------------------------------------------------------------------------------------------------------
 * Statuses and errors
 */

/* Zero is success. A value, once published, means the same for ever; new ones are added at the end. */
typedef int32_t ifsm_status;

enum {
  IFSM_OK = 0,
  IFSM_ERROR_INVALID_HANDLE = 1, /* null, stale, destroyed, forged, or of another kind */
  IFSM_ERROR_NULL = 2,           /* a pointer that must not be NULL is */
  IFSM_ERROR_RANGE = 3,          /* a number, index, count or constant outside its range */
  IFSM_ERROR_NOT_FINITE = 4,     /* NaN or an infinity among the doubles */
  IFSM_ERROR_SHAPE = 5,          /* sizes that do not fit each other */
  IFSM_ERROR_SINGULAR = 6,       /* a filter that cannot be inverted, or whose columns do not sum to one */
  IFSM_ERROR_CAPACITY = 7,       /* an output array is too small; the record holds the count needed */
  IFSM_ERROR_OPTIONS = 8,        /* an options struct's struct_size, or an unknown tail that is not zero */
  IFSM_ERROR_FORMAT = 9,         /* bytes that are not a model, or contradict themselves */
  IFSM_ERROR_VERSION = 10,       /* bytes of a newer schema than this library reads */
  IFSM_ERROR_LIMIT = 11,         /* more than this library takes: size, depth */
  IFSM_ERROR_CANCELLED = 12,     /* a callback or a cancel token said stop */
  IFSM_ERROR_BUSY = 13,          /* a mutable object is in use by another call */
  IFSM_ERROR_MEMORY = 14,        /* an allocation failed; everything is as it was before the call */
  IFSM_ERROR_NUMERICAL = 15,     /* the numbers left the range of doubles on the way */
  IFSM_ERROR_INTERNAL = 16       /* a fault of this library: please report it */
};

/* What went wrong in this thread's last failing call. */
typedef struct ifsm_error {
  uint32_t struct_size;
  ifsm_status status;
  const char *function; /* e.g. "ifsm_model_create" */
  const char *argument; /* the parameter or the field, e.g. "samples"; "" when none is to blame */
  int64_t index;        /* position in the argument; -1 when it has none */
  double value;         /* the offending value; NaN when there is none */
  int64_t required;     /* what a count must be (CAPACITY, SHAPE); -1 when nothing is asked for */
  const char *message;  /* a full sentence: what is wrong and what to do */
} ifsm_error;

/* The record of this thread's last failing call. Success never clears it; before any failure its status is IFSM_OK.
 *
 * error   [out] with struct_size set; its strings are borrowed until this thread's next failing call
 *
 * Does not itself change the record. Errors: NULL, OPTIONS. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_last_error(ifsm_error *error);

/* The name of a status, e.g. "IFSM_ERROR_RANGE"; "unknown status" for any other number. Static storage. Since 0.1. */
IFSM_API const char *ifsm_status_name(ifsm_status status);

/* ------------------------------------------------------------------------------------------------------------
 * The library: versions, threads, log
 */

/* The version of the library that runs, as 10000 major + 100 minor + patch, and as text. Since 0.1. */
IFSM_API int32_t ifsm_version(void);
IFSM_API const char *ifsm_version_text(void);

/* How many threads a call may use that says 0 itself: 1 … 1024, or 0 for one a core (the default). Affects calls
 * that start later; never affects results. Errors: RANGE. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_set_threads(int32_t threads);

/* threads   [out] the setting, 0 for one a core. Errors: NULL. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_threads(int32_t *threads);

/* A log sink: lines of diagnosis, one call each, `text` borrowed during the call. level 0 info, 1 warning. */
typedef void (*ifsm_log_callback)(void *user, int32_t level, const char *text);

/* Sends this process's diagnosis to `sink`; NULL, the default, turns it off. The library never prints.
 * Set it before other threads use the library. `user` is handed through. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_set_log(ifsm_log_callback sink, void *user);

/* ------------------------------------------------------------------------------------------------------------
 * Cancel tokens and progress
 */

typedef struct ifsm_cancel {
  uint64_t id;
} ifsm_cancel;

/* cancel   [out] a new token, owned by the caller. Errors: NULL, MEMORY. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_cancel_create(ifsm_cancel *cancel);

/* Asks every call that was given the token to stop: they answer IFSM_ERROR_CANCELLED within 100 ms and leave nothing
 * behind. Final. May be called from a signal handler's thread, not from the handler itself. Errors: INVALID_HANDLE.
 * Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_cancel_request(ifsm_cancel cancel);

/* requested   [out] 1 after ifsm_cancel_request, else 0. Errors: INVALID_HANDLE, NULL. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_cancel_requested(ifsm_cancel cancel, int32_t *requested);

/* Calls that hold the token finish undisturbed. {0} is fine. Errors: INVALID_HANDLE. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_cancel_destroy(ifsm_cancel cancel);

/* fraction grows from 0 to 1; stage is a word, borrowed. Return non-zero to cancel. Told at least every 50 ms, or when
 * as much time has passed as its last call took: one that is slow costs half of the time at most. */
typedef int32_t (*ifsm_progress_callback)(void *user, double fraction, const char *stage);

/* Return non-zero to cancel. */
typedef int32_t (*ifsm_interrupt_callback)(void *user);

/* What every call of this thread asks about every 50 ms, also one that takes no cancel token (one that is given a
 * progress callback may ask both): whether to stop, which it does with IFSM_ERROR_CANCELLED, leaving nothing behind. For an
 * interpreter's Ctrl-C. A new one takes the last one's place; NULL, the default, asks nothing. Stretches that cannot be
 * interrupted: an allocation, sorting. `user` is handed through. Errors: none. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_set_interrupt(ifsm_interrupt_callback ask, void *user);

/* ------------------------------------------------------------------------------------------------------------
 * Filters: the matrix R = (T_0 … T_N-1 over U_0 … U_N-1), and how neighbouring polygons share their places
 */

typedef struct ifsm_filter {
  uint64_t id;
} ifsm_filter;

/* Topologies. Joined: neighbours share end points, so every change of details leaves the curve in one piece; R is
 * K × K, K = (n-1) N + 1, its first n rows C the distinct columns of (T_0 … T_N-1), the others U with first and last
 * column 0. Square (paper 002): R is nN × nN; leaf polygon q, column c reads place q·stride + c. */
enum { IFSM_TOPOLOGY_JOINED = 0, IFSM_TOPOLOGY_SQUARE = 1 };

typedef struct ifsm_filter_info {
  uint32_t struct_size;
  int32_t topology;         /* IFSM_TOPOLOGY_… */
  int32_t control_points;   /* n: 2 … 16 joined, 1 … 16 square */
  int32_t maps;             /* N: 2 … 8 */
  int32_t stride;           /* places between neighbouring leaf polygons; n - 1 when joined */
  int32_t rows;             /* R is rows × rows */
  int32_t details_per_node; /* (n-1)(N-1) joined, n(N-1) square */
  int32_t contractive;      /* 1 proven, -1 refuted, 0 undecided: T on vectors of sum zero, all words */
  double condition;         /* 2-norm condition number of R */
} ifsm_filter_info;

/* A filter by name, as a wavelet is chosen.
 *
 * name            borrowed, NUL-terminated. "coast": joined, n = 5, N = 2: trained on coastlines, where a fit starts
 *                 that is told nothing else. "casteljau": joined or square, any n and N: subdivides a Bézier polygon
 *                 into N pieces. Square ones, with their own n and N: "haar" (1, 2), "bspline" (4, 2: uniform cubic),
 *                 "four-point" (6, 2), "koch" (3, 4), "takagi" (3, 2)
 * topology        IFSM_TOPOLOGY_…
 * control_points  n, or 0 for the name's own (casteljau: 5)
 * maps            N, or 0 for the name's own (casteljau: 2)
 * filter          [out] owned by the caller
 *
 * Errors: NULL, RANGE (an unknown name lists the known ones; a shape that the name does not have), MEMORY.
 * Source: math of paper 002, section 3; U is the canonical complement, see ifsm_filter_from_maps. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_filter_named(const char *name, int32_t topology, int32_t control_points,
                                                     int32_t maps, ifsm_filter *filter);

/* A filter from the whole of R.
 *
 * topology, control_points, maps   as in ifsm_filter_info
 * stride   places between neighbouring leaf polygons, 1 … n; 0 for n - 1 (joined: only that; n = 1: 1)
 * matrix   copied: rows × rows doubles, row-major
 * count    doubles in `matrix`
 * filter   [out] owned by the caller
 *
 * Errors: NULL, RANGE, SHAPE (count), NOT_FINITE, SINGULAR (a column of T whose sum is not 1, a joint that is not
 * shared, R not invertible in double precision), MEMORY. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_filter_from_matrix(int32_t topology, int32_t control_points, int32_t maps,
                                                           int32_t stride, const double *matrix, int64_t count,
                                                           ifsm_filter *filter);

/* A filter from T alone, with the canonical complement U: square, the orthogonal complement of T's rows, scaled into
 * T's singular values; joined, interior columns orthogonal to those of the interior rows. Analysis is then least
 * squares (joined: with both ends fixed).
 *
 * matrix   copied: joined C, n × ((n-1) N + 1) doubles; square (T_0 | … | T_N-1), n × nN; row-major
 *
 * Everything else, and the errors, as ifsm_filter_from_matrix. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_filter_from_maps(int32_t topology, int32_t control_points, int32_t maps,
                                                         int32_t stride, const double *matrix, int64_t count,
                                                         ifsm_filter *filter);

/* info   [out] with struct_size set. Errors: INVALID_HANDLE, NULL, OPTIONS. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_filter_describe(ifsm_filter filter, ifsm_filter_info *info);

/* R, row-major.
 *
 * matrix     [out] rows × rows doubles
 * capacity   doubles that `matrix` can hold; NULL and 0 ask for the count only
 * count      [out] rows × rows
 *
 * Errors: INVALID_HANDLE, NULL, CAPACITY. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_filter_matrix(ifsm_filter filter, double *matrix, int64_t capacity,
                                                      int64_t *count);

/* Models made with the filter keep it alive. {0} is fine. Errors: INVALID_HANDLE. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_filter_destroy(ifsm_filter filter);

/* ------------------------------------------------------------------------------------------------------------
 * Models: a control polygon, a filter, and a tree of details
 */

typedef struct ifsm_model {
  uint64_t id;
} ifsm_model;

/* Ordered samples. */
typedef struct ifsm_curve {
  const double *points; /* count × dimension doubles, point-major */
  int64_t count;        /* points: 2 … */
  int32_t dimension;    /* 1 … 4 */
  int32_t closed;       /* 1: a ring, the first point not repeated at the end; 0: open */
} ifsm_curve;

typedef struct ifsm_model_options {
  uint32_t struct_size;
  int32_t levels; /* depth of the tree; 0: the smallest with a place for every sample */
} ifsm_model_options;

/* Sets struct_size to `size` and everything else to zero, which is the default. Errors: NULL, OPTIONS. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_model_options_init(ifsm_model_options *options, uint32_t size);

typedef struct ifsm_model_info {
  uint32_t struct_size;
  int32_t dimension;        /* 1 … 4 */
  int32_t closed;           /* 0 or 1 */
  int32_t levels;           /* L: details of levels 0 … L - 1, samples at level L */
  int32_t control_points;   /* n */
  int32_t maps;             /* N */
  int32_t topology;         /* IFSM_TOPOLOGY_… */
  int32_t details_per_node; /* detail vectors of a node */
  int64_t samples;          /* how many samples the model was made from */
  int64_t places;           /* points of level L: at least `samples` */
  int64_t details;          /* detail vectors in all */
  int64_t details_kept;     /* those that are not zero */
  double diagonal;          /* of the samples' bounding box */
  double largest_polygon;   /* largest coordinate of any polygon, from the centre, in diagonals: what rounding of the
                               reconstruction is proportional to (n > 12 makes it grow) */
} ifsm_model_info;

/* The exact model of ordered samples: analysis from level L up to the control points. No fit takes place.
 *
 * filter    borrowed (the model keeps its matrix)
 * curve     borrowed; sample k of m sits at place (2k(g-1) + m-1) div (2(m-1)) of the g places of level L (closed:
 *           k g div m); places between are filled linearly. (n-1) N^L + 1 samples (closed: one less) fill every
 *           place; of other counts smooth curves look rougher than they are (docs/fitting.md)
 * options   borrowed; NULL for defaults
 * model     [out] owned by the caller
 *
 * ifsm_model_samples gives the samples back within 1e-12 of their bounding box's diagonal for n <= 12; beyond, within
 * c·eps·largest_polygon. Errors: INVALID_HANDLE, NULL, RANGE, NOT_FINITE (index: the double), LIMIT, NUMERICAL,
 * OPTIONS, MEMORY. Any thread. Source: paper 002, eq. (7). Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_model_create(ifsm_filter filter, const ifsm_curve *curve,
                                                     const ifsm_model_options *options, ifsm_model *model);

/* A model without samples: a control polygon, zero details, `levels` levels (edit them by ifsm_model_with_details).
 * Its samples are its places.
 *
 * filter      borrowed
 * polygon     borrowed: n control points; closed: the last one equal to the first when joined
 * levels      0 … as long as the places fit into memory (2^40 are refused)
 * model       [out] owned by the caller
 *
 * Errors: as ifsm_model_create, and SHAPE when polygon->count is not n. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_model_from_polygon(ifsm_filter filter, const ifsm_curve *polygon,
                                                           int32_t levels, ifsm_model *model);

/* info   [out] with struct_size set. A look-up: tens of nanoseconds. Errors: INVALID_HANDLE, NULL, OPTIONS.
 * Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_model_describe(ifsm_model model, ifsm_model_info *info);

/* filter   [out] a handle on the model's filter, owned by the caller. Errors: INVALID_HANDLE, NULL, MEMORY.
 * Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_model_filter(ifsm_model model, ifsm_filter *filter);

/* {0} is fine. Errors: INVALID_HANDLE. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_model_destroy(ifsm_model model);

/* The curve at the samples: what the model was made from, unless details were dropped or edited.
 *
 * points     [out] samples × dimension doubles, point-major
 * capacity   doubles that `points` can hold; NULL and 0 ask for the count only
 * count      [out] doubles
 *
 * Errors: INVALID_HANDLE, NULL, CAPACITY, MEMORY. Any thread. Source: paper 002, eq. (6). Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_model_samples(ifsm_model model, double *points, int64_t capacity,
                                                      int64_t *count);

/* Synthesis down to a level: its control polygons joined into one line. Level 0 is the control polygon, level L the
 * finest curve.
 *
 * level    0 … L
 * points   [out] joined: ((n-1) N^level + 1) × dimension doubles (closed: the last point repeats the first); square:
 *          the polygons laid on their places, those read twice averaged, stride (N^level - 1) + n points (closed:
 *          stride N^level)
 *
 * Errors: INVALID_HANDLE, NULL, RANGE, CAPACITY, MEMORY. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_model_points(ifsm_model model, int32_t level, double *points, int64_t capacity,
                                                     int64_t *count);

/* What ifsm_model_evaluate follows: the polyline through the finest places, or the limit of going on below the
 * finest level with zero details. */
enum { IFSM_CURVE_POLYLINE = 0, IFSM_CURVE_LIMIT = 1 };

/* The curve at parameters.
 *
 * curve        IFSM_CURVE_…
 * parameters   borrowed: 0 … 1, from the first place to the last; closed: any finite number, its fraction counts
 * parameter_count   how many
 * points       [out] parameter_count × dimension doubles
 *
 * At a sample's parameter (ifsm_model_parameters) the polyline returns the sample. LIMIT needs contractive maps.
 * Errors: INVALID_HANDLE, NULL, RANGE, NOT_FINITE, CAPACITY, NUMERICAL, MEMORY. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_model_evaluate(ifsm_model model, int32_t curve, const double *parameters,
                                                       int64_t parameter_count, double *points, int64_t capacity,
                                                       int64_t *count);

/* parameters   [out] the parameter of each sample, increasing. Errors: INVALID_HANDLE, NULL, CAPACITY. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_model_parameters(ifsm_model model, double *parameters, int64_t capacity,
                                                         int64_t *count);

/* The address of a parameter: the first `length` symbols of its base-N expansion, each 0 … N-1. Parameter 1 of an open
 * curve has the address N-1 N-1 …; a joint has two addresses, the one that starts there is given.
 *
 * parameter   as in ifsm_model_evaluate
 * length      1 … 1024
 * symbols     [out] room for `length` symbols
 *
 * Errors: INVALID_HANDLE, NULL, RANGE, NOT_FINITE, CAPACITY. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_model_address(ifsm_model model, double parameter, int32_t length,
                                                      int32_t *symbols, int64_t capacity, int64_t *count);

/* And back: the parameters [first, last] of the node that an address names.
 *
 * symbols       borrowed: 0 … N-1
 * symbol_count  0 … 1024; 0 is the whole curve
 * first, last   [out]
 *
 * Errors: INVALID_HANDLE, NULL, RANGE. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_model_interval(ifsm_model model, const int32_t *symbols, int64_t symbol_count,
                                                       double *first, double *last);

/* points   [out] n × dimension doubles: the control polygon of the root. Errors: INVALID_HANDLE, NULL, CAPACITY.
 * Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_model_control_points(ifsm_model model, double *points, int64_t capacity,
                                                             int64_t *count);

/* How detail vectors are told. Absolute: in the samples' axes and units. Node: in the frame of their node's own
 * polygon (turned back by the turns of the polygons above it, in units of the polygon's size), so that they follow
 * the polygon wherever it goes. */
enum { IFSM_FRAME_ABSOLUTE = 0, IFSM_FRAME_NODE = 1 };

/* Details of one level, as stored: what synthesis adds on the way down.
 *
 * level     0 (coarsest) … L - 1
 * frame     IFSM_FRAME_…
 * vectors   [out] N^level × details_per_node × dimension doubles, node by node, point-major
 *
 * Errors: INVALID_HANDLE, NULL, RANGE, CAPACITY, MEMORY. Any thread. Source: paper 002, eq. (7). Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_model_details(ifsm_model model, int32_t level, int32_t frame, double *vectors,
                                                      int64_t capacity, int64_t *count);

/* How much each detail of a level does to the curve: |detail| · g, g² the sum over all places of the squared change
 * that a unit detail makes.
 *
 * values   [out] N^level × details_per_node doubles
 *
 * Errors: INVALID_HANDLE, NULL, RANGE, CAPACITY, MEMORY. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_model_significance(ifsm_model model, int32_t level, double *values,
                                                           int64_t capacity, int64_t *count);

/* A new model with other control points.
 *
 * frame       ABSOLUTE: details stay as they are; NODE: they turn and scale as their own polygons do, so that texture
 *             follows the curve; a part that moves as a whole is moved as a whole. For "casteljau" and its kind: under
 *             trained and fitted filters details of several levels cancel, and ABSOLUTE bends better (docs/fitting.md)
 * points      borrowed: n × dimension doubles; of a closed joined model the last one is the first
 * count       doubles in `points`
 * changed     [out] owned by the caller
 *
 * Errors: INVALID_HANDLE, NULL, RANGE, SHAPE, NOT_FINITE, MEMORY. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_model_with_control_points(ifsm_model model, int32_t frame, const double *points,
                                                                  int64_t count, ifsm_model *changed);

/* A new model with other details at one level; the other levels stay as told in the same frame.
 *
 * vectors   borrowed: as many doubles as ifsm_model_details gives
 *
 * Errors: as ifsm_model_with_control_points. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_model_with_details(ifsm_model model, int32_t level, int32_t frame,
                                                           const double *vectors, int64_t count, ifsm_model *changed);

/* A new model with another filter of the same shape; control points and details stay. (To take the samples apart
 * with another filter, make a model of them: ifsm_model_create.)
 *
 * Errors: INVALID_HANDLE, NULL, SHAPE, MEMORY. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_model_with_filter(ifsm_model model, ifsm_filter filter, ifsm_model *changed);

/* Which details to keep. */
enum {
  IFSM_KEEP_LEVELS = 1,   /* all details of the first `count` levels */
  IFSM_KEEP_COUNT = 2,    /* the `count` most significant ones (control points not counted); under a filter that was
                             fitted its details are large and cancel, and size misleads: add IFSM_RESOLVE_CHOICE */
  IFSM_KEEP_THRESHOLD = 3,     /* those whose significance is above `threshold` */
  IFSM_KEEP_WITHIN = 4,        /* as few as bring the sketch to within `threshold` of the curve, by `distance` */
  IFSM_KEEP_LEVELS_WITHIN = 5  /* all of as few levels (not with IFSM_RESOLVE_CHOICE) */
};

/* How far two curves are from each other. */
enum {
  IFSM_DISTANCE_RMS = 0,      /* root of the mean square between samples of the same number */
  IFSM_DISTANCE_LARGEST = 1,  /* the largest between them */
  IFSM_DISTANCE_HAUSDORFF = 2 /* between the polylines through their finest places, edges and all: the farthest that one
                                 is from the other, to a millionth; where along the curve it is does not count */
};

/* What becomes of the values that are kept. */
enum {
  IFSM_RESOLVE_NONE = 0,   /* they stay as analysis gave them */
  IFSM_RESOLVE_VALUES = 1, /* control points and kept details are solved anew: least squares against the samples, and
                              against the straight lines between them, where a place counts a quarter: it would fly
                              off if nothing held it */
  IFSM_RESOLVE_CHOICE = 2  /* and which details are kept is bettered, their number staying: the nearest sketch found, the
                              slowest (joined; square: as VALUES); ifsm_fit_sketch has the one that a fit ended with */
};

typedef struct ifsm_keep_options {
  uint32_t struct_size;
  int32_t rule; /* IFSM_KEEP_… */
  int64_t count;
  double threshold;
  int32_t resolve; /* IFSM_RESOLVE_… */
  int32_t distance; /* IFSM_DISTANCE_…: what a bound is measured by, and what solving makes small (square: solving always
                       makes the RMS small) */
  ifsm_cancel cancel; /* borrowed; {0} for none */
  ifsm_progress_callback progress; /* may be NULL; searches tell it */
  void *user;                      /* handed to `progress` */
} ifsm_keep_options;

/* Sets struct_size to `size` and everything else to zero, which is the default. Errors: NULL, OPTIONS. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_keep_options_init(ifsm_keep_options *options, uint32_t size);

/* A new model whose other details are zero: a sketch of the curve.
 *
 * options   borrowed; must name a rule
 * kept      [out] owned by the caller
 *
 * WITHIN: the search tries counts, taking more details to be nearer, until what one detail fewer gives is not within the
 * bound; with RESOLVE_CHOICE and a distance other than RMS, one in 32 fewer. `threshold` is in the samples' units, at
 * least 1e-12 of their diagonal (RANGE): models promise no more. At 4097 points a choice for Hausdorff takes about a
 * second, and a search of several such choices five to ten; others take less than one.
 *
 * Errors: INVALID_HANDLE, NULL, RANGE, NOT_FINITE, OPTIONS, CANCELLED, MEMORY. Any thread; the callback runs on this one.
 * Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_model_keep(ifsm_model model, const ifsm_keep_options *options,
                                                   ifsm_model *kept);

/* File formats: one schema (docs/format.md), as JSON text or CBOR bytes. Doubles come back bit for bit. */
enum { IFSM_FORMAT_JSON = 0, IFSM_FORMAT_CBOR = 1, IFSM_FORMAT_FRACTINT = 2 /* systems alone */ };

/* A model as bytes. Details that are zero are not stored.
 *
 * format     IFSM_FORMAT_…
 * bytes      [out] the file; JSON is UTF-8 without a terminating NUL
 * capacity   bytes that `bytes` can hold; NULL and 0 ask for the count only
 * count      [out] bytes
 *
 * Errors: INVALID_HANDLE, NULL, RANGE, CAPACITY, LIMIT and NUMERICAL
 * (what ifsm_model_load would refuse), MEMORY. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_model_save(ifsm_model model, int32_t format, uint8_t *bytes, int64_t capacity,
                                                   int64_t *count);

/* A model from bytes of either format (told apart by the first byte). Depth, size and time are bounded; what
 * contradicts itself is refused.
 *
 * bytes   borrowed
 * count   how many
 * model   [out] owned by the caller
 *
 * Errors: NULL, RANGE, FORMAT (index: the byte, or the entry named in the message), VERSION, LIMIT, NOT_FINITE, SHAPE,
 * SINGULAR, MEMORY. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_model_load(const uint8_t *bytes, int64_t count, ifsm_model *model);

/* ------------------------------------------------------------------------------------------------------------
 * Fits: the filter under which few details say much
 */

typedef struct ifsm_fit {
  uint64_t id;
} ifsm_fit;

typedef struct ifsm_fit_options {
  uint32_t struct_size;
  int32_t threads;        /* at most so many, 0: as ifsm_set_threads says; curves share them, and long curves' parts */
  ifsm_filter start;      /* borrowed: where to start, joined, its shape instead of the one below; {0}: coast where it
                             has that shape, else casteljau */
  int32_t control_points; /* n, 2 … 16; 0: 5; -1: chosen among 2 … 6 */
  int32_t maps;           /* N, 2 … 8; 0: 2; -1: chosen among 2 … 4 */
  const int64_t *budgets; /* borrowed: how many vectors, control points and details together, a sketch may hold that
                             is to be near its curve: from n to what the model of the smallest curve holds. One tells
                             the curve best by that many; several make a filter that is good at all. NULL: 128 alone, or
                             a quarter of the samples of smaller curves */
  int64_t budget_count;   /* 0 … 64 */
  int32_t iterations;     /* Levenberg-Marquardt iterations a round at most, 1 … 1000; 0: 40 */
  int32_t rounds;         /* rounds of sparsity, each with its scale estimated anew, 1 … 100; -1: none; 0: 2, or none from
                             coast to budgets of 128 and more, where they find little and take most of the time */
  int32_t polish;         /* rounds on the sketches' own error, 1 … 100; 0: 8; -1: none */
  int32_t distance;       /* IFSM_DISTANCE_…, with `within` */
  ifsm_cancel cancel;     /* borrowed; {0} for none */
  ifsm_progress_callback progress; /* may be NULL */
  void *user;                      /* handed to `progress` */
  double within; /* above 0: instead of budgets, a bound that sketches keep, by as few details as are found: as
                    IFSM_KEEP_WITHIN, in the samples' units. The shape is not chosen. 0: none */
} ifsm_fit_options;

/* Sets struct_size to `size` and everything else to zero, which is the default. Errors: NULL, OPTIONS. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_fit_options_init(ifsm_fit_options *options, uint32_t size);

/* Which stage a fit is of: docs/fitting.md says which for what. */
enum { IFSM_STAGE_SPARSE = 0, IFSM_STAGE_CURVE = 1, IFSM_STAGE_FILTER = 2 };

/* Why a fit stopped. */
enum {
  IFSM_FIT_CONVERGED = 0,  /* no step improves the cost any more */
  IFSM_FIT_ITERATIONS = 1, /* all iterations were used */
  IFSM_FIT_START_BEST = 2  /* nothing found was better than the start at every budget: the start is returned */
};

typedef struct ifsm_fit_report {
  uint32_t struct_size;
  int32_t reason; /* IFSM_FIT_… */
  int64_t curves;
  int64_t budgets;
  int64_t iterations;     /* Levenberg-Marquardt iterations, all rounds */
  double start_cost;      /* the stage's objective, of the start (sparse: sparsity, of its last round; without
                             any, the sketches' weighted squared error, of the last polish) */
  double final_cost;      /* and of the result */
  double start_condition; /* condition number of R */
  double final_condition;
  int32_t stage;          /* IFSM_STAGE_… */
  int32_t reserved;
  int64_t freedom;        /* stages curve and filter: coordinates of samples beyond the parameters that they determine */
  double noise;           /* and the standard deviation of a residual of weight 1, estimated by them; 1 when covariances
                             told it, 0 when nothing does */
} ifsm_fit_report;

/* How well a curve is told by one budget: distances between its samples and the best sketch that was found, under the
 * filter it started from and under the fitted one. In the samples' units. */
typedef struct ifsm_fit_budget {
  uint32_t struct_size;
  int32_t reserved;
  int64_t budget;  /* as asked for: control points and details; to a tolerance: what the sketch needs */
  int64_t details; /* details alone */
  double start_rms;
  double start_max;
  double rms;
  double max;
  int64_t start_details; /* of the start's sketch: to a tolerance it may hold more */
} ifsm_fit_budget;

/* Stage *sparse*: fits all of R to curves that share it, so that few details tell them. First minimises
 * sum log(1 + |detail|² g² / eps²) by Levenberg-Marquardt, eps following the error at the budgets; then, the choice of
 * details bettered and held, the squared error of the solved sketches themselves, in turns.
 *
 * curves        borrowed: all of one dimension
 * curve_count   1 …
 * options       borrowed; NULL for defaults
 * fit           [out] owned by the caller: at every budget asked for, its RMS is at most the start's, or rounding (the
 *               maximum may grow)
 *
 * To a tolerance (`within`), each curve has one budget: the sketch that keeps the bound. The details that the start needs
 * are found, R is fitted at as many, and those that it needs are found; are they not fewer, all curves taken together, the
 * start is returned. By Hausdorff distance that takes some ten seconds at 4097 points.
 *
 * R's free entries, (R's rows - 1)(rows - 2), are at most 1024 (LIMIT). A fit of 4097 points in the plane at 128 vectors
 * takes a fifth of a second, at 16 or 1000 about one. To bend a curve by its control points, "casteljau" makes better handles than a fitted filter:
 * docs/fitting.md.
 *
 * Errors: NULL, RANGE, SHAPE, NOT_FINITE, INVALID_HANDLE, CANCELLED, NUMERICAL, LIMIT, OPTIONS, MEMORY. Deterministic.
 * The callbacks run on this thread. Source: paper 002, section 4; docs/fitting.md. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_fit_sparse(const ifsm_curve *curves, int64_t curve_count,
                                                   const ifsm_fit_options *options, ifsm_fit *fit);

/* Where stage *curve* looks for samples on the curve: parameters 0 … 1, from the first place to the last. */
enum {
  IFSM_PARAMETERS_INDEX = 0,       /* at their places, as ifsm_model_create puts them */
  IFSM_PARAMETERS_CHORD = 1,       /* in proportion to the distance from sample to sample */
  IFSM_PARAMETERS_CENTRIPETAL = 2, /* to its square root: long jumps count less */
  IFSM_PARAMETERS_GIVEN = 3        /* in ifsm_fit_samples */
};

/* What a squared residual s costs; a is loss_scale, the residual at which outliers begin. */
enum {
  IFSM_LOSS_SQUARES = 0, /* s */
  IFSM_LOSS_HUBER = 1,   /* s up to a², then 2 a sqrt(s) - a²: outliers pull, but not the more the farther */
  IFSM_LOSS_CAUCHY = 2,  /* a² log(1 + s / a²): far ones hardly pull */
  IFSM_LOSS_TUKEY = 3    /* a²/3 (1 - (1 - s / a²)³), constant from a² on: those beyond a do not count */
};

/* What must hold exactly. */
enum {
  IFSM_CONSTRAINT_POINT = 1,  /* the curve passes through a point at a parameter */
  IFSM_CONSTRAINT_TANGENT = 2 /* its first (parameter 0) or last (1) leg lies along a direction; in which sense, the
                                 samples say */
};

/* What is known about one curve's samples. All of it may be left zero. Faults are told as those of, say,
 * "samples[0].weights". Never changes: it stands in arrays. */
typedef struct ifsm_fit_samples {
  const double *parameters; /* borrowed, with IFSM_PARAMETERS_GIVEN: one a sample, increasing, 0 … 1 (a ring's below 1) */
  int64_t parameter_count;
  const double *weights; /* borrowed: one a sample, above 0: what its squared residual is multiplied by */
  int64_t weight_count;
  const double *covariances; /* borrowed, instead of weights: dimension × dimension a sample, row-major, symmetric and
                                positive definite: residuals count in its units */
  int64_t covariance_count;  /* doubles */
  const int32_t *constraint_kinds;     /* borrowed: IFSM_CONSTRAINT_…, constraint_count of them */
  const double *constraint_parameters; /* borrowed: 0 … 1, one a constraint */
  const double *constraint_values;     /* borrowed: dimension doubles a constraint, the point or the direction */
  int64_t constraint_count;            /* 0 … 1024; n control points hold n points at most */
  int32_t fixed_ends;                  /* 1: the curve's ends stay at the first and the last sample (a ring: the first) */
  int32_t reserved;                    /* 0 */
} ifsm_fit_samples;

typedef struct ifsm_fit_curve_options {
  uint32_t struct_size;
  int32_t threads;        /* as in ifsm_fit_options */
  ifsm_filter start;      /* borrowed: where to start, joined, its shape instead of the one below; {0}: casteljau */
  int32_t control_points; /* n, 2 … 16; 0: 5 */
  int32_t maps;           /* N, 2 … 8; 0: 2 */
  int32_t fixed_filter;   /* 1: the filter stays as it is, control points alone are fitted */
  int32_t parameters;     /* IFSM_PARAMETERS_… */
  int32_t reparameterise; /* rounds in which samples find the nearest point of the curve anew, 0 … 10000; 0: none */
  int32_t loss;           /* IFSM_LOSS_… */
  double loss_scale;      /* above 0 with a robust loss: 1.3 to 5 standard deviations of the noise; else 0 */
  int32_t levels;         /* depth of the tree whose places the curve goes through; 0: the smallest with a place for every
                             sample, which is also the least */
  int32_t starts;         /* 1: from the start alone; 2 (and 0): and coarse to fine; 3: and from the samples' collage */
  int32_t iterations;     /* Levenberg-Marquardt iterations a start at most, 1 … 1000; 0: 40 */
  int32_t reserved;       /* 0 */
  double tolerance;       /* relative fall of the cost at which it stops, above 0; 0: 1e-9 */
  const ifsm_fit_samples *samples; /* borrowed: one a curve; NULL: nothing is known */
  int64_t sample_count;            /* curve_count, or 0 */
  ifsm_cancel cancel;              /* borrowed; {0} for none */
  ifsm_progress_callback progress; /* may be NULL */
  void *user;                      /* handed to `progress` */
} ifsm_fit_curve_options;

/* Sets struct_size to `size` and everything else to zero, which is the default. Errors: NULL, OPTIONS. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_fit_curve_options_init(ifsm_fit_curve_options *options, uint32_t size);

/* Stage *curve*: the control points of each curve and the T of all whose curve without details comes nearest to the
 * samples, by Levenberg-Marquardt on T with the control points solved for. The curve is the polyline through the places
 * of the finest level. U is the canonical complement of the T that is found.
 *
 * curves        borrowed: all of one dimension
 * curve_count   1 …
 * options       borrowed; NULL for defaults
 * fit           [out] owned by the caller. Its cost, the sum of the loss over samples, is at most that of the start:
 *               control points by plain least squares under the starting filter. ifsm_fit_sketch(fit, c, 0) is the
 *               fitted curve (no details), ifsm_fit_describe_budget(fit, c, 0) its distance from the samples at
 *               ifsm_fit_parameters, unweighted
 *
 * Fitted to a rough curve alone, T grows large entries, and its exact models need more details than casteljau's: for few
 * details, fit stage sparse. Errors: NULL, RANGE (weights, parameters, scales, constraints that contradict each other),
 * SHAPE, NOT_FINITE, INVALID_HANDLE, CANCELLED, NUMERICAL, LIMIT, OPTIONS, MEMORY. Deterministic. The callbacks run on
 * this thread. Source: paper 002, section 4, first step; docs/fitting.md. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_fit_curve(const ifsm_curve *curves, int64_t curve_count,
                                                  const ifsm_fit_curve_options *options, ifsm_fit *fit);

typedef struct ifsm_fit_filter_options {
  uint32_t struct_size;
  int32_t threads;        /* as in ifsm_fit_options */
  ifsm_filter start;      /* borrowed: whose T stays, joined, its shape instead of the one below; {0}: casteljau */
  int32_t control_points; /* n, 2 … 16; 0: 5 */
  int32_t maps;           /* N, 2 … 8; 0: 2 */
  int32_t kept_levels;    /* levels whose details count, 1 … 40; 0: 3; -1: none, the control points alone */
  int32_t iterations;     /* Levenberg-Marquardt iterations at most, 1 … 1000; 0: 40 */
  double tolerance;       /* relative fall of the cost at which it stops, above 0; 0: 1e-9 */
  ifsm_cancel cancel;     /* borrowed; {0} for none */
  ifsm_progress_callback progress; /* may be NULL */
  void *user;                      /* handed to `progress` */
} ifsm_fit_filter_options;

/* Sets struct_size to `size` and everything else to zero, which is the default. Errors: NULL, OPTIONS. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_fit_filter_options_init(ifsm_fit_filter_options *options, uint32_t size);

/* Stage *filter*: with T as it is, the U under which the first levels of details tell the samples best.
 *
 * curves        borrowed: all of one dimension
 * curve_count   1 …
 * options       borrowed; NULL for defaults
 * fit           [out] owned by the caller. Its cost, the sum of squared distances at the samples, is at most the start's;
 *               ifsm_fit_sketch(fit, c, 0) has the details of those levels. A curve of no more levels is exact under any
 *               U and changes nothing
 *
 * Errors: as ifsm_fit_curve. Source: paper 002, section 4, second step; docs/fitting.md. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_fit_filter(const ifsm_curve *curves, int64_t curve_count,
                                                   const ifsm_fit_filter_options *options, ifsm_fit *fit);

/* Where the fit saw the samples of a curve: stage curve, as given, computed or found anew; other stages, at their places.
 *
 * curve        0 … curves - 1
 * parameters   [out] one a sample
 *
 * Errors: INVALID_HANDLE, NULL, RANGE, CAPACITY. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_fit_parameters(ifsm_fit fit, int64_t curve, double *parameters,
                                                       int64_t capacity, int64_t *count);

/* How sure stage curve is of a curve's control points: their covariance, the Gauss-Newton one of the final cost, T
 * moving with them when it was fitted. Without covariances of the samples it is scaled by the noise that the report
 * tells; robust losses count by their weights at the end.
 *
 * curve        0 … curves - 1
 * covariance   [out] (n × dimension)² doubles, row-major; coordinate a of control point i at i × dimension + a
 *
 * With T fitted, (P, T) and (P A, A^-1 T A) give one limit curve: along such changes the samples tell (nearly) nothing,
 * and the pseudo-inverse counts what they do not tell as known. Then ask for the curve's covariance instead.
 * Errors: INVALID_HANDLE, NULL, RANGE (a fit of another stage), CAPACITY, NUMERICAL (samples that do not determine the
 * control points, or leave nothing to tell the noise by), MEMORY. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_fit_covariance(ifsm_fit fit, int64_t curve, double *covariance,
                                                       int64_t capacity, int64_t *count);

/* The same of the filter's fitted entries: of C (n rows) after stage curve, zero when the filter was fixed; of U after
 * stage filter, on what the cost sees of it.
 *
 * covariance   [out] (rows × columns)² doubles, row-major, the entries in row-major order
 *
 * Errors: as ifsm_fit_covariance. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_fit_filter_covariance(ifsm_fit fit, double *covariance, int64_t capacity,
                                                              int64_t *count);

/* The same of the fitted curve's points: stage curve alone.
 *
 * curve             0 … curves - 1
 * parameters        borrowed: 0 … 1
 * parameter_count   how many
 * covariance        [out] dimension × dimension doubles a parameter, row-major
 *
 * Errors: as ifsm_fit_covariance, and NOT_FINITE. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_fit_curve_covariance(ifsm_fit fit, int64_t curve, const double *parameters,
                                                             int64_t parameter_count, double *covariance,
                                                             int64_t capacity, int64_t *count);

/* curve   0 … curves - 1
 * model   [out] that curve's exact model under the fitted filter, owned by the caller
 * Errors: INVALID_HANDLE, NULL, RANGE, MEMORY. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_fit_model(ifsm_fit fit, int64_t curve, ifsm_model *model);

/* The sketch that the report tells of: the fitted filter, budget - n details, solved (stages curve and filter have one
 * budget: the fitted curve itself; the first levels, as analysis gives them).
 *
 * curve    0 … curves - 1
 * budget   0 … budgets - 1: its position, not its size
 * sketch   [out] owned by the caller
 * Errors: INVALID_HANDLE, NULL, RANGE, MEMORY. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_fit_sketch(ifsm_fit fit, int64_t curve, int64_t budget, ifsm_model *sketch);

/* report   [out] with struct_size set. Errors: INVALID_HANDLE, NULL, OPTIONS. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_fit_describe(ifsm_fit fit, ifsm_fit_report *report);

/* curve    0 … curves - 1
 * budget   0 … budgets - 1
 * row      [out] with struct_size set
 * Errors: INVALID_HANDLE, NULL, RANGE, OPTIONS. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_fit_describe_budget(ifsm_fit fit, int64_t curve, int64_t budget,
                                                            ifsm_fit_budget *row);

/* Models taken from the fit live on. {0} is fine. Errors: INVALID_HANDLE. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_fit_destroy(ifsm_fit fit);

/* ------------------------------------------------------------------------------------------------------------
 * Training: one filter for a family of curves, to be chosen as a wavelet is
 */

typedef struct ifsm_train_options {
  uint32_t struct_size;
  int32_t threads;        /* at most so many; 0: as ifsm_set_threads says */
  ifsm_filter start;      /* borrowed: where to start, joined, its shape instead of the one below; {0}: casteljau */
  int32_t control_points; /* n, 2 … 16; 0: 5 */
  int32_t maps;           /* N, 2 … 8; 0: 2 */
  const int64_t *budgets; /* borrowed: vectors of the sketches that are to be near their curves, each n …; a curve takes
                             those that it holds; NULL: 16, 32, 64 … up to an eighth of its samples */
  int64_t budget_count;   /* 0 … 64 */
  int32_t hold_out;       /* curves hold_out - 1, 2 hold_out - 1, … are not trained on, but judged at the end: 2 …; 0:
                             none */
  int32_t rounds;         /* at most so many, the choice of details bettered after each, 1 … 1000; 0: 12 */
  int32_t iterations;     /* Levenberg-Marquardt iterations a round at most, 1 … 1000; 0: 10 */
  int32_t reserved;       /* 0 */
  double condition;       /* condition number of R, at most (or twice the start's); 0: 30 */
  double reach;           /* of coarse polygons from the middle of their curve, in its diagonals, at most (or twice the
                             start's); 0: 3 */
  ifsm_cancel cancel;     /* borrowed; {0} for none */
  ifsm_progress_callback progress; /* may be NULL */
  void *user;                      /* handed to `progress` */
} ifsm_train_options;

/* Sets struct_size to `size` and everything else to zero, which is the default. Errors: NULL, OPTIONS. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_train_options_init(ifsm_train_options *options, uint32_t size);

/* Why training stopped. */
enum {
  IFSM_TRAIN_CONVERGED = 0,  /* another round would hardly better the sketches */
  IFSM_TRAIN_ROUNDS = 1,     /* all rounds were used */
  IFSM_TRAIN_START_BEST = 2  /* nothing better than the start was found: the start is returned */
};

typedef struct ifsm_train_report {
  uint32_t struct_size;
  int32_t reason;        /* IFSM_TRAIN_… */
  int64_t trained;       /* curves that were trained on, and curves held out; those that hold no budget are neither */
  int64_t held_out;
  int64_t sketches;      /* of the curves trained on: one a budget */
  int64_t rounds;
  int64_t iterations;    /* Levenberg-Marquardt iterations, all rounds */
  double ratio;          /* geometric mean of the sketches' RMS errors, trained over start: at most 1 */
  double held_out_ratio; /* the same of the curves held out; NaN when there are none */
} ifsm_train_report;

/* Trains a filter on curves of one kind, so that few details tell any of them: what is minimised is the error of their
 * solved sketches (as IFSM_RESOLVE_CHOICE gives them), relatively, all curves and budgets alike; a curve that is told far
 * better than the others counts less. A curve's own fit (ifsm_fit_sparse) may start from the result.
 *
 * curves        borrowed: all of one dimension. Sampled alike, e.g. equally far apart: the filter learns that too
 * curve_count   1 …
 * options       borrowed; NULL for defaults
 * filter        [out] owned by the caller
 * report        [out] with struct_size set
 *
 * Errors: NULL, RANGE, SHAPE, NOT_FINITE, INVALID_HANDLE, CANCELLED, NUMERICAL, LIMIT, OPTIONS, MEMORY. Deterministic.
 * The callbacks run on this thread. Source: docs/fitting.md. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_train(const ifsm_curve *curves, int64_t curve_count,
                                              const ifsm_train_options *options, ifsm_filter *filter,
                                              ifsm_train_report *report);

/* ------------------------------------------------------------------------------------------------------------
 * Questions that people ask of a curve
 *
 * All are about the polyline through the model's finest places: the points that ifsm_model_points gives for level L,
 * at the parameters of ifsm_model_evaluate. Each call builds what it needs anew: ask about many points at once. Lengths
 * and distances are in the samples' units.
 */

/* Arc length from one parameter to another, along growing parameters; negative the other way, so that lengths add up.
 *
 * from, to   0 … 1; closed: any finite numbers, whole turns count (0 to 2 is twice round)
 * length     [out]
 *
 * Errors: INVALID_HANDLE, NULL, RANGE, NOT_FINITE, NUMERICAL (no double is large enough), MEMORY. Any thread.
 * Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_model_length(ifsm_model model, double from, double to, double *length);

/* Parameters of points that are equally far apart along the curve. Give one of:
 *
 * points       how many, 1 … 2^40, the other 0: open, both ends and between them (one point: the start); closed, once
 *              round from parameter 0 on
 * spacing      how far apart, > 0, the other 0: from the start on; what is left at the end is shorter
 * parameters   [out] as many doubles as there are points, growing
 *
 * Errors: INVALID_HANDLE, NULL, RANGE (neither or both; more than 2^40 points), NOT_FINITE, CAPACITY, MEMORY. Any
 * thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_model_spaced(ifsm_model model, int64_t points, double spacing,
                                                     double *parameters, int64_t capacity, int64_t *count);

/* The point of the curve nearest to each query; of several equally near, that of the smallest parameter.
 *
 * queries       borrowed: points of the model's dimension, interleaved
 * query_count   doubles in `queries`
 * rows          [out] for each query 2 + dimension doubles: parameter, distance, and the point of the curve
 *
 * A tree of boxes; the answer is that of comparing with every segment. Errors: INVALID_HANDLE, NULL, RANGE,
 * NOT_FINITE, CAPACITY, NUMERICAL (a distance no double is large enough for), MEMORY. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_model_nearest(ifsm_model model, const double *queries, int64_t query_count,
                                                      double *rows, int64_t capacity, int64_t *count);

/* How far one curve is from another, in the samples' units. */
typedef struct ifsm_distances {
  uint32_t struct_size;
  int32_t reserved;
  double rms;      /* between samples of the same number */
  double largest;  /* between them */
  int64_t farthest; /* the number of that sample; of several the first */
  double hausdorff; /* between the polylines through the finest places, edges and all, to a millionth */
} ifsm_distances;

/* From a model to another of as many samples: its sketch, the same samples under another filter, another survey.
 *
 * other       borrowed
 * distances   [out]
 *
 * Errors: INVALID_HANDLE, NULL, OPTIONS, SHAPE (dimensions or numbers of samples differ), NUMERICAL (a distance no double
 * is large enough for), MEMORY. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_model_distance(ifsm_model model, ifsm_model other, ifsm_distances *distances);

/* How the curve bends, seen at a scale: curvature of the quadratic in arc length that is nearest, in least squares, to
 * the arc within `scale` on both sides (an open curve's ends cut it short). A circle of radius r gives
 * 1/r (1 + 0.13 (scale/r)² + …).
 *
 * scale             along the curve, > 0; at most its length, closed: half of it
 * parameters        borrowed: as in ifsm_model_evaluate
 * parameter_count   how many
 * curvatures        [out] one for each parameter, in 1 / the samples' units: in the plane positive where the curve
 *                   turns left, in space not negative
 *
 * Each takes time in proportion to the places within the scale. Errors: INVALID_HANDLE, NULL, RANGE, NOT_FINITE,
 * CAPACITY, SHAPE (a curve of one dimension), NUMERICAL (an arc without direction, such as one that comes back; index:
 * the parameter), MEMORY. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_model_curvature(ifsm_model model, double scale, const double *parameters,
                                                        int64_t parameter_count, double *curvatures, int64_t capacity,
                                                        int64_t *count);

/* Where a plane curve meets itself: pairs of parameters p, q at the same point, p in an earlier segment.
 *
 * rows   [out] for each meeting 6 doubles: first p, first q, last p, last q, x, y of the first point. Where the curve
 *        only passes, first and last are the same; along a piece that is gone twice p grows from first to last, and q
 *        grows or, in the other direction, falls
 *
 * Whether segments meet is decided exactly. Places that repeat the one before count once. A segment owns its start and
 * not its end, so that touching one of the curve's own places is told once; the common point of neighbours is no
 * meeting, but one that turns back onto the other is. Pieces gone twice are told for each pair of segments, ends
 * included. The work is done again when it is asked for after its count: give an array at once if you can.
 * Parameter 1 of a closed curve is told as 0. Errors: INVALID_HANDLE, NULL, CAPACITY, SHAPE (not in the plane), LIMIT
 * (more than 2^22), MEMORY. Any thread. Source: J. R. Shewchuk, Adaptive precision floating-point arithmetic and fast
 * robust geometric predicates, 1997. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_model_crossings(ifsm_model model, double *rows, int64_t capacity,
                                                        int64_t *count);

/* What is counted at each scale. Boxes: the boxes of a grid with that side that the curve touches, the grid's corner at
 * the bounding box's lowest; two and three dimensions. Divider: the steps of that length that a pair of compasses takes
 * along the curve, the rest as the share of a step. */
enum { IFSM_DIMENSION_BOXES = 0, IFSM_DIMENSION_DIVIDER = 1 };

typedef struct ifsm_dimension_options {
  uint32_t struct_size;
  int32_t method;   /* IFSM_DIMENSION_… */
  int32_t scales;   /* how many, 3 … 256, geometrically from the largest to the smallest; 0: 12 */
  int32_t reserved; /* 0 */
  double smallest;  /* from 2^-20 of the bounding box's diagonal on; 0: twice the mean segment, at most largest / 4 */
  double largest;   /* at most the diagonal; 0: a quarter of it */
} ifsm_dimension_options;

/* Sets struct_size to `size` and everything else to zero, which is the default. Errors: NULL, OPTIONS. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_dimension_options_init(ifsm_dimension_options *options, uint32_t size);

typedef struct ifsm_dimension_report {
  uint32_t struct_size;
  int32_t scales;
  double dimension;      /* minus the slope of log count over log scale, by least squares */
  double standard_error; /* of the slope, from the scatter about the line */
  double r_squared;      /* the share of log count's variance that the line explains */
} ifsm_dimension_report;

/* The fractal dimension, as counting tells it. Slopes over two decades are a few hundredths off: on Koch's curve 0.04.
 *
 * options   borrowed; NULL for defaults
 * report    [out] with struct_size set
 * rows      [out] for each scale 2 doubles: the scale, growing smaller (boxes: rounded to 2^-30 of the bounding box's
 *           longest side), and the count
 *
 * Errors: INVALID_HANDLE, NULL, RANGE, NOT_FINITE, CAPACITY, OPTIONS, SHAPE (a curve that is a point; boxes in one or
 * four dimensions), LIMIT (a scale at which more than 2^26 boxes or 2^31 steps might be visited), MEMORY. Any thread.
 * Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_model_dimension(ifsm_model model, const ifsm_dimension_options *options,
                                                        ifsm_dimension_report *report, double *rows, int64_t capacity,
                                                        int64_t *count);

typedef struct ifsm_spectrum_report {
  uint32_t struct_size;
  int32_t levels;        /* L */
  int32_t first;         /* the levels that were fitted: 2 … L - 2, or all when those are fewer than three */
  int32_t last;
  double hurst;          /* H of rms ~ scale^H, by least squares on logarithms; levels whose rms is 0 are left out.
                            NaN, like the next three, when fewer than three levels are left */
  double standard_error; /* of H, from the scatter about the line */
  double r_squared;
  double dimension;      /* that H implies if the law holds. One dimension: 2 - H, of the graph over the parameter.
                            More: 1 / H, of the trail, if the samples are equally far apart along it. Within what is
                            possible */
} ifsm_spectrum_report;

/* How rough the curve is, level by level.
 *
 * report   [out] with struct_size set
 * rows     [out] for each level, coarsest first, 2 doubles: the scale, N^-level, which is the share of the parameters
 *          that a node spans; and the root mean square over all places of what the level's details do to the curve:
 *          their significances, in the samples' units
 *
 * Errors: INVALID_HANDLE, NULL, CAPACITY, OPTIONS, MEMORY. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_model_spectrum(ifsm_model model, ifsm_spectrum_report *report, double *rows,
                                                       int64_t capacity, int64_t *count);

typedef struct ifsm_refine_options {
  uint32_t struct_size;
  int32_t levels;    /* more than the model has, 1 … 40; 0: 1 */
  uint64_t seed;     /* other seeds, other details */
  int32_t learned;   /* how many scales are learnt from, the finest ones, 1 … 40; 0: 4 */
  int32_t reserved;  /* 0 */
  double roughness;  /* what the new displacements are multiplied with, > 0; 0: 1; -1: none */
} ifsm_refine_options;

/* Sets struct_size to `size` and everything else to zero, which is the default. Errors: NULL, OPTIONS. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_refine_options_init(ifsm_refine_options *options, uint32_t size);

/* Super-resolution: a model that goes on below the samples with random details like those that it has.
 *
 * model     borrowed; joined
 * options   borrowed; NULL for defaults
 * refined   [out] owned by the caller: the same filter, more levels; its samples are all its places
 *
 * Each segment's new places are displaced from the straight by normal vectors whose second moments, along the segment
 * and across it, are those of the last scales, and whose mean square continues their trend (a straight line in
 * logarithms). Old samples stay where they are, within what ifsm_model_create promises, and keep their parameters; the
 * places between them too, but for gaps of N places, which are displaced as well. Segments share a level's mean square
 * in proportion to their lengths, up to the root mean square of these (one dimension: all alike). Vectors that would
 * turn a segment back on itself are drawn again, which costs some of the mean square (coasts: a fifth). The refined
 * curve may cross itself: ask ifsm_model_crossings.
 *
 * Deterministic: the same seed gives the same bits on any number of threads. Errors: INVALID_HANDLE, NULL, RANGE,
 * NOT_FINITE, OPTIONS, SHAPE (a square model), LIMIT (more than 2^40 places), NUMERICAL, MEMORY. Any thread.
 * Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_model_refine(ifsm_model model, const ifsm_refine_options *options,
                                                     ifsm_model *refined);

/* ------------------------------------------------------------------------------------------------------------------
 * Deformers: models being edited
 *
 * A deformer holds a state over an immutable model, and a history. A state is told against the model, never against the
 * edit before, so nothing is lost by editing: undo, redo and named states give the same bits again. Level l has
 * *handles*, the points that ifsm_model_points gives of it (a ring's last one, which repeats the first, is none); level
 * 0's are the control points. Texture follows: details take the *turn* of their polygon, from where it is in the model
 * to where it went. Sources: paper 002, section 5, for moves of the control points and of the whole curve; moves that
 * change nothing but the nodes that hold a handle are this library's.
 *
 * Mutable: one call at a time; a second one, of another thread, gets IFSM_ERROR_BUSY and changes nothing. An edit that
 * fails leaves the deformer as it was. Places are in the samples' coordinates.
 * ------------------------------------------------------------------------------------------------------------------ */

typedef struct ifsm_deformer {
  uint64_t id;
} ifsm_deformer;

/* What a turn may be: the similarity that takes a polygon to where it went best; the rotation alone; or any matrix, as
 * in paper 002 (directions that the polygon does not span take the similarity). Where the points leave a turn open, it
 * turns least. */
enum {
  IFSM_TURNING_SIMILARITY = 0,
  IFSM_TURNING_ROTATION = 1,
  IFSM_TURNING_LINEAR = 2
};

/* Whose turn details take. */
enum {
  IFSM_FOLLOW_MOVED = 0, /* that of the nearest node above them that holds a moved handle; of the root, if none does */
  IFSM_FOLLOW_EACH = 1,  /* that of their own node's polygon, all the way down: node-frame details; slow */
  IFSM_FOLLOW_NONE = 2   /* they stay as they are: absolute details */
};

typedef struct ifsm_deformer_options {
  uint32_t struct_size;
  int32_t turning;  /* IFSM_TURNING_… */
  int32_t follow;   /* IFSM_FOLLOW_… */
  int32_t reserved; /* 0 */
} ifsm_deformer_options;

/* Sets struct_size to `size` and everything else to zero, which is the default. Errors: NULL, OPTIONS. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_deformer_options_init(ifsm_deformer_options *options, uint32_t size);

/* model     borrowed; the deformer keeps it alive
 * options   borrowed; NULL for defaults
 * deformer  [out] owned by the caller
 * Errors: INVALID_HANDLE, NULL, RANGE, OPTIONS, MEMORY. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_deformer_create(ifsm_model model, const ifsm_deformer_options *options,
                                                        ifsm_deformer *deformer);

typedef struct ifsm_deformer_info {
  uint32_t struct_size;
  int32_t dimension;
  int32_t levels;
  int32_t closed;   /* 0 or 1 */
  int64_t undoable; /* steps that ifsm_deformer_undo can go back */
  int64_t redoable; /* and ifsm_deformer_redo forth */
  int64_t edits;    /* that made the present state */
  double begin;     /* when the first of them begins, and when the last one ends; 0 without any */
  double end;
} ifsm_deformer_info;

/* info  [out] its struct_size is set by the caller. Errors: INVALID_HANDLE, NULL, OPTIONS, BUSY. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_deformer_describe(ifsm_deformer deformer, ifsm_deformer_info *info);

/* Ends the handle; {0} is fine. Errors: INVALID_HANDLE. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_deformer_destroy(ifsm_deformer deformer);

/* What changes with a handle of level 1 or finer. */
enum {
  IFSM_REACH_NODES = 0, /* only the nodes that hold it; they turn by their own polygons, and elsewhere every bit stays */
  IFSM_REACH_CURVE = 1  /* all of the curve: details below take the turn of the whole (paper 002, Local) */
};

/* How handles near a moved one follow, t being the distance over the radius. */
enum {
  IFSM_FALLOFF_NONE = 0,
  IFSM_FALLOFF_LINEAR = 1, /* 1 - t */
  IFSM_FALLOFF_SMOOTH = 2  /* (1 - t^2)^2 */
};
enum {
  IFSM_RULER_HANDLES = 0, /* distance counts handles */
  IFSM_RULER_LENGTH = 1   /* arc length along the level's polyline as it is */
};

typedef struct ifsm_move_options {
  uint32_t struct_size;
  int32_t places;  /* 1: vectors are the places that handles go to; 0: by how much they move */
  int32_t reach;   /* IFSM_REACH_…; level 0 bends the curve as a whole, whatever it says */
  int32_t falloff; /* IFSM_FALLOFF_… */
  int32_t ruler;   /* IFSM_RULER_… */
  int32_t reserved; /* 0 */
  double radius;   /* of the falloff, > 0; 0 without one, or it is refused */
} ifsm_move_options;

/* Sets struct_size to `size` and everything else to zero, which is the default. Errors: NULL, OPTIONS. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_move_options_init(ifsm_move_options *options, uint32_t size);

/* Moves handles of a level.
 *
 * level         0 … levels
 * handles       handle_count numbers, none twice
 * vectors       vector_count = handle_count × dimension doubles
 * options       borrowed; NULL for defaults
 *
 * Displacements turn with what is above them: bend the curve afterwards, and a moved part bends along.
 * Errors: INVALID_HANDLE, NULL, RANGE (a pinned handle, too), NOT_FINITE, SHAPE, OPTIONS, NUMERICAL (above the handle
 * the curve is drawn together into a point), BUSY, MEMORY. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_deformer_move(ifsm_deformer deformer, int32_t level, const int64_t *handles,
                                                      int64_t handle_count, const double *vectors,
                                                      int64_t vector_count, const ifsm_move_options *options);

/* Pins handles where they are: whatever moves above them, they stay; hold 0 lets them go to where they would be. An edit,
 * as moves are. A handle of a square model is the mean of what several polygons say: pinned, they all say the mean.
 * Errors: INVALID_HANDLE, NULL, RANGE, BUSY, MEMORY. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_deformer_pin(ifsm_deformer deformer, int32_t level, const int64_t *handles,
                                                     int64_t handle_count, int32_t hold);

/* What ifsm_deformer_drag changes. */
enum {
  IFSM_LEAD_HANDLES = 0, /* handles of the level; the nodes that hold them turn */
  IFSM_LEAD_DETAILS = 1  /* details of the level; nothing turns */
};

/* Drags points of the curve, at parameters, to places: exactly, by the least change (sum of squares) of a level's handles
 * or details. Pinned handles stay. A point that is to stay: drag it to where it is (ifsm_deformer_evaluate).
 *
 * parameters    0 … 1 (closed: any, modulo 1), no two of them one point
 * places        place_count = parameter_count × dimension doubles
 *
 * Errors: INVALID_HANDLE, NULL, RANGE, NOT_FINITE, SHAPE, SINGULAR (the level cannot lead the points
 * apart), NUMERICAL (nodes turn so much that no end was found), BUSY, MEMORY. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_deformer_drag(ifsm_deformer deformer, int32_t level, int32_t lead,
                                                      const double *parameters, int64_t parameter_count,
                                                      const double *places, int64_t place_count);

typedef struct ifsm_restyle_options {
  uint32_t struct_size;
  int32_t fade;   /* so many levels on each side follow, less and less, 0 … 64; 0: none */
  int32_t mirror; /* the number of an axis, from 1, along which details are mirrored; 0: none */
  int32_t reserved; /* 0 */
  double angle;   /* radians, in the plane of the first two axes */
} ifsm_restyle_options;

/* Sets struct_size to `size` and everything else to zero, which is the default. Errors: NULL, OPTIONS. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_restyle_options_init(ifsm_restyle_options *options, uint32_t size);

/* Appearance: details of levels first … last scaled (-1e12 … 1e12; 0: the truncated model), mirrored and turned, in this order and
 * after what was done to them before (paper 002, Appearance: the last two levels).
 * options borrowed; NULL for defaults. Errors: INVALID_HANDLE, NULL, RANGE, NOT_FINITE, OPTIONS, BUSY, MEMORY. Since
 * 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_deformer_restyle(ifsm_deformer deformer, int32_t first, int32_t last,
                                                         double scale, const ifsm_restyle_options *options);

typedef struct ifsm_texture_options {
  uint32_t struct_size;
  int32_t fade;     /* as in ifsm_restyle_options */
  ifsm_model from;  /* borrowed: of the same topology, n, N and dimension; {0}: random details */
  double roughness; /* of random ones: H, from level to level sizes shrink by N^-H, -8 … 8; 0: 0.5 */
  double size;      /* root mean square length of those of the first level; 0: of the model's own there */
  uint64_t seed;    /* other seeds, other details */
} ifsm_texture_options;

/* Sets struct_size to `size` and everything else to zero, which is the default. Errors: NULL, OPTIONS. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_texture_options_init(ifsm_texture_options *options, uint32_t size);

/* Texture: details of levels first … last replaced: by those of another model, which lie along this curve as they lay
 * along theirs, or by random ones, normal, independent, the same bits for the same seed.
 * options borrowed; NULL for defaults. Errors: INVALID_HANDLE, NULL, RANGE, NOT_FINITE, SHAPE, OPTIONS, BUSY, MEMORY.
 * Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_deformer_texture(ifsm_deformer deformer, int32_t first, int32_t last,
                                                         const ifsm_texture_options *options);

/* A step back, and forth again. An edit forgets what was undone. Errors: INVALID_HANDLE, RANGE (no step), BUSY, MEMORY.
 * Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_deformer_undo(ifsm_deformer deformer);
IFSM_API IFSM_MUST_USE ifsm_status ifsm_deformer_redo(ifsm_deformer deformer);

/* Keeps the present state by a name (1 … 255 bytes, copied; an older one of that name is given up); goes to a kept
 * state, which is a step that can be undone. Errors: INVALID_HANDLE, NULL, RANGE (an empty, long or unknown name), BUSY,
 * MEMORY. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_deformer_keep_as(ifsm_deformer deformer, const char *name);
IFSM_API IFSM_MUST_USE ifsm_status ifsm_deformer_go_to(ifsm_deformer deformer, const char *name);

/* How the share of an edit that is made grows while it takes place, s being the part of the time that has passed. */
enum {
  IFSM_EASING_SMOOTH = 0, /* 3 s^2 - 2 s^3 */
  IFSM_EASING_LINEAR = 1, /* s */
  IFSM_EASING_IN = 2,     /* s^2 */
  IFSM_EASING_OUT = 3     /* 1 - (1 - s)^2 */
};

/* When the edits that follow take place, for ifsm_deformer_at_time: from begin to end, in any unit; at once when the two
 * are equal. A new deformer's take from 0 to 1, smoothly. It is no edit and changes nothing of the present state.
 * Errors: INVALID_HANDLE, NOT_FINITE, RANGE (end before begin), BUSY. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_deformer_time(ifsm_deformer deformer, double begin, double end,
                                                      int32_t easing);

/* The curve at a time, as a deformer of its own over the same model: the edits of the present state made again, each the
 * share that is made by then. Moves and drags lead along straight lines, looks change by their shares, pins hold from
 * their begin. Before all edits it is the model, after them the present state, bit for bit. A frame of an animation:
 * ask it for points, or a snapshot.
 * frame  [out] owned by the caller. Errors: INVALID_HANDLE, NULL, NOT_FINITE, those of the edits, BUSY, MEMORY. Since
 * 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_deformer_at_time(ifsm_deformer deformer, double time, ifsm_deformer *frame);

/* The edits that made the present state, with their times, as bytes (docs/format.md); what was undone is left out.
 *
 * format    IFSM_FORMAT_…
 * bytes     [out] the file; capacity, count as in ifsm_model_save
 *
 * Errors: INVALID_HANDLE, NULL, RANGE, CAPACITY, BUSY, MEMORY. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_deformer_save(ifsm_deformer deformer, int32_t format, uint8_t *bytes,
                                                      int64_t capacity, int64_t *count);

/* Makes the edits of such a file, after those that there are: all, each a step to undo, or none. On a new deformer of the
 * same model and options that gives the state that was saved, bit for bit.
 *
 * bytes  borrowed; count how many
 *
 * Errors: INVALID_HANDLE, NULL, RANGE (also: other options), SHAPE (the edits of another model, argument "model"),
 * FORMAT, VERSION, LIMIT, NOT_FINITE, those of the edits ("edits[3].handles"), BUSY, MEMORY. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_deformer_replay(ifsm_deformer deformer, const uint8_t *bytes, int64_t count);

/* Where the curve as it is meets itself and the model does not: rows as in ifsm_model_crossings, of pairs of segments
 * (between neighbouring places) that do not meet in the model.
 * rows  [out] 6 doubles each. Errors: INVALID_HANDLE, NULL, CAPACITY, SHAPE (not in the plane), LIMIT, BUSY, MEMORY.
 * Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_deformer_crossings(ifsm_deformer deformer, double *rows, int64_t capacity,
                                                           int64_t *count);

/* Handles first … first + number - 1 of a level, where they are; the finest level's are the curve's places.
 * points  [out] number × dimension doubles. Errors: INVALID_HANDLE, NULL, RANGE, CAPACITY, NUMERICAL (edits have led the
 * curve out of the range of doubles), BUSY, MEMORY. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_deformer_points(ifsm_deformer deformer, int32_t level, int64_t first,
                                                        int64_t number, double *points, int64_t capacity,
                                                        int64_t *count);

/* The handles of a level that the last step (edit, undo, redo) may have changed: what is to be asked for again. All
 * others have kept their bits.
 * first, number  [out] a window for ifsm_deformer_points. Errors: INVALID_HANDLE, NULL, RANGE, BUSY. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_deformer_changed(ifsm_deformer deformer, int32_t level, int64_t *first,
                                                         int64_t *number);

/* The curve at the samples, and at parameters (0 … 1; closed: any, modulo 1), as ifsm_model_samples and
 * ifsm_model_evaluate give them of a model, on the polyline.
 * points  [out] doubles. Errors: INVALID_HANDLE, NULL, RANGE, NOT_FINITE, CAPACITY, BUSY, MEMORY. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_deformer_samples(ifsm_deformer deformer, double *points, int64_t capacity,
                                                         int64_t *count);
IFSM_API IFSM_MUST_USE ifsm_status ifsm_deformer_evaluate(ifsm_deformer deformer, const double *parameters,
                                                          int64_t parameter_count, double *points, int64_t capacity,
                                                          int64_t *count);

/* The present state as a model of its own, which agrees with ifsm_deformer_points within 1e-12 of the curve's size.
 * Details below the deepest moved handles are the model's, turned; sparse ones stay sparse.
 * model  [out] owned by the caller. Errors: INVALID_HANDLE, NULL, BUSY, MEMORY. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_deformer_snapshot(ifsm_deformer deformer, ifsm_model *model);

/* ------------------------------------------------------------------------------------------------------------------
 * Systems: iterated function systems (IFS), some affine maps x -> M x + t of the plane or of space
 *
 * The *attractor* is the one compact set that is the union of its images under the maps; the *measure* on it is the mean
 * of its own images, by the maps' *probabilities*: how often a random point comes by. Maps of probability 0 are there
 * and take no part. A *word* is a list of maps, the outermost first; the word (i, j) stands for x -> map_i(map_j(x)). An
 * *address* is an endless word: its maps, taken ever longer, close in on one point of the attractor.
 *
 * Systems are immutable. Everything but a system's own parts asks for contractive maps, which is proven, or refuted by
 * a word that does not contract (RANGE, argument "system"), or undecided (NUMERICAL). Lengths are in the system's own
 * units. Sources: M. Barnsley, Fractals Everywhere, 1988; docs/systems.md.
 * ------------------------------------------------------------------------------------------------------------------ */

typedef struct ifsm_system {
  uint64_t id;
} ifsm_system;

/* A system from its maps.
 *
 * dimension           d, 2 or 3
 * maps                copied: 1 … 256 maps of d × (d + 1) doubles, row by row (M | t). In the plane a b e c d f
 * count               doubles in `maps`
 * probabilities       copied: one a map, not negative; divided by their sum. NULL with 0: |det M|, but at least a 25th
 *                     of the maps' mean |det|, so that flat maps are taken too (all flat: all alike)
 * probability_count   as many as maps, or 0
 * system              [out] owned by the caller
 *
 * Maps may be singular, may reflect, and need not be contractive. Errors: NULL, RANGE, SHAPE, NOT_FINITE, MEMORY. Any
 * thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_system_create(int32_t dimension, const double *maps, int64_t count,
                                                      const double *probabilities, int64_t probability_count,
                                                      ifsm_system *system);

/* A system from what its maps do: shear, then scale, then turn, then move. Paper 000: the best level of control.
 *
 * parameters   copied: for each map in the plane angle, scale x, scale y, shear, shift x, shift y: M = turn · diag(scale)
 *              · (1 shear | 0 1). In space 12: axis times angle, scales, shears xy, xz, yz, shifts. Angles in radians
 *
 * Everything else as ifsm_system_create. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_system_from_parameters(int32_t dimension, const double *parameters, int64_t count,
                                                               const double *probabilities, int64_t probability_count,
                                                               ifsm_system *system);

/* A system by name: those that ifsm_system_catalog lists, and "fern", "gasket", "dragon", "koch", "levy", "snowflake",
 * "sponge" for the best known of their kinds; "-" and "_" are the same. Errors: NULL, RANGE (an unknown name lists the
 * known ones), MEMORY. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_system_named(const char *name, ifsm_system *system);

typedef struct ifsm_system_entry {
  uint32_t struct_size;
  int32_t dimension;
  const char *name;   /* static storage, like `source` */
  const char *source; /* a paper and its figure, or where it is found */
} ifsm_system_entry;

/* What systems there are by name.
 * index   0 …; RANGE past the last, whose message says how many there are
 * entry   [out] with struct_size set. Errors: NULL, RANGE, OPTIONS. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_system_catalog(int64_t index, ifsm_system_entry *entry);

/* The system that a detail model without its details is: its attractor is the model's IFSM_CURVE_LIMIT, its maps are
 * equally likely.
 *
 * model   borrowed: in the plane with 3 control points, or in space with 4, not on a line (in a plane)
 *
 * Errors: INVALID_HANDLE, NULL, SHAPE, SINGULAR, MEMORY. Source: paper 002, with n = d + 1. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_system_from_model(ifsm_model model, ifsm_system *system);

/* And back: a model without details whose limit is the attractor of the active maps, in their order (2 … 8).
 *
 * topology   IFSM_TOPOLOGY_…. Square: any maps. Joined: the pieces are one chain: the first map's fixed point is where
 *            it begins, the last one's where it ends, and each map leads its end to where the next one leads its
 *            beginning
 * polygon    borrowed: d + 1 points, not on a line (in a plane); joined: from the beginning to the end, inner ones free.
 *            NULL: chosen
 * levels     as in ifsm_model_from_polygon
 * model      [out] owned by the caller
 *
 * Errors: INVALID_HANDLE, NULL, RANGE, NUMERICAL, SHAPE (joined: argument "system", index the map where the chain breaks),
 * SINGULAR (flat maps of which no filter can be made), NOT_FINITE, LIMIT, MEMORY. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_model_from_system(ifsm_system system, int32_t topology,
                                                          const ifsm_curve *polygon, int32_t levels, ifsm_model *model);

typedef struct ifsm_system_info {
  uint32_t struct_size;
  int32_t dimension;   /* 2 or 3 */
  int32_t maps;        /* 1 … 256 */
  int32_t active;      /* those of a probability above 0 */
  int32_t contractive; /* 1 proven, -1 refuted, 0 undecided: all words of the active maps */
  int32_t word_length; /* the longest word that was needed, or tried; refuted: that of ifsm_system_witness */
  double radius;       /* refuted: the spectral radius of the witness, at least 1; else NaN */
} ifsm_system_info;

/* info   [out] with struct_size set. A look-up. Errors: INVALID_HANDLE, NULL, OPTIONS. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_system_describe(ifsm_system system, ifsm_system_info *info);

/* Its parts: the maps as ifsm_system_create takes them; as ifsm_system_from_parameters does (scales not negative but for
 * the last, which has det's sign; angles above -pi, up to pi); the probabilities, of sum 1; and each map's fixed point (d
 * doubles; not finite where a map has none or many).
 * Errors: INVALID_HANDLE, NULL, CAPACITY, MEMORY. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_system_maps(ifsm_system system, double *maps, int64_t capacity, int64_t *count);
IFSM_API IFSM_MUST_USE ifsm_status ifsm_system_parameters(ifsm_system system, double *parameters, int64_t capacity,
                                                          int64_t *count);
IFSM_API IFSM_MUST_USE ifsm_status ifsm_system_probabilities(ifsm_system system, double *probabilities,
                                                             int64_t capacity, int64_t *count);
IFSM_API IFSM_MUST_USE ifsm_status ifsm_system_fixed_points(ifsm_system system, double *points, int64_t capacity,
                                                            int64_t *count);

/* symbols   [out] the word that refutes contractivity; none when it is not refuted. Errors: INVALID_HANDLE, NULL, CAPACITY,
 * MEMORY. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_system_witness(ifsm_system system, int32_t *symbols, int64_t capacity,
                                                       int64_t *count);

/* {0} is fine. Errors: INVALID_HANDLE. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_system_destroy(ifsm_system system);

/* The map that a word is.
 * symbols   borrowed: numbers of maps; none for the identity
 * map       [out] d × (d + 1) doubles, row by row (M | t). Errors: INVALID_HANDLE, NULL, RANGE (index: the symbol),
 * CAPACITY, MEMORY. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_system_word(ifsm_system system, const int32_t *symbols, int64_t symbol_count,
                                                    double *map, int64_t capacity, int64_t *count);

/* The point of an address: `symbols`, the last `period` of which are repeated for ever.
 * symbols   borrowed: numbers of active maps
 * period    1 … symbol_count
 * point     [out] d doubles. Errors: INVALID_HANDLE, NULL, RANGE, NUMERICAL, CAPACITY, MEMORY. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_system_point(ifsm_system system, const int32_t *symbols, int64_t symbol_count,
                                                     int64_t period, double *point, int64_t capacity, int64_t *count);

/* And back: the words of a length in whose pieces of the attractor a point lies: all that are within `tolerance` of it,
 * none that is farther than twice that. Several where pieces touch or overlap; none beside the attractor.
 *
 * point         borrowed: d doubles
 * length        1 … 1024
 * tolerance     > 0; 0: 1e-9 of the attractor's size
 * symbols       [out] `length` symbols for each word, words in order
 *
 * Errors: INVALID_HANDLE, NULL, SHAPE (point_count), RANGE, NOT_FINITE, NUMERICAL, CAPACITY, LIMIT (more than 65536 words, or
 * too many pieces), MEMORY. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_system_addresses(ifsm_system system, const double *point, int64_t point_count,
                                                         int32_t length, double tolerance, int32_t *symbols,
                                                         int64_t capacity, int64_t *count);

/* Where the attractor is. Answers hold it, rounding included, and are too large by at most `tolerance`: above 2^-44 of
 * the attractor's size; 0: 1e-9 of it. By branch and bound: .05 to .6 ms for the boxes of most named systems, some ms for
 * diameters. A ball's radius is larger than the smallest one's by a hundredth at most, as measured (centres differ by up to
 * four), which takes 5 to 25 ms, in space and for ferns of many pieces up to .7 s.
 *
 * box        [out] 2 d doubles: lowest coordinates, highest ones
 * ball       [out] d + 1 doubles: centre, radius
 * diameter   [out] the distance of the two points that are farthest from each other
 *
 * Errors: INVALID_HANDLE, NULL, RANGE, NOT_FINITE, NUMERICAL, CAPACITY, LIMIT (too many pieces), MEMORY. Any thread.
 * Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_system_box(ifsm_system system, double tolerance, double *box, int64_t capacity,
                                                   int64_t *count);
IFSM_API IFSM_MUST_USE ifsm_status ifsm_system_ball(ifsm_system system, double tolerance, double *ball,
                                                    int64_t capacity, int64_t *count);
IFSM_API IFSM_MUST_USE ifsm_status ifsm_system_diameter(ifsm_system system, double tolerance, double *diameter);

/* Moments of the measure, the mean of (x - about)^a over it: exact, by linear systems.
 *
 * degree    1 … 8
 * about     borrowed: d doubles; NULL with 0: the origin
 * moments   [out] those of degree 0, 1, … degree; within a degree, powers of x fall, then those of y: 1, x, y, xx, xy, yy, …
 *
 * Errors: INVALID_HANDLE, NULL, SHAPE (about_count), RANGE, NOT_FINITE, NUMERICAL, CAPACITY, MEMORY. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_system_moments(ifsm_system system, int32_t degree, const double *about,
                                                       int64_t about_count, double *moments, int64_t capacity,
                                                       int64_t *count);

/* dimension   [out] s of Moran's equation, the sum of r^s = 1 over the active maps' ratios r: the Hausdorff dimension where
 * pieces overlap little, else above it. Errors: INVALID_HANDLE, NULL, SHAPE (index: the first map that is no
 * similarity), RANGE, NUMERICAL. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_system_similarity_dimension(ifsm_system system, double *dimension);

/* The box-counting dimension, estimated: cubes of grids of 2, 4, … 2^finest a side that the attractor meets. The line is
 * fitted to those of 16 a side and more. Some hundredths off; a tenth for shapes that fill the plane and have a rough edge.
 *
 * finest   6 … 13 in the plane, 6 … 9 in space; 0: 10, and 7
 * report   [out] with struct_size set
 * rows     [out] for each grid 2 doubles: the side, growing smaller, and the count
 *
 * Takes some .1 s, overlapping systems seconds. Errors: INVALID_HANDLE, NULL, RANGE, SHAPE (the attractor is a point),
 * NUMERICAL, CAPACITY, OPTIONS, MEMORY. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_system_box_dimension(ifsm_system system, int32_t finest,
                                                             ifsm_dimension_report *report, double *rows,
                                                             int64_t capacity, int64_t *count);

/* A system as bytes (docs/format.md); doubles come back bit for bit.
 *
 * format   IFSM_FORMAT_JSON, IFSM_FORMAT_CBOR, or IFSM_FORMAT_FRACTINT: text as Fractint reads it, of one system
 * name     borrowed: what a Fractint file calls it, made a word; NULL: "system"
 * bytes    [out] text is UTF-8 without a terminating NUL; capacity, count as in ifsm_model_save
 *
 * Errors: INVALID_HANDLE, NULL, RANGE, CAPACITY, MEMORY. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_system_save(ifsm_system system, int32_t format, const char *name, uint8_t *bytes,
                                                    int64_t capacity, int64_t *count);

/* A system from bytes: JSON, CBOR, Fractint's text, or flam3's XML where it is affine (what is not is refused by name);
 * the first byte tells which.
 *
 * bytes    borrowed
 * name     borrowed: which of a file of several; NULL: the only one
 * system   [out] owned by the caller
 *
 * Errors: NULL, RANGE (an unknown name, or none for a file of several, lists those that there are), FORMAT (index: the
 * byte, or of text the line from 1), VERSION, LIMIT, NOT_FINITE, SHAPE, MEMORY. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_system_load(const uint8_t *bytes, int64_t count, const char *name,
                                                    ifsm_system *system);

/* The names of a file's systems.
 * names   [out] one a line, each ended by a newline, without a terminating NUL; JSON and CBOR have no names: an empty line
 * Errors: as ifsm_system_load, and CAPACITY. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_system_file_names(const uint8_t *bytes, int64_t byte_count, uint8_t *names,
                                                          int64_t capacity, int64_t *count);

/* ------------------------------------------------------------------------------------------------------------------
 * Pictures of systems: into the caller's arrays, row by row, row 0 on top
 *
 * A pixel owns its left and its upper edge. Asked for the count alone (NULL, 0), nothing is drawn, and the report tells the
 * size and the window only. The same options give the same bits on any number of threads and on any machine.
 * ------------------------------------------------------------------------------------------------------------------ */

/* What ifsm_system_render shows. */
enum {
  IFSM_COLOUR_TONE = 0,    /* plane: how dense the measure is, on a logarithmic scale; space: how near it is */
  IFSM_COLOUR_SYMBOL = 1,  /* the map whose piece it is: the first symbol of addresses */
  IFSM_COLOUR_ADDRESS = 2, /* the share of the measure that has smaller addresses; of so many `symbols` */
  IFSM_COLOUR_SET = 3,     /* plane: pixels that the attractor meets, those that cannot be decided half so */
  IFSM_COLOUR_DISTANCE = 4 /* plane: how far it is, over the palette from dark (near) to light, on a logarithmic scale */
};

/* From light to dark, by lightness alone: fit for grey print and for the colour-blind. */
enum {
  IFSM_PALETTE_DUSK = 0,
  IFSM_PALETTE_SEA = 1,
  IFSM_PALETTE_FERN = 2,
  IFSM_PALETTE_EMBER = 3,
  IFSM_PALETTE_INK = 4
};

typedef struct ifsm_picture_options {
  uint32_t struct_size;
  int32_t width;  /* pixels, 1 … 32768; 0: 1024 */
  int32_t height; /* 0: as wide */
  int32_t threads; /* at most so many; 0: as ifsm_set_threads says */
  double left;    /* the window, in the system's units; of space, in the plane through the middle of its ball, whose */
  double bottom;  /* centre is (0, 0). All four 0: around the attractor */
  double right;
  double top;
  uint64_t seed;   /* other seeds, other points */
  int64_t points;  /* how many the chaos game plays; 0: so that 16 a computed pixel fall into the window, but at most 64 times
                       that; in space 32 a pixel; ifsm_system_sample: 65536 */
  double tolerance; /* of sets and distances, in pixels, up to 1; 0: 1/64 of sets, 1/8 of distances */
  int32_t colour;   /* IFSM_COLOUR_… */
  int32_t palette;  /* IFSM_PALETTE_… */
  const uint8_t *stops; /* borrowed: red, green, blue of colours equally far apart, instead of the palette; of symbols,
                            each map's own, in turn; may be NULL */
  int64_t stop_count;   /* bytes: three a colour, 1 … 256 colours; 0 without */
  int32_t symbols;      /* of addresses, 1 … 16; 0: all */
  int32_t oversample;   /* pixels computed for each one, along both sides, 1 … 8; 0: 2, or 1 above 4096 pixels a side */
  uint32_t background;  /* red, green, blue, alpha from the high byte to the low one; 0: transparent */
  int32_t reserved;     /* 0 */
  double azimuth;       /* space: where the eye is, radians from the x axis to the y axis, and above the xy plane; all three 0:
                           .6, .45, .5 */
  double elevation;
  double field;         /* the angle of view, 0 … 3: so far away is the eye that the ball fills it; 0: infinitely far */
  ifsm_cancel cancel;   /* borrowed; {0} for none */
  ifsm_progress_callback progress; /* may be NULL */
  void *user;                      /* handed to `progress` */
} ifsm_picture_options;

/* Sets struct_size to `size` and everything else to zero, which is the default. Errors: NULL, OPTIONS. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_picture_options_init(ifsm_picture_options *options, uint32_t size);

typedef struct ifsm_picture_report {
  uint32_t struct_size;
  int32_t width; /* pixels */
  int32_t height;
  int32_t reserved;
  double left; /* the window */
  double bottom;
  double right;
  double top;
  int64_t points;    /* that the chaos game played; 0 where it did not */
  int64_t inside;    /* those in the window; when 0, ask ifsm_system_box whether it misses the attractor */
  int64_t met;       /* pixels that were hit, or are met for certain; where it was oversampled, of those computed */
  int64_t undecided; /* of a set: pixels to whose edge it comes within the tolerance, and none was found inside */
} ifsm_picture_report;

/* How often the chaos game hits each pixel: points of the measure, drawn at random.
 *
 * options   borrowed; NULL for defaults. Size, window, threads, seed, points count
 * report    [out] with struct_size set
 * counts    [out] width × height counts, which stay at 2^32 - 1
 *
 * Memory: a quarter more than the counts' (small windows: up to 80 MB). Windows above 2^23 pixels are counted in the array
 * itself: after CANCELLED or MEMORY it holds anything. Errors: INVALID_HANDLE, NULL, RANGE, NOT_FINITE, SHAPE (not in the plane),
 * NUMERICAL, OPTIONS, CAPACITY, CANCELLED, MEMORY. Any thread; the callback runs on this one. Source: M. Barnsley, Fractals
 * Everywhere, 1988; docs/systems.md. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_system_histogram(ifsm_system system, const ifsm_picture_options *options,
                                                         ifsm_picture_report *report, uint32_t *counts,
                                                         int64_t capacity, int64_t *count);

/* What a set's pixels are. */
enum { IFSM_PIXEL_EMPTY = 0, IFSM_PIXEL_UNDECIDED = 1, IFSM_PIXEL_MET = 2 };

/* Which pixels' squares the attractor meets: empty and met ones are proofs, rounding included; nothing is drawn at random.
 *
 * options   borrowed; NULL for defaults. Size, window, threads, tolerance count
 * pixels    [out] width × height times IFSM_PIXEL_…
 *
 * Errors: as ifsm_system_histogram; RANGE also: a tolerance that rounding does not leave; LIMIT: maps that shrink too
 * slowly for it, or overlap so much that a window so small holds more pieces than are looked at. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_system_set(ifsm_system system, const ifsm_picture_options *options,
                                                   ifsm_picture_report *report, uint8_t *pixels, int64_t capacity,
                                                   int64_t *count);

/* How far the middle of each pixel is from the attractor, wherever that is: not below, and above by at most the tolerance.
 *
 * options     borrowed; NULL for defaults. Size, window, threads, tolerance count
 * distances   [out] width × height doubles, in the system's units
 *
 * Some microseconds a pixel. Errors: as ifsm_system_set. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_system_distances(ifsm_system system, const ifsm_picture_options *options,
                                                         ifsm_picture_report *report, double *distances,
                                                         int64_t capacity, int64_t *count);

/* A picture, of the plane or of space.
 *
 * options   borrowed; NULL for defaults
 * rgba      [out] width × height × 4 bytes: red, green, blue (sRGB), alpha, which is not multiplied in
 *
 * Of space, the nearest point of each pixel, darker where it lies behind its surroundings: points of surfaces should be
 * many. Memory: 5 bytes a computed pixel for densities, 36 for symbols and addresses, 8 in space, times the threads but
 * for densities. Errors: as ifsm_system_set; SHAPE also: sets and distances of space. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_system_render(ifsm_system system, const ifsm_picture_options *options,
                                                      ifsm_picture_report *report, uint8_t *rgba, int64_t capacity,
                                                      int64_t *count);

/* Colours for counts that one has, as ifsm_system_render gives them of a density.
 *
 * counts    borrowed: of any source
 * options   borrowed; NULL for defaults. Palette or stops, and background count
 * rgba      [out] 4 bytes a count
 *
 * Errors: NULL, RANGE, NOT_FINITE, OPTIONS, CAPACITY, MEMORY. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_tone_map(const uint32_t *counts, int64_t number, const ifsm_picture_options *options,
                                                 uint8_t *rgba, int64_t capacity, int64_t *count);

/* Points of the chaos game: of the measure, each independent enough of the one before in its address that means of many
 * converge; the first n are the same however many there are.
 *
 * options   borrowed; NULL for defaults. Seed, points, threads count
 * points    [out] points × d doubles, told where they are: after CANCELLED or MEMORY the array holds anything
 *
 * Errors: INVALID_HANDLE, NULL, RANGE, NOT_FINITE, NUMERICAL, OPTIONS, CAPACITY, CANCELLED, MEMORY. Any thread. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_system_sample(ifsm_system system, const ifsm_picture_options *options,
                                                      double *points, int64_t capacity, int64_t *count);

/* The first symbols of the addresses of the same points.
 *
 * length    1 … 1024
 * symbols   [out] points × length, likewise
 *
 * Errors: as ifsm_system_sample. Since 0.1. */
IFSM_API IFSM_MUST_USE ifsm_status ifsm_system_sample_addresses(ifsm_system system, const ifsm_picture_options *options,
                                                                int32_t length, int32_t *symbols, int64_t capacity,
                                                                int64_t *count);

#ifdef __cplusplus
}
#endif

#endif /* IFSM_H */
