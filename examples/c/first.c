#include <ifsm.h>
#include <stdio.h>

int main(void) {
  double samples[257 * 2];                       // x0 y0 x1 y1 …: ordered points, any finite doubles
  for (int k = 0; k < 257; ++k) { samples[2*k] = k; samples[2*k + 1] = (k * k) % 101; }
  ifsm_curve curve = {samples, 257, 2, 0};       // borrowed while the call runs
  ifsm_fit fit = {0};
  ifsm_model model = {0}, sketch = {0};
  ifsm_keep_options keep;
  double points[257 * 2];
  int64_t count = 0;
  if (ifsm_keep_options_init(&keep, sizeof keep)) return 1;
  keep.rule = IFSM_KEEP_COUNT, keep.count = 32, keep.resolve = IFSM_RESOLVE_CHOICE;
  if (ifsm_fit_sparse(&curve, 1, NULL, &fit) || ifsm_fit_model(fit, 0, &model) ||
      ifsm_model_keep(model, &keep, &sketch) || ifsm_model_samples(sketch, points, 257 * 2, &count)) {
    ifsm_error error = {.struct_size = sizeof error};
    if (ifsm_last_error(&error) == IFSM_OK) fprintf(stderr, "%s\n", error.message);
  }
  int failed = count == 0;
  failed |= ifsm_model_destroy(sketch) | ifsm_model_destroy(model) | ifsm_fit_destroy(fit);
  return failed;
}
