// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/pages/page.h"

#include <QHBoxLayout>
#include <QTabWidget>
#include <QVBoxLayout>
#include <utility>

#include "core/base/error.h"
#include "core/tasks/task_options.h"
#include "widgets/commands/commands.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"

namespace spindrift::gui {

Page::Page(PageContext context, StepId step, QWidget* parent)
    : QWidget(parent), context_(std::move(context)), step_(step) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(24, 16, 24, 16);
  column->setSpacing(12);
  auto* head = new QHBoxLayout;
  head->setSpacing(8);
  auto* titles = new QVBoxLayout;
  titles->setSpacing(2);
  titles->addWidget(makeLabel(stepTitle(step), "pageTitle"));
  instruction_ = new WrappedLabel;
  instruction_->setProperty("role", QStringLiteral("instruction"));
  instruction_->setText(stepInstruction(step));
  titles->addWidget(instruction_);
  head->addLayout(titles, 1);
  actions_ = new QHBoxLayout;
  actions_->setSpacing(8);
  head->addLayout(actions_);
  column->addLayout(head);
  callout_ = new Callout;
  column->addWidget(callout_);
  content_ = new QVBoxLayout;
  content_->setSpacing(12);
  column->addLayout(content_, 1);
  setAccessibleName(stepTitle(step));
}

void Page::setInstruction(const QString& sentence) {
  instruction_->setText(sentence);
}

void Page::addAction(QWidget* widget) {
  actions_->addWidget(widget, 0, Qt::AlignVCenter);
}

void Page::addModelSwitch(bool over_time) {
  auto* button = makeButton(over_time ? tr("Model over time") : tr("Model of a state"), nullptr);
  button->setToolTip(over_time
                         ? tr("Identify how these errors follow temperatures and speeds of the log")
                         : tr("Back to the model of the instrument: one thermal state, or every cycle by itself"));
  const auto update = [this, button] {
    button->setVisible(session().campaign() != nullptr && session().campaign()->log.has_value() &&
                       !session().isLogOnly());
  };
  addAction(button);  // first: shown without a parent it would be a window of its own, and take the focus away
  connect(&session(), &SessionModel::campaignChanged, button, update);
  update();
  connect(button, &QPushButton::clicked, this, [this, button, over_time] {
    context_.undo.push(new OptionsCommand(session(), button->text(), session().campaignKey(option_keys::over_time),
                                          over_time, [this] { Q_EMIT session().campaignChanged(); }));
  });
}

bool Page::noticeCampaign() {
  if (seen_visit_ == context_.session.visit()) return false;
  seen_visit_ = context_.session.visit();
  for (auto* tabs : findChildren<QTabWidget*>()) tabs->setCurrentIndex(0);
  return true;
}

Job Page::jobOf(const QString& title, Work work) {
  Job job;
  job.title = title;
  job.work = std::move(work);
  job.failed = [this](const QString& sentence) { showFailure(sentence); };
  return visitJob(context_.session, std::move(job));
}

void Page::showFailure(const QString& sentence) {
  callout_->setAction({}, {});
  callout_->show(Tone::Bad, sentence);
}

void Page::runTask(const std::string& task, WorkEnds ends) {
  if (!ends.done) ends.done = [this] { refresh(); };
  if (!ends.failed) ends.failed = [this](const QString& sentence) { showFailure(sentence); };
  spindrift::gui::runTask(context_.session, context_.jobs, task,
                          {.inputs = [this] { return taskInputs(); },
                           .take = [this](const TaskGiven& given) { keepGiven(given); },
                           .done = std::move(ends.done),
                           .failed = std::move(ends.failed),
                           .cancelled = std::move(ends.cancelled)});
}

void Page::keepGiven(const TaskGiven& given) {
  forgetOtherVisits();
  given_[given.task] = std::make_shared<const TaskGiven>(given);
}

void Page::forgetOtherVisits() {
  if (std::exchange(given_visit_, session().visit()) == session().visit()) return;
  given_.clear();
  reading_.clear();
}

ShownTask Page::shown(const std::string& task, const QString& title) {
  forgetOtherVisits();
  ShownTask out;
  out.state = session().state(task);
  const StoredResult* stored = session().latest(task);
  const auto found = given_.find(task);
  if (stored != nullptr && found != given_.end() && session().tasks().changes(*stored, found->second->origin).empty()) {
    out.given = found->second;
  } else if (out.state.current) {
    out.reading = true;
    showAgain(title, task);
  }
  return out;
}

void Page::runAlone(const std::string& task) {
  // A result that holds, such as that of options that were undone, is read, not worked out once more.
  if (session().state(task).current) return;
  if (canRun(task) && session().tasks().needed(task).size() <= 1) runTask(task);
}

void Page::showAgain(const QString& title, const std::string& task) {
  const auto origin = std::make_shared<const ResultOrigin>(session().begin(task).origin);
  // Whatever refreshes the page meanwhile: what is being read is not begun once more.
  if (const auto found = reading_.find(task); found != reading_.end() && found->second->sameAs(*origin)) return;
  const auto ended = [this, task, origin] {
    if (const auto found = reading_.find(task); found != reading_.end() && found->second == origin)
      reading_.erase(found);
  };
  try {
    Job job;
    job.title = title;
    job.queue = JobQueue::Reading;
    job.key = keyOf(title);
    job.work = [this, ended,
                detail = detailOfTask(session(), task, taskInputs())](JobContext& context) -> std::function<void()> {
      return [this, ended, now = detail(context)] {
        ended();
        if (const TaskGiven* given = now()) keepGiven(*given);
        refresh();
      };
    };
    job.failed = [this, ended](const QString& sentence) {
      ended();
      showFailure(sentence);
    };
    job.cancelled = ended;
    context_.jobs.run(visitJob(session(), std::move(job)));
    reading_[task] = origin;
  } catch (const InputError& e) {
    showFailure(coreSentence(e.what()));
  }
}

void Page::run(const QString& title, Work work) {
  context_.jobs.run(jobOf(title, std::move(work)));
}

void Page::display(const QString& title, Work work) {
  Job job = jobOf(title, std::move(work));
  job.queue = JobQueue::Display;
  job.key = keyOf(title);
  context_.jobs.run(std::move(job));
}

std::string Page::keyOf(const QString& title) const {
  return (stepTitle(step_) + QLatin1Char('/') + title).toStdString();
}

void PageRegistry::add(StepId step, Applies applies, Factory factory, const char* key) {
  entries_.push_back({step, std::move(applies), std::move(factory), key});
}

const PageRegistry::Entry* PageRegistry::find(StepId step, const SessionModel& session) const {
  for (const Entry& entry : entries_) {
    if (entry.step == step && entry.applies(session)) return &entry;
  }
  return nullptr;
}

}  // namespace spindrift::gui
