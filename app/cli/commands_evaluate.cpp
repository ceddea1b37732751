// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <string>
#include <vector>

#include "app/cli/command.h"
#include "core/workflows/evaluate_campaign.h"

namespace spindrift::cli {
namespace {

struct EvaluateArguments {
  std::string campaign;
  std::string out;
  EvaluateOptions options;
  std::vector<std::string> excluded;
};

}  // namespace

void addEvaluateCommands(CLI::App& app, CommandLine& line) {
  auto arguments = std::make_shared<EvaluateArguments>();
  CLI::App* command = addCommand(
      app, line, "evaluate", "Evaluate the raw captures of a campaign into observations with uncertainties",
      [arguments](JobContext& job) {
        Campaign campaign = Campaign::read(arguments->campaign);
        campaign.excluded_captures.insert(arguments->excluded.begin(), arguments->excluded.end());
        const CampaignEvaluation evaluation = evaluateCampaign(campaign, arguments->options, job);
        if (!arguments->out.empty()) evaluation.observations.write(arguments->out);
        return CommandResult{evaluation.json(), evaluation.summary(), evaluation.good_enough ? Done : NotGoodEnough};
      });
  command->add_option("CAMPAIGN", arguments->campaign, "Folder of the campaign")->required();
  command->add_option("--out", arguments->out, "Write the observations to this CSV file")->type_name("FILE");
  command
      ->add_option("--scan-model", arguments->options.scan_model,
                   "Model of a laser scan, in place of the one in machine.json")
      ->check(CLI::IsMember({"rigid", "push_broom"}));
  command
      ->add_option("--exclude", arguments->excluded,
                   "Leave out a capture (its file as the list names it) or a part of a scan "
                   "(\"mask/CLOUD: erase lasso X,Y X,Y X,Y\"; also rectangle X,Y X,Y and brush RADIUS X,Y ..., mm "
                   "in the scan's frame)")
      ->type_name("ITEM");
}

}  // namespace spindrift::cli
