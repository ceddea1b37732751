// SPDX-License-Identifier: Apache-2.0
// The options of all tasks as types, each with the one way it is kept as JSON (option_fields.h).
//
// What a user chose for a task is kept in the session under "<key>/<campaign>": pages and the command line edit it
// (with undo). What a result was made with is put down beside it: that, and what of other tasks it depends on. The task
// graph compares the latter with what the task would be run with now.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/imaging/warm_up.h"
#include "core/machine/campaign.h"
#include "core/machine/nine_parameter_model.h"
#include "core/probing/hole_cycle.h"
#include "core/session/session.h"
#include "core/tasks/option_fields.h"
#include "core/workflows/compensation_workflow.h"
#include "core/workflows/thermal_tests.h"
#include "core/workflows/thermal_workflow.h"
#include "core/workflows/verify_compensation.h"

namespace spindrift {

/// What is kept for one campaign alone. Sessions of earlier versions kept some of it for all campaigns together: that
/// stands where a campaign has nothing of its own.
[[nodiscard]] std::string campaignKey(const std::string& key, std::int64_t campaign);
[[nodiscard]] nlohmann::json campaignSetting(const Session& session, std::int64_t campaign, const std::string& key,
                                             const nlohmann::json& otherwise);

/// Keys of what a session keeps for its campaigns.
namespace option_keys {
inline constexpr auto nine_parameters = "nine-parameter";
inline constexpr auto cycles = "cycle-model";
inline constexpr auto scan_model = "scan-model";
inline constexpr auto thermal = "thermal-model";
inline constexpr auto over_time = "model-over-time";
inline constexpr auto iso230 = "iso-230-3";
inline constexpr auto discrepancy = "discrepancy";
inline constexpr auto compensation = "compensation";
inline constexpr auto verify = "verify";
inline constexpr auto report = "report-options";
inline constexpr auto plan = "plan";
inline constexpr auto warm_statement = "warm-statement";
inline constexpr auto reviewed = "reviewed";  ///< what there was when the comparison was last looked at
inline constexpr auto simulator = "discrepancy/simulator";
inline constexpr auto connections = "connections";  ///< connections.json of the campaign
inline constexpr auto operator_name = "operator";   ///< sessions of earlier versions: one for all campaigns
}  // namespace option_keys

constexpr RobustLoss lastOf(RobustLoss /*unused*/) noexcept {
  return RobustLoss::Tukey;
}
constexpr FanucStep lastOf(FanucStep /*unused*/) noexcept {
  return FanucStep::Negative;
}
constexpr CompensationSource lastOf(CompensationSource /*unused*/) noexcept {
  return CompensationSource::HigherOrder;
}

// What users choose. `key` is where a session keeps it.

/// Of the model of one thermal state.
struct NineParameterChoice {
  static constexpr auto key = option_keys::nine_parameters;
  std::string state;                ///< empty: the last
  std::vector<std::string> points;  ///< empty: all
  RobustLoss robust = RobustLoss::None;

  [[nodiscard]] NineParameterOptions options() const;
  template <class Options, class Visitor>
  static void fields(Options& o, const Visitor& visit) {
    visit("state", o.state);
    visit("points", o.points);
    visit("robust", o.robust);
  }
};

/// Of the model of every cycle of a hole bar.
struct CycleChoice {
  static constexpr auto key = option_keys::cycles;
  bool second_axis = false;
  double growth_um_per_m = 0.0;  ///< of the bar, and
  double trust_um_per_m = 0.1;   ///< its standard uncertainty

  [[nodiscard]] HoleCycleOptions options() const;
  template <class Options, class Visitor>
  static void fields(Options& o, const Visitor& visit) {
    visit("second_axis", o.second_axis);
    visit("growth_um_per_m", o.growth_um_per_m);
    visit("trust_um_per_m", o.trust_um_per_m);
  }
};

/// Of the six errors of an axis; kept as a bare text.
struct ScanModelChoice {
  static constexpr auto key = option_keys::scan_model;
  std::string model;  ///< empty: that of machine.json
};
template <>
[[nodiscard]] nlohmann::json optionsJson(const ScanModelChoice& options);
template <>
[[nodiscard]] ScanModelChoice optionsFrom<ScanModelChoice>(const nlohmann::json& json);

/// Of the model over time.
struct ThermalChoice {
  static constexpr auto key = option_keys::thermal;
  std::string output;                    ///< empty: the first of the log
  std::optional<TimeRange> train, test;  ///< else the first and the second half of the log
  std::string method = "response";
  std::vector<std::string> inputs;  ///< empty: automatic

