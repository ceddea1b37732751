// SPDX-License-Identifier: Apache-2.0
// Runs the deck of the C-frame example machine with CalculiX, as a program of its own in a folder of its own.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/job_context.h"
#include "core/finite_elements/c_frame_deck.h"
#include "core/machine/operating_log.h"
#include "core/machine/simulation_row.h"

namespace spindrift {

/// True if a program `ccx` stands in one of the folders of PATH.
[[nodiscard]] bool calculixIsInstalled();

/// Lines "time, value" of every table of the deck over its duration: at the end of each increment, or the mean over it.
/// Throws InputError if the log lacks a column.
[[nodiscard]] std::map<std::string, std::string> deckTables(const CFrameDeck& deck, const OperatingLog& log,
                                                            const CFrameValues& values);

/// The text with every {{name}}, {{name*factor}} and {{table:NAME}} replaced. A name that is not known is a bug.
[[nodiscard]] std::string fillDeck(std::string_view text, const CFrameValues& values,
                                   const std::map<std::string, std::string>& tables);

/// Runs `ccx -i job_name` in `folder` on one core. Throws InputError: not installed, longer than the limit, a failure
/// status or *ERROR in what it printed (with its last lines); Cancelled.
void runCalculix(const std::filesystem::path& folder, const std::string& job_name, double time_limit_s,
                 const JobContext& job);

/// Deviations of all points and components (um, urad) at the start and at the end of every state; `changes` replace the
/// values of the deck. Throws InputError: see runCalculix; displacements of another number of states than the deck has.
[[nodiscard]] std::vector<SimulationRow> runDeck(const CFrameDeck& deck, const OperatingLog& log,
                                                 const CFrameValues& changes, const JobContext& job);

}  // namespace spindrift
