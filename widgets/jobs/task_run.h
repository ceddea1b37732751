// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a task of the campaign at hand, and before it what it is made from and does not hold: one job after the other,
// each prepared when its turn comes. Cancelling the one that runs cancels the rest; a failure ends it with its reason.
// When another campaign is chosen, the job that runs is filed where it belongs, and what would come after it is not
// begun: the list of messages says so.
#pragma once

#include <functional>
#include <string>

#include "core/tasks/task_work.h"
#include "widgets/jobs/job_runner.h"
#include "widgets/jobs/task_job.h"
#include "widgets/models/session_model.h"

namespace spindrift::gui {

/// What a task has given, for who shows it.
struct TaskGiven {
  std::string task;
  ResultOrigin origin;
  TaskResult result;
};

/// Each may be empty; all are called only while the campaign is at hand.
struct TaskEnds {
  std::function<TaskInputs()> inputs{};          ///< in place of SessionModel::taskInputs
  std::function<void(const TaskGiven&)> take{};  ///< of the task that was asked for; before it is stored
  std::function<void()> done{};                  ///< all of it
  std::function<void(const QString&)> failed{};
  std::function<void()> cancelled{};
};

/// The task itself is run even if its result holds: the user has asked for it.
void runTask(SessionModel& session, JobRunner& jobs, const std::string& task, TaskEnds ends);

/// Runs every task whose result does not hold any more, each after what it is made from (OutdatedChain). What fails is
/// told and ends nothing: `done` is called when the rest is over. `take` is not called.
void runOutdated(SessionModel& session, JobRunner& jobs, TaskEnds ends);

/// The detail that is shown beside a stored result, worked out again: to be run as a job for display. The answer is
/// null where the inputs or options have changed meanwhile. Throws InputError as prepareTask.
[[nodiscard]] std::function<std::function<const TaskGiven*()>(JobContext&)> detailOfTask(SessionModel& session,
                                                                                         const std::string& task,
                                                                                         const TaskInputs& inputs);

}  // namespace spindrift::gui
