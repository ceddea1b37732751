// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "app/cli/command.h"
#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/workflows/report_workflow.h"

namespace spindrift::cli {
namespace {

struct ReportArguments {
  std::string campaign;
  std::string out;
  ReportOptions options;
};

}  // namespace

void addReportingCommands(CLI::App& app, CommandLine& line) {
  auto arguments = std::make_shared<ReportArguments>();
  CLI::App* command = addCommand(
      app, line, "report", "Write the whole evaluation of a campaign as one self-contained HTML file",
      [arguments](JobContext& job) {
        const std::string ending = std::filesystem::path(arguments->out).extension().string();
        if (ending != ".html" && ending != ".htm") {
          throw InputError({arguments->out, ""},
                           "is no name of a web page; allowed: a name that ends in .html (the desktop program "
                           "writes PDF).");
        }
        const Campaign campaign = Campaign::read(arguments->campaign);
        const std::string html = campaignReportHtml(campaign, arguments->options, job);
        writeFileAtomically(arguments->out, html);
        return CommandResult{{{"report", arguments->out}, {"bytes", html.size()}},
                             fmt::format("report written to {}\n", arguments->out),
                             Done};
      });
  command->add_option("CAMPAIGN", arguments->campaign, "Folder of the campaign")->required();
  command->add_option("--out", arguments->out, "HTML file to write")->required()->type_name("FILE.html");
  command
      ->add_option("--observations", arguments->options.observations_file,
                   "Observations in place of the campaign's own or its captures")
      ->type_name("FILE");
  command->add_option("--operator", arguments->options.operator_name, "Name of the operator for the last line");
  command->add_flag("!--no-discrepancy", arguments->options.discrepancy,
                    "Do not search for a missing effect even if the campaign names a simulation");
}

}  // namespace spindrift::cli
