/* Draws Barnsley's fern: asks where its attractor is, and writes its picture as PPM to standard output.
 *
 *     render [name] > fern.ppm
 *
 * The name is one of those that ifsm_system_catalog lists. Pixels are red, green, blue and alpha; PPM has no alpha, so
 * the background is white. */
#include <ifsm.h>
#include <stdio.h>
#include <stdlib.h>

enum { SIZE = 512, RGBA = 4 };

static int failed(ifsm_status status) {
  ifsm_error error = {0};
  if (status == IFSM_OK) return 0;
  error.struct_size = sizeof error;
  if (ifsm_last_error(&error) == IFSM_OK) fprintf(stderr, "%s: %s\n", error.function, error.message);
  return 1;
}

static int tell_box(ifsm_system system) {
  double box[2 * 3];
  int64_t count = 0;
  if (failed(ifsm_system_box(system, 0, box, 2 * 3, &count))) return 1;
  fprintf(stderr, "from");
  for (int64_t k = 0; k < count; ++k) fprintf(stderr, "%s %g", k == count / 2 ? " to" : "", box[k]);
  fprintf(stderr, "\n");
  return 0;
}

static void write_ppm(const uint8_t *rgba) {
  printf("P6\n%d %d\n255\n", SIZE, SIZE);
  for (int pixel = 0; pixel < SIZE * SIZE; ++pixel) fwrite(rgba + RGBA * pixel, 1, 3, stdout);
}

int main(int argc, char **argv) {
  uint8_t *rgba = malloc(SIZE * SIZE * RGBA);
  ifsm_system system = {0};
  ifsm_picture_options options;
  ifsm_picture_report report = {0};
  int64_t count = 0;
  int status = rgba == NULL || failed(ifsm_picture_options_init(&options, sizeof options));
  report.struct_size = sizeof report;
  if (status == 0) {
    options.width = SIZE;
    options.palette = IFSM_PALETTE_FERN;
    options.background = 0xffffffffu;
    status = failed(ifsm_system_named(argc > 1 ? argv[1] : "fern", &system)) || tell_box(system) ||
             failed(ifsm_system_render(system, &options, &report, rgba, SIZE * SIZE * RGBA, &count));
  }
  if (status == 0) write_ppm(rgba);
  status |= failed(ifsm_system_destroy(system));
  free(rgba);
  return status;
}
