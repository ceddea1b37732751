// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/evaluate_campaign.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/base/count_text.h"
#include "core/imaging/evaluate_fiducials.h"
#include "core/imaging/fiducial_captures.h"
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
    for (const std::string& w : instrument.warnings) warnings.push_back(w);
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
    for (const std::string& w : instrument.warnings) text += fmt::format("note: {}\n", w);
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
  for (const InstrumentEvaluation& instrument : evaluation.instruments) {
    evaluation.observations.append(instrument.observations);
    evaluation.good_enough = evaluation.good_enough && instrument.good_enough;
  }
  return evaluation;
}

ObservationSet allObservationsOf(const Campaign& campaign, const std::filesystem::path& file,
                                 const EvaluateOptions& options, JobContext& job) {
  if (!file.empty()) return ObservationSet::read(file);
  if (campaign.observations) return *campaign.observations;
  return evaluateCampaign(campaign, options, job).observations;
}

std::string outsideTravel(const ObservationSet& observations, const MachineDescription& machine) {
  std::set<std::string> outside;
  std::string example;
  for (const Observation& o : observations.rows) {
    for (int i = 0; i < 3; ++i) {
      const LinearAxis* axis = machine.findAxis(std::string(1, "XYZ"[i]));
      if (axis == nullptr) continue;
      const double slack = 0.1 * (axis->travel_mm[1] - axis->travel_mm[0]);
      if (o.position_mm[i] >= axis->travel_mm[0] - slack && o.position_mm[i] <= axis->travel_mm[1] + slack) continue;
      if (outside.insert(o.point).second && example.empty())
        example = fmt::format("{} of point {} is {:g} mm, the travel {:g} to {:g} mm", "xyz"[i], o.point,
                              o.position_mm[i], axis->travel_mm[0], axis->travel_mm[1]);
    }
  }
  if (outside.empty()) return {};
  return fmt::format(
      "{} of {} points lie far outside the travel of this machine ({}): are these its observations, in mm?",
      outside.size(), observations.points().size(), example);
}

ObservationSet observationsOf(const Campaign& campaign, const std::filesystem::path& file,
                              const EvaluateOptions& options, JobContext& job, std::vector<std::string>* notes) {
  ObservationSet set = allObservationsOf(campaign, file, options, job);
  set.absolute = campaign.absolute;
  const std::string left_out = leaveOutCompensated(set, campaign.log);
  if (const std::string outside = outsideTravel(set, campaign.machine); notes != nullptr && !outside.empty())
    notes->push_back(outside);
  if (notes != nullptr && !left_out.empty()) notes->push_back(left_out);
  return set;
}

}  // namespace spindrift
