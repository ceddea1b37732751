// SPDX-License-Identifier: Apache-2.0
// Which work there is on a campaign, what each result is made from, and whether it still holds. Pages, the list of
// steps, reports and the command line ask here and nowhere else.
//
//   files, exclusions, machine, clocks               Session::inputs
//        |
//      check   evaluate ---+--- fit ---+--- compensation ---+
//                          +--- thermal --- log-compensation +--- report
//                          +--- discrepancy                 |
//                          +--- verify ---------------------+
//                          +--- check-warm-up, check-jogs, check-repeatability
//                          +--- simulation (a search that runs a simulator)
//
// A result is current if every input is what it was when the work on it started, and every result that it was made from
// is current itself. An input of another result is that result's own fingerprint: evaluating again with nothing changed
// leaves a fit current, evaluating again with other captures does not, whichever of the two ran first.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/job_context.h"
#include "core/machine/campaign.h"
#include "core/session/session.h"
#include "core/tasks/campaign_facts.h"

namespace spindrift {

class TaskGraph;
struct TaskInputs;
struct TaskResult;
/// What is asked of the work: the payload to be stored, the detail to be shown, or both.
enum class TaskOutput { Payload, Detail, Both };
/// Work that is ready to be run, by any thread. Throws InputError and Cancelled.
using TaskWork = std::function<TaskResult(JobContext&, TaskOutput)>;

/// A task as it is declared (task_kinds.cpp): all that graph, list of steps, window and command line ask of it. Tasks
/// of one id are one task to the user whose work, options and result differ by what the campaign consists of.
struct TaskKind {
  std::string_view id;
  std::string_view title;   ///< while it runs: "Fitting all cycles"
  std::string_view result;  ///< what has changed when its result has: "the fitted model"
  /// Counted up with every change of the program that gives another result from the same inputs and options: results of
  /// an earlier one are outdated. A new version of the program alone outdates nothing.
  int revision = 1;
  bool of_observations = false;  ///< works on observations: captures have to be evaluated first
  bool told = false;             ///< a report shows its result as it is, and says whether it still holds
  bool writes_files = false;     ///< over those of its run before: no earlier result is there any more
  bool starts_programs = false;  ///< runs programs that a file names: only when somebody asks for this task itself
  /// Of tasks of one id the first whose answer is true, else the last.
  bool (*is_for)(const CampaignFacts&) = nullptr;
  /// Whether the campaign has this task.
  bool (*belongs)(const TaskGraph&) = nullptr;
  /// Why it cannot be run, beside missing observations; empty: it can. Null: nothing else keeps it.
  std::string (*blocked)(const TaskGraph&) = nullptr;
  /// Results of other tasks that are inputs of this one; null: none.
  std::vector<std::string> (*made_from)(const TaskGraph&) = nullptr;
  /// What has to be there before without being an input; null: nothing.
  std::vector<std::string> (*after)(const TaskGraph&) = nullptr;
  /// Inputs beside those of every task and the results of others; null: none.
  void (*add_inputs)(const TaskGraph&, nlohmann::json& inputs) = nullptr;
  /// Takes a result for what it counts as now, before it is compared; null: for what it is.
  void (*as_now)(Provenance& then, const ResultOrigin& now) = nullptr;
  // From the types of its options and result.
  /// Options as the session keeps them for the campaign; and those of a stored result, as they would be written now.
  nlohmann::json (*options)(const TaskGraph&) = nullptr;
  nlohmann::json (*options_of)(const nlohmann::json& stored) = nullptr;
  TaskWork (*prepare)(const TaskGraph&, const TaskInputs&) = nullptr;
};
/// All tasks that there are, each after those it is made from; those of one id follow each other.
[[nodiscard]] std::span<const TaskKind> taskKinds() noexcept;
/// Why there are no observations to work on.
inline constexpr std::string_view nothing_evaluated = "Evaluate the captures first (Calibrate).";
/// The first of this id. Null: there is no such task.
[[nodiscard]] const TaskKind* taskKind(std::string_view id) noexcept;
/// The one for this campaign. Throws InputError: there is no such task.
[[nodiscard]] const TaskKind& taskKind(std::string_view id, const CampaignFacts& facts);

enum class TaskState {
  NotRun,
  Blocked,  ///< cannot be run yet; `reason` says why
  Running,
  Current,
  Outdated,  ///< `changed` says what
  Failed,    ///< with the inputs as they are; `reason` says why
};
[[nodiscard]] std::string_view toString(TaskState state) noexcept;

struct TaskStatus {
  TaskState state = TaskState::NotRun;
  std::int64_t result = 0;           ///< the latest; 0: there is none. Stays while the task runs or has failed
  bool current = false;              ///< that result holds, whatever is being done now
  std::vector<std::string> changed;  ///< "2 exclusions", "the options": what it was made from and is other now
  std::string reason;
};

/// What runs and what went wrong, of all campaigns of a session. In memory: nothing runs any more when a program
/// starts.
class TaskLedger {
 public:
  void started(const ResultOrigin& origin);
  /// Done or given up.
  void ended(const ResultOrigin& origin);
  void failed(const ResultOrigin& origin, const std::string& sentence);
  [[nodiscard]] bool running(std::int64_t campaign, const std::string& task) const;
  /// Whether it runs, or waits to, on exactly these inputs and options: what it will give need not be asked for again.
  [[nodiscard]] bool running(const ResultOrigin& now) const;
  /// Why it failed with exactly these inputs and options; null if it did not.
  [[nodiscard]] const std::string* failure(const ResultOrigin& now) const;

