// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/jobs/task_run.h"

#include <QCoreApplication>
#include <memory>
#include <optional>
#include <utility>

#include "core/base/error.h"
#include "core/tasks/task_chain.h"
#include "widgets/common/core_sentence.h"

namespace spindrift::gui {
namespace {

/// What the list of jobs says while it runs.
QString titleOf(const std::string& task, const TaskGraph& graph) {
  return coreSentence(taskKind(task, graph.facts()).title);
}

/// Tasks of the campaign that was at hand when it began, one after the other.
class RunningChain : public std::enable_shared_from_this<RunningChain> {
  Q_DECLARE_TR_FUNCTIONS(Tasks)
 public:
  /// Throws InputError: what is asked for cannot be run.
  using Next = std::function<std::optional<std::string>(const TaskGraph&)>;

  /// `wanted` is the task whose detail is shown, empty where there is none; without one, a failure ends nothing.
  RunningChain(SessionModel& session, JobRunner& jobs, std::string wanted, QString title, Next next, TaskEnds ends)
      : session_(session),
        jobs_(jobs),
        campaign_{session.sessionNumber(), ResultOrigin{session.campaignId(), {}}},
        wanted_(std::move(wanted)),
        title_(std::move(title)),
        next_(std::move(next)),
        ends_(std::move(ends)) {}

  void next() {
    QString title = title_;
    try {
      const TaskGraph graph = session_.tasks();
      const auto task = next_(graph);
      if (task) title = titleOf(*task, graph);
      if (!task) {
        if (ends_.done) ends_.done();
        return;
      }
      start(*task, prepareTask(*task, graph, ends_.inputs ? ends_.inputs() : session_.taskInputs()));
    } catch (const std::exception& e) {
      if (wanted_.empty()) tell(title, e.what());
      fail(coreSentence(e.what()));
    }
  }

 private:
  void start(const std::string& task, TaskWork work) {
    const PendingResult pending = session_.begin(task);
    const bool last = task == wanted_;
    const auto self = shared_from_this();
    // Whoever asked for it: it is not begun again, which would stop it and with it all that waits for it.
    if (!last && session_.runsAlready(pending)) {
      awaitEndOf(pending);
      return;
    }
    const ResultWork result = [self, last, work = std::move(work), origin = pending.origin](JobContext& job) -> Worked {
      auto given = std::make_shared<TaskGiven>(
          TaskGiven{origin.kind, origin, work(job, last ? TaskOutput::Both : TaskOutput::Payload)});
      return {given->result.payload,
              [self, last, given] {
                if (last && self->ends_.take) self->ends_.take(*given);
              },
              {},
              [self, last] {
                if (!last && !self->session_.atHand(self->campaign_))
                  self->tell(self->title_,
                             tr("%1: stopped, because another campaign was chosen. What was finished is stored.")
                                 .arg(self->title_)
                                 .toStdString());
              }};
    };
    jobs_.run(taskJob(session_, pending, titleOf(task, session_.tasks()), result,
                      {.done = [self] { self->next(); },
                       .failed = [self](const QString& sentence) { self->fail(sentence); },
                       .cancelled =
                           [self, pending, last] {
                             // Asked for again by somebody else, who is now served first.
                             if (!last && self->session_.runsAlready(pending)) {
                               self->awaitEndOf(pending);
                             } else if (self->ends_.cancelled) {
                               self->ends_.cancelled();
                             }
                           }}));
  }

  void awaitEndOf(const PendingResult& pending) {
    const auto self = shared_from_this();
    const auto waiting = std::make_shared<QMetaObject::Connection>();
    *waiting = QObject::connect(
        &jobs_, &JobRunner::changed, &session_,
        [self, pending, waiting] {
          if (self->session_.runsAlready(pending)) return;
          QObject::disconnect(*waiting);
          if (self->session_.atHand(self->campaign_)) self->next();
        },
        Qt::QueuedConnection);
  }

  void fail(const QString& sentence) {
    if (ends_.failed) ends_.failed(sentence);
    if (wanted_.empty()) next();
  }

  /// Why something was not begun, among the messages of jobs.
  void tell(const QString& title, const std::string& sentence) {
    Job job;
    job.title = title;
    job.work = [sentence](JobContext&) -> std::function<void()> { throw InputError(sentence); };
    jobs_.run(std::move(job));
  }

  SessionModel& session_;
  JobRunner& jobs_;
  PendingResult campaign_;
  std::string wanted_;
  QString title_;
  Next next_;
  TaskEnds ends_;
};

}  // namespace

void runTask(SessionModel& session, JobRunner& jobs, const std::string& task, TaskEnds ends) {
  if (session.campaign() == nullptr) return;
  const auto next = [chain = TaskChain(task, true)](const TaskGraph& graph) mutable {
    if (const std::string why = graph.whyNot(chain.task()); !why.empty()) throw InputError(why);
    return chain.next(graph);
  };
  std::make_shared<RunningChain>(session, jobs, task, titleOf(task, session.tasks()), next, std::move(ends))->next();
}

void runOutdated(SessionModel& session, JobRunner& jobs, TaskEnds ends) {
  if (session.campaign() == nullptr) return;
  const auto next = [chain = OutdatedChain()](const TaskGraph& graph) mutable { return chain.next(graph); };
  std::make_shared<RunningChain>(session, jobs, std::string(), RunningChain::tr("Running what is outdated"), next,
                                 std::move(ends))
      ->next();
}

std::function<std::function<const TaskGiven*()>(JobContext&)> detailOfTask(SessionModel& session,
                                                                           const std::string& task,
                                                                           const TaskInputs& inputs) {
  const ResultOrigin origin = session.begin(task).origin;
  return [&session, origin,
          work = prepareTask(task, session.tasks(), inputs)](JobContext& job) -> std::function<const TaskGiven*()> {
    auto given = std::make_shared<TaskGiven>(TaskGiven{origin.kind, origin, work(job, TaskOutput::Detail)});
    return [&session, given]() -> const TaskGiven* {
      const ResultOrigin now = session.begin(given->task).origin;
      return now.sameAs(given->origin) ? given.get() : nullptr;
    };
  };
}

}  // namespace spindrift::gui
