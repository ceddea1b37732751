// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/workflow/workflow.h"

#include <algorithm>
#include <array>

#include "core/workflows/report_workflow.h"
#include "widgets/models/session_model.h"
#include "widgets/workflow/report_inputs.h"

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
      return Workflow::tr("Wait until the instrument has settled; before that its drift would pass for the machine's.");
    case StepId::Capture:
      return Workflow::tr("Take every capture of the plan and take bad ones again while you stand at the machine.");
    case StepId::Calibrate:
      return Workflow::tr(
          "Find the centre of rotation, the axis directions and the heights, and turn captures into deviations.");
    case StepId::Model:
      return Workflow::tr("Fit the error model, choose which points fit and which validate, and look at the heat map.");
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
    case StepState::Current:
      return Workflow::tr("current");
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

void Workflow::refresh() {
  std::array<StepStatus, all_steps.size()> now{};
  for (const StepId step : all_steps) now[static_cast<std::size_t>(step)] = evaluate(step);
  if (now == status_) return;
  status_ = std::move(now);
  Q_EMIT statusChanged();
}

/// Of a log alone: the compensator is run with the model that is identified.
StepStatus Workflow::compensatorStatus() const {
  const StoredResult* model = session_.latest("thermal");
  if (model == nullptr) return {StepState::Blocked, tr("Identify a model over time first (Model).")};
  const StoredResult* run = session_.latest("log-compensation");
  if (run == nullptr) return {StepState::NotStarted, tr("Run the compensator over the log.")};
  if (!session_.state("log-compensation").current || run->provenance.options.value("model", 0L) != model->id) {
    return {StepState::Outdated, tr("The model has changed since. Run the compensator again.")};
  }
  return {StepState::Current, tr("The compensator was run over the log.")};
}