 private:
  struct Entry {
    std::vector<ResultOrigin> running;
    ResultOrigin failed_with;
    std::string failure;
  };
  std::map<std::pair<std::int64_t, std::string>, Entry> entries_;
};

/// What of the inputs of an origin is other than it was: "1 exclusion more", "the fitted model".
[[nodiscard]] std::vector<std::string> changesOfInputs(const nlohmann::json& then, const nlohmann::json& now);

/// The tasks of one campaign; cheap to make, holds nothing of its own.
class TaskGraph {
 public:
  /// The latest result of a kind (newestThatHolds), null if there is none. Payloads are read by the steps alone.
  using Latest = std::function<const StoredResult*(const TaskGraph&, const std::string&)>;

  TaskGraph(const Session& session, std::int64_t campaign, std::shared_ptr<const Campaign> data, Latest latest,
            const TaskLedger& ledger);

  /// The tasks that this campaign has, each after those it is made from.
  [[nodiscard]] std::vector<std::string> tasks() const;
  [[nodiscard]] TaskStatus status(const std::string& task) const;
  /// Whether a result, the latest or an earlier one, is what the task would give now.
  [[nodiscard]] bool holds(const StoredResult& result) const;
  /// What a result was made from and is other now: "1 exclusion more", "the options". Nothing: it holds.
  [[nodiscard]] std::vector<std::string> changes(const StoredResult& result) const;
  /// The same against what the task was, or would be, run on (`origin`), whatever has become of the results it is made
  /// from.
  [[nodiscard]] std::vector<std::string> changes(const StoredResult& result, const ResultOrigin& now) const;
  /// Of these results of a kind, oldest first: work that was begun on other inputs or options and ends later takes
  /// nothing away from a result that holds. The newest where none holds; null: there is none.
  [[nodiscard]] const StoredResult* newestThatHolds(std::span<const StoredResult> results) const;
  /// What the task would be run on now; to be called when its work starts. `options` are added to those that the
  /// session keeps for the task.
  [[nodiscard]] ResultOrigin origin(const std::string& task,
                                    const nlohmann::json& options = nlohmann::json::object()) const;
  /// What has to be run, in this order, so that the task is current; empty if it is. Throws InputError: blocked.
  [[nodiscard]] std::vector<std::string> needed(const std::string& task) const;
  /// Why the task cannot be run, whatever is run first; empty: it can.
  [[nodiscard]] std::string whyNot(const std::string& task) const;

  [[nodiscard]] const StoredResult* latest(const std::string& kind) const;
  [[nodiscard]] const CampaignFacts& facts() const { return facts_; }
  [[nodiscard]] const Session& session() const { return session_; }
  [[nodiscard]] std::int64_t campaign() const { return campaign_; }
  [[nodiscard]] const Campaign& data() const { return *data_; }
  /// Of what the latest result of a kind was made from; empty: there is none.
  [[nodiscard]] std::string fingerprintOf(const std::string& kind) const;
  [[nodiscard]] bool hasObservations() const;
  /// Whether the model of this campaign is one over time in place of that of the instrument.
  [[nodiscard]] bool overTime() const;

 private:
  /// Null: no such task.
  [[nodiscard]] const TaskKind* kind(const std::string& task) const;
  [[nodiscard]] std::vector<std::string> madeFrom(const std::string& task) const;
  /// What has to be there before: what it is made from, and what it comes after.
  [[nodiscard]] std::vector<std::string> runFirst(const std::string& task) const;
  /// Empty `why`: as `needed`.
  [[nodiscard]] std::vector<std::string> needed(const std::string& task, std::string& why) const;
  [[nodiscard]] nlohmann::json inputsOfResults(const std::string& task) const;
  [[nodiscard]] std::string blockedBecause(const std::string& task) const;

  const Session& session_;
  std::int64_t campaign_;
  std::shared_ptr<const Campaign> data_;
  CampaignFacts facts_;
  Latest latest_;
  mutable std::map<std::string, const StoredResult*> found_;  ///< by latest_
  const TaskLedger& ledger_;
};

}  // namespace spindrift
