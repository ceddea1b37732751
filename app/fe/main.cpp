// SPDX-License-Identifier: GPL-3.0-or-later
// `spindrift-cli simulation import` for the files of VTK.
#include <clocale>
#include <iostream>

#include "app/cli/commands_finite_elements.h"
#include "app/fe/vtk_result.h"

int main(int argc, char** argv) {
  std::setlocale(LC_ALL, "C");
  CLI::App app("Spindrift reads results of finite elements: CalculiX .frd and .dat, VTK .vtu and .pvd.",
               "spindrift-fe");
  app.set_version_flag("--version", SPINDRIFT_VERSION);
  app.require_subcommand(1);
  app.get_formatter()->column_width(36);
  spindrift::cli::CommandLine line;
  spindrift::cli::addFiniteElementCommands(app, line,
                                           [](const std::filesystem::path& file, const spindrift::FeMap& map) {
                                             if (file.extension() == ".vtu" || file.extension() == ".pvd") {
                                               return spindrift::openVtkResult(file, map.displacement_array);
                                             }
                                             return spindrift::openFeResult(file);
                                           });
  spindrift::cli::addReference(app, "displacements of finite elements as a simulation of a machine tool",
                               {"spindrift", "spindrift-cli"});
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // help, version
    std::cerr << "spindrift-fe: " << spindrift::cli::usageSentence(app, error) << '\n';
    return spindrift::cli::BadInput;
  }
  return spindrift::cli::runSelected(line);
}
