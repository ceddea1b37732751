// SPDX-License-Identifier: Apache-2.0
// Images of coded fiducials (captures/fiducials.csv) evaluated into observations.
#pragma once

#include "core/base/job_context.h"
#include "core/machine/campaign.h"
#include "core/machine/instrument_evaluation.h"

namespace spindrift {

/// Bad captures are listed with their reason, the rest is evaluated. Throws InputError if the list itself cannot be
/// read.
[[nodiscard]] InstrumentEvaluation evaluateFiducials(const Campaign& campaign, JobContext& job);

}  // namespace spindrift
