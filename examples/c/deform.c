/* Edits a curve as a drawing program would: a handle is dragged, only what changed is asked for again, and undo gives
 * the old bits back.
 *
 * Handles of level 3 are the points of the curve synthesised so far. Moving one changes nothing but the nodes that hold
 * it; their texture turns along. Prints the curve before and after, as a table. */
#include <ifsm.h>
#include <stdio.h>
#include <string.h>

enum { SAMPLES = 257, DIMENSION = 2, DOUBLES = SAMPLES * DIMENSION };

static int failed(ifsm_status status) {
  ifsm_error error = {0};
  if (status == IFSM_OK) return 0;
  error.struct_size = sizeof error;
  if (ifsm_last_error(&error) == IFSM_OK) fprintf(stderr, "%s: %s\n", error.function, error.message);
  return 1;
}

/* A rough hill: x runs from 0 to 1. 257 samples are the places of level 6 of n = 5, N = 2. */
static void measure(double *points) {
  unsigned noise = 1;
  for (int k = 0; k < SAMPLES; ++k) {
    const double x = (double)k / (SAMPLES - 1);
    noise = noise * 1103515245u + 12345u;
    points[2 * k] = x;
    points[2 * k + 1] = x * (1 - x) + 0.03 * ((noise >> 16 & 1023) / 1023.0 - 0.5);
  }
}

/* Asks for the window that the last step may have changed, into its place in the caller's buffer. */
static int refresh(ifsm_deformer deformer, int32_t level, double *buffer) {
  int64_t first = 0, number = 0, count = 0;
  return failed(ifsm_deformer_changed(deformer, level, &first, &number)) ||
         failed(ifsm_deformer_points(deformer, level, first, number, buffer + DIMENSION * first, DIMENSION * number,
                                     &count));
}

static int edit(ifsm_deformer deformer, int32_t finest, double *buffer) {
  const int64_t handle = 10, pinned = 16;
  const double by[] = {0.02, 0.1};
  ifsm_move_options options;
  if (failed(ifsm_move_options_init(&options, sizeof options))) return 1;
  options.falloff = IFSM_FALLOFF_SMOOTH; /* its neighbours come along */
  options.radius = 4;
  return failed(ifsm_deformer_pin(deformer, 3, &pinned, 1, 1)) || refresh(deformer, finest, buffer) ||
         failed(ifsm_deformer_move(deformer, 3, &handle, 1, by, 2, &options)) || refresh(deformer, finest, buffer);
}

int main(void) {
  static double before[DOUBLES], after[DOUBLES], again[DOUBLES];
  const ifsm_curve curve = {before, SAMPLES, DIMENSION, 0};
  ifsm_filter filter = {0};
  ifsm_model model = {0};
  ifsm_deformer deformer = {0};
  ifsm_deformer_info info = {0};
  int64_t count = 0;
  int status = 0;
  info.struct_size = sizeof info;
  measure(before);
  status = failed(ifsm_filter_named("casteljau", IFSM_TOPOLOGY_JOINED, 5, 2, &filter)) ||
           failed(ifsm_model_create(filter, &curve, NULL, &model)) ||
           failed(ifsm_deformer_create(model, NULL, &deformer)) || failed(ifsm_deformer_describe(deformer, &info)) ||
           failed(ifsm_deformer_points(deformer, info.levels, 0, SAMPLES, before, DOUBLES, &count));
  memcpy(after, before, sizeof after);
  if (status == 0) status = edit(deformer, info.levels, after);
  memcpy(again, after, sizeof again);
  status = status || failed(ifsm_deformer_undo(deformer)) || refresh(deformer, info.levels, again);
  if (status == 0 && memcmp(before, again, sizeof before) != 0) {
    fprintf(stderr, "undo has not given the old bits back\n");
    status = 1;
  }
  if (status == 0) {
    printf("x,y,edited_x,edited_y\n");
    for (int k = 0; k < SAMPLES; ++k)
      printf("%g,%g,%g,%g\n", before[2 * k], before[2 * k + 1], after[2 * k], after[2 * k + 1]);
  }
  status |=
      failed(ifsm_deformer_destroy(deformer)) | failed(ifsm_model_destroy(model)) | failed(ifsm_filter_destroy(filter));
  return status;
}
