// SPDX-License-Identifier: GPL-3.0-or-later
// Hidden effects made by a small plant of its own (explicit Euler steps, two-lag spindle, friction that is not linear),
// not by the formulas of the catalogue.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/discrepancy/discrepancy.h"

namespace spindrift::small_plant {

struct Plant {
  std::vector<double> time, rpm, feed_x, bearing, housing, screw, table, room;
};

inline Plant runPlant(Random& random) {
  Plant p;
  double bearing = 0.0;
  double housing = 0.0;
  double screw = 0.0;
  double table = 0.0;
  double rpm = 0.0;
  double feed = 0.0;
  for (int i = 0; i < 1440; ++i) {
    const double t = 30.0 * i;
    if (i % 60 == 0 && i > 60) {
      rpm = 1500.0 * static_cast<double>(random.index(5));
      feed = 4000.0 * static_cast<double>(random.index(4));
    }
    const double room = 1.5 * std::sin(t / 9000.0) + 0.00003 * t;
    const double heat = 0.4 * rpm * 1e-3 + 0.5 * std::pow(rpm * 1e-3, 1.4);
    bearing += 30.0 * ((6.0 * heat - (bearing - housing)) / 900.0 - (1.0 + 0.0001 * rpm) * (bearing - room) / 2800.0);
    housing += 30.0 * (0.5 * (bearing - housing) / 1800.0 - (housing - room) / 2600.0);
    screw += 30.0 * (0.3 * feed * 1e-3 - (screw - room)) / 2200.0;
    table += 30.0 * (room - table) / 5000.0;
    p.time.push_back(t);
    p.rpm.push_back(rpm);
    p.feed_x.push_back(feed);
    p.bearing.push_back(bearing);
    p.housing.push_back(housing);
    p.screw.push_back(screw);
    p.table.push_back(table);
    p.room.push_back(room);
  }
  return p;
}

inline constexpr auto machine_json =
    R"({"format":"spindrift-machine","version":1,"name":"m","chain":"V [w-X'-Y'-b-Z-t]",
  "axes":[{"name":"X","travel_mm":[0,480],"drive":{"type":"ball_screw","pitch_mm":10,"fixed_bearing_mm":0}},
          {"name":"Y","travel_mm":[0,400],"drive":{"type":"ball_screw","pitch_mm":10,"fixed_bearing_mm":0}},
          {"name":"Z","travel_mm":[0,400],"drive":{"type":"ball_screw","pitch_mm":10,"fixed_bearing_mm":0}}],
  "table":{"centre_mm":[240,200]},"column":{"base_mm":-180},
  "temperature_sensors":[{"name":"T_spindle_degC","place":"front bearing"},{"name":"T_room_degC","place":"room"}]})";

inline MachineDescription machine() {
  return MachineDescription::parse(JsonNode::parse(machine_json, "machine.json"), "machine.json");
}

enum class Hidden {
  Nothing,
  SpindleDrift,
  DriftThatLifts,
  Screw,
  ScrewWhereItTravels,
  Slip,
  Wave,
  TurnAndDrift,
  LoadThatLasts
};

