// SPDX-License-Identifier: Apache-2.0
// The room around the virtual machine: day cycle, weather, doors, sun, and the hidden causes that no log knows.
//
// Room temperature = mean + amplitude * sin(2 pi (t - phase) / 24 h) + ramp * t + weather + doors. Weather is an
// Ornstein-Uhlenbeck process; an opened door drops the air at once and the room recovers exponentially.
#pragma once

#include <cstdint>
#include <vector>

namespace spindrift {

struct DoorEvent {
  double time_s = 0.0;
  double drop_K = 2.0;
  double recovery_s = 1200.0;  ///< > 0
};

struct EnvironmentOptions {
  double temperature_degC = 20.0;
  double day_amplitude_K = 1.5;
  double day_phase_h = 2.0;  ///< the campaign starts this long before the cycle crosses its mean upwards
  double ramp_K_per_h = 0.0;
  double weather_K = 0.3;      ///< standard deviation of the weather
  double weather_hours = 4.0;  ///< its correlation time, > 0
  std::vector<DoorEvent> doors;
  int random_doors = 0;               ///< further doors at random times
  double coolant_below_room_K = 3.0;  ///< tank of the coolant below the mean of the room
};

/// Room temperature as a function of time, the same for the same seed.
class Environment {
 public:
  Environment() = default;
  Environment(const EnvironmentOptions& options, double duration_s, std::uint64_t seed);
  [[nodiscard]] double room_degC(double time_s) const;
  [[nodiscard]] double coolant_degC() const { return options_.temperature_degC - options_.coolant_below_room_K; }
  /// Relative humidity minus its start, in percent: a hidden cause, not in any log.
  [[nodiscard]] double humidity_percent(double time_s) const;

 private:
  EnvironmentOptions options_;
  double step_s_ = 60.0;
  std::vector<double> weather_K_;
  std::vector<double> humidity_;
};

}  // namespace spindrift
