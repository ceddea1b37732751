// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/random.h"

namespace spindrift {
namespace {

/// Smoothed Ornstein-Uhlenbeck process sampled every step: starts at 0, standard deviation `sigma` in the long run.
std::vector<double> wander(Random& random, std::size_t count, double step_s, double correlation_s, double sigma) {
  std::vector<double> values(count, 0.0);
  const double keep = std::exp(-step_s / correlation_s);
  const double kick = sigma * std::sqrt(1.0 - keep * keep);
  double raw = 0.0;
  double smooth = 0.0;
  const double follow = 1.0 - std::exp(-step_s / 900.0);  // the air of a hall does not jump
  for (std::size_t i = 1; i < count; ++i) {
    raw = keep * raw + kick * random.normal();
    smooth += follow * (raw - smooth);
    values[i] = smooth;
  }
  return values;
}

double interpolated(const std::vector<double>& values, double step_s, double time_s) {
  if (values.empty()) return 0.0;
  const double place = std::clamp(time_s / step_s, 0.0, static_cast<double>(values.size() - 1));
  const auto i = std::min(static_cast<std::size_t>(place), values.size() - 1);
  const auto next = std::min(i + 1, values.size() - 1);
  return values[i] + (place - static_cast<double>(i)) * (values[next] - values[i]);
}

}  // namespace

Environment::Environment(const EnvironmentOptions& options, double duration_s, std::uint64_t seed) : options_(options) {
  Random random(seed);
  const auto count = static_cast<std::size_t>(duration_s / step_s_) + 2;
  weather_K_ = wander(random, count, step_s_, options.weather_hours * 3600.0, options.weather_K);
  Random wet = random.split();
  humidity_ = wander(wet, count, step_s_, 3.0 * 3600.0, 8.0);
  for (int i = 0; i < options.random_doors; ++i) {
    options_.doors.push_back(
        {random.uniform(0.05, 0.95) * duration_s, random.uniform(0.5, 2.5), random.uniform(600.0, 2400.0)});
  }
}

double Environment::room_degC(double time_s) const {
  constexpr double day_s = 86400.0;
  const double angle = 2.0 * std::numbers::pi * (time_s / day_s - options_.day_phase_h / 24.0);
  double room = options_.temperature_degC + options_.day_amplitude_K * std::sin(angle) +
                options_.ramp_K_per_h * time_s / 3600.0 + interpolated(weather_K_, step_s_, time_s);
  for (const DoorEvent& door : options_.doors) {
    if (time_s >= door.time_s) room -= door.drop_K * std::exp(-(time_s - door.time_s) / door.recovery_s);
  }
  return room;
}

double Environment::humidity_percent(double time_s) const {
  return interpolated(humidity_, step_s_, time_s);
}

}  // namespace spindrift
