/* fit.c — from a file of samples to a model in a file, and back to points: every step, every error handled.
 *
 *     cc -std=c99 fit.c $(pkg-config --cflags --libs ifsm) -o fit
 *     ./fit                              fits a built-in curve, writes coast.ifsm.json
 *     ./fit samples.txt model.json       fits the points in samples.txt: "x y" on each line
 */
#include <ifsm.h>
#include <stdio.h>
#include <stdlib.h>

enum { DIMENSION = 2, BUDGET = 24, EVALUATED = 9 };

/* Says what went wrong, in the library's own words, and passes "it failed" on. */
static int failed(ifsm_status status) {
  ifsm_error error = {0};
  if (status == IFSM_OK) return 0;
  error.struct_size = sizeof error;
  if (ifsm_last_error(&error) != IFSM_OK) return 1;
  fprintf(stderr, "%s: %s\n  %s\n", error.function, ifsm_status_name(error.status), error.message);
  return 1;
}

/* A malloc'ed array of interleaved points, and how many; NULL when there are none to be had. */
typedef struct points {
  double *values;
  int64_t count;
} points;

/* A coast: a Takagi curve, that is, zigzags of ever smaller scale. */
static points built_in(void) {
  points made = {malloc(257 * DIMENSION * sizeof(double)), 257};
  if (made.values == NULL) return made;
  for (int k = 0; k < 257; ++k) {
    double y = 0;
    for (int scale = 256; scale > 1; scale /= 2) {
      const int within = k % scale;
      y += within < scale - within ? within : scale - within;
    }
    made.values[DIMENSION * k] = k;
    made.values[DIMENSION * k + 1] = y;
  }
  return made;
}

static points read_points(const char *path) {
  points read = {NULL, 0};
  int64_t room = 0;
  double x, y;
  FILE *file = fopen(path, "r");
  if (file == NULL) return perror(path), read;
  while (fscanf(file, "%lf %lf", &x, &y) == 2) {
    if (read.count == room) {
      double *more = realloc(read.values, (size_t)(room = 2 * room + 64) * DIMENSION * sizeof(double));
      if (more == NULL) {
        free(read.values), fclose(file), perror(path);
        return (points){NULL, 0};
      }
      read.values = more;
    }
    read.values[DIMENSION * read.count] = x;
    read.values[DIMENSION * read.count + 1] = y;
    ++read.count;
  }
  if (!feof(file))
    fprintf(stderr, "%s: line %ld is not \"x y\"; the points before it are used\n", path, (long)read.count + 1);
  fclose(file);
  return read;
}

static int32_t show_progress(void *user, double fraction, const char *stage) {
  (void)user;
  fprintf(stderr, "\r%3.0f %% %-20s", 100 * fraction, stage);
  return 0; /* anything else cancels */
}

/* Fits a filter to the samples; `model` is their exact model under it. */
static int fit_model(points samples, ifsm_model *model) {
  const ifsm_curve curve = {samples.values, samples.count, DIMENSION, 0};
  const int64_t budget = BUDGET;
  ifsm_fit_options options;
  ifsm_fit_budget row = {0};
  ifsm_fit fit = {0};
  int wrong = failed(ifsm_fit_options_init(&options, sizeof options));
  if (wrong) return wrong;
  options.control_points = 3;
  options.budgets = &budget;
  options.budget_count = 1;
  options.progress = show_progress;
  row.struct_size = sizeof row;

  wrong = ifsm_fit_sparse(&curve, 1, &options, &fit);
  fputc('\n', stderr);
  wrong = failed(wrong) || failed(ifsm_fit_describe_budget(fit, 0, 0, &row)) || failed(ifsm_fit_model(fit, 0, model));
  if (!wrong) printf("with %d vectors: rms %.4g, before the fit %.4g\n", BUDGET, row.rms, row.start_rms);
  return failed(ifsm_fit_destroy(fit)) || wrong; /* the model lives on */
}

/* The two-step call: ask for the count, then for the bytes. */
static int save(ifsm_model model, const char *path) {
  int64_t count = 0;
  uint8_t *bytes = NULL;
  FILE *file = NULL;
  int wrong = failed(ifsm_model_save(model, IFSM_FORMAT_JSON, NULL, 0, &count));
  if (wrong) return wrong;
  if ((bytes = malloc((size_t)count)) == NULL) return perror("malloc"), 1;
  wrong = failed(ifsm_model_save(model, IFSM_FORMAT_JSON, bytes, count, &count));
  if (!wrong && (file = fopen(path, "wb")) == NULL) perror(path), wrong = 1;
  if (!wrong && fwrite(bytes, 1, (size_t)count, file) != (size_t)count) perror(path), wrong = 1;
  if (file != NULL && fclose(file) != 0) perror(path), wrong = 1;
  free(bytes);
  if (!wrong) printf("%s: %ld bytes\n", path, (long)count);
  return wrong;
}

static int load(const char *path, ifsm_model *model) {
  long size = 0;
  uint8_t *bytes = NULL;
  int wrong = 1;
  FILE *file = fopen(path, "rb");
  if (file == NULL) return perror(path), 1;
  if (fseek(file, 0, SEEK_END) != 0 || (size = ftell(file)) <= 0 || fseek(file, 0, SEEK_SET) != 0 ||
      (bytes = malloc((size_t)size)) == NULL || fread(bytes, 1, (size_t)size, file) != (size_t)size)
    perror(path);
  else
    wrong = failed(ifsm_model_load(bytes, size, model));
  free(bytes);
  fclose(file);
  return wrong;
}

static int print_curve(ifsm_model model) {
  double parameters[EVALUATED], values[EVALUATED * DIMENSION];
  int64_t count = 0;
  for (int k = 0; k < EVALUATED; ++k) parameters[k] = (double)k / (EVALUATED - 1);
  if (failed(ifsm_model_evaluate(model, IFSM_CURVE_POLYLINE, parameters, EVALUATED, values, EVALUATED * DIMENSION,
                                 &count)))
    return 1;
  for (int k = 0; k < EVALUATED; ++k)
    printf("%6.3f  %10.4f %10.4f\n", parameters[k], values[DIMENSION * k], values[DIMENSION * k + 1]);
  return 0;
}

int main(int argc, char **argv) {
  const char *path = argc > 2 ? argv[2] : "coast.ifsm.json";
  points samples = argc > 1 ? read_points(argv[1]) : built_in();
  ifsm_model fitted = {0}, loaded = {0};
  int wrong = samples.values == NULL || fit_model(samples, &fitted) || save(fitted, path) || load(path, &loaded) ||
              print_curve(loaded);
  wrong = failed(ifsm_model_destroy(fitted)) || wrong; /* {0} is fine, should it never have been made */
  wrong = failed(ifsm_model_destroy(loaded)) || wrong;
  free(samples.values);
  return wrong ? EXIT_FAILURE : EXIT_SUCCESS;
}
