/* Bends a curve by its control points: its texture follows.
 *
 * The filter is "casteljau": smooth parts have no details under it, so what turns with the control polygon is texture
 * alone. (Filters that were trained or fitted tell smooth parts by details that cancel; move their control points with
 * IFSM_FRAME_ABSOLUTE.) The middle control point moves up by a fifth of the curve's size. Prints the curve before and
 * after, as a table. */
#include <ifsm.h>
#include <stdio.h>

enum { SAMPLES = 257, DIMENSION = 2, CONTROL_POINTS = 5, DOUBLES = SAMPLES * DIMENSION };

static int failed(ifsm_status status) {
  ifsm_error error = {0};
  if (status == IFSM_OK) return 0;
  error.struct_size = sizeof error;
  if (ifsm_last_error(&error) == IFSM_OK) fprintf(stderr, "%s: %s\n", error.function, error.message);
  return 1;
}

/* A rough hill: x runs from 0 to 1. */
static void measure(double *points) {
  unsigned noise = 1;
  for (int k = 0; k < SAMPLES; ++k) {
    const double x = (double)k / (SAMPLES - 1);
    noise = noise * 1103515245u + 12345u;
    points[2 * k] = x;
    points[2 * k + 1] = x * (1 - x) + 0.03 * ((noise >> 16 & 1023) / 1023.0 - 0.5);
  }
}

static int bend(ifsm_model model, ifsm_model *bent) {
  double polygon[CONTROL_POINTS * DIMENSION];
  int64_t count = 0;
  ifsm_model_info info = {0};
  info.struct_size = sizeof info;
  if (failed(ifsm_model_describe(model, &info))) return 1;
  if (failed(ifsm_model_control_points(model, polygon, CONTROL_POINTS * DIMENSION, &count))) return 1;
  polygon[2 * 2 + 1] += 0.2 * info.diagonal;
  return failed(ifsm_model_with_control_points(model, IFSM_FRAME_NODE, polygon, count, bent));
}

int main(void) {
  static double before[DOUBLES], after[DOUBLES];
  const ifsm_curve curve = {before, SAMPLES, DIMENSION, 0};
  ifsm_filter filter = {0};
  ifsm_model model = {0}, bent = {0};
  int64_t count = 0;
  int status = 0;
  measure(before);
  status = failed(ifsm_filter_named("casteljau", IFSM_TOPOLOGY_JOINED, 0, 0, &filter)) ||
           failed(ifsm_model_create(filter, &curve, NULL, &model)) || bend(model, &bent) ||
           failed(ifsm_model_samples(bent, after, DOUBLES, &count));
  if (status == 0) {
    printf("x,y,bent_x,bent_y\n");
    for (int k = 0; k < SAMPLES; ++k)
      printf("%g,%g,%g,%g\n", before[2 * k], before[2 * k + 1], after[2 * k], after[2 * k + 1]);
  }
  /* {0} may be destroyed, so that one way out serves all. */
  status |= failed(ifsm_model_destroy(bent)) | failed(ifsm_model_destroy(model)) | failed(ifsm_filter_destroy(filter));
  return status;
}
