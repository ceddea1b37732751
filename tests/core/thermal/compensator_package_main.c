/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs the example of the package (compensator_package_test.cmake). */
#include <stdio.h>

int compensate_one_minute(const char* model_file, double temperature_degC, double* compensation);

int main(int argc, char** argv) {
  double compensation = 0.0;
  const int state = compensate_one_minute(argc > 1 ? argv[1] : "", 25.0, &compensation);
  printf("state %d compensation %g\n", state, compensation);
  return 0;
}
