// SPDX-License-Identifier: GPL-3.0-or-later
// The English formats of the sentences that core makes, as collected from its sources.
#pragma once

#include <span>

namespace spindrift::gui {

/// In the notation of {fmt}: "axis {} is missing; allowed: an entry with its travel." Context "core" of the catalogues.
[[nodiscard]] std::span<const char* const> coreFormats() noexcept;

}  // namespace spindrift::gui
