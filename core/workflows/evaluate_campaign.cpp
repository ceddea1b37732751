// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/evaluate_campaign.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/count_text.h"
#include "core/imaging/evaluate_fiducials.h"
#include "core/imaging/fiducial_captures.h"
#include "core/machine/observation_plausibility.h"
#include "core/probing/evaluate_touches.h"
#include "core/scanning/evaluate_scans.h"
#include "core/scanning/scan_evaluation.h"
#include "core/workflows/compensated_data.h"

namespace spindrift {

nlohmann::json CampaignEvaluation::json() const {
  nlohmann::json out = nlohmann::json::object();
  nlohmann::json rejected = nlohmann::json::array();
  nlohmann::json warnings = nlohmann::json::array();
  nlohmann::json names = nlohmann::json::array();
  for (const InstrumentEvaluation& instrument : instruments) {
    names.push_back(instrument.instrument);
    for (const auto& [key, value] : instrument.details.items()) {
      if (out.contains(key) && out[key].is_array() && value.is_array()) {
        out[key].insert(out[key].end(), value.begin(), value.end());
      } else {
        out[key] = value;
      }
    }
    for (const RejectedCapture& r : instrument.rejected)
      rejected.push_back({{"capture", r.capture}, {"reason", r.reason}});
    for (const EvaluationWarning& w : instrument.warnings) warnings.push_back(w.sentence);
  }
  out["instruments"] = names;
  out["rejected"] = rejected;
  out["warnings"] = warnings;
  out["observation_count"] = observations.rows.size();
  return out;
}

namespace {
/// Of an instrument in a summary.
constexpr std::size_t most_rejected = 20;

/// What an instrument gives that no machine does is a rejected capture; the rest stays.
void leaveOutImplausible(InstrumentEvaluation& instrument) {
  std::vector<std::size_t> out;
  for (const ImplausibleReading& reading : implausibleReadings(instrument.observations)) {
    out.insert(out.end(), reading.rows.begin(), reading.rows.end());
    rejectReading(reading, instrument);
  }
  if (out.empty()) return;
  std::sort(out.begin(), out.end());
  instrument.observations = withoutRows(instrument.observations, out);
}
}  // namespace

std::string CampaignEvaluation::summary() const {
  std::string text;
  for (const InstrumentEvaluation& instrument : instruments) {
    text += instrument.summary;
    if (!text.empty() && text.back() != '\n') text += '\n';
    for (std::size_t i = 0; i < std::min(instrument.rejected.size(), most_rejected); ++i)
      text += fmt::format("rejected {}: {}\n", instrument.rejected[i].capture, instrument.rejected[i].reason);
    if (instrument.rejected.size() > most_rejected)
      text += fmt::format("and {} more rejected; --json lists all\n", instrument.rejected.size() - most_rejected);
    for (const EvaluationWarning& w : instrument.warnings) text += fmt::format("note: {}\n", w.sentence);
  }
  text += countOf(observations.rows.size(), "observation") + "\n";
  return text;
}

CampaignEvaluation evaluateCampaign(const Campaign& campaign, const EvaluateOptions& options, JobContext& job) {
  CampaignEvaluation evaluation;
  const auto fiducials = campaign.captureList("fiducials.csv");
  const auto touches = campaign.captureList("touches.csv");
  const auto scans = campaign.captureList("scans.csv");
  if (!fiducials && !touches && !scans) {
    throw InputError({campaign.path("captures"), ""},
                     "holds no list of captures; allowed: fiducials.csv, touches.csv or scans.csv.");
  }
  // A list that cannot be used ends the evaluation: say so before hours of images are looked at.
  if (fiducials) (void)readFiducialCaptures(*fiducials);
  if (touches) TouchList::read(*touches).checkAgainst(campaign.machine);
  if (scans) (void)readScanList(campaign);
  if (fiducials) evaluation.instruments.push_back(evaluateFiducials(campaign, job));
  if (touches) evaluation.instruments.push_back(evaluateTouches(campaign, job));
  if (scans) evaluation.instruments.push_back(evaluateScans(campaign, options.scan_model, job));
  for (InstrumentEvaluation& instrument : evaluation.instruments) {
    leaveOutImplausible(instrument);
    refusePositionsInAnotherUnit(instrument.observations, campaign.machine);
    evaluation.observations.append(instrument.observations);
    evaluation.good_enough = evaluation.good_enough && instrument.good_enough;
  }
  return evaluation;
}

ObservationSet allObservationsOf(const Campaign& campaign, const std::filesystem::path& file,
                                 const EvaluateOptions& options, JobContext& job) {
  if (!file.empty()) {
    ObservationSet set = ObservationSet::read(file);
    refusePositionsInAnotherUnit(set, campaign.machine);
    return set;
  }
  if (campaign.observations) return *campaign.observations;
  return evaluateCampaign(campaign, options, job).observations;
}

ObservationSet observationsOf(const Campaign& campaign, const std::filesystem::path& file,
                              const EvaluateOptions& options, JobContext& job, std::vector<std::string>* notes) {
  ObservationSet set = allObservationsOf(campaign, file, options, job);
  set.absolute = campaign.absolute;
  const std::string left_out = leaveOutCompensated(set, campaign.log.get());
  if (const std::string outside = outsideTravel(set, campaign.machine); notes != nullptr && !outside.empty())
    notes->push_back(outside);
  if (notes != nullptr && !left_out.empty()) notes->push_back(left_out);
  return set;
}

}  // namespace spindrift
