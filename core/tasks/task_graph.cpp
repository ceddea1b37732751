// SPDX-License-Identifier: Apache-2.0
#include "core/tasks/task_graph.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "core/base/count_text.h"
#include "core/base/error.h"
#include "core/tasks/task_options.h"

namespace spindrift {
namespace {

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

/// Inputs and options by the names that the session keeps them under. Results of tasks say it themselves.
constexpr std::array<std::pair<std::string_view, std::string_view>, 9> words{
    {{"files", "files of the campaign"},
     {"machine", "the machine"},
     {"clocks", "offsets of the clocks"},
     {"after", "the second campaign"},
     {"discrepancy", "the effects in the model"},
     {"notes", "the notes"},
     {"plan", "the measurement plan"},
     {"reasons", "reasons of exclusions"},
     {"simulator", "the simulator"}}};

std::string_view wordsFor(std::string_view name) {
  const auto* const found = std::find_if(words.begin(), words.end(), [&](const auto& w) { return w.first == name; });
  return found == words.end() ? std::string_view() : found->second;
}

std::string described(const std::string& input, const nlohmann::json& then, const nlohmann::json& now) {
  if (input == "exclusions" && then.is_array()) return exclusionsChanged(then, now);
  if (input == "revision") return "the version of the program";
  if (const TaskKind* task = taskKind(input); task != nullptr && !task->result.empty())
    return std::string(task->result);
  const std::string_view text = wordsFor(input);
  return std::string(text.empty() ? input : text);
}

}  // namespace

const TaskKind* taskKind(std::string_view id) noexcept {
  const std::span<const TaskKind> all = taskKinds();
  const auto found = std::find_if(all.begin(), all.end(), [&](const TaskKind& kind) { return kind.id == id; });
  return found == all.end() ? nullptr : &*found;
}

const TaskKind& taskKind(std::string_view id, const CampaignFacts& facts) {
  const TaskKind* last = nullptr;
  for (const TaskKind& kind : taskKinds()) {
    if (kind.id != id) continue;
    last = &kind;
    if (kind.is_for == nullptr || kind.is_for(facts)) break;
  }
  if (last == nullptr) throw InputError(fmt::format("{} is no task of a campaign.", id));
  return *last;
}

std::string_view toString(TaskState state) noexcept {
  constexpr std::array names{"not run", "blocked", "running", "current", "outdated", "failed"};
  return names[static_cast<std::size_t>(state)];
}

void TaskLedger::started(const ResultOrigin& origin) {
  Entry& entry = entries_[{origin.campaign, origin.kind}];
  entry.running.push_back(origin);
  entry.failure.clear();
}

void TaskLedger::ended(const ResultOrigin& origin) {
  const auto found = entries_.find({origin.campaign, origin.kind});
  if (found == entries_.end()) return;
  std::vector<ResultOrigin>& running = found->second.running;
  const auto same =
      std::find_if(running.begin(), running.end(), [&](const ResultOrigin& o) { return o.sameAs(origin); });
  if (same != running.end()) running.erase(same);
}

void TaskLedger::failed(const ResultOrigin& origin, const std::string& sentence) {
  ended(origin);
  Entry& entry = entries_[{origin.campaign, origin.kind}];
  entry.failed_with = origin;
  entry.failure = sentence;
}

bool TaskLedger::running(std::int64_t campaign, const std::string& task) const {
  const auto found = entries_.find({campaign, task});
  return found != entries_.end() && !found->second.running.empty();
}

bool TaskLedger::running(const ResultOrigin& now) const {
  const auto found = entries_.find({now.campaign, now.kind});
  return found != entries_.end() && std::any_of(found->second.running.begin(), found->second.running.end(),
                                                [&](const ResultOrigin& o) { return o.sameAs(now); });
}

const std::string* TaskLedger::failure(const ResultOrigin& now) const {
  const auto found = entries_.find({now.campaign, now.kind});
  if (found == entries_.end() || found->second.failure.empty()) return nullptr;
  const ResultOrigin& then = found->second.failed_with;
  return then.sameAs(now) ? &found->second.failure : nullptr;
}

TaskGraph::TaskGraph(const Session& session, std::int64_t campaign, std::shared_ptr<const Campaign> data, Latest latest,
                     const TaskLedger& ledger)
    : session_(session),
      campaign_(campaign),
      data_(std::move(data)),
      facts_(CampaignFacts::of(*data_)),
      latest_(std::move(latest)),
      ledger_(ledger) {}

const StoredResult* TaskGraph::latest(const std::string& kind) const {
  // Inputs and options do not change while this is used, and to compare all results with them takes a while.
  const auto found = found_.find(kind);
  return found != found_.end() ? found->second : found_[kind] = latest_(*this, kind);
}

const StoredResult* TaskGraph::newestThatHolds(std::span<const StoredResult> results) const {
  if (results.empty()) return nullptr;
  const TaskKind* one = kind(results.front().kind);
  if (results.size() == 1 || (one != nullptr && one->writes_files)) return &results.back();
  const auto found = std::find_if(results.rbegin(), results.rend(), [this](const StoredResult& r) { return holds(r); });
  return found == results.rend() ? &results.back() : &*found;
}

bool TaskGraph::hasObservations() const {
  return facts_.own_observations || latest("evaluate") != nullptr;
}

bool TaskGraph::overTime() const {
  if (!facts_.log) return false;
  return facts_.log_only ||
         session_.setting(campaignKey(option_keys::over_time, campaign_)).value_or(nlohmann::json(false)) == true;
}

std::vector<std::string> TaskGraph::tasks() const {
  std::vector<std::string> all;
  for (const TaskKind& one : taskKinds())
    if ((all.empty() || all.back() != one.id) && one.belongs(*this)) all.emplace_back(one.id);
  return all;
}

const TaskKind* TaskGraph::kind(const std::string& task) const {
  return taskKind(task) == nullptr ? nullptr : &taskKind(task, facts_);
}

std::vector<std::string> TaskGraph::madeFrom(const std::string& task) const {
  const TaskKind* one = kind(task);
  return one == nullptr || one->made_from == nullptr ? std::vector<std::string>() : one->made_from(*this);
}

nlohmann::json TaskGraph::inputsOfResults(const std::string& task) const {
  nlohmann::json inputs = nlohmann::json::object();
  for (const std::string& kind : madeFrom(task)) inputs[kind] = fingerprintOf(kind);
  const TaskKind* one = kind(task);
  if (one == nullptr) return inputs;
  inputs["revision"] = one->revision;
  if (one->add_inputs != nullptr) one->add_inputs(*this, inputs);
  return inputs;
}

std::string TaskGraph::fingerprintOf(const std::string& kind) const {
  const StoredResult* result = latest(kind);
  return result == nullptr ? std::string() : result->provenance.inputs_fingerprint;
}

ResultOrigin TaskGraph::origin(const std::string& task, const nlohmann::json& more) const {
  const TaskKind* one = kind(task);
  nlohmann::json all = one == nullptr ? nlohmann::json::object() : one->options(*this);
  if (more.is_object()) all.update(more);
  return session_.originOf(campaign_, task, all, inputsOfResults(task));
}

std::vector<std::string> changesOfInputs(const nlohmann::json& then, const nlohmann::json& now) {
  std::vector<std::string> changed;
  for (const auto& [name, value] : now.items()) {
    // What an earlier version did not know of counts as not there.
    const nlohmann::json before = then.value(name, value == "" ? value : nlohmann::json());
    if (before != value) changed.push_back(described(name, before, value));
  }
  return changed;
}

std::vector<std::string> TaskGraph::changes(const StoredResult& result, const ResultOrigin& now) const {
  if (result.provenance.inputs.empty()) return {"what it was made from is not known to this version"};
  const TaskKind* one = kind(result.kind);
  Provenance then = result.provenance;
  // Versions that counted no revisions gave the first.
  if (!then.inputs.contains("revision")) then.inputs["revision"] = 1;
  if (one != nullptr && one->as_now != nullptr) one->as_now(then, now);
  // As they would be written now: earlier versions wrote less. Options beyond those belong to whoever added them.
  then.options = one == nullptr ? now.options : one->options_of(then.options);
  std::vector<std::string> changed = changesOfInputs(then.inputs, now.inputs);
  for (const nlohmann::json& differing : {now.options, then.options})
    for (const auto& [name, unused] : differing.items()) {
      if (then.options.value(name, nlohmann::json()) == now.options.value(name, nlohmann::json())) continue;
      changed.emplace_back(wordsFor(name).empty() ? "the options" : wordsFor(name));
    }
  std::vector<std::string> once;
  for (std::string& text : changed)
    if (std::find(once.begin(), once.end(), text) == once.end()) once.push_back(std::move(text));
  return once;
}

std::vector<std::string> TaskGraph::changes(const StoredResult& result) const {
  if (result.provenance.inputs.empty()) return changes(result, {});
  std::vector<std::string> changed = changes(result, origin(result.kind));
  for (const std::string& kind : madeFrom(result.kind)) {
    const StoredResult* from = latest(kind);
    if (from == nullptr || changes(*from).empty()) continue;
    std::string outdated = described(kind, {}, {}) + " is outdated";
    if (std::find(changed.begin(), changed.end(), outdated) == changed.end()) changed.push_back(std::move(outdated));
  }
  return changed;
}

bool TaskGraph::holds(const StoredResult& result) const {
  return changes(result).empty();
}

std::string TaskGraph::blockedBecause(const std::string& task) const {
  const TaskKind* one = kind(task);
  if (one == nullptr) return {};
  std::string why = one->blocked == nullptr ? std::string() : one->blocked(*this);
  if (why.empty() && one->of_observations && !hasObservations()) why = nothing_evaluated;
  return why;
}

TaskStatus TaskGraph::status(const std::string& task) const {
  TaskStatus status;
  if (const StoredResult* result = latest(task)) {
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
  if (const TaskKind* one = kind(task); one != nullptr && one->after != nullptr)
    for (std::string& before : one->after(*this)) first.push_back(std::move(before));
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
