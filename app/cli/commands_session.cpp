// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/command.h"
#include "app/cli/session_source.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/untrusted_text.h"
#include "core/session/session.h"
#include "core/tasks/campaign_state.h"
#include "core/tasks/steps.h"

namespace spindrift::cli {
namespace {

constexpr auto outdated_tasks = "outdated";

struct SessionArguments {
  std::string folder;
  std::string campaign;
  std::string run;  ///< task, or outdated_tasks
};

nlohmann::json stepsOf(const Session& session, const CampaignRecord& record, std::string& summary) {
  // As the window has it: the machine and the clocks as they were edited.
  CampaignState state;
  state.id = record.id;
  state.files = std::make_shared<const Campaign>(Campaign::read(record.folder));
  state.apply(CampaignEdits::of(session, record.id));
  state.excluded = excludedItems(session, record.id);
  const TaskLedger nothing_runs;
  const TaskGraph graph = state.tasks(session, nothing_runs);
  const CaptureCounts counts = CaptureCounts::of(graph);
  nlohmann::json steps = nlohmann::json::array();
  for (const StepId step : all_steps) {
    const StepReport report = stepReport(graph, step, counts);
    nlohmann::json entry = {{"step", toString(step)}, {"state", toString(report.state)}, {"sentence", report.sentence}};
    if (report.of > 0) {
      entry["count"] = report.count;
      entry["of"] = report.of;
    }
    if (const std::string task = taskOfStep(graph, step); !task.empty()) {
      entry["task"] = task;
      entry["changed"] = graph.status(task).changed;
    }
    steps.push_back(std::move(entry));
    summary += fmt::format("  {:<12} {:<12} {}\n", toString(step), toString(report.state), report.sentence);
  }
  return steps;
}

CommandResult stateOf(const SessionArguments& arguments, JobContext& job) {
  CommandResult result;
  // First the files of all: a result of one campaign may rest on another.
  std::vector<InputError> unreadable;
  std::map<std::int64_t, FileCheck> checked;
  {
    Session session = Session::open(arguments.folder);
    result.warnings = session.recoveryMessages();
    for (const CampaignRecord& record : session.campaigns()) {
      try {
        checked[record.id] = session.takeFiles(record.id, fingerprintsOfFiles(record.folder, job));
      } catch (const InputError& error) {
        if (arguments.campaign.empty() || record.name == arguments.campaign) unreadable.push_back(error);
      }
    }
  }
  if (!arguments.run.empty()) {
    // Closed again before the session is looked at.
    SessionSource source(arguments.folder, arguments.campaign, job);
    const bool outdated = arguments.run == outdated_tasks;
    std::vector<std::string> failures;
    const std::vector<std::string> ran =
        outdated ? source.tasks().runOutdated(job, failures) : source.tasks().run(arguments.run, job);
    result.json["ran"] = ran;
    result.summary += !ran.empty()        ? fmt::format("run: {}\n", joinedList(ran))
                      : !failures.empty() ? std::string()
                      : outdated          ? "nothing is outdated: nothing was run\n"
                                          : fmt::format("{} is current: nothing was run\n", arguments.run);
    if (!failures.empty()) result.exit_status = NotGoodEnough;
    result.warnings.insert(result.warnings.end(), failures.begin(), failures.end());
  }
  Session session = Session::open(arguments.folder);
  result.json["campaigns"] = nlohmann::json::array();
  for (const CampaignRecord& record : session.campaigns()) {
    if (!arguments.campaign.empty() && record.name != arguments.campaign) continue;
    if (!checked.contains(record.id)) continue;
    try {
      const FileCheck& files = checked[record.id];
      std::string summary = printable(record.name) + "\n";
      if (!files.same()) result.warnings.push_back(printable(record.name) + ": " + files.sentence() + ".");
      nlohmann::json steps = stepsOf(session, record, summary);
      result.summary += summary;
      result.json["campaigns"].push_back(
          {{"name", record.name}, {"files_changed", files.sentence()}, {"steps", std::move(steps)}});
    } catch (const InputError& error) {
      unreadable.push_back(error);
    }
  }
  // The others are shown all the same.
  if (result.json["campaigns"].empty() && !unreadable.empty()) throw InputError(unreadable.front());
  for (const InputError& error : unreadable) {
    result.warnings.emplace_back(error.what());
    result.exit_status = NotGoodEnough;
  }
  if (result.json["campaigns"].empty()) {
    throw InputError({arguments.folder, ""}, arguments.campaign.empty()
                                                 ? "holds no campaign."
                                                 : fmt::format("holds no campaign \"{}\".", arguments.campaign));
  }
  return result;
}

}  // namespace

void addSessionCommands(CLI::App& app, CommandLine& line) {
  auto arguments = std::make_shared<SessionArguments>();
  std::vector<std::string> allowed;
  for (const TaskKind& kind : taskKinds())
    if (allowed.empty() || allowed.back() != kind.id) allowed.emplace_back(kind.id);
  allowed.emplace_back(outdated_tasks);
  CLI::App* command = addCommand(app, line, "session",
                                 "Show the status of every campaign of a session: what is done, outdated (and why) or "
                                 "blocked; input files are compared with those that the results were calculated from",
                                 [arguments](JobContext& job) { return stateOf(*arguments, job); });
  command->add_option("SESSION", arguments->folder, "Folder of the session; must not be open in the program")
      ->required();
  command->add_option("--campaign", arguments->campaign, "Only the campaign of this name")->type_name("NAME");
  command
      ->add_option(
          "--run", arguments->run,
          "Run what is needed first so that this task is current, with the options that the session keeps, of "
          "--campaign or the campaign opened last: evaluate the captures before a fit, fit before a "
          "compensation; results that are still current are used again. \"simulation\" runs the programs that "
          "the simulator names; \"outdated\" runs every task, but that one, whose result is not current any more")
      ->type_name("TASK")
      ->check(oneOf(allowed));
}

}  // namespace spindrift::cli
