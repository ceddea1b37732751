// SPDX-License-Identifier: GPL-3.0-or-later
// Commands: record.
#include <fmt/format.h>

#include <chrono>

#include "app/cli/command.h"
#include "core/base/count_text.h"
#include "core/base/error.h"
#include "core/base/utc_time.h"
#include "core/connect/genicam_camera.h"
#include "core/connect/recording.h"
#include "core/session/session.h"
#include "core/tasks/task_options.h"

namespace spindrift::cli {
namespace {

struct RecordArguments {
  std::string connections;
  std::string out;
  std::string session;
  std::string start;
  double for_s = 0.0;
  std::string list;
  double listen_s = 3.0;
};

double secondsSince(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

CommandResult listCameras() {
  CommandResult result;
  result.json["kind"] = "genicam";
  result.json["items"] = nlohmann::json::array();
  for (const GenicamDescription& camera : listGenicamCameras()) {
    result.json["items"].push_back({{"item", camera.id},
                                    {"vendor", camera.vendor},
                                    {"model", camera.model},
                                    {"serial", camera.serial},
                                    {"address", camera.address},
                                    {"protocol", camera.protocol}});
    result.summary +=
        fmt::format("{:<32} {} {} {} ({})\n", camera.id, camera.vendor, camera.model, camera.address, camera.protocol);
  }
  result.summary += countOf(result.json["items"].size(), "camera") + "\n";
  if (result.json["items"].empty()) result.exit_status = NotGoodEnough;
  return result;
}

CommandResult listItems(const RecordArguments& a) {
  if (a.list == "genicam:") return listCameras();
  const SourceDescription description = sourceForAddress(a.list);
  const std::unique_ptr<Source> source = description.make();
  std::vector<DataItem> items;
  try {
    source->connect({});
    items = source->list(a.listen_s, {});
    source->close();
  } catch (const ConnectionError& error) {
    throw InputError(error.what());
  }
  CommandResult result;
  result.json["kind"] = description.kind;
  result.json["items"] = nlohmann::json::array();
  for (const DataItem& item : items) {
    result.json["items"].push_back({{"item", item.address},
                                    {"name", item.name},
                                    {"component", item.component},
                                    {"category", item.category},
                                    {"type", item.type},
                                    {"unit", item.unit},
                                    {"value", item.example}});
    result.summary += fmt::format("{:<24} {:<28} {:<20} {:<20} {}{}\n", item.address, item.type, item.unit,
                                  item.example, item.component, item.name.empty() ? "" : " (" + item.name + ")");
  }
  result.summary += countOf(items.size(), "item") + "\n";
  if (items.empty()) result.exit_status = NotGoodEnough;
  return result;
}

/// As they were put together in the window, page Machine.
Connections keptConnections(const Session& session, std::int64_t campaign) {
  const nlohmann::json kept = campaignSetting(session, campaign, option_keys::connections, nlohmann::json());
  if (kept.is_object()) {
    Connections connections = Connections::parse(JsonNode::parse(kept.dump(), "connections of the campaign"));
    if (!connections.columns.empty()) return connections;
  }
  throw InputError({session.folder(), ""},
                   "has no connections for its newest campaign; allowed: map some (Machine, Connections), or name a "
                   "connections.json.");
}

CommandResult record(const RecordArguments& a, JobContext& job) {
  if (!a.list.empty()) return listItems(a);
  if (a.out.empty() == a.session.empty() || (a.connections.empty() && a.session.empty()))
    throw InputError("record needs CONNECTIONS and one of --out FILE and --session FOLDER, or --list ADDRESS.");
  std::optional<Connections> connections;
  if (!a.connections.empty()) connections = Connections::read(a.connections);
  double start_s = localUtc();
  if (!a.start.empty()) {
    const std::optional<double> given = parseUtc(a.start);
    if (!given)
      throw InputError(
          fmt::format("--start \"{}\" is not a time; allowed: UTC such as 2026-01-31T08:00:00Z.", a.start));
    start_s = *given;
  }
  std::filesystem::path log = a.out;
  std::optional<Session> session;
  std::int64_t campaign = 0;
  if (!a.session.empty()) {
    session = Session::open(a.session);
    const std::vector<CampaignRecord> campaigns = session->campaigns();
    if (campaigns.empty())
      throw InputError({a.session, ""}, "holds no campaign to record into; allowed: a session with a campaign.");
    campaign = campaigns.back().id;
    start_s = parseUtc(Campaign::read(campaigns.back().folder).start_utc).value_or(start_s);
    if (!connections) connections = keptConnections(*session, campaign);
    log = session->recordsLog(campaign);
  }
  Recording recording(*connections, log, start_s);
  const auto begin = std::chrono::steady_clock::now();
  // An interruption is the ordinary end of a recording without --for.
  while (!job.cancelled() && (a.for_s <= 0.0 || secondsSince(begin) < a.for_s)) {
    recording.turn(0.1);
    const std::string stage = fmt::format("recording, {}", countOf(recording.log().rows, "row"));
    job.report(a.for_s > 0.0 ? secondsSince(begin) / a.for_s : 0.0, stage);
  }
  recording.finish();
  if (session) (void)session->recordsLog(campaign);
  CommandResult result;
  result.json = recording.json();
  result.json["log"] = log.string();
  result.summary = fmt::format("{}: {}\n", log.string(), countOf(recording.log().rows, "row"));
  const std::vector<SourceStatus> states = recording.sources();
  for (std::size_t s = 0; s < states.size(); ++s) {
    result.summary +=
        fmt::format("{}: {}, {}, missed {}\n", connections->sources[s].name, countOf(states[s].records, "value"),
                    countOf(states[s].connections, "connection"), countOf(states[s].missed, "time"));
  }
  for (const std::string& sentence : recording.log().gaps) result.summary += "gap: " + sentence + "\n";
  for (const std::string& sentence : recording.shortcomings()) {
    result.summary += sentence + "\n";
    result.exit_status = NotGoodEnough;
  }
  return noted(std::move(result), recording.log().sentences);
}

}  // namespace

void addConnectCommands(CLI::App& app, CommandLine& line) {
  auto a = std::make_shared<RecordArguments>();
  CLI::App* command = addCommand(
      app, line, "record",
      "Record data from machines and sensors directly into a log (connections.json says which data item becomes which "
      "column), until --for has passed or an interruption (Ctrl+C). Only reads. Exit status 1: a source was never "
      "reached, "
      "a column has no value, or the disk is full",
      [a](JobContext& job) { return record(*a, job); });
  command->add_option("CONNECTIONS", a->connections,
                      "connections.json; with --session it may be left out: those of the page Machine are used then");
  command->add_option("--out", a->out, "Log to write; an existing log with the same columns is continued")
      ->type_name("FILE");
  command->add_option("--session", a->session, "Record into log.csv of the newest campaign of this session")
      ->type_name("FOLDER");
  command->add_option("--start", a->start, "UTC time at which time_s is 0; default: now, or the start of the campaign")
      ->type_name("TIME");
  command->add_option("--for", a->for_s, "Stop after this time in s")->check(positiveNumber());
  command
      ->add_option("--list", a->list,
                   "Only list the data items offered at this address (http://, mqtt://, serial://, ...); genicam: asks "
                   "for cameras")
      ->type_name("ADDRESS");
  command->add_option("--listen", a->listen_s, "With --list: listen for this time in s where needed")
      ->check(positiveNumber())
      ->capture_default_str();
}

}  // namespace spindrift::cli
