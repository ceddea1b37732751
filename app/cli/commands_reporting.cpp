// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <memory>

#include "app/cli/command.h"
#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/json_reader.h"
#include "core/workflows/log_campaign.h"
#include "core/workflows/report_workflow.h"

namespace spindrift::cli {
namespace {

struct ReportArguments {
  std::string campaign;
  std::string out;
  std::string thermal;
  ReportOptions options;
};

/// A folder for as long as it is needed.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "spindrift-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) throw InputError({pattern, ""}, "no temporary folder could be made.");
    path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Of the folder of a campaign, or of a log alone.
std::string reportOf(const ReportArguments& arguments, JobContext& job) {
  if (!std::filesystem::is_regular_file(arguments.campaign))
    return campaignReportHtml(Campaign::read(arguments.campaign), arguments.options, job);
  const TemporaryFolder folder;
  writeLogCampaign(arguments.campaign, folder.path() / "campaign");
  return campaignReportHtml(Campaign::read(folder.path() / "campaign"), arguments.options, job);
}

}  // namespace

void addReportingCommands(CLI::App& app, CommandLine& line) {
  auto arguments = std::make_shared<ReportArguments>();
  CLI::App* command = addCommand(
      app, line, "report",
      "Write the whole evaluation of a campaign, or of a log alone, as one self-contained HTML file",
      [arguments](JobContext& job) {
        const std::string ending = std::filesystem::path(arguments->out).extension().string();
        if (ending != ".html" && ending != ".htm") {
          throw InputError({arguments->out, ""},
                           "is no name of a web page; allowed: a name that ends in .html (the desktop program "
                           "writes PDF).");
        }
        if (!arguments->thermal.empty()) {
          const JsonNode result = JsonNode::read(arguments->thermal);
          for (const char* key : {"train", "test", "inputs"}) (void)result.at(key);
          arguments->options.stored.thermal = result.value();
        }
        const std::string html = reportOf(*arguments, job);
        writeFileAtomically(arguments->out, html);
        return CommandResult{{{"report", arguments->out}, {"bytes", html.size()}},
                             fmt::format("report written to {}\n", arguments->out),
                             Done};
      });
  command->add_option("CAMPAIGN", arguments->campaign, "Folder of the campaign, or a LOG.csv with displacements (_um)")
      ->required();
  command->add_option("--thermal", arguments->thermal, "Result (JSON) of thermal identify to report with it")
      ->type_name("FILE");
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
