// SPDX-License-Identifier: GPL-3.0-or-later
// A simulator in process for tests: a column with two walls, a spindle and a table, heated and cooled, as four bodies
// with explicit steps of 30 s. Not linear in its films. Deviations are those of a C-frame: bending shows in Y and turns
// into a lift of the overhanging head.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/base/text.h"
#include "core/discrepancy/discrepancy.h"
#include "core/simulator/simulator.h"

namespace spindrift::heated_column {

inline const std::vector<SimulatorParameter>& standardParameters() {
  static const std::vector<SimulatorParameter> all{
      {"h_air", 9.0, "W/m2/K", 1.5, 2.0, 30.0, "film on free faces", {}},
      {"k_wall", 40.0, "W/K", 3.0, 10.0, 100.0, "conductance between the walls", {}},
      {"friction",
       9.0,
       "W/krpm",
       1.0,
       0.0,
       60.0,
       "friction heat of the spindle",
       {"spindle.growth.z", "spindle.drift.y"}},
      {"sun_front",
       0.0,
       "W/m2",
       50.0,
       0.0,
       600.0,
       "heat absorbed by the column's front",
       {"external_heat.a", "column.bending.a"}},
      {"sun_on_s", 0.0, "s", 3600.0, 0.0, 36000.0, "begin of the sun", {}},
      {"sun_off_s", 36000.0, "s", 3600.0, 0.0, 36000.0, "end of the sun", {}},
      {"h_coolant",
       0.0,
       "W/m2/K",
       100.0,
       0.0,
       2000.0,
       "film of the coolant on the table",
       {"table.expansion.xy", "coolant.shock.z"}},
      {"coolant_K", -4.0, "K", 0.5, -15.0, 15.0, "coolant minus start temperature", {}},
      {"paint", 0.5, "1", 0.1, 0.0, 1.0, "colour of the paint", {}},
      {"sensor.T_room_degC.gain", 0.0, "1", 0.02, -0.5, 0.5, "relative error of the room's sensor", {}, true}};
  return all;
}

/// The campaign's log: spindle speeds in steps, coolant in two phases, a room that drifts.
inline OperatingLog logOf(std::uint64_t seed) {
  Random random(seed);
  std::vector<double> time, rpm, coolant, room;
  double speed = 0.0;
  const double phase = random.uniform(0.0, 3.0);
  for (int i = 0; i <= 1200; ++i) {
    if (i % 80 == 0) speed = i < 40 ? 0.0 : 1000.0 * static_cast<double>(random.index(7));
    time.push_back(30.0 * i);
    rpm.push_back(speed);
    coolant.push_back((i > 200 && i < 480) || (i > 700 && i < 900) ? 1.0 : 0.0);
    room.push_back(20.0 + 4.0 * std::sin(30.0 * i / 6500.0 + phase) + 0.00005 * 30.0 * i);
  }
  OperatingLog log(time);
  log.setSignal("spindle_rpm", rpm);
  log.setSignal("coolant", coolant);
  log.setSignal("T_room_degC", room);
  return log;
}

class HeatedColumn : public Simulator {
 public:
  explicit HeatedColumn(OperatingLog log, std::vector<SimulatorParameter> parameters = standardParameters())
      : log_(std::move(log)) {
    file_ = "simulator.json";
    parameters_ = std::move(parameters);
    windows_ = {{"sun_on_s", "sun_off_s"}};
  }

