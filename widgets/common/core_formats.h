// SPDX-License-Identifier: GPL-3.0-or-later
// The English formats of the sentences that core makes, as collected from its sources: a file of core_formats/ for each
// folder of core.
#pragma once

#include <vector>

namespace spindrift::gui {

/// In the notation of {fmt}: "axis {} is missing; allowed: an entry with its travel." Context "core" of the catalogues.
/// In alphabetical order, from any thread.
[[nodiscard]] const std::vector<const char*>& coreFormats();

}  // namespace spindrift::gui