/// `hidden_signal` takes what is hidden in every row, without noise, um.
inline DiscrepancyInput campaign(Hidden hidden, std::uint64_t seed, double strength = 5.0,
                                 std::vector<double>* hidden_signal = nullptr) {
  Random random(seed);
  const Plant plant = runPlant(random);
  DiscrepancyInput input;
  input.machine = machine();
  OperatingLog log(plant.time);
  log.setSignal("spindle_rpm", plant.rpm);
  log.setSignal("feed_x_mm_min", plant.feed_x);
  std::vector<double> bearing;
  std::vector<double> room;
  for (std::size_t i = 0; i < plant.time.size(); ++i) {
    bearing.push_back(20.0 + plant.bearing[i] + random.normal(0.0, 0.05));
    room.push_back(20.0 + plant.room[i] + random.normal(0.0, 0.05));
  }
  log.setSignal("T_spindle_degC", bearing);
  log.setSignal("T_room_degC", room);
  input.log = log;
  const double sigma = 0.5;
  const std::array<Eigen::Vector3d, 6> points{Eigen::Vector3d(40, 40, 0),     Eigen::Vector3d(440, 60, 20),
                                              Eigen::Vector3d(420, 360, 100), Eigen::Vector3d(50, 350, 200),
                                              Eigen::Vector3d(200, 150, 300), Eigen::Vector3d(300, 250, 390)};
  for (int state = 0; state < 32; ++state) {
    const auto at = static_cast<std::size_t>(state * 44);
    for (std::size_t p = 0; p < points.size(); ++p) {
      for (int c = 0; c < 3; ++c) {
        Observation o;
        o.time_s = plant.time[at];
        o.state = "M" + std::to_string(state);
        o.point = "F" + std::to_string(p + 1);
        o.position_mm = points[p];
        o.component = static_cast<Component>(c);
        o.sigma = sigma;
        o.use = state >= 26 ? ObservationUse::Holdout : ObservationUse::Fit;
        double truth = c == 2 ? 0.5 * plant.housing[at] : 0.0;
        const double simulated = truth * 1.006;
        const double given = truth;
        switch (hidden) {
          case Hidden::Nothing:
            break;
          case Hidden::SpindleDrift:
            if (c == 1) truth += strength * sigma * plant.housing[at] / 12.0;
            break;
          case Hidden::DriftThatLifts:
            // The same, and beside its formula a thirtieth of it along Z.
            if (c == 1) truth += strength * sigma * plant.housing[at] / 12.0;
            if (c == 2) truth += strength / 30.0 * sigma * plant.housing[at] / 12.0;
            break;
          case Hidden::Screw:
            if (c == 0) truth += strength * sigma * plant.screw[at] / 2.0 * points[p].x() / 300.0;
            break;
          case Hidden::ScrewWhereItTravels:
            // Warmer towards the far end, where the nut is.
            if (c == 0) truth += strength * sigma * plant.screw[at] / 2.0 * std::pow(points[p].x() / 300.0, 2);
            break;
          case Hidden::Slip:
            if (p == 2 && state > 14) truth += 2.0 * strength * sigma * (c == 0 ? 1.0 : -0.5);
            break;
          case Hidden::Wave:
            if (c == 0) truth += 1.4 * strength * sigma * std::sin(o.time_s / 500.0);
            break;
          case Hidden::LoadThatLasts: {
            // Sun on the head, from state 17 on until the first that is held out, through two lags.
            const auto warm = [&](double since_s) {
              const double slow = std::max(0.0, since_s);
              return 1.0 - 0.6 * std::exp(-slow / 900.0) - 0.4 * std::exp(-slow / 2700.0);
            };
            const double begin_s = plant.time[17 * 44];
            const double end_s = plant.time[26 * 44];
            if (c == 2) truth += strength * sigma * (warm(o.time_s - begin_s) - warm(o.time_s - end_s));
            break;
          }
          case Hidden::TurnAndDrift: {
            // The frame turns about X with a body that follows the room; the spindle drifts along Y with its own heat.
            const double turn = 5.0 * strength * sigma * plant.table[at];
            if (c == 1) truth += -turn * (points[p].z() - 150.0) * 1e-3 + strength * sigma * plant.housing[at] / 12.0;
            if (c == 2) truth += turn * (points[p].y() - 200.0) * 1e-3;
            break;
          }
        }
        if (hidden_signal != nullptr) hidden_signal->push_back(truth - given);
        o.value = truth + random.normal(0.0, sigma);
        input.observations.rows.push_back(o);
        input.predicted.push_back(simulated);
      }
    }
  }
  return input;
}

/// What the small plant makes at its first point, at many points: own noise of readings and shifts of states, um.
inline DiscrepancyInput atManyPoints(std::uint64_t seed, int points, double shift_um) {
  std::vector<double> hidden;
  const DiscrepancyInput few = campaign(Hidden::SpindleDrift, seed, 5.0, &hidden);
  Random random(seed + 1000);
  DiscrepancyInput many;
  many.machine = few.machine;
  many.log = few.log;
  for (std::size_t i = 0; i < few.observations.rows.size(); ++i) {
    if (few.observations.rows[i].point != "F1") continue;
    const double shift = random.normal(0.0, shift_um);
    for (int p = 0; p < points; ++p) {
      Observation o = few.observations.rows[i];
      o.point = "Q" + std::to_string(p);
      o.position_mm = {20.0 * (p % 20), 25.0 * (p / 20 % 16), 40.0 * (p % 7)};
      o.value = few.predicted[i] + hidden[i] + shift + random.normal(0.0, o.sigma);
      many.observations.rows.push_back(o);
      many.predicted.push_back(few.predicted[i]);
    }
  }
  return many;
}

inline DiscrepancyResult run(const DiscrepancyInput& input, const DiscrepancyOptions& options = {}) {
  JobContext job;
  return findDiscrepancy(input, options, job);
}

}  // namespace spindrift::small_plant