StepStatus Workflow::evaluate(StepId step) const {
  const auto campaign = session_.campaign();
  if (campaign == nullptr) return {StepState::Blocked, tr("Open a session or a campaign first.")};
  const bool captures = session_.has(Instrument::Microscope) || session_.has(Instrument::TouchProbe) ||
                        session_.has(Instrument::Profiler);
  const bool own_observations = campaign->observations.has_value();
  const auto fromResult = [&](const char* kind, const QString& how, const QString& done) {
    const ResultState r = session_.state(kind);
    if (!r.there) return StepStatus{StepState::NotStarted, how};
    if (!r.current) return StepStatus{StepState::Outdated, tr("Inputs have changed since. Run it again.")};
    return StepStatus{StepState::Current, done};
  };
  // Effects that the user added or left out are an option of the results that follow.
  const auto choice = [&] {
    const nlohmann::json json =
        session_.setting("discrepancy/" + std::to_string(session_.campaignId()), nlohmann::json::object());
    return json.is_object() ? json : nlohmann::json::object();
  };
  static constexpr std::array choice_lists{"added", "rejected"};
  const auto withChoice = [&](StepStatus status, const char* kind) {
    if (status.state != StepState::Current) return status;
    const StoredResult* result = session_.latest(kind);
    const nlohmann::json& options = result->provenance.options;
    const nlohmann::json& depends = options.contains("depends") ? options["depends"] : options;
    const nlohmann::json then = depends.value("discrepancy", nlohmann::json::object());
    const bool same = std::all_of(choice_lists.begin(), choice_lists.end(), [&](const char* list) {
      return then.value(list, nlohmann::json::array()) == choice().value(list, nlohmann::json::array());
    });
    if (!same || then.value("effects", nlohmann::json()) != choice().value("effects", nlohmann::json())) {
      return StepStatus{StepState::Outdated, tr("The effects in the model have changed since. Run it again.")};
    }
    return status;
  };
  const ResultState evaluated = session_.state("evaluate");
  const bool log_only = session_.isLogOnly();
  const bool over_time = session_.modelOverTime();
  const bool touches = session_.has(Instrument::TouchProbe);
  const bool scans = session_.has(Instrument::Profiler);
  const bool observations = own_observations || evaluated.there;
  switch (step) {
    case StepId::Machine:
      return {StepState::Current, session_.machineEdited() ? tr("Edited in this session.") : tr("As in machine.json.")};
    case StepId::WarmUp:
      if (log_only) return {StepState::Current, tr("The campaign is a log over time: no instrument to warm up.")};
      if (session_.warmStatement()) return {StepState::Current, tr("You stated that the instrument was warm.")};
      return {StepState::NotStarted, tr("Check whether the instrument had settled.")};
    case StepId::Capture:
      if (log_only) return {StepState::Current, tr("The campaign is a log over time: nothing to capture.")};
      if (!captures && !own_observations) return {StepState::NotStarted, tr("No captures yet.")};
      if (!captures) return {StepState::Current, tr("The campaign holds finished observations.")};
      return fromResult("check",
                        touches ? tr("Check the touches.")
                        : scans ? tr("Check the scans.")
                                : tr("Check the captures."),
                        tr("All captures are checked."));
    case StepId::Calibrate:
      if (log_only) return {StepState::Current, tr("The campaign is a log over time: nothing to calibrate.")};
      if (!captures && own_observations) return {StepState::Current, tr("The campaign holds finished observations.")};
      if (!captures) return {StepState::Blocked, tr("There are no captures to evaluate yet.")};
      return fromResult("evaluate",
                        touches ? tr("Evaluate the touches.")
                        : scans ? tr("Evaluate the scans.")
                                : tr("Evaluate the captures."),
                        tr("Captures are evaluated."));
    case StepId::Model:
      if (over_time) return fromResult("thermal", tr("Identify a model over time."), tr("The model is identified."));
      if (!observations) return {StepState::Blocked, tr("Evaluate the captures first (Calibrate).")};
      {
        StepStatus status = fromResult("fit",
                                       touches ? tr("Separate the errors in every cycle.")
                                       : scans ? tr("Find the six errors of the axis.")
                                               : tr("Fit the error model."),
                                       tr("The model is fitted."));
        if (status.state == StepState::Current && evaluated.there && !evaluated.current && !own_observations) {
          status = {StepState::Outdated, tr("The captures have to be evaluated again.")};
        }
        return status;
      }
    case StepId::Discrepancy:
      if (campaign->simulation.empty())
        return {StepState::Blocked, tr("This campaign comes without a simulation to compare with.")};
      if (!observations) return {StepState::Blocked, tr("Evaluate the captures first (Calibrate).")};
      return withChoice(fromResult("discrepancy", tr("Search for what the simulation lacks."), tr("Searched.")),
                        "discrepancy");
    case StepId::Compensate: {
      if (log_only) return compensatorStatus();
      const bool added = !choice().value("added", nlohmann::json::array()).empty();
      if (!session_.state("fit").there && !added) {
        return {StepState::Blocked, campaign->simulation.empty()
                                        ? tr("Fit a model first.")
                                        : tr("Fit a model or add a missing effect to the simulation first.")};
      }
      return withChoice(fromResult("compensation", tr("Work out the corrections."), tr("Corrections are worked out.")),
                        "compensation");
    }
    case StepId::Verify:
      if (log_only)
        return {StepState::Blocked,
                tr("A log alone has no plan that could be measured again. Log the machine with the compensation on and "
                   "open that log as a campaign of its own.")};
      if (!observations) return {StepState::Blocked, tr("Evaluate the captures first (Calibrate).")};
      return fromResult("verify", tr("Measure again with the compensation on."), tr("Before and after are compared."));
    case StepId::Review:
      if (log_only)
        return {StepState::Blocked, tr("A log over time has no points to compare; Model compares models of it.")};
      if (!observations && !scans) return {StepState::Blocked, tr("There is nothing to compare yet.")};
      return {StepState::Current, tr("Look at it whenever you like.")};
    case StepId::Report:
      if (!canReport(*campaign, observations)) return {StepState::Blocked, tr("There is nothing to report yet.")};
      {
        const StepStatus status =
            withChoice(fromResult("report", tr("Write the report."), tr("The report is written.")), "report");
        if (status.state != StepState::Current) return status;
        // A report of an earlier version does not hold what it told.
        const nlohmann::json then =
            session_.latest("report")->provenance.options.value("depends", nlohmann::json::object());
        const nlohmann::json now = reportedInputs(session_);
        for (const auto& [key, value] : now.items()) {
          if (then.contains(key) && then[key] != value) {
            return {StepState::Outdated, tr("What the report tells has changed since it was written.")};
          }
        }
        return status;
      }
  }
  return {};
}

}  // namespace spindrift::gui
