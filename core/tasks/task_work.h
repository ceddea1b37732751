// SPDX-License-Identifier: Apache-2.0
// The work behind every task of a campaign: prepared where the session lives, by copying what it needs, and run
// anywhere. Pages, the command line and the report start the same work, so that what is shown, stored and reported is
// one.
#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/machine/campaign.h"
#include "core/machine/nine_parameter_model.h"
#include "core/machine/table_polynomial.h"
#include "core/probing/cycle_studies.h"
#include "core/probing/evaluate_touches.h"
#include "core/probing/probe_health.h"
#include "core/probing/touch_verdict.h"
#include "core/scanning/scan_check.h"
#include "core/scanning/scan_evaluation.h"
#include "core/tasks/campaign_state.h"
#include "core/tasks/report_task.h"
#include "core/tasks/task_graph.h"
#include "core/tasks/task_options.h"
#include "core/workflows/capture_check.h"
#include "core/workflows/compensator_run.h"
#include "core/workflows/discrepancy_story.h"
#include "core/workflows/discrepancy_workflow.h"
#include "core/workflows/instrument_checks.h"
#include "core/workflows/nine_parameter_maps.h"
#include "core/workflows/thermal_tests.h"

namespace spindrift {

/// What a task reads, besides its options. Shared and never altered.
struct TaskInputs {
  std::shared_ptr<const Campaign> campaign;  ///< as at hand, nothing taken out
  ExcludedItems excluded;
  ObservationsToFit observations;
  // Read anew where they are null.
  std::shared_ptr<const TouchList> touches;
  std::shared_ptr<const TimeSeries> series;  ///< campaignSeries of these observations

  [[nodiscard]] static TaskInputs of(const TaskGraph& graph, const CampaignState& state);
};

/// Of touches and of scans, where the campaign has them.
struct EvaluationDetail {
  std::shared_ptr<const TouchEvaluation> touches;
  std::vector<StylusHealth> health;
  RepeatabilityStudy repeatability;
  std::shared_ptr<const ScanEvaluation> scans;          ///< under the scan model of machine.json
  std::shared_ptr<const CampaignEvaluation> evaluated;  ///< what is stored; null where only the rest was asked for
};

struct CheckedCaptures {
  std::vector<CheckedCapture> captures;
};

struct ScanChecks {
  std::vector<ScanCheck> scans;
};

struct AxisErrorResult {
  std::shared_ptr<const ScanEvaluation> scans;
  nlohmann::json details;   ///< what is stored, with
  bool good_enough = true;  ///< false: none of the errors is known, for
  std::string why_not;
};

struct NineParameterResult {
  NineParameterFit fit;
  TableOrderChoice order;
  std::optional<NineParameterComparison> compared;  ///< with the points that were not fitted
  std::string not_compared;                         ///< why that failed; empty: it did not
  std::optional<NineParameterMaps> maps;            ///< only where the detail is asked for
};

struct LogCompensation {
  CompensatorRun run;
  ThermalModel model;
};

/// What a task has given: the payload of its result, and what is shown beside it and not stored, which is of the type
/// that the task is declared with (task_kinds.cpp).
struct TaskResult {
  template <class... Types>
  using OneOf = std::variant<std::monostate, std::shared_ptr<const Types>...>;
  nlohmann::json payload;
  OneOf<CheckedCaptures, TouchEvaluation, ScanChecks, EvaluationDetail, CheckResult, AxisErrorResult,
        NineParameterResult, IdentifyResult, StandardTest, LogCompensation, DiscrepancyStory, DiscrepancyRun,
        CompensationPlan, VerifyResult, WrittenReport>
      detail;
  /// Null if the detail is another, or there is none.
  template <class T>
  [[nodiscard]] std::shared_ptr<const T> as() const {
    const auto* found = std::get_if<std::shared_ptr<const T>>(&detail);
    return found == nullptr ? nullptr : *found;
  }
};

/// The search with the simulator of a campaign, and what comes of it in the simulation. Copies: any thread.
struct SimulationTask {
  std::filesystem::path simulator;  ///< simulator.json
  EffectOptions effects;
  std::filesystem::path effects_file;
  std::shared_ptr<const Campaign> campaign;
  ObservationsToFit observations;

  /// Throws InputError: there is no simulator.
  [[nodiscard]] static SimulationTask of(const TaskGraph& graph, const TaskInputs& inputs);
  /// Runs the programs that simulator.json names. Throws InputError, Cancelled.
  [[nodiscard]] DiscrepancyRun search(JobContext& job) const;
  /// Puts into the simulation what `before` has found, and writes its new version to `folder` where that is better;
  /// null: it is searched first. Throws as `search`, and if the folder is not empty.
  [[nodiscard]] DiscrepancyRun putInto(const std::filesystem::path& folder, const IntoSimulationOptions& options,
                                       const DiscrepancyRun* before, JobContext& job) const;
};

/// Of the graph's campaign as it is now: to be called together with TaskGraph::origin. Throws InputError: the task has
/// no work here, or nothing to work on.
[[nodiscard]] TaskWork prepareTask(const std::string& task, const TaskGraph& graph, const TaskInputs& inputs);

/// The cycles of the first artefact of an evaluation, whatever its kind; null if there are none.
[[nodiscard]] const CycleEvaluation* cyclesOf(const TouchEvaluation* evaluation);
/// The verdicts on the touches of all artefacts.
[[nodiscard]] std::vector<TouchVerdict> allVerdicts(const TouchEvaluation& evaluation);

}  // namespace spindrift
