// SPDX-License-Identifier: GPL-3.0-or-later
// Made records of a heated frame: a bed is heated for hours and cools, chamber and frame follow, doors open, sensors
// are noisy and quantised, the reading of the height is quantised, drifts and slips. Several structures of the truth.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/random.h"
#include "core/thermal/thermal_model.h"
#include "core/thermal/time_series.h"

namespace spindrift::testing {

/// Output `z_um`; inputs frame, chamber, bed and a nearly constant head, rows of 20 s over 5 ... 7 h. The structure is
/// the seed modulo 5: two bodies; rails on a frame; a line on two temperatures; three bodies with a slow one that no
/// sensor sees directly; a line with a wandering zero.
inline TimeSeries frameRun(std::uint64_t seed) {
  Random random(1000 + seed);
  const double hours = random.uniform(5.0, 7.0);
  const double heated_s = 3600.0 * random.uniform(2.0, 0.55 * hours);
  const double dt = 20.0;
  const auto rows = static_cast<std::size_t>(hours * 3600.0 / dt);
  const double room = random.uniform(18.0, 27.0);
  const double target = random.uniform(60.0, 110.0);
  const double tau_bed = random.uniform(700.0, 1400.0);
  const double tau_chamber = random.uniform(600.0, 1800.0);
  const double tau_frame = random.uniform(600.0, 3000.0);
  const double part_chamber = random.uniform(0.2, 0.35);
  const double part_frame = random.uniform(0.3, 0.8);
  TimeSeries s;
  s.file = "frame_run.csv";
  std::vector<double> bed;
  std::vector<double> chamber;
  std::vector<double> frame;
  std::vector<double> head;
  double b = room;
  double c = room;
  double f = room;
  double h = room;
  double door = 0.0;
  for (std::size_t k = 0; k < rows; ++k) {
    const double t = static_cast<double>(k) * dt;
    s.time_s.push_back(t);
    if (t < heated_s) {
      b = std::min(target, b + dt * 0.12);
    } else {
      b += dt / tau_bed * (room + 0.15 * (c - room) - b);
    }
    h = std::min(100.0, h + dt * 1.5);
    if (random.uniform() < 0.002) door = random.uniform(60.0, 400.0);
    door = std::max(0.0, door - dt);
    const double open = door > 0.0 ? 0.4 : 1.0;
    c += dt / (tau_chamber * open) * (room + part_chamber * open * (b - room) - c);
    f += dt / tau_frame * (room + part_frame * (c - room) + 0.03 * (b - room) - f);
    bed.push_back(b);
    chamber.push_back(c);
    frame.push_back(f);
    head.push_back(h);
  }
  const double of_frame = random.uniform(-22.0, -8.0);
  const double of_bed = random.uniform(-1.5, 1.0);
  const double of_rail = random.uniform(2.0, 8.0);
  const auto lag = [&](const std::vector<double>& u, double tau_s) { return lagFiltered(s.time_s, u, tau_s, false); };
  const std::vector<double> body = lag(frame, random.uniform(200.0, 1500.0));
  const std::vector<double> plate = lag(bed, random.uniform(60.0, 400.0));
  const std::vector<double> rail = lag(chamber, random.uniform(300.0, 1200.0));
  const std::vector<double> base = lag(frame, random.uniform(4000.0, 9000.0));
  std::vector<double> z;
  double wander = 0.0;
  const int structure = static_cast<int>(seed % 5);
  const double quantum = random.uniform() < 0.5 ? 1.25 : 2.5;
  for (std::size_t k = 0; k < rows; ++k) {
    wander += random.normal(0.0, structure == 4 ? 0.25 : 0.05);
    double v = -20000.0 + wander + random.normal(0.0, 2.0);
    switch (structure) {
      case 0:
        v += of_frame * (body[k] - room) + of_bed * (plate[k] - room);
        break;
      case 1:
        v += of_frame * (frame[k] - room) + of_rail * (rail[k] - frame[k]) + of_bed * (plate[k] - room);
        break;
      case 2:
      case 4:
        v += of_frame * (frame[k] - room) + of_bed * (bed[k] - room);
        break;
      default:
        v += 0.6 * of_frame * (body[k] - room) + 0.4 * of_frame * (base[k] - room) + of_bed * (plate[k] - room);
    }
    if (random.uniform() < 0.0005) v += 300.0;
    z.push_back(quantum * std::round(v / quantum));
  }
  const auto read = [&](std::vector<double> u, double noise, double step) {
    for (double& v : u) v = step * std::round((v + random.normal(0.0, noise)) / step);
    return u;
  };
  s.signals = {{"frame_degC", SignalKind::Temperature, read(frame, 0.05, 0.02)},
               {"chamber_degC", SignalKind::Temperature, read(chamber, 0.1, 0.05)},
               {"bed_degC", SignalKind::Temperature, read(bed, 0.1, 0.02)},
               {"head_degC", SignalKind::Temperature, read(head, 0.1, 0.02)},
               {"z_um", SignalKind::Displacement, std::move(z)}};
  return s;
}

}  // namespace spindrift::testing
