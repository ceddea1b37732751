// SPDX-License-Identifier: Apache-2.0
// What has to be run, one after the other, so that a task is current. What a task is made from is run first, what holds
// is used again, and each is looked at anew when its turn comes: its inputs may have changed meanwhile.
//
//   TaskChain chain("fit");
//   while (const auto task = chain.next(graph())) { run *task and keep its result; a failure ends the chain }
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/tasks/task_graph.h"
#include "core/tasks/task_work.h"

namespace spindrift {

class TaskChain {
 public:
  /// `anew`: the task itself is run even if its result holds; what it is made from is not.
  explicit TaskChain(std::string task, bool anew = false) : task_(std::move(task)), anew_(anew) {}

  /// What is to be started now; nothing: the chain is at its end. Throws InputError: blocked, or what was run has
  /// not become current although nothing changed (its result could not be kept).
  [[nodiscard]] std::optional<std::string> next(const TaskGraph& graph);
  [[nodiscard]] const std::string& task() const { return task_; }

 private:
  std::string task_;
  bool anew_;
  std::map<std::string, nlohmann::json> started_;  ///< what each was started with
};

/// What is to be run so that every result that there is holds again; what was never run stays so, and what
/// starts programs is run only when it is asked for. One after the other, each once: what fails, or is outdated by a
/// change meanwhile, stays so with what is made from it.
class OutdatedChain {
 public:
  /// What is to be started now; nothing: the chain is at its end.
  [[nodiscard]] std::optional<std::string> next(const TaskGraph& graph);
  [[nodiscard]] const std::vector<std::string>& started() const { return started_; }

 private:
  std::vector<std::string> started_;
};

/// A campaign of a session on which tasks are run without a window. The session has to live as long.
class CampaignTasks {
 public:
  CampaignTasks(Session& session, CampaignState state) : session_(session), state_(std::move(state)) {}

  [[nodiscard]] TaskGraph graph() const { return state_.tasks(session_, ledger_); }
  [[nodiscard]] const CampaignState& state() const { return state_; }
  [[nodiscard]] const TaskLedger& ledger() const { return ledger_; }
  /// Runs what is needed so that the task is current, and keeps every result; tells the job which task begins, and
  /// takes the exclusions as the session holds them then. Returns what was run, in order. Throws InputError: blocked,
  /// or why one failed (nothing after it is run); Cancelled. `anew` as in TaskChain.
  std::vector<std::string> run(const std::string& task, JobContext& job, bool anew = false);
  /// The same for everything that is outdated (OutdatedChain). What fails ends nothing: its sentence is in `failures`.
  std::vector<std::string> runOutdated(JobContext& job, std::vector<std::string>& failures);

 private:
  /// Of the task as it is now.
  void runOne(const std::string& task, JobContext& job);

  Session& session_;
  CampaignState state_;
  TaskLedger ledger_;
};

}  // namespace spindrift
