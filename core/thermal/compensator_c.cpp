// SPDX-License-Identifier: Apache-2.0
#include "core/thermal/compensator_c.h"

#include <algorithm>
#include <cstring>
#include <exception>
#include <memory>
#include <string>

#include "core/thermal/compensator.h"
#include "core/thermal/thermal_model.h"

struct spindrift_compensator {
  spindrift::Compensator object;
};

namespace {

void say(const std::string& text, char* message, int size) noexcept {
  if (message == nullptr || size <= 0) return;
  const auto length = std::min(text.size(), static_cast<std::size_t>(size) - 1);
  std::memcpy(message, text.data(), length);
  message[length] = '\0';
}

}  // namespace

extern "C" {

spindrift_compensator* spindrift_compensator_load(const char* model_file, double cycle_s, double limit,
                                                  double slew_per_s, char* message, int message_size) {
  say("", message, message_size);
  try {
    auto compensator = std::make_unique<spindrift_compensator>();
    spindrift::CompensatorLimits limits;
    if (limit > 0.0) limits.limit = limit;
    if (slew_per_s > 0.0) limits.slew_per_s = slew_per_s;
    const std::string problem =
        model_file == nullptr ? "No file was given."
                              : compensator->object.load(spindrift::ThermalModel::read(model_file), cycle_s, limits);
    if (problem.empty()) return compensator.release();
    say(problem, message, message_size);
  } catch (const std::exception& error) {
    say(error.what(), message, message_size);
  }
  return nullptr;
}

void spindrift_compensator_free(spindrift_compensator* compensator) {
  delete compensator;
}

int spindrift_compensator_inputs(const spindrift_compensator* compensator) {
  return compensator != nullptr ? compensator->object.inputCount() : 0;
}

int spindrift_compensator_outputs(const spindrift_compensator* compensator) {
  return compensator != nullptr ? compensator->object.outputCount() : 0;
}

const char* spindrift_compensator_input_name(const spindrift_compensator* compensator, int index) {
  return compensator != nullptr ? compensator->object.inputName(index) : "";
}

const char* spindrift_compensator_output_name(const spindrift_compensator* compensator, int index) {
  return compensator != nullptr ? compensator->object.outputName(index) : "";
}

int spindrift_compensator_step(spindrift_compensator* compensator, const double* inputs, const double* age_s,
                               double* outputs) {
  if (compensator == nullptr || inputs == nullptr || outputs == nullptr) return SPINDRIFT_COMPENSATOR_EMPTY;
  return static_cast<int>(compensator->object.step(inputs, age_s, outputs));
}

void spindrift_compensator_update(spindrift_compensator* compensator, int output, double gain_factor,
                                  double offset_correction) {
  if (compensator != nullptr) compensator->object.update(output, gain_factor, offset_correction);
}

void spindrift_compensator_reset(spindrift_compensator* compensator) {
  if (compensator != nullptr) compensator->object.reset();
}

}  // extern "C"
