// SPDX-License-Identifier: Apache-2.0
#include "core/probing/checked_program.h"

#include <algorithm>

namespace spindrift {

CheckedProgram makeCheckedProgram(const MachineDescription& machine, const Artefact& artefact,
                                  const CyclePlanOptions& plan_options, const ProgramOptions& options) {
  CheckedProgram program;
  program.plan = planCycle(machine, artefact, plan_options);
  program.text = writeProgram(program.plan, machine, artefact, plan_options, options);
  ProgramCheckOptions check;
  check.first_ball_mm = plan_options.first_ball_mm;
  check.rotary_sign = options.rotary_sign;
  check.overtravel_mm = plan_options.overtravel_mm + 0.5;
  check.clearance_mm = std::min(1.0, plan_options.clearance_mm);
  program.check = checkProgram(program.text, machine, artefact, check);
  return program;
}

}  // namespace spindrift
