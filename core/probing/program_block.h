// SPDX-License-Identifier: Apache-2.0
// Blocks of a measuring programme in the language of one control, read back into what they command (private to
// probing; see cycle_program.h for the dialects).
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace spindrift {

/// What one block commands, whatever the language. Words: X Y Z and the rotary letter are positions in machine
/// coordinates (mm, deg as the control counts).
struct ProgramBlock {
  int line = 0;
  std::multimap<char, double> words;
  bool touch = false;
  bool guarded = false;
  bool ends = false;
  bool absolute = false;     ///< positions are absolute from here on
  bool millimetres = false;  ///< and in mm
  int motion = -1;           ///< 0 rapid, 1 feed; -1: as before
  /// Of a touch that is given by a direction and a distance: where it ends is the position before plus this.
  std::optional<std::array<double, 3>> towards_mm;
  /// What the control will print of a touch beside where it was: A feature and B stylus (from 1), C angle of the table,
  /// I J K approach.
  std::multimap<char, double> printed;
  std::vector<std::string> issues;

  [[nodiscard]] std::optional<double> word(char letter) const { return among(words, letter); }
  [[nodiscard]] std::optional<double> print(char letter) const { return among(printed, letter); }

 private:
  [[nodiscard]] static std::optional<double> among(const std::multimap<char, double>& words, char letter) {
    const auto found = words.find(letter);
    return found == words.end() ? std::nullopt : std::optional(found->second);
  }
};

/// All blocks that command something or cannot be read. The language is told by the text itself.
[[nodiscard]] std::vector<ProgramBlock> readProgramBlocks(std::string_view text);

}  // namespace spindrift
