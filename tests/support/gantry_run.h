// SPDX-License-Identifier: GPL-3.0-or-later
// Made records of a frame over 5 ... 7 h with two to four temperatures and one deviation of some tens of um. What the
// deviation follows and what makes the record hard go round with the seed, so that every sixteen seeds in a row hold
// each pair once.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/thermal/time_series.h"

namespace spindrift::testing {

/// What the deviation follows; `seed % 4`.
enum class GantryPlant {
  Static,       ///< the temperatures as they are, no memory
  OutputError,  ///< one lag of its own for every temperature, noise at the reading
  Arx,          ///< a difference equation of second order shared by all temperatures, which the noise goes through
  Bodies        ///< bodies between the sensors, one of them seen by none
};
/// What makes it hard; `seed / 4 % 4`.
enum class GantryTrouble {
  FewRows,        ///< a row every two minutes, noise of a twentieth of the course
  RangeLeft,      ///< after 60 % of the record hotter than ever before
  ColouredNoise,  ///< noise with a memory of twenty minutes
  AmbientDrift    ///< a room that changes over hours, which no sensor reads
};

/// Output `z_um`; no speeds.
inline TimeSeries gantryRun(std::uint64_t seed) {
  const auto plant = static_cast<GantryPlant>(seed % 4);
  const auto trouble = static_cast<GantryTrouble>(seed / 4 % 4);
  Random random(910000 + 17 * seed);
  const double end_s = 3600.0 * random.uniform(5.0, 7.0);
  const double period_s = trouble == GantryTrouble::FewRows ? 120.0 : random.uniform() < 0.5 ? 15.0 : 30.0;
  const int sensors = 2 + static_cast<int>(random.uniform(0.0, 2.999));
  const double step_s = 5.0;
  // A heated bed and a motor that are switched, each with its own body; the sensors see mixtures of them and the room.
  std::array<double, 2> heat{};
  std::array<double, 2> body{};
  const std::array<double, 2> body_tau_s = {random.uniform(300.0, 1800.0), random.uniform(1200.0, 5400.0)};
  std::vector<std::array<double, 2>> mixture;
  std::vector<double> sensor_tau_s;
  std::vector<double> gain;
  std::vector<double> lag_s;
  for (int i = 0; i < sensors; ++i) {
    const double part = (i + random.uniform(0.2, 0.8)) / sensors;
    mixture.push_back({1.0 - part, part});
    sensor_tau_s.push_back(random.uniform(30.0, 400.0));
    gain.push_back(random.uniform(0.8, 3.0) * (random.uniform() < 0.3 ? -1.0 : 1.0));
    lag_s.push_back(std::exp(random.uniform(std::log(300.0), std::log(10800.0))));
  }
  const std::array<double, 2> shared_tau_s = {random.uniform(300.0, 1500.0), random.uniform(1800.0, 10800.0)};
  const double hidden_tau_s = random.uniform(1800.0, 10800.0);
  const double drift_phase = random.uniform(0.0, 6.28);
  std::vector<double> read(static_cast<std::size_t>(sensors), 0.0);
  std::vector<double> lagged(static_cast<std::size_t>(sensors), 0.0);
  std::array<double, 2> shared{};
  double hidden = 0.0;
  double coloured = 0.0;
  double through = 0.0;  // noise that goes through the difference equation
  TimeSeries s;
  s.file = "gantry";
  s.signals.resize(static_cast<std::size_t>(sensors) + 1);
  double next_s = 0.0;
  double switch_s = 0.0;
  const double noise = trouble == GantryTrouble::FewRows ? 1.5 : 0.4;
  for (double t = 0.0; t < end_s; t += step_s) {
    if (t >= switch_s) {
      const double scale = trouble == GantryTrouble::RangeLeft && t > 0.6 * end_s ? 1.6 : 1.0;
      heat = {scale * random.uniform(0.0, 14.0), scale * random.uniform(0.0, 10.0)};
      switch_s = t + random.uniform(900.0, 6000.0);
    }
    for (std::size_t b = 0; b < 2; ++b) body[b] += step_s / body_tau_s[b] * (heat[b] - body[b]);
    hidden += step_s / hidden_tau_s * (0.5 * (body[0] + body[1]) - hidden);
    double sum = 0.0;
    double of_lags = 0.0;
    for (int i = 0; i < sensors; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const double here = mixture[k][0] * body[0] + mixture[k][1] * body[1];
      read[k] += step_s / sensor_tau_s[k] * (here - read[k]);
      lagged[k] += step_s / lag_s[k] * (read[k] - lagged[k]);
      sum += gain[k] * read[k];
      of_lags += gain[k] * lagged[k];
    }
    shared[0] += step_s / shared_tau_s[0] * (sum - shared[0]);
    shared[1] += step_s / shared_tau_s[1] * (sum - shared[1]);
    const double innovation = random.normal(0.0, 1.0);
    coloured += step_s / 1200.0 * (-coloured) + 2.0 * std::sqrt(2.0 * step_s / 1200.0) * innovation;
    through += step_s / shared_tau_s[0] * (-through) + 1.0 * std::sqrt(2.0 * step_s / shared_tau_s[0]) * innovation;
    if (t < next_s) continue;
    next_s += period_s;
    double z = 0.0;
    switch (plant) {
      case GantryPlant::Static:
        z = sum;
        break;
      case GantryPlant::OutputError:
        z = of_lags;
        break;
      case GantryPlant::Arx:
        z = 0.6 * shared[0] + 0.4 * shared[1] + through;
        break;
      case GantryPlant::Bodies:
        z = 1.2 * body[0] - 0.8 * body[1] + 2.0 * hidden;
        break;
    }
    if (trouble == GantryTrouble::ColouredNoise) z += coloured;
    if (trouble == GantryTrouble::AmbientDrift) z += 3.0 * std::sin(6.2832 * t / 28800.0 + drift_phase);
    s.time_s.push_back(t);
    for (int i = 0; i < sensors; ++i)
      s.signals[static_cast<std::size_t>(i)].values.push_back(
          22.0 + std::round((read[static_cast<std::size_t>(i)] + random.normal(0.0, 0.05)) * 16.0) / 16.0);
    s.signals.back().values.push_back(z + random.normal(0.0, noise));
  }
  for (int i = 0; i < sensors; ++i) {
    s.signals[static_cast<std::size_t>(i)].name = "t_" + std::to_string(i + 1) + "_degC";
    s.signals[static_cast<std::size_t>(i)].kind = SignalKind::Temperature;
  }
  s.signals.back().name = "z_um";
  s.signals.back().kind = SignalKind::Displacement;
  return s;
}

}  // namespace spindrift::testing
