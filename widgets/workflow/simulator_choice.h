// SPDX-License-Identifier: GPL-3.0-or-later
// Which simulator the session takes for the campaign at hand: the one that was chosen or written last (an option of the
// session, so that it can be undone), else the one that campaign.json names; and the stored search with it.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "core/session/session.h"

namespace spindrift::gui {

class SessionModel;

/// Kind of the stored results: SimulationStory::json. Their options "simulator" and "version" name the simulator that
/// was searched with and the new version that was written (empty: none), "choice" what the search left out.
inline constexpr auto simulation_result = "simulation";

/// Key of the option, whose value is a name.
[[nodiscard]] std::string simulatorKey(const SessionModel& session);
[[nodiscard]] std::string simulatorKey(std::int64_t campaign);
/// What the session calls a simulator.json: relative to its folder, if it lies there.
[[nodiscard]] std::string simulatorName(const SessionModel& session, const std::filesystem::path& file);
[[nodiscard]] std::filesystem::path simulatorFile(const SessionModel& session, const std::string& name);
/// The name of the one at hand; empty: none.
[[nodiscard]] std::string currentSimulator(const SessionModel& session);

/// The newest result that belongs to a simulator (search, or the update that made it), without its payload; id 0: none.
[[nodiscard]] StoredResult simulationResult(SessionModel& session, const std::string& simulator);
/// The payload of the result that made the simulator at hand, for reports; null if there is none.
[[nodiscard]] nlohmann::json simulationUpdateOf(SessionModel& session);

}  // namespace spindrift::gui
