// SPDX-License-Identifier: Apache-2.0
// Answers of programs on the disk, by the SHA-256 of all that went in: $SPINDRIFT_CACHE/simulator, else
// $XDG_CACHE_HOME/spindrift/simulator, else ~/.cache/spindrift/simulator. It may be deleted at any time; answers that
// have not been asked for in 90 days are. Where it cannot be written nothing is kept.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/machine/simulation_row.h"

namespace spindrift {

/// The whole answer of a program.
struct ProgramAnswer {
  std::vector<SimulationRow> rows;  ///< by point (or place), in order of time
  bool by_place = false;
};

class AnswerStore {
 public:
  AnswerStore();
  /// Nothing for an unknown key, or a file that is damaged.
  [[nodiscard]] std::optional<ProgramAnswer> load(const std::string& key) const;
  void save(const std::string& key, const ProgramAnswer& answer) const;

 private:
  std::filesystem::path folder_;  ///< empty: nothing is kept
};

/// Rows of a table that SimulationTable has read; by point or place, then in order of time. Throws InputError.
[[nodiscard]] ProgramAnswer readAnswer(std::string text, const std::filesystem::path& name);

}  // namespace spindrift
