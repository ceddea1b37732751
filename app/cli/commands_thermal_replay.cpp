// SPDX-License-Identifier: GPL-3.0-or-later
// thermal replay and thermal clusters.
#include <fmt/format.h>

#include <memory>

#include "app/cli/command.h"
#include "app/cli/picture_files.h"
#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/printed_number.h"
#include "core/base/text.h"
#include "core/thermal/input_selection.h"
#include "core/workflows/thermal_replay.h"

namespace spindrift::cli {
namespace {

double positiveLimit(std::string_view text, const std::string& part) {
  double value = 0.0;
  if (!parseNumber(text, value) || !(value > 0.0)) {
    throw InputError(fmt::format(
        "--limit \"{}\" is not a limit; allowed: one positive number for all outputs, or NAME=NUMBER separated by "
        "commas.",
        part));
  }
  return value;
}

std::map<std::string, double> parseLimits(const std::string& text) {
  std::map<std::string, double> limits;
  for (const std::string& part : splitList(text)) {
    const std::size_t equals = part.find('=');
    const std::string name = equals == std::string::npos ? "" : std::string(trimmed(part.substr(0, equals)));
    const double value = positiveLimit(trimmed(equals == std::string::npos ? part : part.substr(equals + 1)), part);
    if (!limits.emplace(name, value).second)
      throw InputError(fmt::format("--limit gives {} twice.", name.empty() ? "the limit of all outputs" : name));
  }
  return limits;
}

void addReplay(CLI::App& parent, CommandLine& line) {
  struct Arguments {
    ReplayRequest request;
    std::string source;
    std::string outputs;
    std::string inputs = "auto";
    std::string limits;
    PictureFiles pictures;
    double sigma = 0.0;
    double setup_h = 16.0;
    double setup_interval_min = 20.0;
    double shortest_min = 30.0;
    double longest_h = 6.0;
  };
  auto a = std::make_shared<Arguments>();
  CLI::App* command = addCommand(
      parent, line, "replay",
      "Replay a record with the self-optimising compensation: uncompensated, static and adaptive side by side, number "
      "of on-machine measurements used. Compensation = minus the predicted deviation; residual = recorded minus "
      "predicted, each in the sign of its column; a reduction is positive where the rms becomes smaller, negative "
      "where compensating makes it larger",
      [a](JobContext& job) {
        ReplayRequest& r = a->request;
        r.source = a->source;
        r.outputs = splitList(a->outputs);
        if (a->inputs != "auto") r.inputs = splitList(a->inputs);
        r.limits = parseLimits(a->limits);
        if (a->sigma > 0.0) r.sigma = a->sigma;
        r.setup_s = a->setup_h * 3600.0;
        r.setup_interval_s = a->setup_interval_min * 60.0;
        r.shortest_interval_s = a->shortest_min * 60.0;
        r.longest_interval_s = a->longest_h * 3600.0;
        const ReplayResult result = replayCompensation(r, job);
        if (a->pictures.wanted()) a->pictures.write(result.diagram());
        return CommandResult{result.json(), result.summary(), result.goodEnough() ? Done : NotGoodEnough};
      });
  // Named as elsewhere, so that results are kept out of the campaign's folder.
  command->add_option("CAMPAIGN", a->source, "Folder of a campaign with touches and a log, or a LOG.csv")->required();
  command
      ->add_option("--outputs", a->outputs,
                   "Errors separated by commas: columns of the log, or parameters of the cycles such as EXX,EX0C,EZ0T")
      ->required();
  command->add_option("--inputs", a->inputs, "Candidate inputs separated by commas, or auto")->capture_default_str();
  command->add_option("--limit", a->limits,
                      "Action control limit in the unit of the output: one number, or NAME=NUMBER,...; default: from "
                      "measurement uncertainty and magnitude of the errors during setup");
  command
      ->add_option("--sigma", a->sigma,
                   "Standard uncertainty of one measurement; default: as evaluated, or from the scatter of the "
                   "column, which where values are sparse holds changes of the error too")
      ->check(positiveNumber());
  command->add_option("--setup", a->setup_h, "Duration of the setup phase in h")
      ->check(positiveNumber())
      ->capture_default_str();
  command->add_option("--setup-interval", a->setup_interval_min, "Time between two measurements of the setup in min")
      ->check(positiveNumber())
      ->capture_default_str();
  command->add_option("--shortest", a->shortest_min, "Shortest time between two measurements after the setup in min")
      ->check(positiveNumber())
      ->capture_default_str();
  command->add_option("--longest", a->longest_h, "Longest time without a measurement in h")
      ->check(positiveNumber())
      ->capture_default_str();
  a->pictures.addTo(*command, "the diagrams");
}

void addClusters(CLI::App& parent, CommandLine& line) {
  struct Arguments {
    std::string log;
    std::string sensors;
    int count = 0;
  };
  auto a = std::make_shared<Arguments>();
  CLI::App* command = addCommand(
      parent, line, "clusters", "Cluster redundant temperature sensors and choose a representative of each cluster",
      [a](JobContext&) {
        const TimeSeries series = readTimeSeries(a->log);
        std::vector<std::string> names = splitList(a->sensors);
        if (names.empty()) {
          for (const Signal& s : series.signals)
            if (s.kind == SignalKind::Temperature) names.push_back(s.name);
        }
        if (names.size() < 2)
          throw InputError({a->log, "header"},
                           fmt::format("{} temperature columns; allowed: at least 2 (T_<name>_degC).", names.size()));
        if (a->count > static_cast<int>(names.size()))
          throw InputError(fmt::format("--groups {} is more than the {} sensors.", a->count, names.size()));
        CommandResult result;
        result.json["groups"] = nlohmann::json::array();
        for (const SensorCluster& c : clusterSensors(series, names, a->count)) {
          result.json["groups"].push_back(
              {{"sensors", c.names}, {"mean_change_K", c.mean_change}, {"representative", c.representative}});
          result.summary += fmt::format("{} sensors, mean change {:.2f} K, represented by {}: {}\n", c.names.size(),
                                        printed(c.mean_change), c.representative, joinedList(c.names));
        }
        result.json["notes"] = series.notes;
        for (const std::string& n : series.notes) result.summary += "note: " + n + "\n";
        return result;
      });
  command->add_option("LOG", a->log, "CSV with time_s and temperatures")->required();
  command->add_option("--sensors", a->sensors, "Columns separated by commas; default: all temperatures");
  command->add_option("--groups", a->count, "Number of clusters; 0: cut at the largest distance")
      ->check(nonNegativeNumber())
      ->capture_default_str();
}

}  // namespace

void addThermalReplayCommands(CLI::App& thermal, CommandLine& line) {
  addReplay(thermal, line);
  addClusters(thermal, line);
}

}  // namespace spindrift::cli
