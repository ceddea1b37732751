// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "app/cli/command.h"
#include "app/cli/session_source.h"
#include "core/base/count_text.h"
#include "core/base/error.h"
#include "core/workflows/capture_check.h"
#include "core/workflows/evaluate_campaign.h"

namespace spindrift::cli {
namespace {

struct EvaluateArguments {
  std::string campaign;
  std::string of_session;  ///< name of a campaign
  std::string out;
  EvaluateOptions options;
  std::vector<std::string> excluded;
};

CommandResult check(const EvaluateArguments& a, JobContext& job) {
  Campaign campaign = Campaign::read(a.campaign);
  campaign.excluded_captures.insert(a.excluded.begin(), a.excluded.end());
  const std::vector<CheckedCapture> captures = checkFiducialCaptures(campaign, job);
  CommandResult result;
  result.json["captures"] = nlohmann::json::array();
  std::size_t bad = 0;
  for (const CheckedCapture& c : captures) {
    const bool excluded = campaign.excluded_captures.contains(c.image);
    result.json["captures"].push_back(c.json());
    result.json["captures"].back()["excluded"] = excluded;
    if (c.good || excluded) continue;
    ++bad;
    result.summary += fmt::format("{}: {}\n", c.image, c.sentence);
  }
  result.json["to_take_again"] = bad;
  result.summary +=
      bad == 0 ? fmt::format("{} checked: all can be used\n", countOf(captures.size(), "image"))
               : fmt::format("{} of {} failed the check: take {} again, or exclude {}\n", bad,
                             countOf(captures.size(), "image"), bad == 1 ? "it" : "them", bad == 1 ? "it" : "them");
  if (bad > 0) result.exit_status = NotGoodEnough;
  return result;
}

/// Of a session: what it keeps, if that still holds, else worked out and kept.
CommandResult evaluateInSession(const EvaluateArguments& a, JobContext& job) {
  if (!a.excluded.empty() || !a.options.scan_model.empty()) {
    throw InputError({a.campaign, ""},
                     "is a session, which keeps its own exclusions and models; --exclude and --scan-model are for the "
                     "folder of a campaign.");
  }
  SessionSource source(a.campaign, a.of_session, job);
  const bool made = !source.tasks().run("evaluate", job).empty();
  const auto kept = source.state().evaluation(source.tasks().graph());
  const StoredEvaluation& evaluation = *kept;
  if (!a.out.empty()) evaluation.observations.write(a.out);
  return {evaluation.details,
          made ? evaluation.summary : evaluation.summary + "taken from the session: still current\n",
          evaluation.good_enough ? Done : NotGoodEnough};
}

void addCheck(CLI::App& app, CommandLine& line) {
  auto a = std::make_shared<EvaluateArguments>();
  CLI::App* command = addCommand(app, line, "check",
                                 "Check whether every image of a campaign can be evaluated and matches its list entry "
                                 "(spindle angle, position, focus). Exit status 1: images have to be repeated",
                                 [a](JobContext& job) { return check(*a, job); });
  command->add_option("CAMPAIGN", a->campaign, "Folder of the campaign")->required();
  command->add_option("--exclude", a->excluded, "Exclude a capture (file name as in its list)")->type_name("ITEM");
}

}  // namespace

void addEvaluateCommands(CLI::App& app, CommandLine& line) {
  addCheck(app, line);
  auto arguments = std::make_shared<EvaluateArguments>();
  CLI::App* command = addCommand(
      app, line, "evaluate", "Evaluate the raw captures of a campaign into observations with uncertainties",
      [arguments](JobContext& job) {
        if (isSession(arguments->campaign)) return evaluateInSession(*arguments, job);
        Campaign campaign = Campaign::read(arguments->campaign);
        campaign.excluded_captures.insert(arguments->excluded.begin(), arguments->excluded.end());
        const CampaignEvaluation evaluation = evaluateCampaign(campaign, arguments->options, job);
        if (!arguments->out.empty()) evaluation.observations.write(arguments->out);
        return CommandResult{evaluation.json(), evaluation.summary(), evaluation.good_enough ? Done : NotGoodEnough};
      });
  command->add_option("CAMPAIGN", arguments->campaign, "Folder of the campaign, or of a session")->required();
  command->add_option("--campaign", arguments->of_session, "Campaign of the session; default: the one opened last")
      ->type_name("NAME");
  command->add_option("--out", arguments->out, "Write the observations to this CSV file")->type_name("FILE");
  command
      ->add_option("--scan-model", arguments->options.scan_model,
                   "Model of a laser scan, in place of the one in machine.json")
      ->check(oneOf({"rigid", "push_broom"}));
  command
      ->add_option("--exclude", arguments->excluded,
                   "Exclude a capture (file name as in its list) or a part of a scan (\"mask/CLOUD: erase lasso X,Y "
                   "X,Y X,Y\"; also rectangle X,Y X,Y and brush RADIUS X,Y ..., mm in the scan's frame)")
      ->type_name("ITEM");
}

}  // namespace spindrift::cli
