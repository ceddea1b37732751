/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How a controller written in C uses the compensator: load once, then one step per cycle. */
#include <stdio.h>
#include <string.h>

#include "core/thermal/compensator_c.h"

int compensate_one_minute(const char* model_file, double temperature_degC, double* compensation);

int compensate_one_minute(const char* model_file, double temperature_degC, double* compensation) {
  char message[256];
  double inputs[32] = {0.0};
  double outputs[8] = {0.0};
  int state = SPINDRIFT_COMPENSATOR_EMPTY;
  int i;
  int cycle;
  spindrift_compensator* c = spindrift_compensator_load(model_file, 1.0, 100.0, 1.0, message, (int)sizeof message);
  if (c == NULL) {
    fprintf(stderr, "%s\n", message);
    return state;
  }
  for (i = 0; i < spindrift_compensator_inputs(c); ++i) {
    const char* name = spindrift_compensator_input_name(c, i);
    if (strncmp(name, "T_", 2) == 0) inputs[i] = temperature_degC;
  }
  for (cycle = 0; cycle < 60; ++cycle) state = spindrift_compensator_step(c, inputs, NULL, outputs);
  *compensation = outputs[0];
  spindrift_compensator_free(c);
  return state;
}
