// SPDX-License-Identifier: GPL-3.0-or-later
// Jobs that belong to a campaign. Whatever the user chooses while they run: a result is filed under the campaign that
// it was started for, and nothing of it is shown on the page of another one.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>

#include "widgets/jobs/job_runner.h"
#include "widgets/models/session_model.h"

namespace spindrift::gui {

/// What work on a result has given.
struct Worked {
  nlohmann::json payload;      ///< to be stored
  std::function<void()> take;  ///< keeps in memory what is shown beside it; called before it is stored; may be empty
  nlohmann::json options{};    ///< what it is kept with and is known only now; adds to those of the PendingResult
  std::function<void()> stored{};  ///< called when it is stored, whichever campaign is at hand then; may be empty
};
using ResultWork = std::function<Worked(JobContext&)>;

/// What is shown when the work has ended; each may be empty.
struct WorkEnds {
  std::function<void()> done{};
  std::function<void(const QString&)> failed{};
  std::function<void()> cancelled{};
};

/// Work on a result, to be given to JobRunner::run: the tasks know that it runs and how it ended, asking for the same
/// result again takes its place. `take` and `ends` are called only while its campaign is at hand.
[[nodiscard]] Job taskJob(SessionModel& session, const PendingResult& pending, const QString& title, ResultWork work,
                          WorkEnds ends);

/// Work that leaves no result: what it returns, and how it failed or was cancelled, is told only if no other campaign
/// and no other session has been chosen meanwhile (SessionModel::visit).
[[nodiscard]] Job visitJob(const SessionModel& session, Job job);

}  // namespace spindrift::gui
