/* Edits that take place in time: a hill is bent while its texture grows, frame by frame, and the edits are kept as text
 * and made again on a second deformer. Prints the frames, a column each, as a table; the edits go to standard error. */
#include <ifsm.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SAMPLES = 129, FRAMES = 5 };

static int failed(ifsm_status status) {
  ifsm_error error = {0};
  if (status == IFSM_OK) return 0;
  error.struct_size = sizeof error;
  if (ifsm_last_error(&error) == IFSM_OK) fprintf(stderr, "%s: %s\n", error.function, error.message);
  return 1;
}

/* A profile: one height a sample. */
static void measure(double *heights) {
  unsigned noise = 1;
  for (int k = 0; k < SAMPLES; ++k) {
    const double x = (double)k / (SAMPLES - 1);
    noise = noise * 1103515245u + 12345u;
    heights[k] = x * (1 - x) + 0.03 * ((noise >> 16 & 1023) / 1023.0 - 0.5);
  }
}

/* From 0 to 2 the middle control point rises; from 1 to 3 the last two levels of details double. */
static int edit(ifsm_deformer deformer, int32_t levels) {
  const int64_t middle = 2;
  const double by = 0.5;
  return failed(ifsm_deformer_time(deformer, 0, 2, IFSM_EASING_SMOOTH)) ||
         failed(ifsm_deformer_move(deformer, 0, &middle, 1, &by, 1, NULL)) ||
         failed(ifsm_deformer_time(deformer, 1, 3, IFSM_EASING_LINEAR)) ||
         failed(ifsm_deformer_restyle(deformer, levels - 2, levels - 1, 2, NULL));
}

static int tell_frame(ifsm_deformer deformer, double time, double *heights) {
  ifsm_deformer frame = {0};
  int64_t count = 0;
  const int status = failed(ifsm_deformer_at_time(deformer, time, &frame)) ||
                     failed(ifsm_deformer_samples(frame, heights, SAMPLES, &count));
  return failed(ifsm_deformer_destroy(frame)) | status;
}

/* The edits as text, to be freed by the caller; NULL when that failed. */
static char *kept_edits(ifsm_deformer deformer, int64_t *count) {
  char *text = NULL;
  if (failed(ifsm_deformer_save(deformer, IFSM_FORMAT_JSON, NULL, 0, count))) return NULL;
  text = malloc((size_t)*count);
  if (text != NULL && failed(ifsm_deformer_save(deformer, IFSM_FORMAT_JSON, (uint8_t *)text, *count, count))) {
    free(text);
    text = NULL;
  }
  return text;
}

/* The second deformer, after the same edits, is where the first one is, to the bit. */
static int check_replay(ifsm_deformer deformer, ifsm_deformer second) {
  static double first_end[SAMPLES], second_end[SAMPLES];
  int64_t count = 0;
  int status = 1;
  char *edits = kept_edits(deformer, &count);
  if (edits == NULL) return 1;
  fprintf(stderr, "%.*s", (int)count, edits);
  status = failed(ifsm_deformer_replay(second, (const uint8_t *)edits, count)) ||
           failed(ifsm_deformer_samples(deformer, first_end, SAMPLES, &count)) ||
           failed(ifsm_deformer_samples(second, second_end, SAMPLES, &count));
  free(edits);
  if (status == 0 && memcmp(first_end, second_end, sizeof first_end) != 0) {
    fprintf(stderr, "the same edits have led elsewhere\n");
    status = 1;
  }
  return status;
}

int main(void) {
  static double heights[SAMPLES], frames[FRAMES][SAMPLES];
  const ifsm_curve curve = {heights, SAMPLES, 1, 0};
  ifsm_filter filter = {0};
  ifsm_model model = {0};
  ifsm_deformer deformer = {0}, second = {0};
  ifsm_deformer_info info = {0};
  int status = 0;
  info.struct_size = sizeof info;
  measure(heights);
  status = failed(ifsm_filter_named("casteljau", IFSM_TOPOLOGY_JOINED, 5, 2, &filter)) ||
           failed(ifsm_model_create(filter, &curve, NULL, &model)) ||
           failed(ifsm_deformer_create(model, NULL, &deformer)) || failed(ifsm_deformer_create(model, NULL, &second)) ||
           failed(ifsm_deformer_describe(deformer, &info)) || edit(deformer, info.levels) ||
           failed(ifsm_deformer_describe(deformer, &info)); /* again: it knows now when the edits begin and end */
  for (int k = 0; status == 0 && k < FRAMES; ++k)
    status = tell_frame(deformer, info.begin + (info.end - info.begin) * k / (FRAMES - 1), frames[k]);
  if (status == 0) status = check_replay(deformer, second);
  for (int sample = 0; status == 0 && sample < SAMPLES; ++sample)
    for (int k = 0; k < FRAMES; ++k) printf("%g%c", frames[k][sample], k + 1 < FRAMES ? ',' : '\n');
  status |= failed(ifsm_deformer_destroy(second)) | failed(ifsm_deformer_destroy(deformer)) |
            failed(ifsm_model_destroy(model)) | failed(ifsm_filter_destroy(filter));
  return status;
}
