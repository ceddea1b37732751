// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/workflow/workflow.h"

#include "core/tasks/task_options.h"
#include "widgets/common/core_sentence.h"
#include "widgets/models/session_model.h"

namespace spindrift::gui {

QString stepTitle(StepId step) {
  switch (step) {
    case StepId::Machine:
      return Workflow::tr("Machine");
    case StepId::WarmUp:
      return Workflow::tr("Warm-up");
    case StepId::Capture:
      return Workflow::tr("Capture");
    case StepId::Calibrate:
      return Workflow::tr("Calibrate");
    case StepId::Model:
      return Workflow::tr("Model");
    case StepId::Discrepancy:
      return Workflow::tr("Discrepancy");
    case StepId::Compensate:
      return Workflow::tr("Compensate");
    case StepId::Verify:
      return Workflow::tr("Verify");
    case StepId::Review:
      return Workflow::tr("Review");
    case StepId::Report:
      return Workflow::tr("Report");
  }
  return {};
}

QString stepInstruction(StepId step) {
  switch (step) {
    case StepId::Machine:
      return Workflow::tr("Check that this is the machine in front of you: chain, travels, measuring points.");
    case StepId::WarmUp:
      return Workflow::tr(
          "Wait until the instrument has settled; until then its drift would be mistaken for drift of the machine.");
    case StepId::Capture:
      return Workflow::tr(
          "Take every capture of the plan, and repeat those that fail the check while you are at the machine.");
    case StepId::Calibrate:
      return Workflow::tr(
          "Find the centre of rotation, the axis directions and the heights, and turn captures into deviations.");
    case StepId::Model:
      return Workflow::tr(
          "Fit the error model, choose the points to fit and those to validate, and look at the heat map.");
    case StepId::Discrepancy:
      return Workflow::tr("Find where simulation and measurement disagree, and which effect is missing.");
    case StepId::Compensate:
      return Workflow::tr("See what the model would command, and export it for the control.");
    case StepId::Verify:
      return Workflow::tr("Measure the same plan again with the compensation on, and see whether the goal is met.");
    case StepId::Review:
      return Workflow::tr("Compare thermal states, models, campaigns and scans side by side.");
    case StepId::Report:
      return Workflow::tr("Read the whole evaluation through and save it as a report.");
  }
  return {};
}

const char* stepIcon(StepId step) {
  switch (step) {
    case StepId::Machine:
      return "machine";
    case StepId::WarmUp:
      return "warm-up";
    case StepId::Capture:
      return "capture";
    case StepId::Calibrate:
      return "calibrate";
    case StepId::Model:
      return "model";
    case StepId::Discrepancy:
      return "discrepancy";
    case StepId::Compensate:
      return "compensate";
    case StepId::Verify:
      return "check-circle";
    case StepId::Review:
      return "compare";
    case StepId::Report:
      return "report";
  }
  return "info";
}

QString stateWord(StepState state) {
  switch (state) {
    case StepState::NotStarted:
      return Workflow::tr("not started");
    case StepState::InProgress:
      return Workflow::tr("in progress");
    case StepState::Attention:
      return Workflow::tr("attention");
    case StepState::Current:
      return Workflow::tr("done");
    case StepState::Outdated:
      return Workflow::tr("outdated");
    case StepState::Blocked:
      return Workflow::tr("blocked");
  }
  return {};
}

const char* stateIcon(StepState state) {
  switch (state) {
    case StepState::NotStarted:
      return "not-started";
    case StepState::InProgress:
      return "in-progress";
    case StepState::Attention:
      return "alert";
    case StepState::Current:
      return "check-circle";
    case StepState::Outdated:
      return "outdated";
    case StepState::Blocked:
      return "blocked";
  }
  return "info";
}

Tone stateTone(StepState state) {
  switch (state) {
    case StepState::InProgress:
      return Tone::Accent;
    case StepState::Attention:
      return Tone::Attention;
    case StepState::Current:
      return Tone::Good;
    case StepState::Outdated:
      return Tone::Outdated;
    default:
      return Tone::Neutral;
  }
}

Workflow::Workflow(SessionModel& session, QObject* parent) : QObject(parent), session_(session) {
  connect(&session_, &SessionModel::campaignChanged, this, &Workflow::refresh);
  connect(&session_, &SessionModel::sessionChanged, this, &Workflow::refresh);
  connect(&session_, &SessionModel::resultChanged, this, &Workflow::refresh);
  connect(&session_, &SessionModel::workChanged, this, &Workflow::refresh);
  connect(&session_, &SessionModel::inputsChanged, this, &Workflow::refresh);
  refresh();
}

void Workflow::goTo(StepId step) {
  if (step == current_) return;
  current_ = step;
  Q_EMIT currentChanged(step);
}

void Workflow::next() {
  if (canGoNext()) goTo(static_cast<StepId>(static_cast<int>(current_) + 1));
}

void Workflow::back() {
  if (canGoBack()) goTo(static_cast<StepId>(static_cast<int>(current_) - 1));
}

const CaptureCounts& Workflow::counts(const TaskGraph& tasks) {
  const std::string key = std::to_string(session_.visit()) + "/" + std::to_string(session_.captureGeneration()) + "/" +
                          session_.setting(session_.campaignKey(option_keys::plan), nlohmann::json()).dump();
  if (key != counted_) {
    counted_ = key;
    counts_ = CaptureCounts::of(tasks);
  }
  return counts_;
}

void Workflow::refresh() {
  std::array<StepStatus, all_steps.size()> now{};
  if (session_.campaign() == nullptr) {
    now.fill({StepState::Blocked, tr("Open a session or a campaign first."), {}});
  } else {
    const TaskGraph tasks = session_.tasks();
    for (const StepId step : all_steps) {
      const StepReport report = stepReport(tasks, step, counts(tasks));
      now[static_cast<std::size_t>(step)] = {
          report.state, coreSentence(report.sentence),
          report.of == 0 ? QString() : tr("%1 of %2").arg(report.count).arg(report.of)};
    }
  }
  if (now == status_) return;
  status_ = std::move(now);
  Q_EMIT statusChanged();
}

}  // namespace spindrift::gui
