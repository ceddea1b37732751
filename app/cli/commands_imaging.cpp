// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/command.h"

namespace spindrift::cli {

void addImagingCommands(CLI::App& /*app*/, CommandLine& /*line*/) {}

}  // namespace spindrift::cli
