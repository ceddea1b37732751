// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/jobs/task_job.h"

namespace spindrift::gui {

Job taskJob(SessionModel& session, const PendingResult& pending, const QString& title, ResultWork work, WorkEnds ends) {
  const ResultOrigin& origin = pending.origin;
  Job job;
  job.title = title;
  job.key = std::to_string(pending.session) + "/" + std::to_string(origin.campaign) + "/" + origin.kind;
  job.work = [&session, pending, work = std::move(work),
              done = std::move(ends.done)](JobContext& context) -> std::function<void()> {
    return [&session, pending, worked = work(context), done] {
      session.workEnded(pending);
      if (session.atHand(pending) && worked.take) worked.take();
      PendingResult filed = pending;
      filed.origin.options.update(worked.options.is_object() ? worked.options : nlohmann::json::object());
      session.finish(filed, worked.payload);
      if (session.has(pending) && worked.stored) worked.stored();
      if (session.atHand(pending) && done) done();
    };
  };
  job.failed = [&session, pending, failed = std::move(ends.failed)](const QString& sentence) {
    session.workFailed(pending, sentence);
    if (session.atHand(pending) && failed) failed(sentence);
  };
  job.cancelled = [&session, pending, cancelled = std::move(ends.cancelled)] {
    session.workEnded(pending);
    if (session.atHand(pending) && cancelled) cancelled();
  };
  session.workStarted(pending);
  return job;
}

Job visitJob(const SessionModel& session, Job job) {
  const auto lasts = [&session, visit = session.visit()] { return session.visit() == visit; };
  job.work = [lasts, work = std::move(job.work)](JobContext& context) -> std::function<void()> {
    return [lasts, apply = work(context)] {
      if (lasts() && apply) apply();
    };
  };
  job.failed = [lasts, failed = std::move(job.failed)](const QString& sentence) {
    if (lasts() && failed) failed(sentence);
  };
  job.cancelled = [lasts, cancelled = std::move(job.cancelled)] {
    if (lasts() && cancelled) cancelled();
  };
  return job;
}

}  // namespace spindrift::gui
