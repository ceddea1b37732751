// SPDX-License-Identifier: GPL-3.0-or-later
#include <clocale>

#include "app/cli/command.h"

int main(int argc, char** argv) {
  std::setlocale(LC_ALL, "C");
  CLI::App app(
      "Spindrift measures, explains, predicts and compensates thermal errors of machine tools.\n"
      "A campaign is a folder of plain files (campaign.json, machine.json, captures/, log.csv, observations.csv).\n"
      "Positions are in mm, deviations in um, angles in urad, time in s.\n"
      "Exit status: 0 done, 1 done but the answer is not good enough, 2 bad input or usage, 3 internal error.",
      "spindrift-cli");
  app.set_version_flag("--version", SPINDRIFT_VERSION);
  app.require_subcommand(1);
  app.get_formatter()->column_width(36);
  spindrift::cli::CommandLine line;
  spindrift::cli::addCaptureCommands(app, line);
  spindrift::cli::addImagingCommands(app, line);
  spindrift::cli::addEvaluateCommands(app, line);
  spindrift::cli::addKinematicsCommands(app, line);
  spindrift::cli::addScanningCommands(app, line);
  spindrift::cli::addProbingCommands(app, line);
  spindrift::cli::addThermalCommands(app, line);
  spindrift::cli::addSimulationCommands(app, line);
  spindrift::cli::addCompensationCommands(app, line);
  spindrift::cli::addDiscrepancyCommands(app, line);
  spindrift::cli::addReportingCommands(app, line);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int status = app.exit(error);
    return status == 0 ? spindrift::cli::Done : spindrift::cli::BadInput;
  }
  return spindrift::cli::runSelected(line);
}