  /// With what was not chosen as the series has it.
  [[nodiscard]] IdentifyRequest request(const TimeSeries& series) const;
  template <class Options, class Visitor>
  static void fields(Options& o, const Visitor& visit) {
    visit("output", o.output);
    visit("train", o.train);
    visit("test", o.test);
    visit("method", o.method);
    visit("inputs", o.inputs);
  }
};

/// Of the thermal test of ISO 230-3 in a log.
struct Iso230Choice {
  static constexpr auto key = option_keys::iso230;
  std::string test;                    ///< "etve" or "spindle"; empty: the one that the log is a record of
  std::optional<std::string> ambient;  ///< column; empty text: none; not there: that of the room
  std::string speed;                   ///< column; empty: that of the spindle
  std::string range;                   ///< "FROM:TO" in s as typed; empty: the whole record

  /// Throws InputError for a range that cannot be read. The test may be empty: the log is a record of none.
  [[nodiscard]] Iso230Request request(const TimeSeries& series) const;
  /// Whether a report of the campaign tells this test: of displacements in its log, or chosen by hand.
  [[nodiscard]] bool told(const Campaign& campaign) const;
  bool operator==(const Iso230Choice&) const = default;
  template <class Options, class Visitor>
  static void fields(Options& o, const Visitor& visit) {
    visit("test", o.test);
    visit("ambient", o.ambient);
    visit("speed", o.speed);
    visit("range", o.range);
  }
};

struct CompensationChoice {
  static constexpr auto key = option_keys::compensation;
  std::optional<CompensationSource> source;  ///< else the completed model where there is one
  std::string state;                         ///< empty: that of the fit, else the warmest
  int positions = 11;                        ///< along each axis
  std::optional<Eigen::Vector3d> reference_mm;
  std::optional<FanucStep> fanuc;  ///< direction of a positive value, as tried on the control

  template <class Options, class Visitor>
  static void fields(Options& o, const Visitor& visit) {
    visit("source", o.source);
    visit("state", o.state);
    visit("positions", o.positions);
    visit("reference_mm", o.reference_mm);
    visit("fanuc", o.fanuc);
  }
};

struct VerifyOptions {
  static constexpr auto key = option_keys::verify;
  VerifyRequest request;
  std::string after;  ///< folder of the second campaign, as `placeName` calls it; empty: not chosen

  template <class Options, class Visitor>
  static void fields(Options& o, const Visitor& visit) {
    visit("goal_um", o.request.goal_um);
    visit("goal_urad", o.request.goal_urad);
    visit("criterion", o.request.criterion, std::array<std::string_view, 2>{"largest", "rms"});
    visit("after", o.after);
  }
};

struct ReportChoice {
  static constexpr auto key = option_keys::report;
  bool tells_discrepancy = true;

  template <class Options, class Visitor>
  static void fields(Options& o, const Visitor& visit) {
    visit("tells_discrepancy", o.tells_discrepancy);
  }
};

/// Effects that the user put into the model, left out, or edited.
struct EffectOptions {
  static constexpr auto key = option_keys::discrepancy;
  std::vector<std::string> added;
  std::vector<std::string> rejected;
  nlohmann::json effects;  ///< effects.json as edited; null: as campaign.json names it

  template <class Options, class Visitor>
  static void fields(Options& o, const Visitor& visit) {
    visit("added", o.added);
    visit("rejected", o.rejected);
    visit("effects", o.effects);
  }
  [[nodiscard]] bool considers(const std::string& id) const;
  /// Takes an effect out of both lists, or puts it among the rejected.
  void consider(const std::string& id, bool considered);
  /// The file in the session's folder after which those are named that hold the effects as edited.
  [[nodiscard]] static std::filesystem::path file(const Session& session, std::int64_t campaign);
  /// The campaign with the effects as edited; the campaign itself if none were. They are put down beside `file` under
  /// the name of their content for as long as the campaign that is returned is held: work that was begun with other
  /// effects goes on with those. Results carry the effects among their options, none refers to such a file. Any thread.
  /// Throws InputError if they cannot be written.
  [[nodiscard]] std::shared_ptr<const Campaign> applied(std::shared_ptr<const Campaign> campaign,
                                                        const std::filesystem::path& file) const;
};

/// What a session keeps of these for a campaign.
template <class Choice>
[[nodiscard]] Choice chosen(const Session& session, std::int64_t campaign) {
  return optionsFrom<Choice>(campaignSetting(session, campaign, Choice::key, nlohmann::json()));
}

// What results are made with.

struct NoOptions {
  template <class Options, class Visitor>
  static void fields(Options& /*o*/, const Visitor& /*visit*/) {}
};

/// Of a model whose choice is kept beside its name.
template <class Choice>
struct ModelOptions {
  std::string model;
  Choice choice;

