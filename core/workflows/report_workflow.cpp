// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/report_workflow.h"

#include "core/reporting/campaign_report.h"
#include "core/session/session.h"

namespace spindrift {

std::string campaignReportHtml(const Campaign& campaign, const ReportOptions& options, JobContext& job) {
  CampaignReportInput input;
  input.campaign = &campaign;
  input.created_utc = utcNow();
  input.operator_name = options.operator_name;
  input.exclusions = options.exclusions;
  input.notes = options.notes;
  const bool has_captures =
      campaign.captureList("fiducials.csv") || campaign.captureList("touches.csv") || campaign.captureList("scans.csv");
  JobContext evaluating = job.part(0.0, 0.6);
  if (has_captures) {
    CampaignEvaluation evaluation = evaluateCampaign(campaign, options.evaluate, evaluating);
    input.instruments = std::move(evaluation.instruments);
    input.observations = std::move(evaluation.observations);
  }
  if (!options.observations_file.empty()) {
    input.observations = ObservationSet::read(options.observations_file);
  } else if (campaign.observations) {
    input.observations = *campaign.observations;
  }
  job.report(1.0, "writing the report");
  return campaignReport(input).html();
}

}  // namespace spindrift
