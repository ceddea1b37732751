// SPDX-License-Identifier: Apache-2.0
// Laser scans (captures/scans.csv) evaluated into observations.
#pragma once

#include "core/base/job_context.h"
#include "core/machine/campaign.h"
#include "core/machine/instrument_evaluation.h"
#include "core/scanning/scan_evaluation.h"

namespace spindrift {

/// Bad captures are listed with their reason, the rest is evaluated. Throws InputError if the list itself cannot be
/// read.
[[nodiscard]] InstrumentEvaluation evaluateScans(const Campaign& campaign, const std::string& scan_model,
                                                 JobContext& job);
/// The same of scans that were compared already.
[[nodiscard]] InstrumentEvaluation observationsOfScans(const Campaign& campaign, const ScanEvaluation& evaluation);

}  // namespace spindrift
