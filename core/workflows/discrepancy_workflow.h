// SPDX-License-Identifier: Apache-2.0
// The user action "find what the simulation lacks": campaign folder in, result and files out. Units as in FORMATS.md.
#pragma once

#include <filesystem>

#include "core/base/job_context.h"
#include "core/discrepancy/discrepancy.h"
#include "core/discrepancy/into_simulation.h"
#include "core/discrepancy/own_effects.h"

namespace spindrift {

struct DiscrepancyRequest {
  std::filesystem::path campaign;
  std::filesystem::path observations;  ///< empty: the campaign's own, else its captures evaluated in memory
  std::filesystem::path effects;       ///< effects of the user's; empty: those that campaign.json names
  DiscrepancyOptions options;
  std::filesystem::path model_out;   ///< empty: not written
  std::filesystem::path prediction;  ///< time_s,point,component,predicted of the completed model
  std::filesystem::path html;
  std::filesystem::path simulator;        ///< simulator.json that is run; empty: none, or the campaign's if needed
  std::filesystem::path into_simulation;  ///< folder of the simulator's new version; empty: nothing is put in
  std::vector<std::string> mechanisms;    ///< parameters to put in; empty: those behind what is named
};

struct DiscrepancyRun {
  DiscrepancyInput input;
  DiscrepancyResult result;
  std::vector<std::string> notes;          ///< what was left out and why
  std::vector<std::string> mechanisms;     ///< parameters of the simulator that are behind what was named
  std::optional<SimulationUpdate> update;  ///< what was put into the simulation

  /// The JSON of FORMATS.md; `gap` also holds peak-to-peak and fit, as the report has them.
  [[nodiscard]] nlohmann::json json() const;
};

/// The search on a campaign in memory, with the observations given in place of its own.
[[nodiscard]] DiscrepancyRun searchDiscrepancy(const Campaign& campaign, ObservationSet observations,
                                               const DiscrepancyOptions& options, JobContext& job);
/// The same with the parameters of a simulator among the hypotheses, which is run for it.
[[nodiscard]] DiscrepancyRun searchDiscrepancy(const Campaign& campaign, ObservationSet observations,
                                               const DiscrepancyOptions& options, const Simulator& simulator,
                                               JobContext& job);
/// Puts what was found into the simulation and, where that improves it, writes the simulator's new version to `folder`
/// with its prediction as simulation.csv. Throws InputError if the folder is not empty.
[[nodiscard]] SimulationUpdate updateSimulation(const Campaign& campaign, const DiscrepancyRun& run,
                                                const Simulator& simulator, const IntoSimulationOptions& options,
                                                const std::filesystem::path& folder, JobContext& job);

/// The catalogue as a whole, or with a campaign as its machine and log have it; and the user's own effects.
struct EffectsRequest {
  std::filesystem::path campaign;  ///< empty: no machine in particular
  std::filesystem::path effects;   ///< effects.json; empty: those that campaign.json names
};
struct EffectsAnswer {
  std::vector<Effect> effects;
  std::shared_ptr<const OwnEffects> own;  ///< may be null
  std::vector<std::string> warnings;
  [[nodiscard]] nlohmann::json json() const;
  [[nodiscard]] std::string summary() const;
};
/// Throws InputError, as for a search: expressions are evaluated at the campaign's observations, if it has any.
[[nodiscard]] EffectsAnswer listEffects(const EffectsRequest& request);
/// The same for a campaign in memory: with `own_effects` (may be null) in place of the effects that it names, checked
/// at the observations given (may be null) in place of its own.
[[nodiscard]] EffectsAnswer listEffects(const Campaign& campaign, const ObservationSet* observations,
                                        std::shared_ptr<const OwnEffects> own_effects);

/// Throws InputError; nothing is written then. The campaign folder is never written to.
[[nodiscard]] DiscrepancyRun runDiscrepancy(const DiscrepancyRequest& request, JobContext& job);

}  // namespace spindrift
