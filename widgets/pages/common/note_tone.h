// SPDX-License-Identifier: GPL-3.0-or-later
// The tone of what a result says beside itself.
#pragma once

#include "widgets/theme/theme.h"
#include "widgets/workflow/workflow.h"

namespace spindrift::gui {

/// As the list of steps has it: a note where the step is done, a warning where it asks for attention. So no step is
/// green beside a page that warns.
[[nodiscard]] inline Tone noteTone(const Workflow& workflow, StepId step) {
  return workflow.status(step).state == StepState::Current ? Tone::Accent : Tone::Attention;
}

}  // namespace spindrift::gui
