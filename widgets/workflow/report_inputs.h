// SPDX-License-Identifier: GPL-3.0-or-later
// What a report tells of a session beside its campaign: held against what was there when it was written.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace spindrift::gui {

class SessionModel;

/// Results (by their ids), the word on the warm-up and the options of the fit, to be kept with a report. Another value
/// later means that the report has to be written again.
[[nodiscard]] nlohmann::json reportedInputs(const SessionModel& session);

}  // namespace spindrift::gui
