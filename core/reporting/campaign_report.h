// SPDX-License-Identifier: Apache-2.0
// The report of a campaign: what was measured, with what, what came out with which uncertainty, and from what it was
// made.
//
// Sections that need results of higher parts (fits, discrepancy, ISO 230-3) are handed in ready as `ReportSection`, so
// that the report shows exactly what the pages and commands computed and computes nothing itself.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/machine/campaign.h"
#include "core/machine/instrument_evaluation.h"
#include "core/reporting/report.h"

namespace spindrift {

/// A part of the report that somebody else fills.
struct ReportSection {
  std::string heading;
  std::function<void(Report&)> fill;
};

struct CampaignReportInput {
  const Campaign* campaign = nullptr;
  /// Evaluations of the captures, if there are any.
  std::vector<InstrumentEvaluation> instruments;
  ObservationSet observations;
  /// Plan, captures, state of the instrument: after the operating conditions. Each writes its own heading, or nothing.
  std::vector<std::function<void(Report&)>> preparation;
  std::vector<ReportSection> sections;
  /// Models over time, standard tests, compensation: after the sections. Each writes its own heading, or nothing.
  std::vector<std::function<void(Report&)>> conclusions;
  /// Excluded items with reasons, notes: shown as they are.
  std::vector<std::pair<std::string, std::string>> exclusions;
  std::vector<std::string> notes;
  /// Names and values for the summary on the first page, beside the largest changes of the observations.
  ReportFacts headlines;
  std::string created_utc;
  std::string operator_name;  ///< may be empty: a line to sign on is left
  std::string fingerprint;    ///< of the campaign as the work began; empty: as it is now
};

/// False for the machine that stands in for one in a campaign made of a log alone.
[[nodiscard]] bool isDescribed(const MachineDescription& machine);

/// The whole report: title, summary, machine, operating log; `preparation`; results of each instrument, observations
/// over time; `sections`, `conclusions`; exclusions, notes and provenance.
[[nodiscard]] Report campaignReport(const CampaignReportInput& input);

}  // namespace spindrift
