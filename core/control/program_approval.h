// SPDX-License-Identifier: Apache-2.0
// What a programme would move, and the operator's consent to it.
//
// The dry run reads a programme of absolute straight moves without executing it: G0, G1, G38.2 to G38.5 with X Y Z and
// F, spindle (M3, M4, M5, S), dwell (G4 P), coolant (M7, M8, M9), end (M2, M30), the settings G17 G21 G40 G49 G54 G64
// G80 G90 G94, comments and (LOG...) lines. Anything else (G91, variables, loops, offsets, tool changes) is refused:
// what cannot be foreseen is not run. Every target has to lie within the travel of machine.json, and the speed of the
// spindle within its limit.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/machine/machine_description.h"
#include "core/probing/cycle_program.h"

namespace spindrift {

struct DryMove {
  int line = 0;
  bool probing = false;
  bool rapid = false;
  Eigen::Vector3d from_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d to_mm = Eigen::Vector3d::Zero();
};

struct DryRun {
  std::vector<DryMove> moves;
  std::vector<ProgramIssue> issues;
  Eigen::Vector3d lowest_mm = Eigen::Vector3d::Zero();  ///< of all targets
  Eigen::Vector3d highest_mm = Eigen::Vector3d::Zero();
  int touches = 0;
  double largest_rpm = 0.0;
  double estimated_s = 0.0;  ///< at the programmed feeds, rapids at 10 m/min
  [[nodiscard]] bool good() const noexcept { return issues.empty(); }
  /// "12 moves within X 95 to 105, ... mm, 4 touches, about 9 s".
  [[nodiscard]] std::string summary() const;
};

[[nodiscard]] DryRun dryRun(std::string_view program, const MachineDescription& machine,
                            const Eigen::Vector3d& start_mm);

/// A programme that was looked at and agreed to. Cannot be made in any other way.
class ApprovedProgram {
 public:
  /// The operator's answer to what would move.
  using Confirm = std::function<bool(const DryRun& run)>;

  /// Throws InputError: the first thing that is wrong with the programme, with its line; or not confirmed. A programme
  /// that touches an `artefact` (may be null) also has to pass checkProgram.
  [[nodiscard]] static ApprovedProgram approve(std::string text, const MachineDescription& machine,
                                               const Eigen::Vector3d& start_mm, const Confirm& confirm,
                                               const Artefact* artefact = nullptr,
                                               const ProgramCheckOptions& options = {});
  [[nodiscard]] const std::string& text() const noexcept { return text_; }
  [[nodiscard]] const DryRun& run() const noexcept { return run_; }

 private:
  ApprovedProgram(std::string text, DryRun run) : text_(std::move(text)), run_(std::move(run)) {}
  std::string text_;
  DryRun run_;
};

}  // namespace spindrift
