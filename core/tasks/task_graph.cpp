// SPDX-License-Identifier: Apache-2.0
#include "core/tasks/task_graph.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "core/base/count_text.h"
#include "core/base/error.h"
#include "core/session/fingerprint.h"
#include "core/tasks/task_options.h"
#include "core/workflows/report_workflow.h"

namespace spindrift {
namespace {

constexpr std::array kinds{
    TaskKind{.id = "check"},
    TaskKind{.id = "evaluate"},
    TaskKind{.id = "check-jogs", .of_observations = true, .told = true},
    TaskKind{.id = "check-repeatability", .of_observations = true, .told = true},
    TaskKind{.id = "fit", .of_observations = true},
    TaskKind{.id = "thermal", .told = true},
    TaskKind{.id = "log-compensation", .told = true},
    TaskKind{.id = "discrepancy", .of_observations = true},
    TaskKind{.id = "simulation", .of_observations = true, .told = true, .starts_programs = true},
    TaskKind{.id = "compensation", .of_observations = true, .told = true},
    TaskKind{.id = "verify", .of_observations = true, .told = true},
    TaskKind{.id = "report"},
};

bool isReport(const std::string& task) {
  return task == "report";
}

/// What differs between two lists of exclusions, in words.
std::string exclusionsChanged(const nlohmann::json& then, const nlohmann::json& now) {
  const auto others = [](const nlohmann::json& of, const nlohmann::json& than) {
    return static_cast<std::size_t>(std::count_if(of.begin(), of.end(), [&](const nlohmann::json& item) {
      return std::find(than.begin(), than.end(), item) == than.end();
    }));
  };
  const std::size_t out = others(now, then);
  const std::size_t back = others(then, now);
  if (back == 0) return fmt::format("{} more", countOf(out, "exclusion"));
  if (out == 0) return fmt::format("{} taken back", countOf(back, "exclusion"));
  return fmt::format("{} more, {} taken back", countOf(out, "exclusion"), back);
}

std::string described(const std::string& input, const nlohmann::json& then, const nlohmann::json& now) {
  if (input == "exclusions" && then.is_array()) return exclusionsChanged(then, now);
  if (input == "files") return "files of the campaign";
  if (input == "machine") return "the machine";
  if (input == "clocks") return "offsets of the clocks";
  if (input == "program") return then.is_string() ? "the version of the program" : "what it was made from is not known";
  if (input == "after") return "the second campaign";
  if (input == "evaluate") return "the evaluation";
  if (input == "fit") return "the fitted model";
  if (input == "thermal") return "the model over time";
  if (input == "discrepancy") return "the effects in the model";
  if (input == "notes") return "the notes";
  if (input == "plan") return "the measurement plan";
  if (input == "reasons") return "reasons of exclusions";
  if (input == "simulator") return "the simulator";
  return input;
}

bool isInstrumentCheck(const std::string& task) {
  return task == "check-jogs" || task == "check-repeatability";
}

/// A search with a simulator that wrote a new version of it counts as one with the version while that is at hand.
Provenance asOfVersion(Provenance then, const ResultOrigin& now) {
  const std::string version = then.options.value("version", "");
  then.options["version"] = "";
  if (version.empty() || version != now.options.value("simulator", "")) return then;
  then.options["simulator"] = version;
  then.inputs["simulator"] = then.options.value("written", "");
  return then;
}

}  // namespace

std::span<const TaskKind> taskKinds() noexcept {
  return kinds;
}

const TaskKind* taskKind(std::string_view id) noexcept {
  const auto* const found =
      std::find_if(kinds.begin(), kinds.end(), [&](const TaskKind& kind) { return kind.id == id; });
  return found == kinds.end() ? nullptr : found;
}

std::string_view toString(TaskState state) noexcept {
  constexpr std::array names{"not run", "blocked", "running", "current", "outdated", "failed"};
  return names[static_cast<std::size_t>(state)];
}

void TaskLedger::started(const ResultOrigin& origin) {
  Entry& entry = entries_[{origin.campaign, origin.kind}];
  ++entry.running;
  entry.failure.clear();
}

void TaskLedger::ended(const ResultOrigin& origin) {
  const auto found = entries_.find({origin.campaign, origin.kind});
  if (found != entries_.end() && found->second.running > 0) --found->second.running;
}

void TaskLedger::failed(const ResultOrigin& origin, const std::string& sentence) {
  ended(origin);
  Entry& entry = entries_[{origin.campaign, origin.kind}];
  entry.failed_with = origin;
  entry.failure = sentence;
}

bool TaskLedger::running(std::int64_t campaign, const std::string& task) const {
  const auto found = entries_.find({campaign, task});
  return found != entries_.end() && found->second.running > 0;
}

const std::string* TaskLedger::failure(const ResultOrigin& now) const {
  const auto found = entries_.find({now.campaign, now.kind});
  if (found == entries_.end() || found->second.failure.empty()) return nullptr;
  const ResultOrigin& then = found->second.failed_with;
  return then.inputs == now.inputs && then.options == now.options ? &found->second.failure : nullptr;
}

TaskGraph::TaskGraph(const Session& session, std::int64_t campaign, std::shared_ptr<const Campaign> data, Latest latest,
                     const TaskLedger& ledger)
    : session_(session),
      campaign_(campaign),
      data_(std::move(data)),
      facts_(CampaignFacts::of(*data_)),
      latest_(std::move(latest)),
      ledger_(ledger) {}

bool TaskGraph::hasObservations() const {
  return facts_.own_observations || latest_("evaluate") != nullptr;
}

bool TaskGraph::overTime() const {
  if (!facts_.log) return false;
  return facts_.log_only ||
         session_.setting(campaignKey(option_keys::over_time, campaign_)).value_or(nlohmann::json(false)) == true;
}

std::vector<std::string> TaskGraph::tasks() const {
  std::vector<std::string> all;
  if (facts_.captures()) all.insert(all.end(), {"check", "evaluate"});
  const bool has_simulator = !SimulationOptions::of(session_, campaign_, *data_).simulator.empty();
  if (facts_.log_only) {
    all.insert(all.end(), {"thermal", "log-compensation", "report"});
    return all;
  }
  all.insert(all.end(), {"check-jogs", "check-repeatability", "fit"});
  if (facts_.log) all.emplace_back("thermal");
  if (facts_.simulation) all.emplace_back("discrepancy");
  if (has_simulator) all.emplace_back("simulation");
  all.insert(all.end(), {"compensation", "verify", "report"});
  return all;
}

nlohmann::json TaskGraph::options(const std::string& task) const {
  const auto kept = [&](const char* key) {
    return session_.setting(campaignKey(key, campaign_)).value_or(nlohmann::json());
  };
  const auto object = [&](const char* key) {
    nlohmann::json value = kept(key);
    return value.is_object() ? value : nlohmann::json::object();
  };
  const nlohmann::json fit =
      campaignSetting(session_, campaign_, option_keys::nine_parameters, nlohmann::json::object());
  if (task == "fit") {
    if (facts_.touches) return {{"model", "cycles"}, {"options", object(option_keys::cycles)}};
    if (facts_.scans) {
      const nlohmann::json model = kept(option_keys::scan_model);
      return {{"model", "axis-errors"}, {"scan_model", model.is_string() ? model : nlohmann::json("")}};
    }
    return {{"model", "nine-parameter"}, {"options", fit.is_object() ? fit : nlohmann::json::object()}};
  }
  if (task == "thermal") return {{"model", "thermal"}, {"options", object(option_keys::thermal)}};
  const nlohmann::json effects = EffectOptions::of(session_, campaign_).json();
  if (task == "discrepancy") return {{"discrepancy", effects}};
  if (task == "simulation") return SimulationOptions::of(session_, campaign_, *data_).json();
  if (isInstrumentCheck(task)) return {{"part", allowedPart(task)}};
  if (task == "compensation") {
    const CompensationRequest request = compensationRequest(session_, campaign_, latest_("fit") != nullptr);
    return {{"options", object(option_keys::compensation)},
            {"source", std::string(toString(request.source))},
            {"fit", fit},
            {"discrepancy", effects}};
  }
  if (task == "verify") return {{"options", VerifyOptions::of(session_, campaign_).json()}};
  if (isReport(task)) {
    const ReportTaskOptions report = ReportTaskOptions::of(session_, campaign_);
    nlohmann::json warm = kept(option_keys::warm_statement);
    return {{"operator", report.operator_name},
            {"tells_discrepancy", report.tells_discrepancy},
            {"notes", report.notes.empty() ? nlohmann::json() : nlohmann::json(report.notes)},
            {"discrepancy", effects},
            {"fit", fit},
            {"warm", warm.is_object() && warm.contains("by") ? warm : nlohmann::json()},
            {"simulator", kept(option_keys::simulator)}};
  }
  return nlohmann::json::object();
}

std::vector<std::string> TaskGraph::madeFrom(const std::string& task) const {
  if (task == "check" || task == "evaluate") return {};
  if (task == "log-compensation") return {"thermal"};
  // Captures are evaluated on the way: what comes from a campaign's own observations has no other input.
  if (facts_.own_observations || !facts_.captures()) return {};
  return {"evaluate"};
}

nlohmann::json TaskGraph::inputsOfResults(const std::string& task) const {
  nlohmann::json inputs = nlohmann::json::object();
  const auto add = [&](const std::string& kind) {
    const StoredResult* result = latest_(kind);
    inputs[kind] = result == nullptr ? std::string() : result->provenance.inputs_fingerprint;
  };
  for (const std::string& kind : madeFrom(task)) add(kind);
  if (isReport(task)) {
    // The report has to be written again when there are others.
    for (const TaskKind& kind : kinds)
      if (kind.told) add(std::string(kind.id));
    // What is printed word by word, beside the notes (an option).
    Fingerprint reasons;
    for (const Exclusion& exclusion : session_.exclusions(campaign_)) reasons.add(exclusion.item).add(exclusion.reason);
    const auto plan = session_.setting(campaignKey(option_keys::plan, campaign_)).value_or(nlohmann::json());
    inputs["reasons"] = reasons.text();
    inputs["plan"] = Fingerprint().add(plan.dump()).text();
  }
  if (task == "simulation") {
    const std::string name = SimulationOptions::of(session_, campaign_, *data_).simulator;
    inputs["simulator"] = name.empty() ? std::string() : simulatorFingerprint(simulatorFile(session_, name));
  }
  if (task == "verify") {
    const std::string folder = VerifyOptions::of(session_, campaign_).after;
    inputs["after"] = "";
    for (const CampaignRecord& record : session_.campaigns())
      if (record.id != campaign_ && record.folder == folder) inputs["after"] = record.fingerprint;
  }
  return inputs;
}

ResultOrigin TaskGraph::origin(const std::string& task, const nlohmann::json& more) const {
  nlohmann::json all = options(task);
  if (more.is_object()) all.update(more);
  return session_.originOf(campaign_, task, all, inputsOfResults(task));
}

std::vector<std::string> TaskGraph::changes(const StoredResult& result) const {
  const ResultOrigin now = origin(result.kind);
  const std::optional<Provenance> of_version =
      result.kind == "simulation" ? std::optional(asOfVersion(result.provenance, now)) : std::nullopt;
  const Provenance& then = of_version ? *of_version : result.provenance;
  if (result.provenance.inputs.empty()) return {"what it was made from is not known to this version"};
  std::vector<std::string> changed;
  for (const auto& [name, value] : now.inputs.items()) {
    const nlohmann::json before = then.inputs.value(name, nlohmann::json());
    if (before != value) changed.push_back(described(name, before, value));
  }
  // Options beyond those that the session keeps belong to whoever added them.
  for (const auto& [name, value] : now.options.items()) {
    if (then.options.value(name, nlohmann::json()) == value) continue;
    const bool named = name == "discrepancy" || name == "notes" || name == "simulator";
    changed.push_back(named ? described(name, {}, {}) : "the options");
  }
  for (const std::string& kind : madeFrom(result.kind)) {
    const StoredResult* from = latest_(kind);
    if (from != nullptr && !changes(*from).empty()) changed.push_back(described(kind, {}, {}) + " is outdated");
  }
  std::vector<std::string> once;
  for (std::string& text : changed)
    if (std::find(once.begin(), once.end(), text) == once.end()) once.push_back(std::move(text));
  return once;
}

bool TaskGraph::holds(const StoredResult& result) const {
  return changes(result).empty();
}

std::string TaskGraph::blockedBecause(const std::string& task) const {
  if (task == "check" || task == "evaluate")
    return facts_.captures() ? std::string() : "There are no captures to evaluate yet.";
  if (task == "thermal") return facts_.log ? std::string() : "The campaign has no log.";
  if (task == "log-compensation")
    return latest_("thermal") != nullptr ? std::string() : "Identify a model over time first (Model).";
  if (task == "discrepancy" && !facts_.simulation) return "This campaign comes without a simulation to compare with.";
  if (task == "simulation" && SimulationOptions::of(session_, campaign_, *data_).simulator.empty())
    return "There is no simulator to search with: campaign.json names none and none was chosen (Discrepancy).";
  if (isReport(task)) return canReport(*data_, hasObservations()) ? std::string() : "There is nothing to report yet.";
  if (task == "verify" && facts_.log_only)
    return "A log alone has no plan that could be measured again. Log the machine with the compensation on and open "
           "that log as a campaign of its own.";
  if (task == "compensation" && latest_("fit") == nullptr && EffectOptions::of(session_, campaign_).added.empty())
    return facts_.simulation ? "Fit a model or add a missing effect to the simulation first." : "Fit a model first.";
  if (const TaskKind* kind = taskKind(task); kind != nullptr && kind->of_observations)
    return hasObservations() ? std::string() : "Evaluate the captures first (Calibrate).";
  return {};
}

TaskStatus TaskGraph::status(const std::string& task) const {
  TaskStatus status;
  if (const StoredResult* result = latest_(task)) {
    status.result = result->id;
    status.changed = changes(*result);
    status.current = status.changed.empty();
    status.state = status.current ? TaskState::Current : TaskState::Outdated;
  }
  if (ledger_.running(campaign_, task)) {
    status.state = TaskState::Running;
    return status;
  }
  if (!status.current) {
    if (const std::string* why = ledger_.failure(origin(task))) {
      status.state = TaskState::Failed;
      status.reason = *why;
    } else if (std::string why_not = blockedBecause(task); !why_not.empty()) {
      status.state = TaskState::Blocked;
      status.reason = std::move(why_not);
    }
  }
  return status;
}

std::vector<std::string> TaskGraph::runFirst(const std::string& task) const {
  std::vector<std::string> first = madeFrom(task);
  if (task == "compensation" && latest_("fit") == nullptr && EffectOptions::of(session_, campaign_).added.empty())
    first.emplace_back("fit");
  return first;
}

std::vector<std::string> TaskGraph::needed(const std::string& task, std::string& why) const {
  std::vector<std::string> order;
  for (const std::string& kind : runFirst(task)) {
    for (std::string& first : needed(kind, why))
      if (std::find(order.begin(), order.end(), first) == order.end()) order.push_back(std::move(first));
    if (!why.empty()) return {};
  }
  const TaskStatus now = status(task);
  const std::vector<std::string> all = tasks();
  const bool possible = std::find(all.begin(), all.end(), task) != all.end();
  if (now.state == TaskState::Blocked && (order.empty() || !possible)) {
    why = now.reason;
    return {};
  }
  if (!order.empty() || !now.current) order.push_back(task);
  return order;
}

std::vector<std::string> TaskGraph::needed(const std::string& task) const {
  std::string why;
  std::vector<std::string> order = needed(task, why);
  if (!why.empty()) throw InputError({data_->folder, ""}, fmt::format("{} cannot be run: {}", task, why));
  return order;
}

std::string TaskGraph::whyNot(const std::string& task) const {
  std::string why;
  (void)needed(task, why);
  return why;
}

}  // namespace spindrift
