// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <memory>

#include "app/cli/command.h"
#include "core/base/atomic_file.h"
#include "core/simulation/virtual_campaign.h"

namespace spindrift::cli {
namespace {

struct SimulateArguments {
  std::string scenario;
  std::string out;
  std::string truth;
  std::uint64_t seed = 0;
  bool has_seed = false;
};

/// "23 ms", "6.4 s", "2 min 18 s".
std::string durationText(double ms) {
  if (ms < 1000.0) return fmt::format("{:.0f} ms", ms);
  if (ms < 60'000.0) return fmt::format("{:.1f} s", ms / 1000.0);
  const auto seconds = std::lround(ms / 1000.0);
  return fmt::format("{} min {} s", seconds / 60, seconds % 60);
}

CommandResult simulate(const SimulateArguments& arguments, JobContext& job) {
  const Scenario scenario = Scenario::read(arguments.scenario);
  // Rendering images and clouds takes nearly all of the time where there are any.
  const double part_of_plant = scenario.microscope || scenario.profiler ? 0.02 : 0.8;
  const VirtualCampaign campaign = simulateCampaign(
      scenario, arguments.has_seed ? std::optional(arguments.seed) : std::nullopt, job.part(0.0, part_of_plant));
  JobContext writing = job.part(part_of_plant, 1.0);
  const auto started = std::chrono::steady_clock::now();
  writeCampaign(campaign, arguments.out, writing);
  const double writing_ms =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - started).count();
  const std::size_t observations = campaign.campaign.observations ? campaign.campaign.observations->rows.size() : 0;
  if (!arguments.truth.empty()) {
    writeFileAtomically(arguments.truth, truthJson(campaign).dump(1) + "\n");
  }
  CommandResult result;
  result.json = {{"campaign", arguments.out},
                 {"seed", arguments.has_seed ? arguments.seed : scenario.seed},
                 {"log_rows", campaign.campaign.log->time_s().size()},
                 {"observations", observations},
                 {"simulation_rows", campaign.simulation.size()},
                 {"touches", campaign.touches.size()},
                 {"images", campaign.captures ? campaign.captures->images() : 0},
                 {"scans", campaign.captures ? campaign.captures->scans() : 0},
                 {"elapsed_ms", campaign.elapsed_ms + writing_ms},
                 {"plant_ms", campaign.elapsed_ms},
                 {"writing_ms", writing_ms}};
  result.summary = fmt::format(
      "{}: {} log rows, {} observations, {} rows of simulation, {} touches{} (machine simulated in {}, {} in {})",
      arguments.out, campaign.campaign.log->time_s().size(), observations, campaign.simulation.size(),
      campaign.touches.size(),
      !campaign.captures
          ? ""
          : fmt::format(", {} images, {} scans", campaign.captures->images(), campaign.captures->scans()),
      durationText(campaign.elapsed_ms), campaign.captures ? "captures rendered and files written" : "files written",
      durationText(writing_ms));
  return result;
}

}  // namespace

void addSimulationCommands(CLI::App& app, CommandLine& line) {
  auto arguments = std::make_shared<SimulateArguments>();
  CLI::App* command = addCommand(app, line, "simulate",
                                 "Run the virtual machine and write a campaign as a real machine would have left it",
                                 [arguments](JobContext& job) { return simulate(*arguments, job); });
  command->add_option("SCENARIO", arguments->scenario, "Scenario (JSON, format spindrift-scenario)")->required();
  command->add_option("--out", arguments->out, "Folder of the campaign: new or empty")->required()->type_name("DIR");
  command->add_option("--seed", arguments->seed, "Seed of everything random, in place of the scenario's")
      ->check(CLI::NonNegativeNumber)
      ->each([arguments](const std::string&) { arguments->has_seed = true; });
  command
      ->add_option("--truth", arguments->truth,
                   "Also write what is hidden (effects, sizes, noise-free signals in um and urad) to this file")
      ->type_name("FILE");
}

}  // namespace spindrift::cli
