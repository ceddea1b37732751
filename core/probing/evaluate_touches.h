// SPDX-License-Identifier: Apache-2.0
// Touches of hole and ball artefacts (captures/touches.csv) evaluated into observations.
#pragma once

#include <vector>

#include "core/base/job_context.h"
#include "core/machine/campaign.h"
#include "core/machine/instrument_evaluation.h"
#include "core/probing/ball_cycle.h"
#include "core/probing/hole_cycle.h"

namespace spindrift {

/// Everything that was found, for pages and reports.
struct TouchEvaluation {
  TouchList touches;                         ///< without those the user excluded
  std::vector<Touch> excluded;               ///< by the user (Campaign::excluded_captures names them by Touch::id)
  std::vector<HoleCycleResult> hole_cycles;  ///< one per hole bar
  std::vector<BallCycleResult> ball_cycles;  ///< one per ball artefact
};

/// Throws InputError if the list cannot be read or contradicts the machine file.
[[nodiscard]] TouchEvaluation evaluateTouchList(const Campaign& campaign, TouchList touches,
                                                const HoleCycleOptions& hole_options,
                                                const BallCycleOptions& ball_options, JobContext& job);

/// Observations, JSON and summary of an evaluation.
[[nodiscard]] InstrumentEvaluation describeTouches(const TouchEvaluation& evaluation,
                                                   const MachineDescription& machine);

/// JSON of one artefact: `cycles:[{cycle, parameters:{NAME:{value,standard_uncertainty}}}]` and what belongs to it.
[[nodiscard]] nlohmann::json cyclesJson(const CycleEvaluation& evaluation);

/// Bad captures are listed with their reason, the rest is evaluated. Throws InputError if the list itself cannot be
/// read.
[[nodiscard]] InstrumentEvaluation evaluateTouches(const Campaign& campaign, JobContext& job);

}  // namespace spindrift
