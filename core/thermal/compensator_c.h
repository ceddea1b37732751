/* SPDX-License-Identifier: Apache-2.0 */
/* C interface of the thermal compensator (core/thermal/compensator.h).
 *
 * Loading happens outside the control loop and may allocate. spindrift_compensator_step neither allocates nor blocks.
 * Outputs are compensation values (minus the predicted deviation) in the unit of the model, um or urad.
 *
 * Time of a step: no loop in it depends on values. It is at most 1024 lags, 8 x 96 products and 96 powers, and numbers
 * that decay are set to zero before they become subnormal. Measured (tests/benchmarks/thermal/thermal_speed.cpp, one
 * core of a busy x86-64 machine, with the clock): 0.2 us for 8 inputs of order 3 in 6 outputs; for the largest model
 * (32 signals with three powers, 8 outputs, 1024 lags) 1.7 us in the median and below 7 us in 99.9 % of the steps. What
 * is longer was an interruption by the system: a controller with a real-time system measures its own worst case. */
#ifndef SPINDRIFT_COMPENSATOR_C_H
#define SPINDRIFT_COMPENSATOR_C_H

#include <stddef.h>
#include <stdint.h>

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
 * bytes, always ended) if it cannot be used, also if its identification called it not good enough. limit: of each
 * output; slew_per_s: of its change; 0 or less takes the default. */
spindrift_compensator* spindrift_compensator_load(const char* model_file, double cycle_s, double limit,
                                                  double slew_per_s, char* message, int message_size);
void spindrift_compensator_free(spindrift_compensator* compensator);

/* Asks for 0 where 0 stands for the default; limit, slew_per_s and most_gain cannot be 0. */
#define SPINDRIFT_COMPENSATOR_ZERO (-1.0)

/* Options of a load. Set `struct_size` to sizeof and leave 0 what shall have its default; a later version of the
 * library only adds members at the end and takes a shorter struct as it is; an earlier one refuses a longer struct that
 * is not 0 beyond what it knows. Units: um or urad, s. */
typedef struct spindrift_compensator_options {
  size_t struct_size;
  double cycle_s;         /* needed */
  double limit;           /* of the magnitude of every output */
  double slew_per_s;      /* of the change of every output */
  double stale_after_s;   /* an input without a good value for longer is stale */
  double recover_after_s; /* good again for this long before the compensation returns */
  double range_margin;    /* part of the range of training by which an input may leave it */
  double minimum_margin;  /* but never less than this, in the input's unit */
  double update_limit;    /* of the sum of measured offsets; never more than limit */
  int32_t force;          /* 1: take a model that its identification called not good enough */
  double least_gain;      /* a measured gain factor below is refused */
  double most_gain;       /* and one above */
} spindrift_compensator_options;

/* As spindrift_compensator_load, with options. */
spindrift_compensator* spindrift_compensator_load_with(const char* model_file,
                                                       const spindrift_compensator_options* options, char* message,
                                                       size_t message_size);

/* Set `struct_size` to sizeof; no more than that is written. */
typedef struct spindrift_compensator_status {
  size_t struct_size;
  int32_t state;            /* enum spindrift_compensator_state */
  int32_t refused_input;    /* first input refused in the last step, -1 if none */
  int32_t refused_update;   /* output whose last measured update was refused, -1 if none */
  int32_t forced;           /* 1: the model was called not good enough and was loaded by force */
  int32_t value_not_finite; /* 1: the model's own value was no number in the last step */
  int32_t outside_training; /* first input used in the last step outside its range of training, -1 if none */
  int32_t limited_output;   /* first output that stands at its limit, -1 if none */
  double settling_s;        /* how long what the machine did before the first good step still counts, 0: settled */
} spindrift_compensator_status;

/* 0, or -1 if an argument is NULL or the struct has no size. */
int spindrift_compensator_get_status(const spindrift_compensator* compensator, spindrift_compensator_status* status);

/* Copies a name of any length into `buffer` (at most `size` bytes, always ended) and returns the bytes that the whole
 * name needs with its end, 0 for an index that does not exist. */
size_t spindrift_compensator_copy_input_name(const spindrift_compensator* compensator, int index, char* buffer,
                                             size_t size);
size_t spindrift_compensator_copy_output_name(const spindrift_compensator* compensator, int index, char* buffer,
                                              size_t size);

/* One cycle with the lengths of all arrays. Returns the state, or -1 without touching anything if a length is not that
 * of the model, or compensator or outputs is NULL. age_s may be NULL (then age_count is 0); inputs may be NULL (then
 * input_count is 0) in a cycle for which none has come: the outputs are held, and faded to zero as for any bad input.
 */
int spindrift_compensator_step_sized(spindrift_compensator* compensator, const double* inputs, size_t input_count,
                                     const double* age_s, size_t age_count, double* outputs, size_t output_count);

int spindrift_compensator_inputs(const spindrift_compensator* compensator);
int spindrift_compensator_outputs(const spindrift_compensator* compensator);
const char* spindrift_compensator_input_name(const spindrift_compensator* compensator, int index);
const char* spindrift_compensator_output_name(const spindrift_compensator* compensator, int index);

/* One cycle; age_s and inputs may be NULL as above. Returns the state; SPINDRIFT_COMPENSATOR_EMPTY without touching
 * anything if compensator or outputs is NULL. */
int spindrift_compensator_step(spindrift_compensator* compensator, const double* inputs, const double* age_s,
                               double* outputs);
/* After an on-machine measurement: deviation = gain_factor * model + corrections. Returns 1, or 0 if the values are
 * impossible: then nothing changes and the status says so. */
int spindrift_compensator_update(spindrift_compensator* compensator, int output, double gain_factor,
                                 double offset_correction);
/* Forgets what the inputs were and for how long they have been bad: the next good step begins at rest. The outputs go
 * on from where they are with the slew limit, and measured updates stay. */
void spindrift_compensator_reset(spindrift_compensator* compensator);

#ifdef __cplusplus
}
#endif

#endif
