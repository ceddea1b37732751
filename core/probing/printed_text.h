// SPDX-License-Identifier: Apache-2.0
// Text that measuring programmes print, read by a template that a user adapts to his control without programming.
//
// Template (JSON): {"format":"spindrift-printed-text","version":1,
//   "touch_line":"T A{feature} B{stylus} C{c_deg} D{touch} X{x} Y{y} Z{z} I{nx} J{ny} K{nz} S{time}",
//   "cycle_line":"CYCLE {cycle}", "cycle_prefix":"M",
//   "values":{"feature":{"1":"H1"},"stylus":{"1":"p0"}}, "artefact":"bar", "position":"stylus_centre"|
//   "spindle_reference", "mm_per_unit":1, "s_per_unit":0.001, "touch_interval_s":3, "cycle_interval_s":600, "c_sign":1,
//   "clock":"running"|"day_of_month", "decimal_comma":false}
// A placeholder {name} takes a word or number, {skip} takes anything; blanks match any number of blanks, or none before
// a placeholder. Places: feature, stylus, artefact, cycle, c_deg, touch, x, y, z, nx, ny, nz, time. Lines that match
// neither pattern are counted and ignored. What a line does not carry comes from the template or from what stands
// before (touches are then numbered, times counted up). A clock "day_of_month" counts from the first of the month and
// begins again with the next one: a fall by more than 27 days goes on with the day after.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/json_reader.h"
#include "core/base/line_pattern.h"
#include "core/probing/touch.h"

namespace spindrift {

/// Reads such a text line by line, as it grows.
class PrintedTextReader {
 public:
  /// Throws InputError: a bad template (unknown place, missing key or place).
  PrintedTextReader(std::filesystem::path name, const JsonNode& pattern, const MachineDescription& machine);
  PrintedTextReader(const PrintedTextReader&) = delete;
  PrintedTextReader& operator=(const PrintedTextReader&) = delete;

  /// The touch of the next line, if it is one. Throws InputError: a matching line with a value that is none; the line
  /// is left out then, as if it were empty.
  [[nodiscard]] std::optional<Touch> read(std::string_view line);
  [[nodiscard]] int ignoredLines() const { return ignored_lines_; }
  /// Of these: lines that begin as a touch does, and the first of them (from 1). Their touches are lost.
  [[nodiscard]] int cutLines() const { return cut_lines_; }
  [[nodiscard]] std::size_t firstCutLine() const { return first_cut_line_; }

 private:
  using Values = std::map<std::string, std::string>;
  void beginCycle(const Values& values);
  [[nodiscard]] std::string cycleName(std::string label) const;
  [[nodiscard]] Touch touchOf(const Values& values);
  [[nodiscard]] std::string translated(const std::string& place, const std::string& value) const;
  [[nodiscard]] std::string word(const Values& values, const char* what, const std::string& otherwise) const;
  [[nodiscard]] double number(const Values& values, const char* what, double otherwise) const;
  [[nodiscard]] SourcePlace place(const std::string& what) const;

  std::filesystem::path name_;
  LinePattern touch_line_;
  std::string touch_begin_;  ///< what stands before its first place
  std::optional<LinePattern> cycle_line_;
  std::string prefix_, artefact_, stylus_;
  std::vector<Stylus> styli_;  ///< of the machine
  bool reference_ = false;     ///< positions are those of the spindle
  bool decimal_comma_ = false;
  bool day_of_month_ = false;
  double mm_per_unit_, s_per_unit_, interval_s_, cycle_interval_s_, c_sign_;
  std::map<std::string, std::map<std::string, std::string>> translations_;

  std::size_t line_ = 0;
  int ignored_lines_ = 0;
  int cut_lines_ = 0;
  std::size_t first_cut_line_ = 0;
  std::string cycle_;
  int cycles_ = 0;
  double clock_s_ = 0.0;
  double cycle_start_s_ = 0.0;
  std::optional<double> first_time_s_;
  double printed_s_ = 0.0;               ///< time of the last touch as the clock shows it
  double months_before_s_ = 0.0;         ///< what the months before it add
  std::map<std::string, int> numbered_;  ///< touches of the cycle, by feature, stylus and angle
};

struct PrintedText {
  TouchList touches;
  int ignored_lines = 0;
  int cut_lines = 0;  ///< of these: begin as a touch does
  std::size_t first_cut_line = 0;
};

/// A whole text. Throws InputError: a bad template, a matching line with a value that is none, no line that matches.
[[nodiscard]] PrintedText readPrintedText(std::string_view text, const std::filesystem::path& name,
                                          const JsonNode& pattern, const MachineDescription& machine);

}  // namespace spindrift
