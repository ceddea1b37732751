// SPDX-License-Identifier: Apache-2.0
#include "core/tasks/steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <set>
#include <system_error>

#include "core/base/count_text.h"
#include "core/base/csv.h"
#include "core/base/error.h"
#include "core/machine/observation.h"
#include "core/machine/observation_plausibility.h"
#include "core/scanning/painted_mask.h"
#include "core/scanning/registration.h"
#include "core/tasks/campaign_state.h"
#include "core/tasks/task_options.h"
#include "core/workflows/instrument_checks.h"
#include "core/workflows/measurement_plan.h"

namespace spindrift {
namespace {

StepReport report(StepState state, std::string sentence) {
  return {state, std::move(sentence), 0, 0};
}

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
  return text;
}

/// What a step says of its task; what the result says for itself is asked for when it holds.
StepReport ofTask(const TaskGraph& graph, const std::string& task, const char* how) {
  const TaskStatus status = graph.status(task);
  switch (status.state) {
    case TaskState::NotRun:
      return report(StepState::NotStarted, how);
    case TaskState::Blocked:
      return report(StepState::Blocked, status.reason);
    case TaskState::Running:
      return report(StepState::InProgress, "Calculation in progress.");
    case TaskState::Failed:
      return report(StepState::Attention, status.reason);
    case TaskState::Outdated:
      return report(StepState::Outdated, fmt::format("Changed since: {}. Run it again.", joined(status.changed)));
    case TaskState::Current:
      break;
  }
  return report(StepState::Current, {});
}

/// A step that is done, or asks for attention with the first of what its result warns of.
StepReport done(const char* sentence, const std::vector<std::string>& warnings) {
  if (warnings.empty()) return report(StepState::Current, sentence);
  return report(StepState::Attention, warnings.front());
}

std::vector<std::string> warningsOf(const nlohmann::json& result) {
  return result.value("warnings", std::vector<std::string>());
}

std::set<std::string> excludedItems(const TaskGraph& graph) {
  std::set<std::string> items;
  for (const Exclusion& exclusion : graph.session().exclusions(graph.campaign())) items.insert(exclusion.item);
  return items;
}

/// Not an observation ("M1/F3/EX"), not the mask of a scan, and not a touch.
bool namesAFile(const std::string& item) {
  if (isMaskItem(item) || item.starts_with("touch/")) return false;
  const std::size_t slash = item.rfind('/');
  return slash == std::string::npos || !componentFromString(item.substr(slash + 1));
}

struct Checked {
  std::size_t all = 0;
  std::size_t bad = 0;
  std::size_t settled = 0;  ///< rows of the list that it looked at, or that were taken out
  const char* what = "capture";
};

/// What the last check found. Payloads: {"captures": [{image, good}]}, {"scans": [{cloud, usable, reason}]},
/// {"touches": {"plausible": 40, "rejected": 1, "missing": 2, "excluded": 0}}.
Checked checked(const TaskGraph& graph) {
  Checked out;
  const nlohmann::json& payload = graph.latest("check")->payload;
  const std::set<std::string> excluded = excludedItems(graph);
  std::set<std::string> files;
  const auto count = [&](const char* list, const char* name, auto isGood) {
    for (const nlohmann::json& entry : payload.value(list, nlohmann::json::array())) {
      const std::string file = entry.value(name, std::string());
      ++out.all;
      files.insert(file);
      if (!isGood(entry) && !excluded.contains(file)) ++out.bad;
    }
  };
  count("captures", "image", [](const nlohmann::json& e) { return e.value("good", true); });
  if (payload.contains("scans")) out.what = "scan";
  count("scans", "cloud",
        [](const nlohmann::json& e) { return e.value("usable", true) && e.value("reason", std::string()).empty(); });
  if (payload.contains("touches")) {
    out.what = "touch";
    for (const auto& [state, number] : payload["touches"].items()) {
      out.all += number.get<std::size_t>();
      if (state == "rejected" || state == "missing") out.bad += number.get<std::size_t>();
      if (state != "missing") out.settled += number.get<std::size_t>();
    }
    return out;
  }
  std::copy_if(excluded.begin(), excluded.end(), std::inserter(files, files.end()), namesAFile);
  out.settled = files.size();
  return out;
}

std::string counted(const Checked& c, const char* which) {
  const std::string_view many = std::string_view(c.what) == "touch" ? "touches" : "";
  return fmt::format("{} of {} {}", c.bad, countOf(c.all, c.what, many), which);
}

StepReport capture(const TaskGraph& graph, const CaptureCounts& counts) {
  const CampaignFacts& facts = graph.facts();
  if (facts.log_only) return report(StepState::Current, "The campaign is a log over time: nothing to capture.");
  if (counts.planned > 0 && counts.taken < counts.planned) {
    return {counts.taken == 0 && counts.listed == 0 ? StepState::NotStarted : StepState::InProgress,
            fmt::format("{} of {} planned captures are taken.", counts.taken, counts.planned), counts.taken,
            counts.planned};
  }
  if (!facts.captures())
    return facts.own_observations ? report(StepState::Current, "The campaign holds finished observations.")
                                  : report(StepState::NotStarted, "No captures yet.");
  const char* how = facts.touches ? "Check the touches." : facts.scans ? "Check the scans." : "Check the captures.";
  StepReport step = ofTask(graph, "check", how);
  if (graph.latest("check") == nullptr) return step;
  const Checked found = checked(graph);
  if (step.state == StepState::Outdated && counts.to_check > found.settled) {
    return {StepState::InProgress, fmt::format("{} of {} captures are checked.", found.settled, counts.to_check),
            found.settled, counts.to_check};
  }
  if (step.state != StepState::Current) return step;
  if (found.bad == 0)
    return report(StepState::Current, counts.listed > counts.to_check
                                          ? "The captures checked here can be used; those of other instruments are "
                                            "judged when they are evaluated."
                                          : "All captures are checked.");
  return {StepState::Attention, counted(found, "failed the check. Take them again, or exclude them."), found.bad,
          found.all};
}

StepReport calibrate(const TaskGraph& graph, const CaptureCounts& counts) {
  const CampaignFacts& facts = graph.facts();
  if (facts.log_only) return report(StepState::Current, "The campaign is a log over time: nothing to calibrate.");
  if (!facts.captures() && facts.own_observations)
    return report(StepState::Current, "The campaign holds finished observations.");
  const char* how = facts.touches ? "Evaluate the touches."
                    : facts.scans ? "Evaluate the scans."
                                  : "Evaluate the captures.";
  StepReport step = ofTask(graph, "evaluate", how);
  if (step.state != StepState::Current) return step;
  const nlohmann::json& payload = graph.latest("evaluate")->payload;
  const nlohmann::json details = payload.value("json", nlohmann::json::object());
  const std::size_t rejected = details.value("rejected", nlohmann::json::array()).size();
  if (rejected > 0) {
    return {StepState::Attention,
            fmt::format("{} of {} captures could not be used and were left out.", rejected,
                        std::max(counts.listed, rejected)),
            rejected, std::max(counts.listed, rejected)};
  }
  if (!payload.value("good_enough", true)) {
    const std::vector<std::string> warnings = warningsOf(details);
    return warnings.empty() ? report(StepState::Attention, "The result is not good enough.") : done("", warnings);
  }
  // What the calibration of a profiler cannot determine stands beside its numbers; where it matters, another warning
  // says so.
  std::vector<std::string> findings;
  for (EvaluationWarning& w : warningsOfEvaluation(payload))
    if (w.kind == WarningKind::Finding) findings.push_back(std::move(w.sentence));
  return done("Captures are evaluated.", findings);
}

StepReport model(const TaskGraph& graph) {
  const CampaignFacts& facts = graph.facts();
  const bool over_time = graph.overTime();
  const char* task = over_time ? "thermal" : "fit";
  const char* how = over_time       ? "Identify a model over time."
                    : facts.touches ? "Separate the errors in every cycle."
                    : facts.scans   ? "Find the six errors of the axis."
                                    : "Fit the error model.";
  StepReport step = ofTask(graph, task, how);
  if (step.state != StepState::Current) return step;
  const nlohmann::json& payload = graph.latest(task)->payload;
  if (over_time) {
    if (payload.value("good_enough", true)) return report(StepState::Current, "The model is identified.");
    return report(StepState::Attention, "In the test range the model is no better than the baselines.");
  }
  const std::string status = payload.value("status", std::string("converged"));
  if (status != "converged") return report(StepState::Attention, payload.value("message", status));
  if (payload.value("rejected", false))
    return report(StepState::Attention,
                  "The model is fitted, but does not describe this state, or a point is disturbed: its residuals are "
                  "larger than the stated uncertainties allow.");
  if (facts.scans && payload.contains("scan_model")) {
    const auto& profiler = graph.data().machine.profiler;
    const std::string of_machine = profiler ? profiler->scan_model : std::string(toString(ScanModel::Rigid));
    if (payload["scan_model"] != of_machine)
      return report(StepState::Attention,
                    fmt::format("The machine description says that its scans are {}. Under another scan model the "
                                "errors are wrong by more than they say.",
                                printedName(scanModelFromString(of_machine))));
  }
  return done("The model is fitted.", warningsOf(payload));
}

StepReport discrepancy(const TaskGraph& graph) {
  StepReport step = ofTask(graph, "discrepancy", "Search for what the simulation lacks.");
  if (step.state != StepState::Current) return step;
  const nlohmann::json result = graph.latest("discrepancy")->payload.value("result", nlohmann::json::object());
  if (result.value("verdict", std::string()) == "unknown")
    return report(StepState::Attention, "Something is missing, and no effect of the catalogue explains it.");
  step.sentence = "The search is done.";
  return step;
}

StepReport compensate(const TaskGraph& graph) {
  const bool log_only = graph.facts().log_only;
  const char* task = log_only ? "log-compensation" : "compensation";
  StepReport step = ofTask(graph, task, log_only ? "Run the compensator over the log." : "Calculate the compensation.");
  if (step.state != StepState::Current) return step;
  return done(log_only ? "The compensator was run over the log." : "The compensation is calculated.",
              warningsOf(graph.latest(task)->payload));
}

StepReport verify(const TaskGraph& graph) {
  StepReport step = ofTask(graph, "verify", "Measure again with the compensation on.");
  if (step.state != StepState::Current) return step;
  const nlohmann::json& payload = graph.latest("verify")->payload;
  const std::string verdict = payload.value("verdict", std::string());
  if (verdict == "not met" || verdict == "cannot be decided")
    return report(StepState::Attention, payload.value("reason", "The goal: " + verdict + "."));
  step.sentence = "Before and after are compared.";
  return step;
}

StepReport warmUp(const TaskGraph& graph) {
  if (graph.facts().log_only)
    return report(StepState::Current, "The campaign is a log over time: no instrument to warm up.");
  // What was measured of the instrument and speaks against it is said before what somebody states.
  for (const char* check : {"check-jogs", "check-repeatability"}) {
    const StoredResult* result = graph.latest(check);
    if (result == nullptr || result->payload.value("passed", true) || !graph.status(check).current) continue;
    if (result->payload.value("status", std::string()) == toString(FitStatus::Converged))
      return report(StepState::Attention, result->payload.value("reason", std::string()));
  }
  const bool stated = warmStatement(graph).has_value();
  StepReport step = ofTask(graph, "check-warm-up", "");
  std::string found;
  if (step.state == StepState::Current) {
    try {
      const WarmUpResult result = warmUpFrom(graph.latest("check-warm-up")->payload);
      found = result.reason;
      if (result.settled) return report(StepState::Current, result.reason);
      // A drift that may be the machine's own says nothing against the operator.
      if (result.status == FitStatus::Converged && (!stated || result.cause == WarmUpCause::Instrument))
        return report(StepState::Attention, result.reason + " " + result.cause_reason);
    } catch (const InputError& e) {
      return report(StepState::Attention, e.what());
    }
  } else if (step.state != StepState::NotStarted && step.state != StepState::Blocked && !stated) {
    return step;
  }
  if (stated) return report(StepState::Current, "You stated that the instrument was warm.");
  if (!found.empty()) return report(StepState::NotStarted, found + " " + warmUpNotChecked());
  return report(StepState::NotStarted,
                graph.hasObservations() ? warmUpNotChecked() : "Check whether the instrument had settled.");
}

StepReport review(const TaskGraph& graph) {
  if (graph.facts().log_only)
    return report(StepState::Blocked, "A log over time has no points to compare; Model compares models of it.");
  if (!graph.hasObservations() && !graph.facts().scans)
    return report(StepState::Blocked, "There is nothing to compare yet.");
  const nlohmann::json seen =
      graph.session().setting(campaignKey(option_keys::reviewed, graph.campaign())).value_or(nlohmann::json());
  if (!seen.is_object()) return report(StepState::NotStarted, "Compare states, simulation and model side by side.");
  const std::vector<std::string> changed = changesOfInputs(seen, reviewedNow(graph));
  if (!changed.empty())
    return report(StepState::Outdated, fmt::format("Changed since the review: {}. Review again.", joined(changed)));
  return report(StepState::Current, "Comparison reviewed.");
}

std::size_t rowsOf(const Campaign& campaign, const char* list) {
  const auto file = campaign.captureList(list);
  if (!file) return 0;
  try {
    return CsvTable::read(*file).rowCount();
  } catch (const InputError&) {
    return 0;
  }
}

}  // namespace

