// SPDX-License-Identifier: GPL-3.0-or-later
// Commands: plant ..., batch ...
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>
#include <system_error>

#include "app/cli/command.h"
#include "core/base/atomic_file.h"
#include "core/base/count_text.h"
#include "core/base/error.h"
#include "core/base/utc_time.h"
#include "core/plant/batch_engine.h"
#include "core/plant/batch_worker.h"
#include "core/plant/plant_overview.h"
#include "core/plant/publish.h"

namespace spindrift::cli {
namespace {

struct PlantArguments {
  std::string store;
  std::string folder;
  std::string campaign;
  std::string machine;
  std::string parameter;
  std::string state;
  std::string csv;
  std::string html;
  std::string out;
  std::string kind;
  std::string time;
  std::string note;
  std::vector<std::int64_t> campaigns;
  double every_days = -1.0;
  ChartOptions chart;
};

PlantAddress addressOf(const std::string& given) {
  if (!given.empty()) return PlantAddress::parse(given);
  const char* set = std::getenv("SPINDRIFT_PLANT");
  return PlantAddress::parse(set != nullptr ? set : "");
}

void addStore(CLI::App* command, std::string& store) {
  command
      ->add_option("--store", store,
                   "The plant store: a file (SQLite), or postgresql:host=NAME dbname=plant user=NAME; default: the one "
                   "that SPINDRIFT_PLANT names")
      ->type_name("ADDRESS");
}

double now() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

nlohmann::json toJson(const PublishCount& count) {
  return {{"campaigns_new", count.campaigns_new},
          {"campaigns_there", count.campaigns_there},
          {"results_new", count.results_new},
          {"results_there", count.results_there},
          {"results_again", count.results_again}};
}

nlohmann::json toJson(const PlantListing& c) {
  return {{"id", c.id},
          {"machine", c.machine},
          {"name", c.name},
          {"start_utc", utcText(c.start_s)},
          {"program_version", c.program_version},
          {"publisher", c.publisher},
          {"fingerprint", c.fingerprint},
          {"verdict", c.verdict.empty() ? nlohmann::json() : nlohmann::json(c.verdict)},
          {"results", c.results}};
}

CommandResult init(const PlantArguments& a) {
  const PlantStore store = PlantStore::make(addressOf(a.store));
  CommandResult result;
  result.json = {{"store", store.address()}, {"role", toString(store.role())}};
  result.summary = fmt::format("{}: ready, the role here is {}\n", store.address(), toString(store.role()));
  result.warnings = store.warnings();
  return result;
}

CommandResult publish(const PlantArguments& a, JobContext& job) {
  const PlantAddress address = addressOf(a.store);
  PublishOutcome outcome;
  if (Session::isSession(a.folder)) {
    Session session = Session::open(a.folder);
    std::vector<std::int64_t> ids;
    for (const CampaignRecord& record : session.campaigns()) {
      if (a.campaign.empty() || record.name == a.campaign) ids.push_back(record.id);
    }
    if (ids.empty())
      throw InputError({a.folder, ""}, a.campaign.empty() ? "holds no campaign to publish."
                                                          : fmt::format("holds no campaign \"{}\".", a.campaign));
    outcome = publishFromSession(session, ids, address);
  } else {
    const PlantCampaign campaign = plantCampaign(std::filesystem::path(a.folder), job);
    PlantStore store = PlantStore::openOrMake(address);
    outcome.warnings = store.warnings();
    outcome.count = store.publish(std::span(&campaign, 1));
  }
  CommandResult result;
  result.json = toJson(outcome.count);
  result.json["store"] = address.text();
  result.json["waiting"] = outcome.waiting;
  result.json["reason"] = outcome.reason.empty() ? nlohmann::json() : nlohmann::json(outcome.reason);
  result.warnings = outcome.warnings;
  if (outcome.waiting > 0) {
    result.exit_status = NotGoodEnough;
    result.summary =
        fmt::format("{} {} in the session and will be published next time: {}\n", countOf(outcome.waiting, "campaign"),
                    outcome.waiting == 1 ? "waits" : "wait", outcome.reason);
    return result;
  }
  result.summary = fmt::format("{}: {} new, {} there already; {} new, {} there already\n", address.text(),
                               countOf(outcome.count.campaigns_new, "campaign"), outcome.count.campaigns_there,
                               countOf(outcome.count.results_new, "result"), outcome.count.results_there);
  if (outcome.count.results_again > 0)
    result.summary +=
        fmt::format("in force again, in the place of later ones: {}\n", countOf(outcome.count.results_again, "result"));
  return result;
}

CommandResult list(const PlantArguments& a) {
  PlantStore store = PlantStore::open(addressOf(a.store), {.as = PlantRole::Reader});
  CommandResult result;
  result.warnings = store.warnings();
  result.json = {
      {"store", store.address()}, {"machines", nlohmann::json::array()}, {"campaigns", nlohmann::json::array()}};
  if (!a.machine.empty()) (void)store.machine(a.machine);
  for (const MachineState& s : plantOverview(store, now())) {
    if (!a.machine.empty() && s.machine.name != a.machine) continue;
    const ModelState model = modelState(store, s.machine.name, {});
    nlohmann::json entry = spindrift::toJson(s);
    entry["model_campaign"] = model.model ? nlohmann::json(model.model->campaign_name) : nlohmann::json();
    entry["model_holds"] = model.model ? nlohmann::json(model.reasons.empty()) : nlohmann::json();
    entry["model_reasons"] = model.reasons;
    result.json["machines"].push_back(entry);
    result.summary += fmt::format("{:<24} {:>5} {:<12} {}\n", s.machine.name, countOf(s.machine.campaigns, "campaign"),
                                  s.machine.last_verdict, s.dueSentence());
    if (!model.reasons.empty()) result.summary += "  model no longer holds: " + model.reasons.front() + "\n";
  }
  for (const PlantListing& c : store.campaigns(a.machine)) {
    result.json["campaigns"].push_back(toJson(c));
    if (!a.machine.empty())
      result.summary += fmt::format("{:>6}  {}  {:<24} {:<12} {}\n", c.id, utcText(c.start_s).substr(0, 10), c.name,
                                    c.verdict, c.publisher);
  }
  if (result.json["machines"].empty()) result.summary += "no machine yet: publish a campaign\n";
  return result;
}

CommandResult trend(const PlantArguments& a) {
  PlantStore store = PlantStore::open(addressOf(a.store), {.as = PlantRole::Reader});
  CommandResult result;
  result.warnings = store.warnings();
  if (a.parameter.empty()) {
    (void)store.machine(a.machine);
    result.json = {{"machine", a.machine}, {"parameters", nlohmann::json::array()}};
    for (const TrendName& n : store.trendNames(a.machine)) {
      result.json["parameters"].push_back({{"kind", n.kind}, {"parameter", n.name}, {"values", n.values}});
      result.summary += fmt::format("{}/{}  {}\n", n.kind, n.name, countOf(n.values, "value"));
    }
    return result;
  }
  const MachineTrend found = machineTrend(store, a.machine, a.parameter, a.state, a.chart);
  if (!a.csv.empty()) writeFileAtomically(a.csv, found.csv());
  result.json = found.json();
  result.summary = found.summary();
  return result;
}

CommandResult compare(const PlantArguments& a) {
  PlantStore store = PlantStore::open(addressOf(a.store), {.as = PlantRole::Reader});
  const CampaignComparison compared = compareCampaigns(store, a.campaigns);
  return {compared.json(), compared.summary(), Done, store.warnings()};
}

CommandResult event(const PlantArguments& a) {
  PlantStore store = PlantStore::open(addressOf(a.store));
  CommandResult result;
  result.warnings = store.warnings();
  if (a.every_days >= 0.0) store.setInterval(a.machine, a.every_days);
  if (!a.kind.empty()) {
    const std::optional<double> time_s = a.time.empty() ? std::optional(now()) : parseUtc(a.time);
    if (!time_s)
      throw InputError(fmt::format("--time \"{}\" is not a time; allowed: UTC such as 2026-01-31T08:00:00Z.", a.time));
    store.addEvent({a.machine, *time_s, a.kind, a.note, plantPublisher()});
  } else if (a.every_days < 0.0) {
    throw InputError("Nothing is entered; allowed: --kind, --every-days, or both.");
  }
  result.json = {{"machine", a.machine}, {"events", nlohmann::json::array()}};
  for (const MachineEvent& e : store.events(a.machine)) {
    result.json["events"].push_back(
        {{"time_utc", utcText(e.time_s)}, {"kind", e.kind}, {"note", e.note}, {"author", e.author}});
    result.summary += fmt::format("{}  {:<16} {}\n", utcText(e.time_s).substr(0, 10), e.kind, e.note);
  }
  return result;
}

CommandResult exportStore(const PlantArguments& a, JobContext& job) {
  PlantStore store = PlantStore::open(addressOf(a.store), {.as = PlantRole::Reader});
  CommandResult result;
  result.warnings = store.warnings();
  if (!a.html.empty()) {
    if (a.machine.empty()) throw InputError("--html is the report of one machine; allowed: with --machine NAME.");
    writeFileAtomically(a.html, htmlOf(machineReport(store, a.machine, now()).report));
    result.summary += a.html + ": report of " + a.machine + "\n";
  }
  nlohmann::json all = {{"format", "spindrift-plant-export"},
                        {"version", 1},
                        {"campaigns", nlohmann::json::array()},
                        {"events", nlohmann::json::array()}};
  const std::vector<PlantListing> listed = store.campaigns(a.machine);
  for (std::size_t i = 0; i < listed.size(); ++i) {
    job.report(static_cast<double>(i) / static_cast<double>(listed.size()), "reading campaigns");
    job.throwIfCancelled();
    all["campaigns"].push_back(store.campaign(listed[i].id).json());
  }
  for (const PlantMachine& m : store.machines()) {
    if (!a.machine.empty() && m.name != a.machine) continue;
    for (const MachineEvent& e : store.events(m.name))
      all["events"].push_back({{"machine", m.name},
                               {"time_utc", utcText(e.time_s)},
                               {"kind", e.kind},
                               {"note", e.note},
                               {"author", e.author}});
  }
  if (!a.out.empty()) {
    writeFileAtomically(a.out, all.dump(1) + "\n");
    result.summary += fmt::format("{}: {}\n", a.out, countOf(listed.size(), "campaign"));
  }
  if (a.out.empty() && a.html.empty()) result.summary = all.dump(1) + "\n";
  result.json = std::move(all);
  return result;
}

void addPlantGroup(CLI::App& app, CommandLine& line) {
  CLI::App* group = app.add_subcommand("plant", "Many machines over years: publish, list, trends, events, export");
  group->require_subcommand(1);
  const auto add = [&](const char* name, const char* what, CommandResult (*run)(const PlantArguments&, JobContext&)) {
    auto a = std::make_shared<PlantArguments>();
    CLI::App* command = addCommand(*group, line, name, what, [a, run](JobContext& job) { return run(*a, job); });
    addStore(command, a->store);
    return std::pair(command, a);
  };
  add("init", "Create a plant store, or migrate an older one (as its owner)",
      [](const PlantArguments& a, JobContext&) { return init(a); });
  {
    auto [command, a] =
        add("publish",
            "Publish the campaigns of a session, or a campaign folder (it is evaluated), with results and "
            "provenance; raw captures stay where they are. Publishing again adds nothing. Exit status 1: "
            "the store cannot be reached, and what was to be published waits in the session",
            publish);
    command->add_option("FOLDER", a->folder, "Session or campaign")->required();
    command->add_option("--campaign", a->campaign, "Only the campaign of this name")->type_name("NAME");
  }
  {
    auto [command, a] = add("list", "List machines with their last state and what is due, and campaigns",
                            [](const PlantArguments& args, JobContext&) { return list(args); });
    command->add_option("--machine", a->machine, "Only this machine, with its campaigns")->type_name("NAME");
  }
  {
    auto [command, a] =
        add("trend", "One parameter of a machine over months: control limits, and statistically significant changes",
            [](const PlantArguments& args, JobContext&) { return trend(args); });
    command->add_option("MACHINE", a->machine, "Machine")->required();
    command->add_option("PARAMETER", a->parameter,
                        "Parameter, such as EX_um or fit/EX_um; default: list those available");
    command->add_option("--state", a->state, "Thermal state or cycle; default: the last one of each campaign")
        ->type_name("NAME");
    command
        ->add_option("--baseline", a->chart.baseline,
                     "Number of values that determine level and control limits, 5 to 1000")
        ->capture_default_str();
    command->add_option("--alpha", a->chart.alpha, "Significance level: probability of a false alarm, 0.001 to 0.2")
        ->capture_default_str();
    command->add_option("--csv", a->csv, "Write values and limits to this CSV file")->type_name("FILE");
  }
  {
    auto [command, a] = add("compare", "Campaigns side by side, of whatever sessions and machines",
                            [](const PlantArguments& args, JobContext&) { return compare(args); });
    command->add_option("CAMPAIGN", a->campaigns, "Numbers that plant list shows, two or more")->required();
  }
  {
    auto [command, a] = add("event", "Record an event of a machine, such as a repair, or its measurement interval",
                            [](const PlantArguments& args, JobContext&) { return event(args); });
    command->add_option("MACHINE", a->machine, "Machine")->required();
    command->add_option("--kind", a->kind, "Kind of event")->check(oneOf(eventKinds()));
    command->add_option("--time", a->time, "Time of the event (UTC); default: now")->type_name("TIME");
    command->add_option("--note", a->note, "Remark")->type_name("TEXT");
    command->add_option("--every-days", a->every_days, "Measurement interval in days; 0: not specified")
        ->check(nonNegativeNumber());
  }
  {
    auto [command, a] =
        add("export", "Export the whole store or one machine as JSON; report of a machine as HTML", exportStore);
    command->add_option("--machine", a->machine, "Only this machine")->type_name("NAME");
    command->add_option("--out", a->out, "JSON file; default: standard output")->type_name("FILE");
    command->add_option("--html", a->html, "Report of the machine (one HTML file)")->type_name("FILE");
  }
}

// Batches -------------------------------------------------------------------------------------------------------------

struct BatchArguments {
  std::string store;
  std::string plan;
  std::string batch;
  std::string engine = "local";
  std::string results;
  std::string logs = "spindrift-batch-logs";
  int processes = 0;
  int tasks = 4;
  int round = 1;
  std::int64_t answered = -1;
  bool wait = false;
  int time_limit_min = 0;
  double budget_s = 0.0;
};

std::string thisProgram() {
  return std::filesystem::read_symlink("/proc/self/exe").string();
}

/// 0 done, 1 still open or some failed (the summary says what).
CommandResult told(const BatchState& state) {
  CommandResult result;
  result.json = state.json();
  result.summary = state.summary();
  if (!state.finished() || state.failed_items > 0) result.exit_status = NotGoodEnough;
  return result;
}

SlurmOptions slurmOptions(const BatchArguments& a, const BatchPlan& plan) {
  SlurmOptions options;
  options.tasks = a.tasks;
  options.logs = std::filesystem::absolute(a.logs);
  options.time_limit_min = a.time_limit_min;
  options.round = a.round;
  options.answered = a.answered;
  options.lease_s = plan.lease_s;
  options.grace_s = std::max(10.0, 2.0 * plan.lease_s);
  options.program = thisProgram();
  return options;
}

CommandResult runBatch(const BatchArguments& a, std::int64_t id, const PlantAddress& address, JobContext& job) {
  PlantStore store = PlantStore::open(address);
  BatchQueue queue(store);
  if (a.engine == "slurm") {
    const BatchState state = queue.state(id);
    CommandResult result;
    result.json = state.json();
    if (state.finished()) {
      result.summary = state.summary();
      return result;
    }
    const SlurmOptions options = slurmOptions(a, queue.plan(id));
    if (a.wait) {
      const EngineReport report = runThroughSlurm(address, id, options, job);
      if (!report.refused.empty()) throw InputError(report.refused);
      result = told(report.state);
      result.json["tasks_given"] = report.started;
      if (report.stopped) result.summary += fmt::format("stopped; batch resume {} --engine slurm continues it\n", id);
      return result;
    }
    const std::string array = giveToSlurm(address, id, options);
    result.json["slurm_job"] = array.empty() ? nlohmann::json() : nlohmann::json(array);
    result.summary =
        array.empty()
            ? fmt::format("batch {}: Slurm holds its tasks already; batch status {} says how far it is\n", id, id)
            : fmt::format("batch {}: in Slurm's array job {}; batch status {} says how far it is\n", id, array, id);
    return result;
  }
  EngineOptions options;
  options.processes = a.processes;
  options.worker_command = {thisProgram(), "batch", "work"};
  const EngineReport report = runLocally(address, id, options, job);
  if (!report.refused.empty()) throw InputError(report.refused);
  CommandResult result = told(report.state);
  result.json["processes_started"] = report.started;
  result.json["processes_killed"] = report.killed;
  if (report.stopped) result.summary += fmt::format("stopped; batch resume {} continues it\n", id);
  return result;
}

CommandResult startBatch(const BatchArguments& a, JobContext& job) {
  const BatchPlan plan = BatchPlan::read(a.plan);
  plan.requireFiles();
  const PlantAddress address = addressOf(a.store);
  std::int64_t id = 0;
  {
    PlantStore store = PlantStore::openOrMake(address);
    BatchQueue queue(store);
    id = queue.submit(plan);
  }
  return runBatch(a, id, address, job);
}

std::atomic<bool>& terminated() {
  static std::atomic<bool> flag{false};
  return flag;
}

/// A number is not looked up: the store may be away for a while when an engine starts a worker.
std::int64_t batchOf(const std::string& number_or_name, const PlantAddress& address) {
  const char* const end = number_or_name.data() + number_or_name.size();
  std::int64_t number = 0;
  const auto [at, error] = std::from_chars(number_or_name.data(), end, number);
  if (error == std::errc() && at == end) return number;
  PlantStore store = PlantStore::open(address);
  return BatchQueue(store).find(number_or_name);
}

CommandResult workBatch(const BatchArguments& a) {
  std::signal(SIGTERM, [](int) { terminated() = true; });
  WorkerOptions options;
  options.engine = a.engine;
  options.budget_s = a.budget_s;
  options.stop = &terminated();
  const PlantAddress address = addressOf(a.store);
  const std::int64_t id = batchOf(a.batch, address);
  const WorkerReport report = workOnBatch(address, id, options);
  CommandResult result;
  result.json = {{"worker", workerName()},
                 {"chunks", report.chunks},
                 {"items", report.items},
                 {"dropped", report.dropped},
                 {"stopped", report.stopped}};
  result.summary =
      fmt::format("{}: {}, {}\n", workerName(), countOf(report.chunks, "chunk"), countOf(report.items, "item"));
  return result;
}

/// Keeps a worker working while something is free: what Slurm starts.
CommandResult tendBatch(const BatchArguments& a) {
  static std::stop_source stop;
  // request_stop without registered callbacks only sets an atomic flag.
  std::signal(SIGTERM, [](int) { stop.request_stop(); });
  std::signal(SIGINT, [](int) { stop.request_stop(); });
  const PlantAddress address = addressOf(a.store);
  EngineOptions options;
  const char* processors = std::getenv("SLURM_CPUS_PER_TASK");
  options.processes = processors != nullptr ? std::max(1, std::atoi(processors)) : 1;
  options.worker_command = {thisProgram(), "batch", "work"};
  options.engine = "slurm";
  options.stay = false;
  options.poll_s = 5.0;
  JobContext job(stop.get_token(), nullptr);
  const EngineReport report = runLocally(address, batchOf(a.batch, address), options, job);
  if (!report.refused.empty()) throw InputError(report.refused);
  CommandResult result;
  result.json = {{"processes_started", report.started}, {"processes_killed", report.killed}};
  result.summary =
      fmt::format("{}: {} started, {} killed\n", workerName(), countOf(report.started, "worker"), report.killed);
  return result;
}

/// Of a batch on which nothing works: what Slurm holds of it, or what to do.
void tellWhoWorks(CommandResult& result, const BatchState& state, const PlantAddress& address) {
  if (!state.idle()) return;
  const std::optional<SlurmTasks> slurm = tasksInSlurm(address, state.id, 5.0);
  const std::size_t running = slurm ? slurm->running.size() : 0;
  if (slurm && running + static_cast<std::size_t>(slurm->waiting) > 0) {
    result.json["slurm"] = {
        {"running", running}, {"waiting", slurm->waiting}, {"held", slurm->stuck.size()}, {"reason", slurm->reason}};
    result.summary += fmt::format("Slurm holds {} of it, {} waiting{}\n",
                                  countOf(static_cast<long>(running) + slurm->waiting, "task"), slurm->waiting,
                                  slurm->reason.empty() || slurm->reason == "None" ? "" : " (" + slurm->reason + ")");
    return;
  }
  if (slurm) result.json["slurm"] = {{"running", 0}, {"waiting", 0}, {"held", slurm->stuck.size()}};
  result.summary +=
      fmt::format("{}batch resume {}{} continues it\n", slurm ? "Slurm has no task of it that will begin; " : "",
                  state.id, slurm ? " --engine slurm" : "");
}

CommandResult statusOfBatch(const BatchArguments& a) {
  const PlantAddress address = addressOf(a.store);
  PlantStore store = PlantStore::open(address, {.as = PlantRole::Reader});
  BatchQueue queue(store);
  if (a.batch.empty()) {
    CommandResult result;
    result.json["batches"] = nlohmann::json::array();
    for (const BatchState& s : queue.all()) {
      result.json["batches"].push_back(s.json());
      result.summary += s.summary();
    }
    if (result.summary.empty()) result.summary = "no batch yet\n";
    return result;
  }
  const std::int64_t id = queue.find(a.batch);
  if (!a.results.empty()) {
    const BatchPlan plan = queue.plan(id);
    std::string lines;
    queue.answers(id, [&](const ItemAnswer& answer) {
      lines += nlohmann::json({{"item", answer.item},
                               {"name", plan.itemName(answer.item)},
                               {"work_s", answer.work_s},
                               {"failed", answer.failed},
                               {"answer", answer.answer}})
                   .dump() +
               "\n";
    });
    writeFileAtomically(a.results, lines);
  }
  const BatchState state = queue.state(id);
  CommandResult result = told(state);
  tellWhoWorks(result, state, address);
  return result;
}

CommandResult changeBatch(const BatchArguments& a, JobContext& job, bool resume) {
  const PlantAddress address = addressOf(a.store);
  std::int64_t id = 0;
  {
    PlantStore store = PlantStore::open(address);
    BatchQueue queue(store);
    id = queue.find(a.batch);
    if (!resume) {
      queue.cancel(id);
      CommandResult result;
      result.json = queue.state(id).json();
      result.summary = queue.state(id).summary();
      return result;
    }
    queue.resume(id);
  }
  return runBatch(a, id, address, job);
}

/// After a round of Slurm: another one while chunks are open.
CommandResult sweepBatch(BatchArguments a) {
  const PlantAddress address = addressOf(a.store);
  PlantStore store = PlantStore::open(address);
  BatchQueue queue(store);
  const std::int64_t id = queue.find(a.batch);
  const BatchState state = queue.state(id);
  CommandResult result = told(state);
  if (state.finished() || state.cancelled) return result;
  SlurmOptions options = slurmOptions(a, queue.plan(id));
  options.round = state.answered > a.answered ? 1 : a.round + 1;
  if (options.round > options.rounds) {
    result.summary +=
        fmt::format("{} rounds brought no answer; batch resume {} --engine slurm continues it\n", a.round, id);
    return result;
  }
  result.summary += "another round: " + giveToSlurm(address, id, options) + "\n";
  return result;
}

void addEngineOptions(CLI::App* command, BatchArguments& a) {
  command->add_option("--engine", a.engine, "Where to run: local processes, or tasks of Slurm")
      ->check(oneOf({"local", "slurm"}))
      ->capture_default_str();
  command->add_option("--processes", a.processes, "local: number of processes; 0: one per processor")
      ->check(numberBetween(0, 10000));
  command->add_option("--tasks", a.tasks, "slurm: number of tasks of the array")
      ->check(numberBetween(1, 10000))
      ->capture_default_str();
  command
      ->add_option("--time-limit", a.time_limit_min, "slurm: time limit of a task in minutes; 0: that of the partition")
      ->check(numberBetween(0, 1000000));
  command->add_flag(
      "--wait", a.wait,
      "slurm: wait until nothing is open, and give Slurm again what it has lost or did not bring to an end");
  command->add_option("--logs", a.logs, "slurm: folder for the output of the tasks")
      ->capture_default_str()
      ->type_name("DIR");
}

void addBatchGroup(CLI::App& app, CommandLine& line) {
  auto started = std::make_shared<BatchArguments>();
  CLI::App* group = addCommand(app, line, "batch",
                               "Evaluate, fit, identify, search, simulate or study many campaigns or seeds "
                               "(spindrift-batch plan): as processes on "
                               "this computer or through Slurm; results are kept in the plant store. Exit status "
                               "1: an item failed or is still open",
                               [started](JobContext& job) { return startBatch(*started, job); });
  const CLI::App* const whole = group;
  group->callback([&line, whole, started] {
    if (!whole->get_subcommands().empty()) return;
    if (started->plan.empty()) throw CLI::RequiredError("PLAN.json, or one of status, cancel, resume,");
    line.selected = [started](JobContext& job) { return startBatch(*started, job); };
  });
  group->add_option("PLAN", started->plan, "Plan (JSON, format spindrift-batch)");
  addStore(group, started->store);
  addEngineOptions(group, *started);
  const auto add = [&](const char* name, const char* what, auto run) {
    auto a = std::make_shared<BatchArguments>();
    CLI::App* command = addCommand(*group, line, name, what, [a, run](JobContext& job) { return run(*a, job); });
    addStore(command, a->store);
    return std::pair(command, a);
  };
  {
    auto [command, a] = add("status", "Show progress and cost of batches, or the results of one batch",
                            [](const BatchArguments& args, JobContext&) { return statusOfBatch(args); });
    command->add_option("BATCH", a->batch, "Number or name; default: all batches");
    command->add_option("--results", a->results, "Write the results to this file, one JSON document per line")
        ->type_name("FILE");
  }
  {
    auto [command, a] = add("cancel", "Cancel a batch: no further item is started, running items are returned",
                            [](const BatchArguments& args, JobContext& job) { return changeBatch(args, job, false); });
    command->add_option("BATCH", a->batch, "Number or name")->required();
  }
  {
    auto [command, a] = add("resume", "Resume a batch that was cancelled or stopped, or retry its failed items",
                            [](const BatchArguments& args, JobContext& job) { return changeBatch(args, job, true); });
    command->add_option("BATCH", a->batch, "Number or name")->required();
    addEngineOptions(command, *a);
  }
  {
    auto [command, a] =
        add("work", "Run one worker: claim and process items until none is free (started by the engines)",
            [](const BatchArguments& args, JobContext&) { return workBatch(args); });
    command->add_option("BATCH", a->batch, "Number or name")->required();
    command->add_option("--engine", a->engine, "Engine that started the worker")->check(oneOf({"local", "slurm"}));
    command->add_option("--budget", a->budget_s, "Start no new item after this time in s")->check(nonNegativeNumber());
  }
  {
    auto [command, a] = add("tend", "Keep a worker running until no item is free (started by Slurm)",
                            [](const BatchArguments& args, JobContext&) { return tendBatch(args); });
    command->add_option("BATCH", a->batch, "Number")->required();
  }
  {
    auto [command, a] = add("sweep", "After a round of Slurm: start another one while items are open",
                            [](const BatchArguments& args, JobContext&) { return sweepBatch(args); });
    command->add_option("BATCH", a->batch, "Number or name")->required();
    command->add_option("--round", a->round, "Number of the round that has ended, counted since the last answer");
    command->add_option("--answered", a->answered, "Number of answers when the round began");
    addEngineOptions(command, *a);
  }
}

}  // namespace

void addPlantCommands(CLI::App& app, CommandLine& line) {
  addPlantGroup(app, line);
  addBatchGroup(app, line);
}

}  // namespace spindrift::cli
