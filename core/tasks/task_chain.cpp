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

std::optional<std::string> OutdatedChain::next(const TaskGraph& graph) {
  const auto begun = [this](const std::string& task) {
    return std::find(started_.begin(), started_.end(), task) != started_.end();
  };
  for (const std::string& task : graph.tasks()) {
    if (taskKind(task)->starts_programs) continue;
    const TaskStatus status = graph.status(task);
    if (status.result == 0 || status.current || !graph.whyNot(task).empty()) continue;
    const std::vector<std::string> order = graph.needed(task);
    if (order.empty() || std::any_of(order.begin(), order.end(), begun)) continue;
    started_.push_back(order.front());
    return order.front();
  }
  return std::nullopt;
}

void CampaignTasks::runOne(const std::string& task, JobContext& job) {
  job.report(0.0, task);
  job.throwIfCancelled();
  state_.excluded = excludedItems(session_, state_.id);
  const ResultOrigin origin = graph().origin(task);
  const TaskWork work = prepareTask(task, graph(), TaskInputs::of(graph(), state_));
  ledger_.started(origin);
  try {
    const TaskResult result = work(job, TaskOutput::Payload);
    ledger_.ended(origin);
    state_.keep(session_.keepResult(origin, result.payload));
  } catch (const InputError& e) {
    ledger_.failed(origin, e.what());
    throw;
  } catch (...) {
    ledger_.ended(origin);
    throw;
  }
}

std::vector<std::string> CampaignTasks::run(const std::string& task, JobContext& job, bool anew) {
  std::vector<std::string> ran;
  TaskChain chain(task, anew);
  const auto steps = std::max(1.0, static_cast<double>(graph().needed(task).size()));
  while (const auto next = chain.next(graph())) {
    const double done = std::min(1.0, static_cast<double>(ran.size()) / steps);
    JobContext part = job.part(done, std::min(1.0, done + 1.0 / steps));
    runOne(*next, part);
    ran.push_back(*next);
  }
  return ran;
}

std::vector<std::string> CampaignTasks::runOutdated(JobContext& job, std::vector<std::string>& failures) {
  std::vector<std::string> ran;
  OutdatedChain chain;
  const auto most = static_cast<double>(graph().tasks().size());
  while (const auto next = chain.next(graph())) {
    const auto done = static_cast<double>(chain.started().size() - 1);
    JobContext part = job.part(done / most, (done + 1.0) / most);
    try {
      runOne(*next, part);
      ran.push_back(*next);
    } catch (const InputError& e) {
      failures.push_back(fmt::format("{} failed: {}", *next, e.what()));
    }
  }
  return ran;
}

}  // namespace spindrift
