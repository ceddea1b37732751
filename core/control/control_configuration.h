// SPDX-License-Identifier: Apache-2.0
// Configuration of a LinuxCNC control that drives a virtual machine: files of LinuxCNC's own formats, made of its stock
// HAL components only. It is at the same time the pattern for a real machine: channel B of the compensation and its
// watchdog are the same there, probe and temperatures come from hardware.
//
//   joint command -> offset (hidden from the control) -> drive -> + error -> tip -> compared with three planes -> probe
//   comp-x (y, z) -> limit3 (range, speed, acceleration) -> offset       comp-alive -> watchdog -> enable of limit3
//
// Signals, mm, s, degC: comp-x comp-y comp-z (wanted compensation, to be written), comp-alive (to be toggled),
// comp-hold (1: the last compensation is held when nothing toggles, 0: it fades to zero), error-x ... (deviation =
// actual minus commanded, written by the machine's truth), surface-x ... (planes of the artefact), machine-time, one
// per temperature sensor (named as its column, with '-' for '_'). The artefact is an inside corner: a floor that is
// touched in -Z, walls in +X and +Y.
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/machine/machine_description.h"

namespace spindrift {

struct ControlConfiguration {
  int port = 5007;
  double servo_period_s = 1e-3;
  // What the control allows of a compensation, whatever it is told.
  double limit_mm = 0.3;
  double speed_mm_s = 0.02;
  double acceleration_mm_s2 = 0.2;
  double watchdog_s = 2.0;                              ///< silence after which the compensation fades or is held
  Eigen::Vector3d corner_mm = Eigen::Vector3d::Zero();  ///< where floor and walls meet
  std::vector<std::string> temperatures;                ///< columns, "T_spindle_degC"
  /// Compensation files of the axes X, Y, Z and their type (0 or 1); empty: none.
  std::array<std::string, 3> compensation_file;
  int compensation_type = 0;
  double max_velocity_mm_s = 200.0;
  double max_acceleration_mm_s2 = 2000.0;

  /// Throws InputError.
  void validate() const;
};

/// Name of the signal that holds a temperature.
[[nodiscard]] std::string temperatureSignal(const std::string& column);

/// Writes spindrift.ini, spindrift.hal, sim.var and tool.tbl; travel comes from the machine. The folder must be there.
/// Throws InputError: a machine without X, Y and Z, a corner outside its travel.
void writeControlConfiguration(const MachineDescription& machine, const ControlConfiguration& configuration,
                               const std::filesystem::path& folder);

/// What a program prints with (LOG,...): relative to the folder of the configuration.
inline constexpr const char* print_file = "touches.txt";

}  // namespace spindrift
