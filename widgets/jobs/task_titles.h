// SPDX-License-Identifier: GPL-3.0-or-later
// What the list of jobs says while a task runs.
#pragma once

#include <QString>
#include <string>

#include "core/tasks/campaign_facts.h"

namespace spindrift::gui {

/// "Evaluating the touches".
[[nodiscard]] QString taskTitle(const std::string& task, const CampaignFacts& facts);
/// Of all that is outdated.
[[nodiscard]] QString outdatedTitle();

}  // namespace spindrift::gui
