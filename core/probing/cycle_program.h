// SPDX-License-Identifier: Apache-2.0
// A planned cycle as a programme for the operator's control, and an independent check of such a programme.
//
// Coordinates are positions of the spindle reference (tip minus stylus offset) in machine coordinates, mm: the work
// offset is zero and no tool length is active, so that star styli need no tool change. Two dialects:
//   fanuc    Custom macro B: G65 P8902 guarded move, G65 P8903 touch (G31 inside), DPRNT to the printer port; the
//   macros
//            stand behind the main programme
//   generic  RS274/NGC as LinuxCNC reads it: G38.3 guarded, G38.2 touch, (LOG,...) to a file
// Every touch prints: T A<feature> B<stylus> C<angle> D<touch> X Y Z I J K (numbers from 1; I J K = approach), every
// cycle CYCLE <number>. printed_text.h reads it. The check reads the text back without knowing the plan: every target
// within the travel, no move through the artefact, touches that reach the feature they name, a retract after every
// touch, turns and travel only at a safe height.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/probing/cycle_plan.h"

namespace spindrift {

enum class ProgramDialect { Fanuc, Generic };

/// "fanuc" or "generic"; throws InputError otherwise.
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

/// Reads a programme of either dialect and checks it. Unknown words are issues; nothing is thrown for a bad programme.
[[nodiscard]] ProgramCheck checkProgram(std::string_view text, const MachineDescription& machine,
                                        const Artefact& artefact, const ProgramCheckOptions& options = {});

}  // namespace spindrift