  [[nodiscard]] SimulatorRun run(const ParameterValues& changes, const ObservationSet& at,
                                 const JobContext& job) const override {
    job.throwIfCancelled();
    ++runs;
    ParameterValues v;
    for (const SimulatorParameter& p : parameters_) v[p.name] = p.value;
    for (const auto& [name, value] : changes) {
      const SimulatorParameter* p = find(name);
      if (p == nullptr) throw InputError("no parameter " + name);
      if (value < p->min || value > p->max) throw InputError(name + " beyond its bounds");
      v[name] = value;
    }
    if (fails_above && v["h_air"] > *fails_above) {
      if (gives_nan) {
        SimulatorRun bad;
        bad.predicted.assign(at.rows.size(), std::nan(""));
        return bad;
      }
      throw SimulatorFailed("the column melts at h_air = " + exactNumber(v["h_air"]) + " W/m2/K.");
    }
    const auto& time = log_.time_s();
    const auto& rpm = *log_.signal("spindle_rpm");
    const auto& coolant = *log_.signal("coolant");
    const auto& room = *log_.signal("T_room_degC");
    std::vector<std::array<double, 4>> state;  // front, rear, spindle, table, K since the start
    std::array<double, 4> s{};
    for (std::size_t i = 0; i < time.size(); ++i) {
      state.push_back(s);
      const double air = (room[i] - room[0]) / (1.0 + v["sensor.T_room_degC.gain"]);
      const double sun = time[i] >= v["sun_on_s"] && time[i] < v["sun_off_s"] ? v["sun_front"] : 0.0;
      const double h = v["h_air"];
      const std::array<double, 4> heat{
          1.2 * (sun + h * (air - s[0])) + v["k_wall"] * (s[1] - s[0]) + 2.0 * (s[2] - s[0]),
          1.2 * h * (air - s[1]) + v["k_wall"] * (s[0] - s[1]),
          (v["friction"] + v["seal"]) * std::pow(rpm[i] * 1e-3, 1.5) + 0.6 * h * (air - s[2]) - 2.0 * (s[2] - s[0]),
          0.9 * h * (air - s[3]) + 0.25 * coolant[i] * v["h_coolant"] * (v["coolant_K"] - s[3])};
      constexpr std::array<double, 4> capacity{220e3, 240e3, 22e3, 150e3};  // J/K
      for (std::size_t b = 0; b < 4; ++b) s[b] += 30.0 * heat[b] / capacity[b];
    }
    const auto deviation = [&](const std::array<double, 4>& t, const Eigen::Vector3d& p, Component c) {
      const double bend = 14.0 * (t[0] - t[1]);  // urad
      switch (c) {
        case Component::EX:
          return -11.0 * t[3] * (p.x() - 240.0) * 1e-3;
        case Component::EY:
          return bend * (p.z() + 180.0) * 1e-3 - 11.0 * t[3] * (p.y() - 200.0) * 1e-3 + 0.25 * t[2];
        case Component::EZ:
          return 0.3 * bend + 4.0 * (t[0] + t[1]) * 0.5 - 1.1 * t[2];
        default:
          return 0.0;
      }
    };
    SimulatorRun out;
    const auto stateAt = [&](double when) {
      const double at_row = std::clamp(when / 30.0, 0.0, static_cast<double>(state.size() - 1));
      const auto i = std::min(static_cast<std::size_t>(at_row), state.size() - 2);
      const double part = at_row - static_cast<double>(i);
      std::array<double, 4> t{};
      for (std::size_t b = 0; b < 4; ++b) t[b] = state[i][b] + part * (state[i + 1][b] - state[i][b]);
      return t;
    };
    std::map<std::string, Eigen::Vector3d> points;
    for (const Observation& o : at.rows) {
      out.predicted.push_back(deviation(stateAt(o.time_s), o.position_mm, o.component));
      points[o.point] = o.position_mm;
    }
    for (const auto& [name, position] : points) {
      for (double t = 0.0; t <= 36000.0; t += 600.0) {
        for (const Component c : {Component::EX, Component::EY, Component::EZ})
          out.rows.push_back({t, name, Eigen::Vector3d::Zero(), c, deviation(stateAt(t), position, c)});
      }
    }
    return out;
  }

  void writeVersion(const ParameterValues&, const std::filesystem::path&, const nlohmann::json&) const override {}

  std::optional<double> fails_above;
  bool gives_nan = false;
  mutable std::atomic<int> runs{0};

 private:
  OperatingLog log_;
};

/// A campaign measured on a column with the values `truth`, simulated by one without them.
struct Column {
  DiscrepancyInput input;
  std::unique_ptr<HeatedColumn> simulator;
  std::vector<double> truth;  ///< without noise, um
};

inline Column columnCampaign(const ParameterValues& truth, std::uint64_t seed, double sigma = 0.4,
                             std::vector<SimulatorParameter> parameters = standardParameters()) {
  Column out;
  const OperatingLog log = logOf(seed);
  out.simulator = std::make_unique<HeatedColumn>(log, std::move(parameters));
  DiscrepancyInput& input = out.input;
  input.machine = MachineDescription::parse(
      JsonNode::parse(R"({"format":"spindrift-machine","version":1,"name":"m","chain":"V [w-X'-Y'-b-Z-t]",
  "axes":[{"name":"X","travel_mm":[0,480]},{"name":"Y","travel_mm":[0,400]},{"name":"Z","travel_mm":[0,400]}],
  "table":{"centre_mm":[240,200]},"column":{"base_mm":-180},
  "temperature_sensors":[{"name":"T_room_degC","place":"room"}]})",
                      "machine.json"),
      "machine.json");
  input.log = log;
  Random random(seed + 1000);
  const std::array<Eigen::Vector3d, 6> points{Eigen::Vector3d(40, 40, 0),     Eigen::Vector3d(440, 60, 20),
                                              Eigen::Vector3d(420, 360, 100), Eigen::Vector3d(50, 350, 200),
                                              Eigen::Vector3d(200, 150, 300), Eigen::Vector3d(300, 250, 390)};
  for (int state = 0; state <= 40; ++state) {
    for (std::size_t p = 0; p < points.size(); ++p) {
      for (int c = 0; c < 3; ++c) {
        Observation o;
        o.time_s = 900.0 * state;
        o.state = "M" + std::to_string(state);
        o.point = "F" + std::to_string(p + 1);
        o.position_mm = points[p];
        o.component = static_cast<Component>(c);
        o.sigma = sigma;
        o.use = state > 28 ? ObservationUse::Holdout : ObservationUse::Fit;
        input.observations.rows.push_back(o);
      }
    }
  }
  JobContext job;
  // The machine may have what its simulator's bounds do not know of.
  std::vector<SimulatorParameter> wide = standardParameters();
  for (SimulatorParameter& p : wide) {
    p.min = std::min(p.min, -1e6);
    p.max = 1e6;
  }
  out.truth = HeatedColumn(log, wide).run(truth, input.observations, job).predicted;
  input.predicted = out.simulator->run({}, input.observations, job).predicted;
  for (std::size_t i = 0; i < out.truth.size(); ++i)
    input.observations.rows[i].value = out.truth[i] + random.normal(0.0, sigma);
  return out;
}

}  // namespace spindrift::heated_column
