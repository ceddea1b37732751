// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <memory>

#include "app/cli/command.h"
#include "core/base/atomic_file.h"
#include "core/base/count_text.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/simulation/virtual_campaign.h"
#include "core/simulator/c_frame.h"

namespace spindrift::cli {
namespace {

struct SimulateArguments {
  std::string scenario;
  std::string c_frame;
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

/// The finite-element machine with one cause left out of its simulation.
CommandResult simulateCFrame(const SimulateArguments& arguments, JobContext& job) {
  const auto story = cFrameStoryFromString(arguments.c_frame);
  if (!story) {
    throw InputError(fmt::format("--c-frame \"{}\" is not known; allowed: {}.", arguments.c_frame,
                                 joinedList(cFrameStoryNames(), "or")));
  }
  const std::uint64_t seed = arguments.has_seed ? arguments.seed : 1;
  const CFrameCampaign campaign = writeCFrameCampaign(*story, arguments.out, seed, job);
  if (!arguments.truth.empty()) writeFileAtomically(arguments.truth, campaign.truth.dump(1) + "\n");
  CommandResult result;
  result.json = {{"campaign", arguments.out},
                 {"seed", seed},
                 {"story", toString(*story)},
                 {"observations", campaign.observations},
                 {"simulation_rows", campaign.simulation_rows},
                 {"simulation_nodes", campaign.coarse_nodes},
                 {"simulation_run_ms", 1e3 * campaign.coarse_s},
                 {"measured_nodes", campaign.fine_nodes},
                 {"measured_run_ms", 1e3 * campaign.fine_s},
                 {"elapsed_ms", 1e3 * campaign.elapsed_s}};
  result.summary = fmt::format(
      "{}: finite-element machine, story {}: {} observations from {} nodes, simulation from {} nodes ({} a run), "
      "written in {}",
      arguments.out, toString(*story), campaign.observations, campaign.fine_nodes, campaign.coarse_nodes,
      durationText(1e3 * campaign.coarse_s), durationText(1e3 * campaign.elapsed_s));
  return result;
}

CommandResult simulate(const SimulateArguments& arguments, JobContext& job) {
  if (arguments.scenario.empty() == arguments.c_frame.empty()) {
    throw InputError("Nothing to simulate is given, or two things; allowed: a SCENARIO or --c-frame.");
  }
  if (!arguments.c_frame.empty()) return simulateCFrame(arguments, job);
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
      "{}: {}, {}, {} of simulation, {}{} (machine simulated in {}, {} in {})", arguments.out,
      countOf(campaign.campaign.log->time_s().size(), "log row"), countOf(observations, "observation"),
      countOf(campaign.simulation.size(), "row"), countOf(campaign.touches.size(), "touch", "touches"),
      !campaign.captures ? ""
                         : fmt::format(", {}, {}", countOf(campaign.captures->images(), "image"),
                                       countOf(campaign.captures->scans(), "scan")),
      durationText(campaign.elapsed_ms), campaign.captures ? "captures rendered and files written" : "files written",
      durationText(writing_ms));
  return result;
}

}  // namespace

void addSimulationCommands(CLI::App& app, CommandLine& line) {
  auto arguments = std::make_shared<SimulateArguments>();
  CLI::App* command =
      addCommand(app, line, "simulate", "Run the virtual machine and write a campaign like that of a real machine",
                 [arguments](JobContext& job) { return simulate(*arguments, job); });
  command->add_option("SCENARIO", arguments->scenario, "Scenario (JSON, format spindrift-scenario)");
  command
      ->add_option("--c-frame", arguments->c_frame,
                   "In place of a scenario: a machining centre in CalculiX (must be installed) whose simulation lacks "
                   "one cause, sun, friction, coolant or room; the truth is written to <out>.truth.json")
      ->type_name("STORY");
  command->add_option("--out", arguments->out, "Folder of the campaign: new or empty")->required()->type_name("DIR");
  command->add_option("--seed", arguments->seed, "Random seed, instead of that of the scenario")
      ->check(nonNegativeNumber())
      ->each([arguments](const std::string&) { arguments->has_seed = true; });
  command
      ->add_option(
          "--truth", arguments->truth,
          "Also write the hidden truth (effects, sizes, noise-free signals; keys with _um and _urad) to this file")
      ->type_name("FILE");
}

}  // namespace spindrift::cli
