// SPDX-License-Identifier: GPL-3.0-or-later
// Replay of P1 on a machine of its own: 105 h of random X and C speed, 29 temperature sensors, room with day and night
// and an open door, a cooling circuit that loses flow after 62 h. Heat moves through a chain of lumped bodies with
// speed-dependent convection, so no error is a sum of lags of the sensors. Uncompensated, static and adaptive side by
// side, then reduction against number of measurements, with the time it takes.
//   thermal_replay [SEED [SECONDS BETWEEN ROWS, a multiple of 15]]      default 1 300
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/thermal/adaptive.h"

namespace {

using spindrift::Random;
using spindrift::SignalKind;
using spindrift::TimeSeries;

TimeSeries machine(std::uint64_t seed, int seconds) {
  Random random(seed);
  TimeSeries s;
  s.file = "replay";
  // Bodies: 0 motor, 1 bearing, 2..5 screw pieces, 6 nut, 7 saddle, 8 bed, 9 column, 10 C drive, 11 table, 12 guide, 13
  // enclosure.
  constexpr int bodies = 14;
  const double capacity[bodies] = {9e3, 4e3, 2.5e3, 2.5e3, 2.5e3, 2.5e3, 3e3, 3e4, 2e5, 1.2e5, 1.5e4, 6e4, 2e4, 5e4};
  const int link[][2] = {{0, 1},  {1, 2},  {2, 3}, {3, 4},   {4, 5},  {6, 3},  {6, 4}, {6, 7},
                         {7, 12}, {12, 8}, {8, 9}, {10, 11}, {11, 8}, {13, 9}, {0, 8}};
  const double conductance[] = {3.0, 2.0, 0.8, 0.8, 0.8, 2.0, 2.0, 4.0, 6.0, 8.0, 20.0, 10.0, 12.0, 5.0, 3.0};
  const double to_air[bodies] = {3.0, 1.0, 0.7, 0.7, 0.7, 0.7, 0.5, 5.0, 15.0, 14.0, 2.0, 8.0, 3.0, 20.0};
  double T[bodies];
  for (double& t : T) t = 22.0;
  struct Sensor {
    int body;
    double part;
    double state;
    double tau;
  };
  std::vector<Sensor> sensors;
  for (int i = 0; i < 26; ++i)
    sensors.push_back({i % bodies, random.uniform(0.6, 1.0), 22.0, random.uniform(20.0, 200.0)});
  std::vector<std::vector<double>> readings(29);
  std::vector<double> feed;
  std::vector<double> c_speed;
  std::vector<double> exx;
  std::vector<double> ex0c;
  std::vector<double> ez0t;
  double x_speed = 0.0;
  double c = 0.0;
  double door = 0.0;
  const double dt = 15.0;
  const int steps = static_cast<int>(105.0 * 3600.0 / dt);
  for (int k = 0; k < steps; ++k) {
    const double hour = k * dt / 3600.0;
    if (random.uniform() < dt / 5400.0) x_speed = random.uniform() < 0.25 ? 0.0 : random.uniform(2000.0, 30000.0);
    if (random.uniform() < dt / 9000.0) c = random.uniform() < 0.4 ? 0.0 : random.uniform(10.0, 120.0);
    if (random.uniform() < dt / 20000.0) door = 1.0;
    if (random.uniform() < dt / 1800.0) door = 0.0;
    const double room = 22.0 + 1.8 * std::sin(2.0 * M_PI * (hour - 9.0) / 24.0) + 0.02 * hour - 1.2 * door;
    const double cooling = hour < 62.0 ? 1.0 : 0.6;
    double heat[bodies] = {};
    const double v = x_speed / 30000.0;
    heat[0] = 70.0 * std::pow(v, 1.2);
    heat[1] = 35.0 * std::pow(v, 1.5);
    heat[6] = 45.0 * std::pow(v, 1.4);
    heat[12] = 60.0 * v;
    heat[10] = 180.0 * std::pow(c / 120.0, 1.6);
    double flow[bodies];
    for (int b = 0; b < bodies; ++b)
      flow[b] = heat[b] + to_air[b] * (1.0 + (b >= 2 && b <= 6 ? 1.2 * v : 0.0)) * (room - T[b]);
    flow[10] -= 6.0 * cooling * (T[10] - 22.0);
    for (std::size_t l = 0; l < std::size(conductance); ++l) {
      const double q = conductance[l] * (T[link[l][1]] - T[link[l][0]]);
      flow[link[l][0]] += q;
      flow[link[l][1]] -= q;
    }
    for (int b = 0; b < bodies; ++b) T[b] += dt * flow[b] / capacity[b];
    for (Sensor& sensor : sensors)
      sensor.state += dt / sensor.tau * (sensor.part * T[sensor.body] + (1.0 - sensor.part) * room - sensor.state);
    if (k % std::max(1, seconds / 15) != 0) continue;
    s.time_s.push_back(k * dt);
    for (std::size_t i = 0; i < 26; ++i) readings[i].push_back(sensors[i].state + random.normal(0.0, 0.05));
    readings[26].push_back(room + random.normal(0.0, 0.1));
    readings[27].push_back(room + 0.5 + random.normal(0.0, 0.1));
    readings[28].push_back(22.0 + random.normal(0.0, 0.05));
    feed.push_back(x_speed);
    c_speed.push_back(c);
    const double screw = (T[2] + T[3] + T[4] + T[5]) / 4.0 - 22.0;
    exx.push_back(11.0 * screw + 3.0 * (T[6] - T[8]) - 6.0 * (T[8] - 22.0));
    ex0c.push_back(2.2 * (T[11] - T[8]) + 1.4 * (T[7] - T[8]) + 2.0 * (T[8] - 22.0) +
                   0.02 * (T[10] - 22.0) * (T[10] - 22.0));
    ez0t.push_back(3.0 * (T[11] - 22.0) - 4.0 * (T[9] - 22.0) + 1.5 * (T[10] - T[11]) + 1.0 * (T[13] - 22.0));
  }
  for (std::size_t i = 0; i < readings.size(); ++i)
    s.signals.push_back({"T_" + std::to_string(i + 1) + "_degC", SignalKind::Temperature, readings[i]});
  s.signals.push_back({"feed_x_mm_min", SignalKind::Feed, feed});
  s.signals.push_back({"speed_c_rpm", SignalKind::Speed, c_speed});
  s.signals.push_back({"exx_um_m", SignalKind::Displacement, exx});
  s.signals.push_back({"ex0c_um", SignalKind::Displacement, ex0c});
  s.signals.push_back({"ez0t_um", SignalKind::Displacement, ez0t});
  return s;
}

spindrift::AdaptiveResult replay(const TimeSeries& s, double scale) {
  // Touch-probe cycle of P1: 0.2 um and 0.9 um/m at k = 1.
  std::vector<spindrift::AdaptiveError> errors = {{"exx_um_m", 0.9, 6.0 * scale, 3.0 * scale},
                                                  {"ex0c_um", 0.2, 2.5 * scale, 1.2 * scale},
                                                  {"ez0t_um", 0.2, 2.5 * scale, 1.2 * scale}};
  std::vector<std::string> candidates;
  for (const auto& signal : s.signals)
    if (signal.kind != SignalKind::Displacement) candidates.push_back(signal.name);
  spindrift::AdaptiveOptions options;
  options.longest_interval_s = 6.0 * 3600.0 * scale;
  return spindrift::replayAdaptive(s, errors, candidates, options, {});
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t seed = argc > 1 ? std::stoull(argv[1]) : 1;
  const TimeSeries s = machine(seed, argc > 2 ? std::stoi(argv[2]) : 300);
  const auto start = std::chrono::steady_clock::now();
  const spindrift::AdaptiveResult r = replay(s, 1.0);
  std::printf(
      "105 h, 29 sensors, seed %llu: setup of 16 h with %zu measurements, then %zu measurements, %zu identifications\n",
      static_cast<unsigned long long>(seed), r.setup_measurements, r.measurements, r.reidentifications);
  for (const auto& e : r.errors) {
    std::printf("  %-9s rms: uncompensated %6.2f, static %6.2f (-%.0f %%), adaptive %6.2f (-%.0f %%)\n", e.name.c_str(),
                e.rms_uncompensated, e.rms_static, e.static_reduction_percent, e.rms_adaptive,
                e.adaptive_reduction_percent);
  }
  std::printf("paper:                                                          EXX 87 %%, EX0C 86 %%, EZ0T 79 %%\n");
  std::printf("reduction against the number of measurements after the setup (limits scaled):\n");
  for (const double scale : {4.0, 2.0, 1.5, 1.0, 0.7, 0.5, 0.35}) {
    const spindrift::AdaptiveResult c = replay(s, scale);
    std::printf("  %4zu measurements: EXX %.1f %%, EX0C %.1f %%, EZ0T %.1f %%\n", c.measurements,
                c.errors[0].adaptive_reduction_percent, c.errors[1].adaptive_reduction_percent,
                c.errors[2].adaptive_reduction_percent);
  }
  std::printf("%zu rows, 8 replays of 3 errors one after the other: %.1f s\n", s.time_s.size(),
              std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  return 0;
}
