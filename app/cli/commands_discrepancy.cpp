// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>

#include "app/cli/command.h"
#include "core/workflows/discrepancy_workflow.h"

namespace spindrift::cli {

void addDiscrepancyCommands(CLI::App& app, CommandLine& line) {
  auto request = std::make_shared<DiscrepancyRequest>();
  CLI::App* command =
      addCommand(app, line, "discrepancy",
                 "Find where measurement and simulation disagree, and which physical effect the simulation lacks",
                 [request](JobContext& job) {
                   const DiscrepancyRun run = runDiscrepancy(*request, job);
                   std::string summary = run.result.summary();
                   if (run.update) summary += run.update->summary();
                   const bool put_in = !run.update || run.update->status == FitStatus::Converged;
                   return noted({run.json(), summary, run.result.decided && put_in ? Done : NotGoodEnough}, run.notes);
                 });
  command->add_option("CAMPAIGN", request->campaign, "Folder of the campaign")->required();
  command->add_option("--observations", request->observations, "Observations in place of the campaign's own (CSV)")
      ->type_name("FILE");
  command->add_option("--effects", request->effects, "Effects of your own in place of the campaign's (effects.json)")
      ->type_name("FILE");
  command->add_option("--accept", request->options.accept, "Always include this effect (id, repeatable)")
      ->type_name("ID");
  command->add_option("--reject", request->options.reject, "Do not consider this effect (id, repeatable)")
      ->type_name("ID");
  command->add_option("--max-effects", request->options.max_effects, "Maximum number of effects to add, 0 to 10")
      ->capture_default_str();
  command
      ->add_option("--suggest-hours", request->options.suggest_hours,
                   "Maximum duration of the suggested next measurement in h, at most 72")
      ->capture_default_str();
  command
      ->add_option("--suggest-points", request->options.suggest_points,
                   "Maximum number of points of the suggested next measurement, 1 to 50")
      ->capture_default_str();
  command
      ->add_option("--suggest-times", request->options.suggest_times,
                   "Maximum number of times at which it measures these points, 3 to 200")
      ->capture_default_str();
  command
      ->add_option("--simulator", request->simulator,
                   "Simulation that can be run (simulator.json): its parameters and sensors are searched as well. Runs "
                   "the programs that the file names")
      ->type_name("FILE");
  command
      ->add_option("--into-simulation", request->into_simulation,
                   "Put what is missing into the simulation: fit its physical parameters, run it again, write its new "
                   "version to this new folder")
      ->type_name("FOLDER");
  command
      ->add_option("--mechanism", request->mechanisms,
                   "Parameter of the simulator to put in, in place of those behind what is named (repeatable)")
      ->type_name("NAME");
  command->add_option("--model-out", request->model_out, "Write the effects found as model.json")->type_name("FILE");
  command
      ->add_option("--prediction", request->prediction,
                   "Write the completed model (simulation plus effects, µm or µrad) for every observation (CSV)")
      ->type_name("FILE");
  command->add_option("--html", request->html, "Write a report with plots (one HTML file)")->type_name("FILE");

  auto listing = std::make_shared<EffectsRequest>();
  CLI::App* effects = addCommand(
      app, line, "effects",
      "List the effects that the search knows: physics, drivers, shape, references; with a campaign those of its "
      "machine and of its effects.json",
      [listing](JobContext&) {
        const EffectsAnswer answer = listEffects(*listing);
        return CommandResult{answer.json(), answer.summary(), Done};
      });
  effects->add_option("CAMPAIGN", listing->campaign, "Folder of a campaign (without it: the whole catalogue)");
  effects->add_option("--effects", listing->effects, "Effects of your own (effects.json)")->type_name("FILE");
}

}  // namespace spindrift::cli
