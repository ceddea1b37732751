// SPDX-License-Identifier: GPL-3.0-or-later
// Made records of a printer with a dozen sensors over 5 ... 7 h: bed, heated chamber air, gantry, uprights, a slow base
// and electronics as a network of bodies; heaters that soak, step or go higher in the last part than ever before;
// sensors that lag, are noisy, coarsely quantised or drift; a height that follows bodies, sensors or a model of low
// order.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/thermal/thermal_model.h"
#include "core/thermal/time_series.h"

namespace spindrift::testing {

/// What the height follows.
enum class PrinterHeight {
  Bodies,       ///< several bodies, one of them slow and seen by no sensor
  Sensors,      ///< two temperatures as they are read, no memory
  OutputError,  ///< one lag for each of two temperatures, noise at the reading
  Arx           ///< a difference equation of second order that noise goes through
};
/// What the heaters do.
enum class PrinterHeat {
  Soak,   ///< heated for some hours, then left to cool
  Steps,  ///< another target every half to one and a half hours
  Higher  ///< steps; after 60 % of the record hotter than before
};

/// Output `z_um`, rows of 10 ... 60 s, twelve temperatures, no speeds.
inline TimeSeries printerRun(std::uint64_t seed, PrinterHeight height, PrinterHeat heat) {
  Random random(40000 + 100 * seed + 10 * static_cast<std::uint64_t>(height) + static_cast<std::uint64_t>(heat));
  enum Body { Bed, Plate, Air, Gantry, Upright, Base, Head, Board, Room, Bodies };
  const double hours = random.uniform(5.0, 7.0);
  const double end_s = 3600.0 * hours;
  const std::array<double, 4> periods_s = {10.0, 20.0, 30.0, 60.0};
  const double period_s = periods_s[random.index(periods_s.size())];
  constexpr double step_s = 5.0;

  // Programme of the bed.
  std::vector<std::pair<double, double>> programme;  // from, target
  const double room = random.uniform(17.0, 26.0);
  const double top = random.uniform(60.0, 110.0);
  if (heat == PrinterHeat::Soak) {
    programme = {{random.uniform(0.0, 600.0), top}, {end_s * random.uniform(0.4, 0.65), 0.0}};
  } else {
    double t = random.uniform(0.0, 900.0);
    while (t < end_s) {
      const bool last = t >= 0.6 * end_s;
      double target = random.uniform() < 0.3 ? 0.0 : random.uniform(45.0, top);
      if (heat == PrinterHeat::Higher) target = last ? random.uniform(1.1, 1.4) * top : 0.8 * target;
      programme.emplace_back(t, target);
      t += random.uniform(1800.0, 5400.0);
      if (heat == PrinterHeat::Higher && !last) t = std::min(t, std::max(0.6 * end_s, programme.back().first + 600.0));
    }
  }

  // The network: tau dT/dt = sum of shares (other body - T) + share of the room.
  std::array<double, Bodies> tau_s{};
  tau_s[Bed] = random.uniform(700.0, 1500.0);
  tau_s[Plate] = random.uniform(90.0, 500.0);
  tau_s[Air] = random.uniform(500.0, 1500.0);
  tau_s[Gantry] = random.uniform(500.0, 1800.0);
  tau_s[Upright] = random.uniform(900.0, 3600.0);
  tau_s[Base] = random.uniform(5000.0, 14000.0);
  tau_s[Head] = 60.0;
  tau_s[Board] = random.uniform(300.0, 1200.0);
  tau_s[Room] = 1.0;
  const double of_air = random.uniform(0.25, 0.45);    // of the bed in the air
  const double of_gantry = random.uniform(0.5, 0.95);  // of the air in the gantry
  const double of_upright = random.uniform(0.25, 0.7);
  const double of_base = random.uniform(0.2, 0.6);
  const double swing = random.uniform(0.2, 1.5);
  const double board_warms = random.uniform(8.0, 18.0);
  std::array<double, Bodies> T{};
  T.fill(room);
  if (random.uniform() < 0.3) T[Base] += random.uniform(0.5, 3.0);  // of yesterday
  double door = 0.0;
  TimeSeries s;
  s.file = "printer_run.csv";
  std::vector<std::array<double, Bodies>> course;
  const auto steps = static_cast<std::size_t>(end_s / step_s);
  const auto stride = static_cast<std::size_t>(period_s / step_s);
  for (std::size_t k = 0; k < steps; ++k) {
    const double t = static_cast<double>(k) * step_s;
    double target = 0.0;
    for (const auto& [from, value] : programme)
      if (t >= from) target = value;
    if (random.uniform() < 0.0004) door = random.uniform(60.0, 500.0);
    door = std::max(0.0, door - step_s);
    const double open = door > 0.0 ? 0.4 : 1.0;
    const double air = room + swing * std::sin(2.0 * M_PI * t / 30000.0 + static_cast<double>(seed));
    const std::array<double, Bodies> before = T;
    const auto towards = [&](Body b, double v, double faster = 1.0) {
      T[b] += faster * step_s / tau_s[b] * (v - before[b]);
    };
    if (target > before[Bed]) {
      T[Bed] = std::min(target, before[Bed] + step_s * 0.12);
    } else {
      towards(Bed, before[Air] * 0.2 + air * 0.8);
      T[Bed] = std::max(T[Bed], target);
    }
    towards(Plate, 0.93 * before[Bed] + 0.07 * before[Air]);
    towards(Air, air + of_air * open * (before[Bed] - air), 1.0 / open);
    towards(Gantry, air + of_gantry * (before[Air] - air));
    towards(Upright, air + of_upright * (before[Air] - air) + 0.02 * (before[Bed] - air));
    towards(Base, air + of_base * (before[Upright] - air) + 0.05 * (before[Bed] - air));
    towards(Head, target > 0.0 ? 150.0 : 0.3 * before[Air] + 0.7 * air);
    towards(Board, air + 0.15 * (before[Air] - air) + (target > 0.0 ? board_warms : 0.4 * board_warms));
    T[Room] = air;
    if (k % stride != 0) continue;
    s.time_s.push_back(t);
    course.push_back(T);
  }
  const std::size_t rows = course.size();
  const auto of = [&](Body b) {
    std::vector<double> out;
    for (const auto& c : course) out.push_back(c[b]);
    return out;
  };

  // Sensors: mixtures of two bodies with lag, noise, steps of the converter and, some, drift.
  struct Place {
    const char* name;
    Body body;
    Body other;
  };
  constexpr std::array<Place, 12> places = {{{"bed", Bed, Plate},
                                             {"plate", Plate, Bed},
                                             {"chamber", Air, Gantry},
                                             {"chamber_top", Air, Head},
                                             {"frame", Upright, Air},
                                             {"frame_back", Upright, Room},
                                             {"gantry_left", Gantry, Air},
                                             {"gantry_right", Gantry, Upright},
                                             {"head", Head, Air},
                                             {"board", Board, Room},
                                             {"computer", Board, Air},
                                             {"room", Room, Air}}};
  std::vector<std::vector<double>> seen;  // without noise
  for (const Place& place : places) {
    const double part = random.uniform(0.0, place.other == Head ? 0.02 : 0.15);
    std::vector<double> mixed;
    for (const auto& c : course) mixed.push_back((1.0 - part) * c[place.body] + part * c[place.other]);
    seen.push_back(lagFiltered(s.time_s, mixed, random.uniform(5.0, 90.0), false));
    const double noise = std::exp(random.uniform(std::log(0.02), std::log(0.25)));
    const double quantum = random.uniform() < 0.25 ? 0.25 : 0.02;
    const double drift = random.uniform() < 0.25 ? random.uniform(0.002, 0.01) : 0.0;
    double drifted = 0.0;
    Signal signal{std::string(place.name) + "_degC", SignalKind::Temperature, {}};
    for (const double v : seen.back()) {
      drifted += drift * std::sqrt(period_s / 20.0) * random.normal();
      signal.values.push_back(quantum * std::round((v + drifted + random.normal(0.0, noise)) / quantum));
    }
    s.signals.push_back(std::move(signal));
  }

  const double of_frame = random.uniform(-22.0, -8.0);
  const double of_bed = random.uniform(-1.5, 1.5);
  const double quantum = random.uniform() < 0.5 ? 1.25 : 2.5;
  std::vector<double> z(rows, 0.0);
  const auto add = [&](double gain, const std::vector<double>& u) {
    for (std::size_t k = 0; k < rows; ++k) z[k] += gain * (u[k] - room);
  };
  switch (height) {
    case PrinterHeight::Bodies:
      add(of_frame * random.uniform(0.4, 1.0), of(Upright));
      add(-of_frame * random.uniform(0.0, 0.5), of(Gantry));
      add(of_frame * random.uniform(0.1, 0.6), of(Base));
      add(of_bed, of(Plate));
      break;
    case PrinterHeight::Sensors:
      add(of_frame, seen[4]);
      add(of_bed, seen[random.index(3)]);
      break;
    case PrinterHeight::OutputError:
      add(of_frame, lagFiltered(s.time_s, seen[4], random.uniform(300.0, 4000.0), false));
      add(of_bed, lagFiltered(s.time_s, seen[0], random.uniform(60.0, 2000.0), false));
      break;
    case PrinterHeight::Arx: {
      const double fast = std::exp(-period_s / random.uniform(60.0, 600.0));
      const double slow = std::exp(-period_s / random.uniform(1500.0, 6000.0));
      const double noise = random.uniform(0.02, 0.3) * std::sqrt(period_s / 20.0);
      for (std::size_t k = 2; k < rows; ++k)
        z[k] = (fast + slow) * z[k - 1] - fast * slow * z[k - 2] +
               (1.0 - fast) * (1.0 - slow) * (of_frame * (seen[4][k] - room) + of_bed * (seen[0][k] - room)) +
               random.normal(0.0, noise);
    }
  }
  const double noise = height == PrinterHeight::Arx ? 0.3 : random.uniform(0.5, 3.0);
  const double wandering = random.uniform(0.0, 0.1) * std::sqrt(period_s / 20.0);
  double wander = 0.0;
  for (double& v : z) {
    wander += random.normal(0.0, wandering);
    v += wander + random.normal(0.0, noise);
    if (random.uniform() < 0.0003) v += 200.0;
    v = quantum * std::round(v / quantum);
  }
  s.signals.push_back({"z_um", SignalKind::Displacement, std::move(z)});
  return s;
}

}  // namespace spindrift::testing
