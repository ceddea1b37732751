// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <algorithm>
#include <clocale>
#include <filesystem>
#include <iostream>

#include "app/cli/command.h"
#include "app/cli/commands_finite_elements.h"
#include "core/base/error.h"

namespace {

bool knows(const CLI::App& app, const std::string& command) {
  const auto all = app.get_subcommands([](const CLI::App*) { return true; });
  return std::any_of(all.begin(), all.end(), [&](const CLI::App* one) { return one->check_name(command); });
}

/// VTK stays out of this program: spindrift-fe beside it takes the same arguments and goes on in its place.
void goOnInFe(char** argv) {
  std::error_code none;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", none);
  const std::filesystem::path other = self.parent_path() / "spindrift-fe";
  if (none || !std::filesystem::exists(other, none)) return;
  std::cout.flush();
  execv(other.c_str(), argv);  // returns only if it failed
}

}  // namespace

int main(int argc, char** argv) {
  std::setlocale(LC_ALL, "C");
  CLI::App app(
      "Spindrift measures, explains, predicts and compensates thermal errors of machine tools.\n"
      "A campaign is a folder of plain files (campaign.json, machine.json, captures/, log.csv, observations.csv).\n"
      "Positions are in mm, deviations in µm, angles in µrad, times in s; files write um and urad.\n"
      "Exit status: 0 success, 1 success but the result does not meet its criterion, 2 invalid input or usage, 3 "
      "internal error.",
      "spindrift-cli");
  app.set_version_flag("--version", SPINDRIFT_VERSION);
  app.require_subcommand(1);
  app.get_formatter()->column_width(36);
  spindrift::cli::CommandLine line;
  spindrift::cli::addCaptureCommands(app, line);
  spindrift::cli::addConnectCommands(app, line);
  spindrift::cli::addImagingCommands(app, line);
  spindrift::cli::addEvaluateCommands(app, line);
  spindrift::cli::addKinematicsCommands(app, line);
  spindrift::cli::addLoopCommands(app, line);
  spindrift::cli::addScanningCommands(app, line);
  spindrift::cli::addProbingCommands(app, line);
  spindrift::cli::addThermalCommands(app, line);
  spindrift::cli::addSimulationCommands(app, line);
  spindrift::cli::addCompensationCommands(app, line);
  spindrift::cli::addDiscrepancyCommands(app, line);
  spindrift::cli::addFiniteElementCommands(app, line,
                                           [argv](const std::filesystem::path& file, const spindrift::FeMap&) {
                                             if (file.extension() == ".vtu" || file.extension() == ".pvd")
                                               goOnInFe(argv);
                                             return spindrift::openFeResult(file);
                                           });
  spindrift::cli::addTeachingCommands(app, line);
  spindrift::cli::addReportingCommands(app, line);
  spindrift::cli::addSessionCommands(app, line);
  spindrift::cli::addPlantCommands(app, line);
  spindrift::cli::addReference(app, "thermal errors of machine tools: measure, explain, predict, compensate",
                               {"spindrift", "spindrift-fe"});
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // help, version
    std::string sentence = spindrift::cli::usageSentence(app, error);
    if (argc > 1 && argv[1][0] != '-' && !knows(app, argv[1]))
      sentence = "\"" + std::string(argv[1]) + "\" is not a command; allowed: those that --help lists.";
    std::cerr << "spindrift-cli: " << sentence << '\n';
    return spindrift::cli::BadInput;
  }
  return spindrift::cli::runSelected(line);
}
