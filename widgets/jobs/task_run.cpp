// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/jobs/task_run.h"

#include <QCoreApplication>
#include <memory>
#include <utility>

#include "core/base/error.h"
#include "core/tasks/task_chain.h"
#include "widgets/common/core_sentence.h"
#include "widgets/jobs/task_titles.h"

namespace spindrift::gui {
namespace {

class RunningChain : public std::enable_shared_from_this<RunningChain> {
  Q_DECLARE_TR_FUNCTIONS(Tasks)
 public:
  RunningChain(SessionModel& session, JobRunner& jobs, const std::string& task, TaskEnds ends)
      : session_(session),
        jobs_(jobs),
        chain_(task, true),
        ends_(std::move(ends)),
        asked_(session.begin(task)),
        title_(taskTitle(task, session.tasks().facts())) {}

  void next() {
    try {
      const TaskGraph graph = session_.tasks();
      if (const std::string why = graph.whyNot(chain_.task()); !why.empty()) throw InputError(why);
      const auto task = chain_.next(graph);
      if (!task) {
        if (ends_.done) ends_.done();
        return;
      }
      start(*task, prepareTask(*task, graph, ends_.inputs ? ends_.inputs() : session_.taskInputs()));
    } catch (const std::exception& e) {
      if (ends_.failed) ends_.failed(coreSentence(e.what()));
    }
  }

 private:
  void start(const std::string& task, TaskWork work) {
    const PendingResult pending = session_.begin(task);
    const bool last = task == chain_.task();
    const auto self = shared_from_this();
    const ResultWork result = [self, last, work = std::move(work), origin = pending.origin,
                               inputs = session_.inputsKey()](JobContext& job) -> Worked {
      auto given = std::make_shared<TaskGiven>(
          TaskGiven{origin.kind, origin, inputs, work(job, last ? TaskOutput::Both : TaskOutput::Payload)});
      return {given->result.payload,
              [self, last, given] {
                if (last && self->ends_.take) self->ends_.take(*given);
              },
              {},
              [self, last] {
                if (!last && !self->session_.atHand(self->asked_)) self->leave();
              }};
    };
    jobs_.run(taskJob(session_, pending, taskTitle(task, session_.tasks().facts()), result,
                      {.done = [self] { self->next(); },
                       .failed =
                           [self](const QString& sentence) {
                             if (self->ends_.failed) self->ends_.failed(sentence);
                           },
                       .cancelled =
                           [self] {
                             if (self->ends_.cancelled) self->ends_.cancelled();
                           }}));
  }

  /// Tells what is not begun any more.
  void leave() {
    Job job;
    job.title = title_;
    job.work = [](JobContext&) -> std::function<void()> {
      throw InputError(tr("Not begun: another campaign was chosen while what it needs was worked out.").toStdString());
    };
    jobs_.run(std::move(job));
  }

  SessionModel& session_;
  JobRunner& jobs_;
  TaskChain chain_;
  TaskEnds ends_;
  PendingResult asked_;
  QString title_;
};

}  // namespace

void runTask(SessionModel& session, JobRunner& jobs, const std::string& task, TaskEnds ends) {
  if (session.campaign() == nullptr) return;
  std::make_shared<RunningChain>(session, jobs, task, std::move(ends))->next();
}

std::function<std::function<const TaskGiven*()>(JobContext&)> detailOfTask(SessionModel& session,
                                                                           const std::string& task,
                                                                           const TaskInputs& inputs) {
  const ResultOrigin origin = session.begin(task).origin;
  return [&session, origin, key = session.inputsKey(),
          work = prepareTask(task, session.tasks(), inputs)](JobContext& job) -> std::function<const TaskGiven*()> {
    auto given = std::make_shared<TaskGiven>(TaskGiven{origin.kind, origin, key, work(job, TaskOutput::Detail)});
    return [&session, given]() -> const TaskGiven* {
      const ResultOrigin now = session.begin(given->task).origin;
      return now.inputs == given->origin.inputs && now.options == given->origin.options ? given.get() : nullptr;
    };
  };
}

}  // namespace spindrift::gui
