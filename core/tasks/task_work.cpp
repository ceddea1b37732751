// SPDX-License-Identifier: Apache-2.0
#include "core/tasks/task_work.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/base/error.h"
#include "core/tasks/task_options.h"
#include "core/workflows/open_simulator.h"

namespace spindrift {
TaskInputs TaskInputs::of(const TaskGraph& graph, const CampaignState& state) {
  TaskInputs inputs;
  inputs.campaign = state.campaign;
  inputs.excluded = state.excluded;
  inputs.observations = {state.campaign, state.campaign->observations ? nullptr : state.evaluation(graph),
                         state.excluded, clockOffsetsOf(graph.session(), state.id)};
  return inputs;
}

SimulationTask SimulationTask::of(const TaskGraph& graph, const TaskInputs& inputs) {
  const SimulationOptions options = SimulationOptions::of(graph.session(), graph.campaign(), graph.data());
  if (options.simulator.empty()) throw InputError(graph.status("simulation").reason);
  return {placeNamed(graph.session(), options.simulator), chosen<EffectOptions>(graph.session(), graph.campaign()),
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
  const TaskKind& kind = taskKind(task, graph.facts());
  if (kind.of_observations && inputs.observations == nullptr) throw InputError(std::string(nothing_evaluated));
  return kind.prepare(graph, inputs);
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
