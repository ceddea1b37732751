// SPDX-License-Identifier: Apache-2.0
#include "core/tasks/task_work.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string_view>
#include <utility>

#include "core/base/error.h"
#include "core/base/json_reader.h"
#include "core/scanning/evaluate_scans.h"
#include "core/scanning/scan_check.h"
#include "core/tasks/report_task.h"
#include "core/tasks/scan_check_payload.h"
#include "core/tasks/task_options.h"
#include "core/workflows/campaign_series.h"
#include "core/workflows/capture_check.h"
#include "core/workflows/compensation_workflow.h"
#include "core/workflows/discrepancy_story.h"
#include "core/workflows/evaluate_campaign.h"
#include "core/workflows/fit_campaign.h"
#include "core/workflows/instrument_checks.h"
#include "core/workflows/open_simulator.h"
#include "core/workflows/simulation_story.h"
#include "core/workflows/thermal_workflow.h"
#include "core/workflows/verify_compensation.h"

namespace spindrift {
namespace {

template <class T>
std::any shared(T value) {
  return std::shared_ptr<const T>(std::make_shared<const T>(std::move(value)));
}

/// Two parts of the work, each wanted or not.
std::pair<JobContext, JobContext> parts(const JobContext& job, TaskOutput output) {
  const double middle = output == TaskOutput::Both ? 0.5 : output == TaskOutput::Payload ? 1.0 : 0.0;
  return {job.part(0.0, middle), job.part(middle, 1.0)};
}

TouchList touchesOf(const Campaign& campaign, const std::shared_ptr<const TouchList>& read) {
  if (read != nullptr) return *read;
  const auto list = campaign.captureList("touches.csv");
  if (!list) throw InputError({campaign.folder.string(), ""}, "lists no touches.");
  return TouchList::read(*list);
}

/// As the session keeps them and steps.cpp counts them.
std::string_view keptName(TouchState state) {
  constexpr std::array names{"plausible", "rejected", "excluded", "missing"};
  return names[static_cast<std::size_t>(state)];
}

TaskWork checkWork(const TaskGraph& graph, const TaskInputs& in) {
  const auto campaign = withoutExcluded(*in.campaign, in.excluded);
  if (graph.facts().images) {
    return [campaign](JobContext& job, TaskOutput) -> TaskResult {
      nlohmann::json captures = nlohmann::json::array();
      for (const CheckedCapture& c : checkFiducialCaptures(*campaign, job)) captures.push_back(c.json());
      return {{{"captures", captures}}, {}};
    };
  }
  if (graph.facts().touches) {
    return [campaign, list = in.touches](JobContext& job, TaskOutput) -> TaskResult {
      TouchEvaluation evaluation = evaluateTouchList(*campaign, touchesOf(*campaign, list), {}, {}, job);
      nlohmann::json counts = nlohmann::json::object();
      for (const TouchVerdict& v : allVerdicts(evaluation)) {
        const std::string name(keptName(v.state));
        counts[name] = counts.value(name, 0) + 1;
      }
      return {{{"touches", counts}}, shared(std::move(evaluation))};
    };
  }
  return [campaign](JobContext& job, TaskOutput) -> TaskResult {
    return {payloadOfScanChecks(checkScans(*campaign, job)), {}};
  };
}

EvaluationDetail detailOf(const Campaign& campaign, const CampaignFacts& facts,
                          const std::shared_ptr<const TouchList>& list, JobContext& job) {
  EvaluationDetail detail;
  JobContext first = job.part(0.0, facts.scans ? 0.5 : 1.0);
  JobContext second = job.part(facts.touches ? 0.5 : 0.0, 1.0);
  if (facts.touches) {
    auto touches =
        std::make_shared<TouchEvaluation>(evaluateTouchList(campaign, touchesOf(campaign, list), {}, {}, first));
    // Only spheres qualify a probe; a hole bar says nothing about it.
    if (!touches->ball_cycles.empty()) detail.health = checkProbeHealth(touches->touches, campaign.machine);
    if (const CycleEvaluation* cycles = cyclesOf(touches.get())) detail.repeatability = studyRepeatability(*cycles);
    detail.touches = std::move(touches);
  }
  if (facts.scans) detail.scans = std::make_shared<const ScanEvaluation>(evaluateScanCampaign(campaign, "", second));
  return detail;
}

TaskWork evaluateWork(const TaskGraph& graph, const TaskInputs& in) {
  return [campaign = withoutExcluded(*in.campaign, in.excluded), facts = graph.facts(), list = in.touches](
             JobContext& job, TaskOutput output) -> TaskResult {
    auto [first, second] = parts(job, output);
    TaskResult result;
    if (output != TaskOutput::Detail) result.payload = payloadOf(evaluateCampaign(*campaign, {}, first));
    if (output != TaskOutput::Payload) result.detail = shared(detailOf(*campaign, facts, list, second));
    return result;
  };
}

TaskWork cyclesWork(const TaskGraph& graph, const TaskInputs& in) {
  const nlohmann::json kept =
      campaignSetting(graph.session(), graph.campaign(), option_keys::cycles, nlohmann::json::object());
  return [campaign = withoutExcluded(*in.campaign, in.excluded), list = in.touches, options = cycleOptions(kept)](
             JobContext& job, TaskOutput) -> TaskResult {
    TouchEvaluation evaluation = evaluateTouchList(*campaign, touchesOf(*campaign, list), options, {}, job);
    const CycleEvaluation* cycles = cyclesOf(&evaluation);
    if (cycles == nullptr) throw InputError("The touches make up no whole cycle.");
    nlohmann::json payload = cyclesJson(*cycles);
    return {std::move(payload), shared(std::move(evaluation))};
  };
}

TaskWork axisErrorsWork(const TaskGraph& graph, const TaskInputs& in) {
  const nlohmann::json kept =
      campaignSetting(graph.session(), graph.campaign(), option_keys::scan_model, nlohmann::json());
  return [campaign = withoutExcluded(*in.campaign, in.excluded),
          model = kept.is_string() ? kept.get<std::string>() : std::string()](JobContext& job,
                                                                              TaskOutput output) -> TaskResult {
    auto [first, second] = parts(job, output);
    TaskResult result;
    if (output != TaskOutput::Detail) result.payload = evaluateScans(*campaign, model, first).details;
    if (output != TaskOutput::Payload) result.detail = shared(evaluateScanCampaign(*campaign, model, second));
    return result;
  };
}

TaskWork nineParameterWork(const TaskGraph& graph, const TaskInputs& in) {
  const NineParameterOptions options = nineParameterOptions(
      campaignSetting(graph.session(), graph.campaign(), option_keys::nine_parameters, nlohmann::json::object()));
  return [observations = in.observations, options](JobContext&, TaskOutput output) -> TaskResult {
    NineParameterResult result;
    result.fit = fitNineParameters(*observations, options);
    result.order = chooseTableOrder(result.fit);
    try {
      if (output != TaskOutput::Payload) result.compared = compareWithOthers(*observations, result.fit, options);
    } catch (const InputError& e) {
      result.not_compared = e.what();
    }
    const NineParameterFit& fit = result.fit;
    nlohmann::json parameters = nlohmann::json::object();
    for (int i = 0; i < nine_parameter_count; ++i) {
      parameters[std::string(nine_parameter_names[static_cast<std::size_t>(i)])] = {
          {"value", jsonNumber(fit.determined(i) ? fit.parameters[i] : std::nan(""))},
          {"standard_uncertainty", jsonNumber(fit.standardUncertainty(i))}};
    }
    const nlohmann::json full = toJson(fit);
    nlohmann::json payload{{"parameters", parameters},
                           {"state", fit.state},
                           {"status", std::string(toString(fit.status))},
                           {"message", fit.message},
                           {"parameter_order", full.at("parameter_order")},
                           {"covariance", full.at("covariance")},
                           {"higher_order", result.order.json()}};
    return {std::move(payload), shared(std::move(result))};
  };
}

TaskWork thermalWork(const TaskGraph& graph, const TaskInputs& in) {
  const nlohmann::json kept =
      campaignSetting(graph.session(), graph.campaign(), option_keys::thermal, nlohmann::json::object());
  return [campaign = withoutExcluded(*in.campaign, in.excluded), observations = in.observations, read = in.series,
          kept](JobContext& job, TaskOutput) -> TaskResult {
    JobContext reading = job.part(0.0, read != nullptr ? 0.0 : 0.2);
    JobContext identifying = job.part(read != nullptr ? 0.0 : 0.2, 1.0);
    const TimeSeries series = read != nullptr ? *read : campaignSeries(*campaign, observations.get(), reading).series;
    if (series.time_s.size() < 2) throw InputError("the log has a single row.");
    IdentifyResult result = identifyThermalModel(series, identifyRequest(kept, series), identifying);
    nlohmann::json payload = result.json();
    return {std::move(payload), shared(std::move(result))};
  };
}

TaskWork logCompensationWork(const TaskGraph& graph, const TaskInputs& in) {
  const StoredResult* model = graph.latest("thermal");
  if (model == nullptr) throw InputError("Identify a model over time first (Model).");
  return [campaign = withoutExcluded(*in.campaign, in.excluded), observations = in.observations,
          stored = model->payload.at("model"),
          options = model->provenance.options](JobContext& job, TaskOutput) -> TaskResult {
    const TimeSeries series = campaignSeries(*campaign, observations.get(), job).series;
    LogCompensation result;
    result.model = ThermalModel::parse(JsonNode::parse(stored.dump(), "model"));
    result.run = runCompensator(series, result.model, judgedRange(options, series), job);
    nlohmann::json payload = result.run.result.json();
    return {std::move(payload), shared(std::move(result))};
  };
}

TaskWork discrepancyWork(const TaskGraph& graph, const TaskInputs& in) {
  const EffectOptions effects = EffectOptions::of(graph.session(), graph.campaign());
  return [campaign = withoutExcluded(*in.campaign, in.excluded), observations = in.observations, effects,
          file = EffectOptions::file(graph.session(), graph.campaign())](JobContext& job, TaskOutput) -> TaskResult {
    DiscrepancyOptions options;
    options.accept = effects.added;
    options.reject = effects.rejected;
    return {tellDiscrepancy(*effects.applied(campaign, file), *observations, options, job).json(), {}};
  };
}

template <CheckResult (*check)(const ObservationSet&, const MachineDescription&)>
TaskWork instrumentCheckWork(const TaskGraph& /*graph*/, const TaskInputs& in) {
  return [campaign = in.campaign, observations = in.observations](JobContext&, TaskOutput) -> TaskResult {
    return {check(*observations, campaign->machine).json, {}};
  };
}

TaskWork simulationWork(const TaskGraph& graph, const TaskInputs& in) {
  return [task = SimulationTask::of(graph, in)](JobContext& job, TaskOutput) -> TaskResult {
    DiscrepancyRun run = task.search(job);
    nlohmann::json payload = SimulationStory::of(run).json();
    return {std::move(payload), shared(std::move(run))};
  };
}

TaskWork compensationWork(const TaskGraph& graph, const TaskInputs& in) {
  return [campaign = withoutExcluded(*in.campaign, in.excluded), observations = in.observations,
          effects = EffectOptions::of(graph.session(), graph.campaign()),
          file = EffectOptions::file(graph.session(), graph.campaign()),
          request = compensationRequest(graph.session(), graph.campaign(), graph.latest("fit") != nullptr)](
             JobContext& job, TaskOutput) -> TaskResult {
    CompensationPlan plan = planCompensation(*effects.applied(campaign, file), *observations, request, job);
    nlohmann::json payload = plan.json();
    return {std::move(payload), shared(std::move(plan))};
  };
}

TaskWork verifyWork(const TaskGraph& graph, const TaskInputs& in) {
  const VerifyOptions options = VerifyOptions::of(graph.session(), graph.campaign());
  if (options.after.empty()) throw InputError("Choose the campaign that was measured with the compensation on first.");
  return [campaign = withoutExcluded(*in.campaign, in.excluded), before = in.observations, options](
             JobContext& job, TaskOutput) -> TaskResult {
    // One campaign may hold both: then what was taken while compensating must not be left out of the second set.
    const Campaign second =
        std::filesystem::path(options.after) == campaign->folder ? *campaign : Campaign::read(options.after);
    const ObservationSet after = allObservationsOf(second, {}, {}, job);
    VerifyResult result = verifyCampaigns(*campaign, *before, second, after, options.request);
    nlohmann::json payload = result.json();
    return {std::move(payload), shared(std::move(result))};
  };
}

using Prepare = TaskWork (*)(const TaskGraph&, const TaskInputs&);

TaskWork fitWork(const TaskGraph& graph, const TaskInputs& in) {
  if (graph.facts().touches) return cyclesWork(graph, in);
  return graph.facts().scans ? axisErrorsWork(graph, in) : nineParameterWork(graph, in);
}

TaskWork reportWork(const TaskGraph& graph, const TaskInputs& in) {
  return [task = ReportTask::of(graph, in.excluded)](JobContext& job, TaskOutput) -> TaskResult {
    return {task.run(job), {}};
  };
}

/// One for each of taskKinds().
constexpr std::array<std::pair<std::string_view, Prepare>, 12> works{
    {{"check", checkWork},
     {"evaluate", evaluateWork},
     {"check-jogs", instrumentCheckWork<checkJogs>},
     {"check-repeatability", instrumentCheckWork<checkRepeatability>},
     {"fit", fitWork},
     {"thermal", thermalWork},
     {"log-compensation", logCompensationWork},
     {"discrepancy", discrepancyWork},
     {"simulation", simulationWork},
     {"compensation", compensationWork},
     {"verify", verifyWork},
     {"report", reportWork}}};

}  // namespace

TaskInputs TaskInputs::of(const Session& session, const CampaignState& state) {
  TaskInputs inputs;
  inputs.campaign = state.campaign;
  inputs.excluded = state.excluded;
  if (auto set =
          observationsToFit(*state.campaign, state.evaluation.get(), state.excluded, clockOffsetsOf(session, state.id)))
    inputs.observations = std::make_shared<const ObservationSet>(std::move(*set));
  return inputs;
}

SimulationTask SimulationTask::of(const TaskGraph& graph, const TaskInputs& inputs) {
  const SimulationOptions options = SimulationOptions::of(graph.session(), graph.campaign(), graph.data());
  if (options.simulator.empty()) throw InputError(graph.status("simulation").reason);
  return {simulatorFile(graph.session(), options.simulator), options.effects,
          EffectOptions::file(graph.session(), graph.campaign()), withoutExcluded(*inputs.campaign, inputs.excluded),
          inputs.observations};
}

DiscrepancyRun SimulationTask::search(JobContext& job) const {
  const auto with = effects.applied(campaign, effects_file);
  DiscrepancyOptions options;
  options.reject = effects.rejected;
  return searchDiscrepancy(*with, *observations, options, *openSimulator(simulator, *with, *observations), job);
}

DiscrepancyRun SimulationTask::putInto(const std::filesystem::path& folder, const IntoSimulationOptions& options,
                                       const DiscrepancyRun* before, JobContext& job) const {
  // Answers of the simulator are kept: a search of an earlier session is made again quickly.
  JobContext searching = job.part(0.0, 0.4);
  DiscrepancyRun run = before != nullptr ? *before : search(searching);
  JobContext fitting = job.part(before != nullptr ? 0.0 : 0.4, 1.0);
  const auto with = effects.applied(campaign, effects_file);
  run.update = updateSimulation(*with, run, *openSimulator(simulator, *with, *observations), options, folder, fitting);
  return run;
}

TaskWork prepareTask(const std::string& task, const TaskGraph& graph, const TaskInputs& inputs) {
  const auto found = std::find_if(works.begin(), works.end(), [&](const auto& one) { return one.first == task; });
  if (found == works.end()) throw InputError(fmt::format("{} is no task of a campaign.", task));
  const bool fits_points = task == "fit" && !graph.facts().touches && !graph.facts().scans;
  const bool of_observations = task == "fit" ? fits_points : taskKind(task)->of_observations;
  if (of_observations && inputs.observations == nullptr) throw InputError("Evaluate the captures first (Calibrate).");
  return found->second(graph, inputs);
}

const CycleEvaluation* cyclesOf(const TouchEvaluation* evaluation) {
  if (evaluation == nullptr) return nullptr;
  if (!evaluation->hole_cycles.empty()) return &evaluation->hole_cycles.front();
  if (!evaluation->ball_cycles.empty()) return &evaluation->ball_cycles.front();
  return nullptr;
}

std::vector<TouchVerdict> allVerdicts(const TouchEvaluation& evaluation) {
  std::vector<TouchVerdict> all;
  const auto add = [&](const CycleEvaluation& cycles) {
    std::vector<TouchVerdict> some = touchVerdicts(evaluation, cycles);
    std::move(some.begin(), some.end(), std::back_inserter(all));
  };
  for (const HoleCycleResult& r : evaluation.hole_cycles) add(r);
  for (const BallCycleResult& r : evaluation.ball_cycles) add(r);
  return all;
}

}  // namespace spindrift
