// SPDX-License-Identifier: GPL-3.0-or-later
// The simulator of the campaign at hand, as core/tasks names it, and the stored search with it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/session/session.h"

namespace spindrift::gui {

class SessionModel;

/// Key of the option, whose value is a name.
[[nodiscard]] std::string simulatorKey(std::int64_t campaign);
[[nodiscard]] std::filesystem::path simulatorFile(const SessionModel& session, const std::string& name);
/// The name of the one at hand; empty: none.
[[nodiscard]] std::string currentSimulator(const SessionModel& session);

/// The newest result that belongs to a simulator (search, or the update that made it), without its payload; id 0: none.
[[nodiscard]] StoredResult simulationResult(const SessionModel& session, const std::string& simulator);

}  // namespace spindrift::gui
