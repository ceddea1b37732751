// SPDX-License-Identifier: Apache-2.0
#include "core/thermal/compensator_c.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <memory>
#include <string>
#include <string_view>

#include "core/thermal/compensator.h"
#include "core/thermal/thermal_model.h"

struct spindrift_compensator {
  spindrift::Compensator object;
};

namespace {

void say(std::string_view text, char* message, std::size_t size) noexcept {
  if (message == nullptr || size == 0) return;
  const auto length = std::min(text.size(), size - 1);
  std::memcpy(message, text.data(), length);
  message[length] = '\0';
}

std::size_t copyName(std::string_view name, char* buffer, std::size_t size) noexcept {
  say(name, buffer, size);
  return name.empty() ? 0 : name.size() + 1;
}

}  // namespace

extern "C" {

spindrift_compensator* spindrift_compensator_load_with(const char* model_file,
                                                       const spindrift_compensator_options* options, char* message,
                                                       size_t message_size) {
  say("", message, message_size);
  constexpr std::size_t most_bytes = 4096;  // beyond that nobody has set it
  if (options == nullptr || options->struct_size < offsetof(spindrift_compensator_options, limit) ||
      options->struct_size > most_bytes) {
    say("No options were given, or their struct_size is not set.", message, message_size);
    return nullptr;
  }
  // What a later version of the struct asks for is not left out silently: a limit would be gone.
  const auto* bytes = reinterpret_cast<const unsigned char*>(options);
  if (options->struct_size > sizeof(spindrift_compensator_options) &&
      std::any_of(bytes + sizeof(spindrift_compensator_options), bytes + options->struct_size,
                  [](unsigned char byte) { return byte != 0; })) {
    say("The options ask for something that this version of the library does not know; allowed: 0 there.", message,
        message_size);
    return nullptr;
  }
  // What the caller's version of the struct does not have keeps its default.
  spindrift_compensator_options given{};
  std::memcpy(&given, options, std::min(options->struct_size, sizeof given));
  try {
    auto compensator = std::make_unique<spindrift_compensator>();
    spindrift::CompensatorLimits limits;
    const auto take = [](double value, double& limit) {
      if (value != 0.0) limit = value;
    };
    const auto take_or_zero = [&](double value, double& limit) {
      take(value, limit);
      if (value == SPINDRIFT_COMPENSATOR_ZERO) limit = 0.0;
    };
    take(given.limit, limits.limit);
    take(given.slew_per_s, limits.slew_per_s);
    take_or_zero(given.stale_after_s, limits.stale_after_s);
    take_or_zero(given.recover_after_s, limits.recover_after_s);
    take_or_zero(given.range_margin, limits.range_margin);
    take_or_zero(given.minimum_margin, limits.minimum_margin);
    take_or_zero(given.update_limit, limits.update_limit);
    take_or_zero(given.least_gain, limits.least_gain);
    take(given.most_gain, limits.most_gain);
    limits.forced = given.force != 0;
    const std::string problem =
        model_file == nullptr
            ? "No file was given."
            : compensator->object.load(spindrift::ThermalModel::read(model_file), given.cycle_s, limits);
    if (problem.empty()) return compensator.release();
    say(problem, message, message_size);
  } catch (const std::exception& error) {
    say(error.what(), message, message_size);
  }
  return nullptr;
}

spindrift_compensator* spindrift_compensator_load(const char* model_file, double cycle_s, double limit,
                                                  double slew_per_s, char* message, int message_size) {
  spindrift_compensator_options options{};
  options.struct_size = sizeof options;
  options.cycle_s = cycle_s;
  // What is no number is refused where it is taken.
  options.limit = limit <= 0.0 ? 0.0 : limit;
  options.slew_per_s = slew_per_s <= 0.0 ? 0.0 : slew_per_s;
  return spindrift_compensator_load_with(model_file, &options, message,
                                         message_size > 0 ? static_cast<std::size_t>(message_size) : 0);
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
  if (compensator == nullptr || outputs == nullptr) return SPINDRIFT_COMPENSATOR_EMPTY;
  return static_cast<int>(compensator->object.step(inputs, age_s, outputs));
}

int spindrift_compensator_step_sized(spindrift_compensator* compensator, const double* inputs, size_t input_count,
                                     const double* age_s, size_t age_count, double* outputs, size_t output_count) {
  if (compensator == nullptr || outputs == nullptr) return -1;
  const auto inputs_wanted = static_cast<std::size_t>(compensator->object.inputCount());
  if (input_count != (inputs == nullptr ? 0 : inputs_wanted) ||
      output_count != static_cast<std::size_t>(compensator->object.outputCount()) ||
      age_count != (age_s == nullptr ? 0 : inputs_wanted))
    return -1;
  return static_cast<int>(compensator->object.step(inputs, age_s, outputs));
}

int spindrift_compensator_get_status(const spindrift_compensator* compensator, spindrift_compensator_status* status) {
  if (compensator == nullptr || status == nullptr || status->struct_size <= sizeof status->struct_size) return -1;
  const spindrift::CompensatorStatus now = compensator->object.status();
  const spindrift_compensator_status all{
      status->struct_size, static_cast<std::int32_t>(now.state), now.refused_input,    now.refused_update,
      now.forced ? 1 : 0,  now.value_not_finite ? 1 : 0,         now.outside_training, now.limited_output,
      now.settling_s};
  std::memcpy(status, &all, std::min(status->struct_size, sizeof all));
  return 0;
}

size_t spindrift_compensator_copy_input_name(const spindrift_compensator* compensator, int index, char* buffer,
                                             size_t size) {
  return copyName(spindrift_compensator_input_name(compensator, index), buffer, size);
}

size_t spindrift_compensator_copy_output_name(const spindrift_compensator* compensator, int index, char* buffer,
                                              size_t size) {
  return copyName(spindrift_compensator_output_name(compensator, index), buffer, size);
}

int spindrift_compensator_update(spindrift_compensator* compensator, int output, double gain_factor,
                                 double offset_correction) {
  return compensator != nullptr && compensator->object.update(output, gain_factor, offset_correction) ? 1 : 0;
}

void spindrift_compensator_reset(spindrift_compensator* compensator) {
  if (compensator != nullptr) compensator->object.reset();
}

}  // extern "C"
