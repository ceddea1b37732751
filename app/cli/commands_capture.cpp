// SPDX-License-Identifier: GPL-3.0-or-later
// Commands: plan, watch.
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <thread>

#include "app/cli/command.h"
#include "core/base/atomic_file.h"
#include "core/base/count_text.h"
#include "core/base/error.h"
#include "core/workflows/capture_watch.h"

namespace spindrift::cli {
namespace {

double secondsNow() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void addPlan(CLI::App& app, CommandLine& line) {
  struct Arguments {
    std::string machine;
    std::string kind = "image";
    PlanOptions options;
    std::string out;
  };
  auto a = std::make_shared<Arguments>();
  CLI::App* command =
      addCommand(app, line, "plan",
                 "Plan a measurement: which fiducials or artefacts of a machine to measure, in what order and when",
                 [a](JobContext&) {
                   PlanOptions options = a->options;
                   options.kind = a->kind == "cycle"  ? PlannedKind::Cycle
                                  : a->kind == "scan" ? PlannedKind::Scan
                                                      : PlannedKind::Image;
                   const std::filesystem::path given = a->machine;
                   const MachineDescription machine =
                       MachineDescription::read(std::filesystem::is_directory(given) ? given / "machine.json" : given);
                   const MeasurementPlan plan = makePlan(machine, options);
                   if (!a->out.empty()) writeFileAtomically(a->out, plan.json().dump(1) + "\n");
                   std::string summary = fmt::format("{} items in {} states\n", plan.items.size(), plan.states.size());
                   for (const PlannedItem& item : plan.items)
                     summary += fmt::format("  {:>7.0f} s  {:<24} {}\n", item.due_s, item.id, item.instruction());
                   return CommandResult{plan.json(), summary, Done};
                 });
  command->add_option("MACHINE", a->machine, "machine.json, or the folder of a campaign")->required();
  command->add_option("--kind", a->kind, "image: fiducials under the microscope; cycle: touches; scan: profiler")
      ->check(oneOf({"image", "cycle", "scan"}))
      ->capture_default_str();
  command->add_option("--states", a->options.states, "Number of thermal states, including the cold reference state")
      ->capture_default_str();
  command->add_option("--interval", a->options.interval_s, "Time between thermal states in s")->capture_default_str();
  command->add_option("--out", a->out, "Write the plan (spindrift-plan JSON) to this file")->type_name("FILE");
}

struct WatchArguments {
  std::string folder;
  std::string session;
  std::string machine;
  std::string plan;
  std::string pattern;
  double until_idle_s = 30.0;
  double settle_s = 1.0;
};

/// The session with the campaign that captures go into: the newest one, or a new one where there is none.
std::pair<Session, std::int64_t> sessionFor(const WatchArguments& a) {
  const bool there = Session::isSession(a.session);
  Session session = there ? Session::open(a.session) : Session::create(a.session);
  const std::vector<CampaignRecord> campaigns = session.campaigns();
  if (!a.machine.empty()) {
    const MachineDescription machine = MachineDescription::read(a.machine);
    const std::int64_t id = session.newCampaign(machine.name, utcNow(), machine.source.dump(1));
    return {std::move(session), id};
  }
  if (campaigns.empty()) {
    throw InputError({a.session, ""},
                     "holds no campaign; allowed: a session with one, or --machine FILE to begin a new one.");
  }
  const std::int64_t id = campaigns.back().id;
  return {std::move(session), id};
}

/// `live`: every answer is printed as it comes, for the operator who still stands there.
CommandResult watch(const WatchArguments& a, bool live, JobContext& job) {
  std::optional<JsonNode> pattern;
  if (!a.pattern.empty()) {
    pattern = JsonNode::read(a.pattern);
    pattern->requireFormat("spindrift-printed-text", 1);
  }
  std::optional<MeasurementPlan> plan;
  if (!a.plan.empty()) plan = MeasurementPlan::parse(JsonNode::read(a.plan));
  // Before a session is made that would be left behind empty.
  if (!std::filesystem::is_directory(a.folder))
    throw InputError({a.folder, ""}, "is not a folder; allowed: the folder into which the instrument writes.");
  if (!a.machine.empty()) (void)MachineDescription::read(a.machine);
  if (a.machine.empty() && !Session::isSession(a.session))
    throw InputError({a.session, ""}, "is not a session; allowed: a session, or --machine FILE to begin a new one.");
  auto [session, campaign] = sessionFor(a);
  if (plan) storePlan(session, campaign, *plan);
  FolderWatchOptions options;
  options.settle_s = a.settle_s;
  CaptureWatch watch(session, campaign, a.folder, std::move(pattern), options);
  CommandResult result;
  result.json["items"] = nlohmann::json::array();
  double last_news_s = secondsNow();
  std::string problem;
  while (secondsNow() - last_news_s < a.until_idle_s) {
    job.throwIfCancelled();
    for (const IncomingItem& item : watch.turn(secondsNow())) {
      if (live) {
        fmt::print("{:<10} {}  {}\n", toString(item.state), item.name, item.sentence);
        std::fflush(stdout);
      }
      result.json["items"].push_back(item.json());
      result.json["items"].back()["state"] = toString(item.state);
      last_news_s = secondsNow();
    }
    if (!watch.idle()) last_news_s = secondsNow();
    if (live && watch.problem() != problem && !watch.problem().empty()) fmt::print("{}\n", watch.problem());
    problem = watch.problem();
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  watch.finish();
  result.warnings = watch.problems();
  result.json["problems"] = result.warnings;
  if (!result.warnings.empty()) result.exit_status = NotGoodEnough;
  for (const IncomingItem& item : watch.undecided())
    result.warnings.push_back(fmt::format("{}: {}", item.name, item.sentence));
  const std::vector<std::string> retakes = watch.retakes();
  result.json["retakes"] = retakes;
  result.json["touches"] = watch.touches();
  result.json["session"] = session.folder().string();
  result.summary = fmt::format("{}, {}\n", countOf(result.json["items"].size(), "file"),
                               countOf(watch.touches(), "touch", "touches"));
  if (!watch.plan().empty()) {
    const std::size_t done = watch.done().size();
    result.json["plan"] = {{"captured", done}, {"planned", watch.plan().items.size()}};
    result.summary += fmt::format("{} of {} captured\n", done, countOf(watch.plan().items.size(), "planned item"));
    if (done < watch.plan().items.size()) result.exit_status = NotGoodEnough;
  }
  for (const std::string& sentence : retakes) result.summary += sentence + "\n";
  if (!retakes.empty()) result.exit_status = NotGoodEnough;
  return result;
}

void addWatch(CLI::App& app, CommandLine& line) {
  auto a = std::make_shared<WatchArguments>();
  CLI::App* command =
      addCommand(app, line, "watch",
                 "Import captures into a session as they arrive in a folder; each is checked immediately. Exit status "
                 "1: captures have to be repeated, planned items are missing, or lines of touches cannot be read",
                 [a, &line](JobContext& job) { return watch(*a, line.json_file != "-", job); });
  command->add_option("FOLDER", a->folder, "Folder into which camera, control or profiler writes")->required();
  command->add_option("--session", a->session, "Folder of the session; created if it does not exist")->required();
  command->add_option("--machine", a->machine, "machine.json: start a new campaign in the session")->type_name("FILE");
  command->add_option("--plan", a->plan, "Measurement plan of the campaign (see the command plan)")->type_name("FILE");
  command->add_option("--template", a->pattern, "How a control prints touches (spindrift-printed-text JSON)")
      ->type_name("FILE");
  command->add_option("--until-idle", a->until_idle_s, "Stop when no file has arrived for this time in s")
      ->check(positiveNumber())
      ->capture_default_str();
  command->add_option("--settle", a->settle_s, "A file is complete when it has not changed for this time in s")
      ->check(nonNegativeNumber())
      ->capture_default_str();
}

}  // namespace

void addCaptureCommands(CLI::App& app, CommandLine& line) {
  addPlan(app, line);
  addWatch(app, line);
}

}  // namespace spindrift::cli
