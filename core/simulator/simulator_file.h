// SPDX-License-Identifier: Apache-2.0
// What simulator.json (FORMATS.md) has in common for all kinds, and how new versions of it are written. Paths in it are
// relative to its folder and never leave it.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/json_reader.h"
#include "core/simulator/json_edit.h"
#include "core/simulator/simulator.h"

namespace spindrift {

enum class SimulatorKind { Scenario, Command, Calculix, Sensitivities };

struct SimulatorFile {
  std::filesystem::path file;
  std::string text;  ///< as it was read
  JsonNode root;
  SimulatorKind kind = SimulatorKind::Command;
  std::vector<SimulatorParameter> parameters;  ///< own ones, in the order of the file

  [[nodiscard]] std::filesystem::path folder() const;
  /// The path that `node` names, as it stands there: of a file within the folder. Throws InputError: an absolute path,
  /// one with "..", what is no file.
  [[nodiscard]] std::string relativeFile(const JsonNode& node) const;
};

/// Throws InputError: another format or kind, a parameter without a name, with the name of another one, with a value
/// beyond its bounds or a negative uncertainty.
[[nodiscard]] SimulatorFile openSimulatorFile(const std::filesystem::path& file);

/// A relative path without "..". Throws InputError.
[[nodiscard]] std::string pathWithin(const JsonNode& node);

/// Every parameter with its value: the given one, else its own. Parameters may be named by name or id. Throws
/// InputError: an unknown name, a value beyond its bounds or none.
[[nodiscard]] ParameterValues completeValues(const Simulator& simulator, const ParameterValues& given);

/// "h_air = 12, sun_front = 80" of the values that were given; "its own values" where none are.
[[nodiscard]] std::string valuesText(const ParameterValues& given);

/// What of every observation decides its prediction, as text: for keys of answers.
[[nodiscard]] std::string placesOf(const ObservationSet& at);

/// Changes that put `values` into the parameters of simulator.json: only where they differ from what stands there.
[[nodiscard]] std::vector<JsonEdit> valueEdits(const SimulatorFile& file, const ParameterValues& values);

/// Makes `folder` (absent or empty) with what `fill` writes into the folder that it is handed. After an exception
/// everything is as before. Throws InputError.
void writeWholeFolder(const std::filesystem::path& folder,
                      const std::function<void(const std::filesystem::path& into)>& fill);

/// A copy of `relative` from one folder to another, with its permissions. Throws InputError.
void copyWithin(const std::filesystem::path& from, const std::filesystem::path& to, const std::string& relative);

}  // namespace spindrift
