// SPDX-License-Identifier: GPL-3.0-or-later
// `simulation import`, shared by spindrift-cli and by spindrift-fe, which also reads VTK.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "app/cli/command.h"
#include "core/finite_elements/fe_map.h"
#include "core/finite_elements/fe_result.h"

namespace spindrift::cli {

/// Opens a result; the map says which array of a VTK file holds displacements.
using ReaderOfMap = std::function<std::unique_ptr<FeResultReader>(const std::filesystem::path& file, const FeMap& map)>;

void addFiniteElementCommands(CLI::App& app, CommandLine& line, const ReaderOfMap& open);

}  // namespace spindrift::cli
