// SPDX-License-Identifier: Apache-2.0
// The report of a whole campaign, as the command line and the desktop program make it.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/job_context.h"
#include "core/discrepancy/discrepancy.h"
#include "core/machine/campaign.h"
#include "core/machine/nine_parameter_model.h"
#include "core/reporting/report.h"
#include "core/workflows/evaluate_campaign.h"
#include "core/workflows/report_sections.h"

namespace spindrift {

struct ReportOptions {
  std::filesystem::path observations_file;  ///< in place of the campaign's own observations or captures
  EvaluateOptions evaluate;
  std::optional<CampaignEvaluation> evaluated;  ///< of a session, with what the user excluded: not evaluated again
  bool discrepancy = true;                      ///< search for a missing effect where the campaign names a simulation
  DiscrepancyOptions search;                    ///< of that search: effects put in or left out by the user
  NineParameterOptions fit;                     ///< of the model of each state; its state is set
  /// The test of ISO 230-3 as it was chosen for the series of the log; none: the one that the log is a record of.
  AskedTest iso230;
  std::string operator_name;
  std::vector<std::pair<std::string, std::string>> exclusions;
  std::vector<std::string> notes;
  StoredResults stored;  ///< of a session; shown as they are
  /// What the user excluded and whose clocks were moved, for observations that are evaluated here; none: nothing.
  std::function<void(ObservationSet&)> choices;
  std::string fingerprint;  ///< of the campaign when the work started; empty: taken then
  /// DiscrepancyStory::json of a session: told in place of a new search; null: search.
  std::shared_ptr<const nlohmann::json> story;
};

/// Whether there is anything to report: observations (own or evaluated), or a log. A log alone is reported with its
/// conditions, displacements, ISO 230-3 parameters and what was modelled over time.
[[nodiscard]] bool canReport(const Campaign& campaign, bool has_observations);

/// Evaluates the captures (if any), fits where there is something to fit, and returns the report. A
/// part that cannot be computed from this campaign is left out with the reason in the report.
[[nodiscard]] Report reportOfCampaign(const Campaign& campaign, const ReportOptions& options, JobContext& job);

}  // namespace spindrift
