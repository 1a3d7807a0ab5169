/* Asks a system of one's own what is known about it: the Koch curve from four similarities. Where a word leads, which
 * addresses a point has, how its measure lies, and its dimension, exact and counted. */
#include <ifsm.h>
#include <math.h>
#include <stdio.h>

enum { MAPS = 4, PER_MAP = 6 };

static int failed(ifsm_status status) {
  ifsm_error error = {0};
  if (status == IFSM_OK) return 0;
  error.struct_size = sizeof error;
  if (ifsm_last_error(&error) == IFSM_OK) fprintf(stderr, "%s: %s\n", error.function, error.message);
  return 1;
}

/* angle, scale x, scale y, shear, shift x, shift y */
static int make(ifsm_system *koch) {
  const double third = 1.0 / 3, turn = acos(0.5), height = sqrt(3.0) / 6;
  const double parameters[MAPS * PER_MAP] = {0,     third, third, 0, 0,   0,      turn, third, third, 0, third,     0,
                                             -turn, third, third, 0, 0.5, height, 0,    third, third, 0, 2 * third, 0};
  return failed(ifsm_system_from_parameters(2, parameters, MAPS * PER_MAP, NULL, 0, koch));
}

static int tell(ifsm_system koch) {
  const int32_t address[] = {1, 3}; /* 1 3 3 3 …: the peak */
  double peak[2], moments[6], exact = 0, rows[2 * 32];
  int32_t symbols[8];
  int64_t count = 0;
  ifsm_dimension_report counted = {0};
  counted.struct_size = sizeof counted;
  if (failed(ifsm_system_point(koch, address, 2, 1, peak, 2, &count))) return 1;
  printf("The peak is at %.6f, %.6f\n", peak[0], peak[1]);
  if (failed(ifsm_system_addresses(koch, peak, 2, 2, 1e-9, symbols, 8, &count))) return 1;
  for (int64_t k = 0; k < count; k += 2)
    printf("  and has the address %d %d …\n", (int)symbols[k], (int)symbols[k + 1]);
  if (failed(ifsm_system_moments(koch, 2, NULL, 0, moments, 6, &count))) return 1;
  printf("Mean %.6f, %.6f; variance of x %.6f\n", moments[1], moments[2], moments[3] - moments[1] * moments[1]);
  if (failed(ifsm_system_similarity_dimension(koch, &exact))) return 1;
  if (failed(ifsm_system_box_dimension(koch, 0, &counted, rows, 2 * 32, &count))) return 1;
  printf("Dimension %.10f; counted in boxes %.2f\n", exact, counted.dimension);
  return fabs(exact - log(4.0) / log(3.0)) > 1e-12;
}

int main(void) {
  ifsm_system koch = {0};
  int status = make(&koch) || tell(koch);
  status |= failed(ifsm_system_destroy(koch));
  return status;
}
