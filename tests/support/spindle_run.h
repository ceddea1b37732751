// SPDX-License-Identifier: GPL-3.0-or-later
// Made records of a machine under changing speeds: a network of bodies heated by the spindle and the room, sensors that
// each see a mixture of them, a displacement that follows bodies, sensors or something that no sensor sees.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/thermal/time_series.h"

namespace spindrift::testing {

/// Output `z_um`; inputs spindle_rpm and 5 ... 12 temperatures, rows of 30 s over 8 ... 16 h. The structure is the seed
/// modulo 4: a line on three temperatures; two bodies between the sensors; a growth that follows the speed with a time
/// constant of its own and next to no sensor; bodies with a zero that wanders. Speeds of the last part may exceed those
/// of the first.
inline TimeSeries spindleRun(std::uint64_t seed) {
  Random random(7000 + seed);
  constexpr double dt = 30.0;
  const double hours = random.uniform(8.0, 16.0);
  const auto rows = static_cast<std::size_t>(hours * 3600.0 / dt);
  const auto sensors = static_cast<std::size_t>(random.uniform(5.0, 13.0));
  const double exponent = random.uniform(1.0, 1.8);
  const double room = random.uniform(18.0, 24.0);
  const double swing = random.uniform(0.2, 2.0);
  const double longest_s = 3600.0 * random.uniform(0.7, 2.5);
  std::array<double, 4> tau_s{};
  std::array<double, 4> heating{};
  std::array<double, 4> of_room{};
  for (std::size_t b = 0; b < tau_s.size(); ++b) {
    tau_s[b] = std::exp(random.uniform(std::log(300.0), std::log(12000.0)));
    heating[b] = random.uniform(0.0, 14.0);
    of_room[b] = random.uniform(0.5, 1.0);
  }
  heating[3] = 0.0;  // the bed: room only
  std::array<double, 4> body{};
  body.fill(room);
  std::vector<std::array<double, 4>> bodies;
  std::vector<double> speed;
  std::vector<double> hidden;
  const double hidden_tau_s = random.uniform(400.0, 4000.0);
  double grown = 0.0;
  double rpm = 0.0;
  double until_s = 1800.0 * random.uniform();
  TimeSeries s;
  s.file = "spindle_run.csv";
  for (std::size_t k = 0; k < rows; ++k) {
    const double t = static_cast<double>(k) * dt;
    s.time_s.push_back(t);
    if (t >= until_s) {
      const double top = t < 0.6 * hours * 3600.0 ? 8000.0 : 10000.0;
      rpm = rpm > 0.0 && random.uniform() < 0.4 ? 0.0 : 500.0 * std::floor(random.uniform(1.0, top / 500.0));
      until_s = t + longest_s * random.uniform(0.2, 1.0);
    }
    const double load = std::pow(rpm / 8000.0, exponent);
    const double air = room + swing * std::sin(t / 86400.0 * 2.0 * 3.14159265358979 + 1.0);
    for (std::size_t b = 0; b < body.size(); ++b)
      body[b] += dt / tau_s[b] * (room + of_room[b] * (air - room) + heating[b] * load - body[b]);
    grown += dt / hidden_tau_s * (load - grown);
    bodies.push_back(body);
    speed.push_back(rpm);
    hidden.push_back(grown);
  }
  s.signals.push_back({"spindle_rpm", SignalKind::Speed, speed});
  std::vector<std::vector<double>> seen;
  for (std::size_t i = 0; i < sensors; ++i) {
    std::array<double, 4> part{};
    double sum = 0.0;
    for (double& p : part) sum += p = std::pow(random.uniform(), 3.0);
    Signal signal{"T" + std::to_string(i) + "_degC", SignalKind::Temperature, {}};
    seen.emplace_back();
    for (const auto& b : bodies) {
      double v = 0.0;
      for (std::size_t j = 0; j < b.size(); ++j) v += part[j] / sum * b[j];
      seen.back().push_back(v);
      signal.values.push_back(0.02 * std::round((v + random.normal(0.0, 0.03)) / 0.02));
    }
    s.signals.push_back(std::move(signal));
  }
  std::array<double, 4> gain{};
  for (double& g : gain) g = random.uniform(-2.0, 4.0);
  const double of_speed = random.uniform(4.0, 12.0);
  const auto structure = seed % 4;
  double wander = 0.0;
  Signal z{"z_um", SignalKind::Displacement, {}};
  for (std::size_t k = 0; k < rows; ++k) {
    wander += random.normal(0.0, structure == 3 ? 0.05 : 0.002);
    double v = wander + random.normal(0.0, 0.15);
    for (std::size_t j = 0; j < gain.size(); ++j) {
      if (structure == 0) {
        if (j < 3) v += gain[j] * (seen[j][k] - room);
      } else if (structure == 1) {
        if (j % 2 == 1) v += gain[j] * (bodies[k][j] - room);
      } else {
        v += 0.3 * gain[j] * (bodies[k][j] - room);
      }
    }
    if (structure == 2) v += of_speed * hidden[k];
    if (random.uniform() < 0.0003) v += 1.5;
    z.values.push_back(v);
  }
  s.signals.push_back(std::move(z));
  return s;
}

}  // namespace spindrift::testing
