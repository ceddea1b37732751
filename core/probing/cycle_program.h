// SPDX-License-Identifier: Apache-2.0
// A planned cycle as a programme for the operator's control, and an independent check of such a programme.
//
// Coordinates are positions of the spindle reference (tip minus stylus offset) in machine coordinates, mm: the work
// offset is zero and no tool length is active, so that star styli need no tool change. Four dialects:
//   fanuc       Custom macro B: G65 P8902 guarded move, G65 P8903 touch (G31 inside), DPRNT to the printer port; the
//               macros stand behind the main programme
//   generic     RS274/NGC as LinuxCNC reads it: G38.3 guarded, G38.2 touch, (LOG,...) to a file
//   siemens     SINUMERIK 840D: SUPA moves, MEAS=1 with $AC_MEA asked after it, $AA_MM (machine coordinates) written by
//               WRITE into the file SPINDRIFT.MPF; R99 counts the cycles
//   heidenhain  TNC conversational: L ... M91 (the control stops at a contact unless M141), TCH PROBE 4 with REFERENCE
//               SYSTEM:1, FN 16 prints through the masks TOUCH.A and CYCLE.A (companionFiles)
// Sources: Siemens, SINUMERIK 840D sl, Programming Manual Job Planning (MEAS, $AA_MM, WRITE) and Fundamentals (SUPA);
// Heidenhain, TNC user's manuals, Touch Probe Cycles (cycle 4) and Conversational Programming (FN 16, FN 18, M91,
// M141). None of the programmes replaces a dry run on the machine: which signal the probe uses and where a touch is
// stored is set by the machine builder. Every touch prints: T A<feature> B<stylus> C<angle> D<touch> X Y Z I J K
// (numbers from 1; I J K = approach), every cycle CYCLE <number>. printed_text.h reads it. The check reads the text
// back without knowing the plan: every target within the travel, no move through the artefact, touches that reach the
// feature they name, a retract after every touch, turns and travel only at a safe height.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/probing/cycle_plan.h"

namespace spindrift {

enum class ProgramDialect { Fanuc, Generic, Siemens, Heidenhain };

/// "fanuc", "generic", "siemens" or "heidenhain"; throws InputError otherwise.
[[nodiscard]] ProgramDialect programDialect(std::string_view name);

struct ProgramOptions {
  ProgramDialect dialect = ProgramDialect::Fanuc;
  int program_number = 9001;
  /// -1 if the control counts its rotary axis clockwise seen from above.
  int rotary_sign = 1;
};

/// Text of the programme.
[[nodiscard]] std::string writeProgram(const CyclePlan& plan, const MachineDescription& machine,
                                       const Artefact& artefact, const CyclePlanOptions& plan_options,
                                       const ProgramOptions& options = {});

/// A file that has to stand on the control beside the programme.
struct CompanionFile {
  std::string name;
  std::string content;
};
/// Heidenhain: the masks of FN 16, to be copied to TNC:\\SPINDRIFT. None for the others.
[[nodiscard]] std::vector<CompanionFile> companionFiles(ProgramDialect dialect);

/// Template for printed_text.h that reads what this programme prints.
[[nodiscard]] nlohmann::json printedTextTemplate(const MachineDescription& machine, const Artefact& artefact,
                                                 const ProgramOptions& options = {});

/// A move as the text says it.
struct ParsedMove {
  MoveKind kind = MoveKind::Rapid;
  Eigen::Vector3d reference_mm = Eigen::Vector3d::Zero();
  double c_deg = 0.0;
  int feature = 0;  ///< from 1, of a touch
  int stylus = 0;   ///< from 1, of a touch
  int line = 0;
};

struct ProgramIssue {
  int line = 0;
  std::string what;
};

struct ProgramCheck {
  std::vector<ParsedMove> moves;
  std::vector<ProgramIssue> issues;
  int touches = 0;
  [[nodiscard]] bool good() const noexcept { return issues.empty(); }
};

struct ProgramCheckOptions {
  double clearance_mm = 1.0;   ///< free distance that moves above the artefact must keep
  double overtravel_mm = 5.0;  ///< a touch may not search further behind the surface
  Eigen::Vector3d first_ball_mm = Eigen::Vector3d::Zero();
  int rotary_sign = 1;
};

/// Reads a programme of any of the dialects and checks it. Unknown words are issues; nothing is thrown for a bad
/// programme.
[[nodiscard]] ProgramCheck checkProgram(std::string_view text, const MachineDescription& machine,
                                        const Artefact& artefact, const ProgramCheckOptions& options = {});

}  // namespace spindrift
