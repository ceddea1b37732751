// SPDX-License-Identifier: Apache-2.0
// A scenario: everything that decides what a virtual campaign is. Read from JSON ("spindrift-scenario", version 1).
//
//   {"format":"spindrift-scenario","version":1,"name":"morning","seed":1,"start_utc":"2026-03-01T05:00:00Z",
//    "duration_s":43200,"log_period_s":30,
//    "machine":{...machine.json...} or "machine.json" (relative to the scenario),
//    "programme":{"random":{"idle_s","mean_hold_s","speeds_rpm":[],"feeds_mm_min":[],"c_speeds_rpm":[],"coolant","move",
//                           "stroke_part","instrument_on_s"}}
//             or {"segments":[{"from_s","spindle_rpm","feed_x_mm_min",..,"pos_x_mm",..,"stroke_x",..,"c_rpm","coolant",
//                              "instrument_on"}]} (a key that is left out keeps its value),
//    "environment":{"temperature_degC","day_amplitude_K","day_phase_h","ramp_K_per_h","weather_K","weather_hours",
//                   "doors":[{"time_s","drop_K","recovery_s"}],"random_doors","coolant_below_room_K"},
//    "physics":{"friction":1,"screw_friction":1,"convection":1,"spindle_mass":1,...} (multipliers),
//    "effects":{"spindle.growth.z":{"on":true,"size":1},"column.bending.a":{"strength":4},
//               "fixture.slip.F3":{"time_s":20000,...}},
//    "simulation":{"effects":["spindle.growth.z"],"parameter_error":0.01,"gain_uncertainty":0.01,"missing_rows":0,
//                  "size_errors":{"spindle.growth.z":0.1}},
//    "measurement":{"first_s":0,"every_s":1200,"states":36 or "times_s":[],"per_point_s":8,"points":["F1"],
//                   "components":["EX","EY","EZ"],"c_deg":[0],"tool_offset_mm":[0,0,0],"holdout_last":10 or
//                   "holdout":["M4"],"random_approach":true,"clock_offset_s":0},
//    "instrument":{"name","sigma_um","sigma_urad","resolution_um","drift_um_per_h","ar1","dropped","outliers",
//                  "outlier_size"},
//    "touches":{"artefact","first_s","every_s","cycles","touch_s","sigma_um","pretravel_um","origin_mm":[x,y,z]},
//    "microscope":{...}, "profiler":{...} (scenario_instruments.h),
//    "sensors":[{"name","place","noise_K","ar1","resolution_K","bias_K","drift_K_per_h","time_constant_s","dead",
//                "dropout"}],
//    "log":{"omit":["coolant"]}}
//
// `size` multiplies what the physics gives; `strength` asks for the rms of the cause over the rows to be fitted, in its
// main component, in units of sigma. `convection.speed` and `dynamics.second_lag` among the effects scale how much
// motion adds to convection and how heavy the spindle is (their size is a factor; off = 0 and a tenth).
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/base/json_reader.h"
#include "core/machine/component.h"
#include "core/simulation/environment.h"
#include "core/simulation/programme.h"
#include "core/simulation/scenario_instruments.h"
#include "core/simulation/virtual_machine.h"

namespace spindrift {

/// A temperature sensor in the log.
struct SensorOptions {
  std::string name;   ///< "T_column_front_degC"
  std::string place;  ///< of volumesAt()
  double noise_K = 0.04;
  double ar1 = 0.0;  ///< correlation of the noise from one row to the next (same variance), [0, 1)
  double resolution_K = 0.001;
  double bias_K = 0.0;
  double drift_K_per_h = 0.0;    ///< linear in time
  double time_constant_s = 0.0;  ///< first-order lag between the body and the sensor, >= 0
  bool dead = false;             ///< repeats its first value
  double dropout = 0.0;          ///< part of the rows in which the field is empty, [0, 1)
};

/// When and where the instrument measures.
struct MeasurementOptions {
  std::vector<double> times_s;
  double per_point_s = 8.0;
  std::vector<std::string> points;  ///< empty: all of the machine
  std::vector<Component> components{Component::EX, Component::EY, Component::EZ};
  std::vector<double> c_deg{0.0};  ///< table angles, one state after another
  Eigen::Vector3d tool_offset_mm = Eigen::Vector3d::Zero();
  std::set<std::string> holdout;  ///< names of states
  bool random_approach = true;
  double clock_offset_s = 0.0;  ///< the clock of the observations (and of the simulation table) minus that of the log
};

/// What the instrument adds to the truth. Noise is normal; `ar1` is its correlation from one state to the next, per
/// point and component (same variance). Drift is linear in time and the same for all points of a component.
struct InstrumentOptions {
  std::string name = "microscope";
  double sigma_um = 0.5;
  double sigma_urad = 2.0;
  double resolution_um = 0.0;
  double drift_um_per_h = 0.0;
  double ar1 = 0.0;           ///< [0, 1)
  double dropped = 0.0;       ///< part of the rows that are missing
  double outliers = 0.0;      ///< part of the rows that are off
  double outlier_size = 8.0;  ///< by this many sigma
};

/// The simulation that the campaign comes with: the same machine with fewer causes and slightly wrong numbers.
struct BaseSimulationOptions {
  std::vector<std::string> effects;
  double parameter_error = 0.01;              ///< every size and physical parameter is off by at most this part
  double gain_uncertainty = 0.01;             ///< stated in campaign.json
  double missing_rows = 0.0;                  ///< part of the rows that the table lacks
  std::map<std::string, double> size_errors;  ///< of single effects, relative, beside parameter_error
};

/// Probing of a hole bar or of balls.
struct TouchOptions {
  std::string artefact;
  std::vector<double> times_s;  ///< start of each cycle
  double touch_s = 2.5;
  double sigma_um = 0.25;                               ///< of one touch along its approach
  double pretravel_um = 2.0;                            ///< the probe triggers late by this much, always
  Eigen::Vector3d origin_mm = Eigen::Vector3d::Zero();  ///< balls: centre of the first ball
};

struct ScenarioEffect {
  PlantEffectSetting setting;
  std::optional<double> strength;  ///< in place of the size
};

struct Scenario {
  std::string name;
  std::uint64_t seed = 1;
  std::string start_utc = "2026-03-01T05:00:00Z";
  double duration_s = 43200.0;
  double log_period_s = 30.0;
  MachineDescription machine;
  std::optional<Programme> programme;  ///< else random
  RandomProgrammeOptions random_programme;
  EnvironmentOptions environment;
  PlantParameters physics;
  std::map<std::string, ScenarioEffect> effects;
  std::optional<BaseSimulationOptions> simulation;
  std::optional<MeasurementOptions> measurement;
  InstrumentOptions instrument;
  std::optional<TouchOptions> touches;
  std::optional<MicroscopeOptions> microscope;
  std::optional<ProfilerOptions> profiler;
  std::vector<SensorOptions> sensors;
  std::set<std::string> omitted_signals;  ///< columns the log lacks

  /// Throws InputError with file and JSON path for anything that is not as described above.
  [[nodiscard]] static Scenario read(const std::filesystem::path& file);
  [[nodiscard]] static Scenario parse(const JsonNode& root, const std::filesystem::path& file);
};

/// Sensors that a machine has where the scenario names none: those of machine.json whose place is a body of the virtual
/// machine, else spindle, housing, column front and rear, table and room.
[[nodiscard]] std::vector<SensorOptions> standardSensors(const MachineDescription& machine);

}  // namespace spindrift
