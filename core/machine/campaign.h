// SPDX-License-Identifier: Apache-2.0
// A campaign folder as FORMATS.md describes it: plain files, written once and never altered by an evaluation.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>

#include "core/base/shared_value.h"
#include "core/machine/machine_description.h"
#include "core/machine/observation.h"
#include "core/machine/operating_log.h"

namespace spindrift {

struct Campaign {
  std::filesystem::path folder;
  std::string name;
  std::string start_utc;                      ///< "2026-01-31T08:00:00Z"
  std::string simulation;                     ///< "model.json", "simulation.csv" or empty; relative to the folder
  double simulation_gain_uncertainty = 0.01;  ///< relative, per component
  bool absolute = false;                      ///< "reference": "absolute": no constant of an observation is free
  std::filesystem::path effects;              ///< "effects.json" or empty; relative to the folder, or absolute
  std::filesystem::path simulator;            ///< "simulator.json" or empty; relative to the folder, or absolute
  MachineDescription machine;
  SharedValue<OperatingLog> log;
  SharedValue<ObservationSet> observations;  ///< the campaign's own observations.csv
  /// Captures the user took out, as the lists name them ("captures/images/a.jpg"): evaluations leave them out.
  std::set<std::string> excluded_captures;

  /// Reads campaign.json, machine.json and, where present, log.csv and observations.csv. Captures are read by the
  /// instruments. Throws InputError.
  [[nodiscard]] static Campaign read(const std::filesystem::path& folder);

  [[nodiscard]] std::filesystem::path path(std::string_view relative) const { return folder / relative; }
  /// `captures/<name>` if it is there.
  [[nodiscard]] std::optional<std::filesystem::path> captureList(std::string_view file_name) const;
};

}  // namespace spindrift