  template <class Options, class Visitor>
  static void fields(Options& o, const Visitor& visit) {
    visit("model", o.model);
    visit("options", o.choice);
  }
};

struct AxisErrorOptions {
  std::string model;
  std::string scan_model;  ///< as ScanModelChoice

  template <class Options, class Visitor>
  static void fields(Options& o, const Visitor& visit) {
    visit("model", o.model);
    visit("scan_model", o.scan_model);
  }
};

/// Of the check whether the instrument had settled.
struct WarmUpCheckOptions {
  double drift_limit_um_per_h = WarmUpOptions().drift_limit_um_per_h;

  template <class Options, class Visitor>
  static void fields(Options& o, const Visitor& visit) {
    visit("drift_limit_um_per_h", o.drift_limit_um_per_h);
  }
};

/// Of a check of the instrument.
struct InstrumentCheckOptions {
  double part = 1.0;  ///< largest difference that is allowed, of the resolution of the axis

  template <class Options, class Visitor>
  static void fields(Options& o, const Visitor& visit) {
    visit("part", o.part);
  }
};

struct DiscrepancyTaskOptions {
  EffectOptions effects;

  template <class Options, class Visitor>
  static void fields(Options& o, const Visitor& visit) {
    visit("discrepancy", o.effects);
  }
};

/// Of a search with a simulator.
struct SimulationOptions {
  /// The effects: those added stay out, the simulator is to make them unnecessary.
  struct Choice {
    std::vector<std::string> rejected;
    nlohmann::json effects;

    template <class Options, class Visitor>
    static void fields(Options& o, const Visitor& visit) {
      visit("rejected", o.rejected);
      visit("effects", o.effects);
    }
  };
  /// As `placeName` calls it: chosen or written last, else named by campaign.json; or empty.
  std::string simulator;
  std::string version;  ///< the name of the new version that was written; empty: none
  std::string written;  ///< what that was (simulatorFingerprint)
  Choice choice;

  [[nodiscard]] static SimulationOptions of(const Session& session, std::int64_t campaign, const Campaign& data);
  template <class Options, class Visitor>
  static void fields(Options& o, const Visitor& visit) {
    visit("simulator", o.simulator);
    visit("version", o.version);
    visit("written", o.written);
    visit("choice", o.choice);
  }
};
/// What the session calls a file or folder: relative to its own folder, if it lies there, so that it may be moved.
[[nodiscard]] std::string placeName(const Session& session, const std::filesystem::path& file);
[[nodiscard]] std::filesystem::path placeNamed(const Session& session, const std::string& name);
/// SHA-256 of a simulator.json; empty where it cannot be read.
[[nodiscard]] std::string simulatorFingerprint(const std::filesystem::path& file);

struct CompensationTaskOptions {
  CompensationChoice choice;
  CompensationSource source = CompensationSource::NineParameters;  ///< the one that is used
  NineParameterChoice fit;
  EffectOptions effects;

  /// `fitted` says whether there is a fit to compensate with.
  [[nodiscard]] static CompensationTaskOptions of(const Session& session, std::int64_t campaign, bool fitted);
  [[nodiscard]] CompensationRequest request() const;
  template <class Options, class Visitor>
  static void fields(Options& o, const Visitor& visit) {
    visit("options", o.choice);
    visit("source", o.source,
          std::array{toString(CompensationSource::NineParameters), toString(CompensationSource::CompletedModel),
                     toString(CompensationSource::HigherOrder)});
    visit("fit", o.fit);
    visit("discrepancy", o.effects);
  }
};

struct VerifyTaskOptions {
  VerifyOptions options;

  template <class Options, class Visitor>
  static void fields(Options& o, const Visitor& visit) {
    visit("options", o.options);
  }
};

struct ReportTaskOptions {
  std::string operator_name;
  bool tells_discrepancy = true;
  std::vector<std::string> notes;  ///< as the report tells them
  EffectOptions effects;
  NineParameterChoice fit;
  nlohmann::json warm;                   ///< the operator's word that the instrument was warm; null: not given
  std::optional<std::string> simulator;  ///< the one that was chosen
  Iso230Choice iso230;

  [[nodiscard]] static ReportTaskOptions of(const Session& session, std::int64_t campaign);
  template <class Options, class Visitor>
  static void fields(Options& o, const Visitor& visit) {
    visit("operator", o.operator_name);
    visit("tells_discrepancy", o.tells_discrepancy);
    visit("notes", o.notes);
    visit("discrepancy", o.effects);
    visit("fit", o.fit);
    visit("warm", o.warm);
    visit("simulator", o.simulator);
    visit("iso230", o.iso230);
  }
};

}  // namespace spindrift
