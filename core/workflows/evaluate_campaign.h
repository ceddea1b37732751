// SPDX-License-Identifier: Apache-2.0
// From raw captures to observations, whatever instruments took part in a campaign.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/job_context.h"
#include "core/machine/campaign.h"
#include "core/machine/instrument_evaluation.h"

namespace spindrift {

struct EvaluateOptions {
  std::string scan_model;  ///< "", "rigid" or "push_broom": in place of the one in machine.json
};

/// The evaluations of all instruments and their observations in one set (rows in order of the instruments, each in
/// order of time; covariances kept).
struct CampaignEvaluation {
  std::vector<InstrumentEvaluation> instruments;
  ObservationSet observations;
  bool good_enough = true;

  /// JSON of `evaluate` (FORMATS.md): details of the instruments merged, `rejected`, `warnings`, number of
  /// observations.
  [[nodiscard]] nlohmann::json json() const;
  [[nodiscard]] std::string summary() const;
};

/// Throws InputError if the campaign has no captures, a list cannot be read or the positions are metres; a bad capture
/// and a reading that no machine gives (core/machine/observation_plausibility.h) are listed, the rest is evaluated. The
/// campaign folder is not written to.
[[nodiscard]] CampaignEvaluation evaluateCampaign(const Campaign& campaign, const EvaluateOptions& options,
                                                  JobContext& job);

/// Observations for a command: from `file` if given, else the campaign's own, else its captures evaluated in memory.
/// What was taken while the control was compensating is marked `exclude`, so that no fit uses it; `notes` gets the
/// sentence that says so.
[[nodiscard]] ObservationSet observationsOf(const Campaign& campaign, const std::filesystem::path& file,
                                            const EvaluateOptions& options, JobContext& job,
                                            std::vector<std::string>* notes = nullptr);
/// The same with what was taken while compensating as it is, for verification.
[[nodiscard]] ObservationSet allObservationsOf(const Campaign& campaign, const std::filesystem::path& file,
                                               const EvaluateOptions& options, JobContext& job);

}  // namespace spindrift