std::optional<nlohmann::json> warmStatement(const TaskGraph& graph) {
  nlohmann::json given =
      graph.session().setting(campaignKey(option_keys::warm_statement, graph.campaign())).value_or(nlohmann::json());
  if (given.is_object() && given.contains("by")) return given;
  // Sessions of earlier versions keep it as a result; an empty object takes that back.
  const StoredResult* result = given.is_null() ? graph.latest("warm-up") : nullptr;
  return result == nullptr ? std::nullopt : std::optional(result->payload);
}

nlohmann::json reviewedNow(const TaskGraph& graph) {
  nlohmann::json now = graph.session().inputs(graph.campaign());
  for (const char* kind : {"evaluate", "fit"}) now[kind] = graph.fingerprintOf(kind);
  return now;
}

std::string_view toString(StepId step) noexcept {
  constexpr std::array names{"Machine",     "Warm-up",    "Capture", "Calibrate", "Model",
                             "Discrepancy", "Compensate", "Verify",  "Review",    "Report"};
  return names[static_cast<std::size_t>(step)];
}

std::string_view toString(StepState state) noexcept {
  constexpr std::array names{"not started", "in progress", "attention", "done", "outdated", "blocked"};
  return names[static_cast<std::size_t>(state)];
}

CaptureCounts CaptureCounts::of(const TaskGraph& graph) {
  CaptureCounts counts;
  for (const char* list : {"fiducials.csv", "touches.csv", "scans.csv"}) {
    const std::size_t rows = rowsOf(graph.data(), list);
    if (counts.listed == 0) counts.to_check = rows;
    counts.listed += rows;
  }
  const auto kept = graph.session().setting(campaignKey(option_keys::plan, graph.campaign()));
  if (!kept || !kept->is_object() || kept->empty()) return counts;
  try {
    const MeasurementPlan plan = MeasurementPlan::parse(JsonNode::parse(kept->dump(), "the plan of the session"));
    counts.planned = plan.items.size();
    counts.taken = capturedItems(plan, graph.data()).size();
  } catch (const InputError&) {
    counts.planned = counts.taken = 0;
  }
  return counts;
}

