// SPDX-License-Identifier: Apache-2.0
// What to measure next: operating programme, points and times that tell most about which of the rivals it is. Internal
// to core/discrepancy.
//
// Candidates are the effect named and all that may stand in its place, each with the drivers and lags that the data
// leave it, weighted by their evidence. Every programme that the machine can run (planned_programme.h) is scored by
// what it would leave unknown (measurement_design.h); for the best ones points are added one by one and exchanged, then
// times one by one, within what the user allows.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/discrepancy/discrepancy.h"
#include "core/discrepancy/effect_posterior.h"

namespace spindrift {

/// `ambiguous`: the effects named that have rivals. Nothing where no measurement of this kind tells them apart: nothing
/// that could drive one of them is in the log, or what they are about is over.
[[nodiscard]] std::optional<MeasurementSuggestion> suggestMeasurement(
    const DiscrepancyInput& input, const DriverTable& drivers, const EffectSearch& search,
    const ResidualProblem& problem, const EffectPosterior& posterior, const std::vector<std::string>& ambiguous,
    const DiscrepancyOptions& options, const DiscrepancyPriors& priors, const JobContext& job);

}  // namespace spindrift
