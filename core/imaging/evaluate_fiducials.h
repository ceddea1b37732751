// SPDX-License-Identifier: Apache-2.0
// Images of coded fiducials (captures/fiducials.csv) evaluated into observations.
#pragma once

#include <filesystem>
#include <memory>

#include "core/base/job_context.h"
#include "core/imaging/pattern.h"
#include "core/machine/campaign.h"
#include "core/machine/instrument_evaluation.h"

namespace spindrift {

/// Bad captures are listed with their reason, the rest is evaluated. Throws InputError if the list itself cannot be
/// read.
[[nodiscard]] InstrumentEvaluation evaluateFiducials(const Campaign& campaign, JobContext& job);

/// The artwork of this campaign's fiducials: `pattern.json` of its folder, else the standard pattern. Throws
/// InputError.
[[nodiscard]] std::shared_ptr<const FiducialPattern> campaignPattern(const std::filesystem::path& folder);

}  // namespace spindrift
