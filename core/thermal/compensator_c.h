/* SPDX-License-Identifier: Apache-2.0 */
/* C interface of the thermal compensator (core/thermal/compensator.h).
 *
 * Loading happens outside the control loop and may allocate. spindrift_compensator_step neither allocates nor blocks.
 * Outputs are compensation values (minus the predicted deviation) in the unit of the model, um or urad. */
#ifndef SPINDRIFT_COMPENSATOR_C_H
#define SPINDRIFT_COMPENSATOR_C_H

#ifdef __cplusplus
extern "C" {
#endif

typedef struct spindrift_compensator spindrift_compensator;

enum spindrift_compensator_state {
  SPINDRIFT_COMPENSATOR_EMPTY = 0,
  SPINDRIFT_COMPENSATOR_RUNNING = 1,
  SPINDRIFT_COMPENSATOR_HOLDING = 2,
  SPINDRIFT_COMPENSATOR_FALLBACK = 3
};

/* Reads a spindrift-thermal-model file. Returns NULL and writes a sentence into `message` (at most `message_size`
 * bytes, always ended) if it cannot be used. limit: of each output; slew_per_s: of its change; 0 or less takes the
 * default. */
spindrift_compensator* spindrift_compensator_load(const char* model_file, double cycle_s, double limit,
                                                  double slew_per_s, char* message, int message_size);
void spindrift_compensator_free(spindrift_compensator* compensator);

int spindrift_compensator_inputs(const spindrift_compensator* compensator);
int spindrift_compensator_outputs(const spindrift_compensator* compensator);
const char* spindrift_compensator_input_name(const spindrift_compensator* compensator, int index);
const char* spindrift_compensator_output_name(const spindrift_compensator* compensator, int index);

/* One cycle; age_s may be NULL. Returns the state. */
int spindrift_compensator_step(spindrift_compensator* compensator, const double* inputs, const double* age_s,
                               double* outputs);
/* After an on-machine measurement: deviation = gain_factor * model + corrections. */
void spindrift_compensator_update(spindrift_compensator* compensator, int output, double gain_factor,
                                  double offset_correction);
void spindrift_compensator_reset(spindrift_compensator* compensator);

#ifdef __cplusplus
}
#endif

#endif
