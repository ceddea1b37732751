// SPDX-License-Identifier: Apache-2.0
// A measuring programme as it is handed to the operator: planned, written, read back and checked in one go.
#pragma once

#include <string>

#include "core/probing/cycle_plan.h"
#include "core/probing/cycle_program.h"

namespace spindrift {

struct CheckedProgram {
  CyclePlan plan;
  std::string text;
  ProgramCheck check;  ///< only a programme with check.good() may be given away
};

/// Throws InputError if the cycle cannot be planned on this machine.
[[nodiscard]] CheckedProgram makeCheckedProgram(const MachineDescription& machine, const Artefact& artefact,
                                                const CyclePlanOptions& plan_options, const ProgramOptions& options);

}  // namespace spindrift
