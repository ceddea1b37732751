// SPDX-License-Identifier: Apache-2.0
// From a scenario to a campaign: run the plant, look at it through instruments and sensors, and write what a real
// machine would have left behind. The truth is kept apart.
#pragma once

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/job_context.h"
#include "core/machine/campaign.h"
#include "core/simulation/scenario.h"
#include "core/simulation/virtual_captures.h"

namespace spindrift {

/// A row of simulation.csv: um or urad.
struct SimulatedRow {
  double time_s = 0.0;
  std::string point;
  Component component = Component::EX;
  double predicted = 0.0;
};

/// One probing: what touches.csv holds.
struct TouchRow {
  double time_s = 0.0;
  std::string cycle;
  std::string feature;
  std::string stylus;
  double c_deg = 0.0;
  int touch = 0;
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d approach = Eigen::Vector3d::Zero();
  Eigen::Vector3d deviation_mm = Eigen::Vector3d::Zero();  ///< of the tip, truth: in no file of the campaign
};

/// What no file of the campaign holds. Signals are noise-free and stand beside the observations, row by row (um, urad).
struct CampaignTruth {
  std::vector<std::string> hidden;  ///< causes that are on and not in the given simulation
  std::vector<std::string> base;    ///< causes in the given simulation
  PlantEffectSettings settings;     ///< of everything that is on, sizes resolved
  std::vector<double> total;
  std::vector<double> hidden_signal;                   ///< of the hidden causes together
  std::vector<double> base_error;                      ///< plant minus given simulation, of the causes that both have
  std::map<std::string, std::vector<double>> signals;  ///< of every cause that is on, hidden or not
  struct Size {
    double rms = 0.0;  ///< over the rows to be fitted, in the main component
    Component component = Component::EX;
  };
  std::map<std::string, Size> sizes;  ///< of every hidden cause

  [[nodiscard]] nlohmann::json json(const std::vector<Observation>& rows) const;
};

/// A campaign in memory. `campaign` has machine, log and observations as if it had been read from a folder.
struct VirtualCampaign {
  Campaign campaign;
  std::vector<SimulatedRow> simulation;  ///< empty if the scenario has none
  std::vector<TouchRow> touches;
  std::string touched_artefact;
  /// Rows of the log in which a sensor dropped out, by signal: empty fields in log.csv (in memory already filled).
  std::map<std::string, std::vector<std::size_t>> dropouts;
  std::shared_ptr<const VirtualCaptures> captures;  ///< images and clouds; null if the scenario has none
  CampaignTruth truth;
  double elapsed_ms = 0.0;
};

/// The machine of a scenario with its programme and its room; runs the heat flow. `seed` replaces that of the scenario.
[[nodiscard]] std::shared_ptr<const VirtualMachine> makeVirtualMachine(const Scenario& scenario,
                                                                       std::optional<std::uint64_t> seed,
                                                                       const JobContext& job);

/// Deterministic: the same scenario and seed give the same campaign. `seed` replaces that of the scenario.
[[nodiscard]] VirtualCampaign simulateCampaign(const Scenario& scenario, std::optional<std::uint64_t> seed,
                                               const JobContext& job);

/// Writes campaign.json, machine.json, log.csv and what there is of observations.csv, simulation.csv and captures/
/// (images and clouds are rendered now). Throws InputError if the folder is there and not empty; Cancelled, and then
/// nothing is left in it.
void writeCampaign(const VirtualCampaign& campaign, const std::filesystem::path& folder, JobContext& job);
void writeCampaign(const VirtualCampaign& campaign, const std::filesystem::path& folder);

/// `truth` as JSON; "captures" lists what images, clouds and touches should lead to: [{"state","point","component",
/// "value"}], um and urad, deviation from the first state (touches: mean over the touches of a feature, `point` as
/// `evaluate` names it).
[[nodiscard]] nlohmann::json truthJson(const VirtualCampaign& campaign);

/// Touches of the scenario's artefact on the plant; sizes of effects as resolved in `settings`.
[[nodiscard]] std::vector<TouchRow> simulateTouches(const VirtualMachine& plant, const TouchOptions& options,
                                                    const PlantEffectSettings& settings, std::uint64_t seed);

}  // namespace spindrift
