// SPDX-License-Identifier: GPL-3.0-or-later
// A job that works on a result: the tasks know that it runs and how it ended, and asking for the same result again
// takes its place.
#pragma once

#include "widgets/jobs/job_runner.h"
#include "widgets/models/session_model.h"

namespace spindrift::gui {

/// To be given to JobRunner::run. `job.work` ends in session.finish(pending, ...).
[[nodiscard]] Job taskJob(SessionModel& session, const PendingResult& pending, Job job);

}  // namespace spindrift::gui