namespace {

StepReport readReport(const TaskGraph& graph, StepId step, const CaptureCounts& counts) {
  switch (step) {
    case StepId::Machine: {
      if (const std::vector<std::string> outside = pointsOutsideTravel(graph.data().machine); !outside.empty())
        return report(StepState::Attention, outside.front());
      const nlohmann::json edited =
          graph.session().setting(Session::machineKey(graph.campaign())).value_or(nlohmann::json());
      return report(StepState::Current, edited.empty() ? "As in machine.json." : "Edited in this session.");
    }
    case StepId::WarmUp:
      return warmUp(graph);
    case StepId::Capture:
      return capture(graph, counts);
    case StepId::Calibrate:
      return calibrate(graph, counts);
    case StepId::Model:
      return model(graph);
    case StepId::Discrepancy:
      return discrepancy(graph);
    case StepId::Compensate:
      return compensate(graph);
    case StepId::Verify:
      return verify(graph);
    case StepId::Review:
      return review(graph);
    case StepId::Report: {
      StepReport step_report = ofTask(graph, "report", "Write the report.");
      if (step_report.state != StepState::Current) return step_report;
      const std::string file = graph.latest("report")->payload.value("file", std::string());
      if (std::error_code none; !std::filesystem::is_regular_file(graph.session().folder() / file, none))
        return report(StepState::Attention, "The file of the report is gone. Write it again.");
      step_report.sentence = "The report is written.";
      return step_report;
    }
  }
  return {};
}

}  // namespace

StepReport stepReport(const TaskGraph& graph, StepId step, const CaptureCounts& counts) try {
  return readReport(graph, step, counts);
} catch (const nlohmann::json::exception&) {
  // A session that somebody else wrote, or that is damaged.
  return report(StepState::Outdated, "The stored result cannot be read. Run it again.");
}

std::string taskOfStep(const TaskGraph& graph, StepId step) {
  switch (step) {
    case StepId::WarmUp:
      return graph.facts().log_only ? "" : "check-warm-up";
    case StepId::Capture:
      return "check";
    case StepId::Calibrate:
      return "evaluate";
    case StepId::Model:
      return graph.overTime() ? "thermal" : "fit";
    case StepId::Discrepancy:
      return "discrepancy";
    case StepId::Compensate:
      return graph.facts().log_only ? "log-compensation" : "compensation";
    case StepId::Verify:
      return "verify";
    case StepId::Report:
      return "report";
    default:
      return {};
  }
}

}  // namespace spindrift
