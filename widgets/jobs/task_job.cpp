// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/jobs/task_job.h"

namespace spindrift::gui {

Job taskJob(SessionModel& session, const PendingResult& pending, Job job) {
  const ResultOrigin& origin = pending.origin;
  job.key = std::to_string(pending.session) + "/" + std::to_string(origin.campaign) + "/" + origin.kind;
  job.work = [&session, pending, work = std::move(job.work)](JobContext& context) -> std::function<void()> {
    std::function<void()> apply = work(context);
    return [&session, pending, apply = std::move(apply)] {
      session.workEnded(pending);
      if (apply) apply();
    };
  };
  job.failed = [&session, pending, failed = std::move(job.failed)](const QString& sentence) {
    session.workFailed(pending, sentence);
    if (failed) failed(sentence);
  };
  job.cancelled = [&session, pending, cancelled = std::move(job.cancelled)] {
    session.workEnded(pending);
    if (cancelled) cancelled();
  };
  session.workStarted(pending);
  return job;
}

}  // namespace spindrift::gui
