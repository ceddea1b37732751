// SPDX-License-Identifier: Apache-2.0
#include "core/tasks/task_chain.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"

namespace spindrift {

std::optional<std::string> TaskChain::next(const TaskGraph& graph) {
  if (started_.contains(task_)) return std::nullopt;
  std::vector<std::string> order = graph.needed(task_);
  if (order.empty() && anew_) order.push_back(task_);
  if (order.empty()) return std::nullopt;
  const std::string& first = order.front();
  const ResultOrigin origin = graph.origin(first);
  const nlohmann::json now = {origin.inputs, origin.options};
  const auto [before, is_new] = started_.try_emplace(first, now);
  if (!is_new && before->second == now)
    throw InputError({graph.data().folder.string(), ""}, fmt::format("the result of {} was not kept.", first));
  before->second = now;
  return first;
}

std::vector<std::string> CampaignTasks::run(const std::string& task, JobContext& job, bool anew) {
  std::vector<std::string> ran;
  TaskChain chain(task, anew);
  const auto steps = std::max(1.0, static_cast<double>(graph().needed(task).size()));
  while (const auto next = chain.next(graph())) {
    const double done = std::min(1.0, static_cast<double>(ran.size()) / steps);
    JobContext part = job.part(done, std::min(1.0, done + 1.0 / steps));
    part.report(0.0, *next);
    part.throwIfCancelled();
    state_.excluded = excludedItems(session_, state_.id);
    const ResultOrigin origin = graph().origin(*next);
    const TaskWork work = prepareTask(*next, graph(), TaskInputs::of(session_, state_));
    ledger_.started(origin);
    try {
      const TaskResult result = work(part, TaskOutput::Payload);
      ledger_.ended(origin);
      state_.latest[*next] = session_.keepResult(origin, result.payload);
    } catch (const InputError& e) {
      ledger_.failed(origin, e.what());
      throw;
    } catch (...) {
      ledger_.ended(origin);
      throw;
    }
    if (const auto& kept = state_.latest[*next]; *next == "evaluate" && kept)
      state_.evaluation = std::make_shared<const StoredEvaluation>(evaluationFrom(*kept));
    ran.push_back(*next);
  }
  return ran;
}

}  // namespace spindrift
