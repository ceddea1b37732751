// SPDX-License-Identifier: Apache-2.0
// The options of every task, as the session keeps them for a campaign: what a task would be run with now. Pages edit
// them (with undo), the task graph compares them with those a result was made with.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/machine/campaign.h"
#include "core/machine/nine_parameter_model.h"
#include "core/probing/hole_cycle.h"
#include "core/session/session.h"
#include "core/workflows/compensation_workflow.h"
#include "core/workflows/thermal_workflow.h"
#include "core/workflows/verify_compensation.h"

namespace spindrift {

/// What is kept for one campaign alone. Sessions of earlier versions kept some of it for all campaigns together: that
/// stands where a campaign has nothing of its own.
[[nodiscard]] std::string campaignKey(const std::string& key, std::int64_t campaign);
[[nodiscard]] nlohmann::json campaignSetting(const Session& session, std::int64_t campaign, const std::string& key,
                                             const nlohmann::json& otherwise);

/// Keys of the options of the tasks.
namespace option_keys {
inline constexpr auto nine_parameters = "nine-parameter";
inline constexpr auto cycles = "cycle-model";
inline constexpr auto scan_model = "scan-model";
inline constexpr auto thermal = "thermal-model";
inline constexpr auto over_time = "model-over-time";
inline constexpr auto discrepancy = "discrepancy";
inline constexpr auto compensation = "compensation";
inline constexpr auto verify = "verify";
inline constexpr auto report = "report-options";
inline constexpr auto plan = "plan";
inline constexpr auto warm_statement = "warm-statement";
inline constexpr auto simulator = "discrepancy/simulator";
inline constexpr auto connections = "connections";  ///< connections.json of the campaign
inline constexpr auto operator_name = "operator";   ///< sessions of earlier versions: one for all campaigns
}  // namespace option_keys

/// Effects that the user put into the model, left out, or edited.
struct EffectOptions {
  std::vector<std::string> added;
  std::vector<std::string> rejected;
  nlohmann::json effects;  ///< effects.json as edited; null: as campaign.json names it
  [[nodiscard]] static EffectOptions of(const Session& session, std::int64_t campaign);
  [[nodiscard]] nlohmann::json json() const;
  [[nodiscard]] bool considers(const std::string& id) const;
  /// Takes an effect out of both lists, or puts it among the rejected.
  void consider(const std::string& id, bool considered);
  /// The file in the session's folder that holds the effects as edited.
  [[nodiscard]] static std::filesystem::path file(const Session& session, std::int64_t campaign);
  /// The campaign with the effects as edited, which are put down in `file`; the campaign itself if none were. Any
  /// thread. Throws InputError if they cannot be written.
  [[nodiscard]] std::shared_ptr<const Campaign> applied(std::shared_ptr<const Campaign> campaign,
                                                        const std::filesystem::path& file) const;
};

/// The simulator that is searched with. Its results are kept with "version" beside, the name of the new version that
/// was written (empty: none), and "written", what that was; whoever puts something into the simulation adds both.
struct SimulationOptions {
  std::string
      simulator;  ///< as `simulatorName` calls it: chosen or written last, else named by campaign.json; or empty
  EffectOptions effects;  ///< those added stay out: the simulator is to make them unnecessary
  [[nodiscard]] static SimulationOptions of(const Session& session, std::int64_t campaign, const Campaign& data);
  [[nodiscard]] nlohmann::json json() const;
};
/// What the session calls a simulator.json: relative to its folder, if it lies there.
[[nodiscard]] std::string simulatorName(const Session& session, const std::filesystem::path& file);
[[nodiscard]] std::filesystem::path simulatorFile(const Session& session, const std::string& name);
/// SHA-256 of a simulator.json; empty where it cannot be read.
[[nodiscard]] std::string simulatorFingerprint(const std::filesystem::path& file);

/// Largest difference that a check of the instrument allows, as a part of the resolution of the axis: 1 for
/// "check-jogs", 0.5 for "check-repeatability".
[[nodiscard]] double allowedPart(const std::string& check);

/// Of the model of one thermal state.
[[nodiscard]] NineParameterOptions nineParameterOptions(const nlohmann::json& json);

/// Of the model of every cycle of a hole bar.
[[nodiscard]] HoleCycleOptions cycleOptions(const nlohmann::json& json);
/// Of the model over time: what was not chosen is chosen by the series (first output, first and second half).
[[nodiscard]] IdentifyRequest identifyRequest(const nlohmann::json& json, const TimeSeries& series);

/// What is asked of the compensation; `fitted` says whether there is a fit to compensate with.
[[nodiscard]] CompensationRequest compensationRequest(const Session& session, std::int64_t campaign, bool fitted);

struct VerifyOptions {
  VerifyRequest request;
  std::string after;  ///< folder of the second campaign; empty: not chosen
  [[nodiscard]] static VerifyOptions of(const Session& session, std::int64_t campaign);
  [[nodiscard]] nlohmann::json json() const;
};

struct ReportTaskOptions {
  std::string operator_name;
  bool tells_discrepancy = true;
  std::vector<std::string> notes;  ///< as the report tells them
  [[nodiscard]] static ReportTaskOptions of(const Session& session, std::int64_t campaign);
};

}  // namespace spindrift
