// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <memory>

#include "app/cli/command.h"
#include "app/cli/session_source.h"
#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/json_reader.h"
#include "core/reporting/report_file.h"
#include "core/workflows/file_reference.h"
#include "core/workflows/log_campaign.h"
#include "core/workflows/manual.h"
#include "core/workflows/report_workflow.h"

namespace spindrift::cli {
namespace {

struct ReportArguments {
  std::string campaign;
  std::string of_session;  ///< name of a campaign
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
Report reportOf(const ReportArguments& arguments, JobContext& job) {
  if (!std::filesystem::is_regular_file(arguments.campaign))
    return reportOfCampaign(Campaign::read(arguments.campaign), arguments.options, job);
  const TemporaryFolder folder;
  writeLogCampaign(arguments.campaign, folder.path() / "campaign");
  return reportOfCampaign(Campaign::read(folder.path() / "campaign"), arguments.options, job);
}

CommandResult writeReport(const Report& report, const std::string& file, JobContext& job) {
  const std::size_t bytes = writeReportFile(report, file, job);
  return {{{"report", file}, {"bytes", bytes}}, fmt::format("written: {}\n", file), Done};
}

CommandResult listFiles(const std::string& id) {
  CommandResult result;
  result.summary = filesMarkdown(id);
  for (const FileFormat& format : fileFormats()) {
    if (!id.empty() && id != format.id) continue;
    nlohmann::json keys = nlohmann::json::array();
    for (const FileKey& key : format.keys)
      keys.push_back({{"path", key.path},
                      {"unit", key.unit},
                      {"without", key.without},
                      {"allowed", key.allowed},
                      {"meaning", key.meaning}});
    result.json["files"].push_back(
        {{"id", format.id}, {"file", format.file}, {"format", format.format}, {"keys", std::move(keys)}});
  }
  return result;
}

/// Of a session: the report that the window would write, filed where the window files it; a copy at --out.
CommandResult reportInSession(const ReportArguments& a, bool pdf, JobContext& job) {
  if (!a.thermal.empty() || !a.options.observations_file.empty()) {
    throw InputError({a.campaign, ""},
                     "is a session, which keeps its own results; --thermal and --observations are for the folder of a "
                     "campaign.");
  }
  SessionSource source(a.campaign, a.of_session, job);
  if (const std::string why = source.tasks().graph().whyNot("report"); !why.empty())
    throw InputError({a.campaign, ""}, "holds nothing to report: neither observations nor a log.");
  const auto written = [&] {
    const StoredResult* report = source.tasks().graph().latest("report");
    const std::string name = report == nullptr ? "" : report->payload.value(pdf ? "pdf" : "file", std::string());
    return source.tasks().graph().session().folder() / name;
  };
  source.tasks().run("report", job, !std::filesystem::is_regular_file(written()));
  const std::string bytes = readFile(written());
  writeFileAtomically(a.out, bytes);
  return {{{"report", a.out}, {"bytes", bytes.size()}}, fmt::format("written: {}\n", a.out), Done};
}

}  // namespace

void addReportingCommands(CLI::App& app, CommandLine& line) {
  auto arguments = std::make_shared<ReportArguments>();
  CLI::App* command = addCommand(
      app, line, "report",
      "Write the whole evaluation of a campaign, or of a log alone, as one self-contained file: HTML, or pages as PDF",
      [arguments](JobContext& job) {
        const bool pdf = isReportPdf(arguments->out);
        if (isSession(arguments->campaign)) return reportInSession(*arguments, pdf, job);
        if (!arguments->thermal.empty()) {
          const JsonNode result = JsonNode::read(arguments->thermal);
          for (const char* key : {"train", "test", "inputs"}) (void)result.at(key);
          arguments->options.stored.thermal = result.value();
        }
        return writeReport(reportOf(*arguments, job), arguments->out, job);
      });
  command
      ->add_option("CAMPAIGN", arguments->campaign,
                   "Folder of the campaign, of a session, or a LOG.csv with displacements (_um)")
      ->required();
  command->add_option("--campaign", arguments->of_session, "Campaign of the session; default: the one opened last")
      ->type_name("NAME");
  command->add_option("--thermal", arguments->thermal, "Result (JSON) of thermal identify to report with it")
      ->type_name("FILE");
  command->add_option("--out", arguments->out, "File to write, by its ending .html or .pdf")
      ->required()
      ->type_name("FILE");
  command
      ->add_option("--observations", arguments->options.observations_file,
                   "Observations in place of the campaign's own or its captures")
      ->type_name("FILE");
  command->add_option("--operator", arguments->options.operator_name, "Name of the operator, as printed in the report");
  command->add_flag("!--no-discrepancy", arguments->options.discrepancy,
                    "Do not search for a missing effect even if the campaign names a simulation");
  auto manual_file = std::make_shared<std::string>();
  addCommand(
      app, line, "manual",
      "Write the manual: instruments with worked examples, statistics, every effect with its figure, all commands",
      [manual_file, &app](JobContext& job) { return writeReport(manual(referenceMarkdown(app)), *manual_file, job); })
      ->add_option("--out", *manual_file, "File to write, by its ending .html or .pdf")
      ->required()
      ->type_name("FILE");
  auto file = std::make_shared<std::string>();
  addCommand(app, line, "files",
             "Print every file that is read or written with its keys and columns: unit, default, allowed values, "
             "meaning (Markdown)",
             [file](JobContext&) { return listFiles(*file); })
      ->add_option("FILE", *file, "One of them, such as machine or scenario (without it: all)");
}

}  // namespace spindrift::cli
