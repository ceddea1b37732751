// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

namespace spindrift::testing {

/// Runs `body` in a process of its own, where limits, mounts and user ids may be changed without harm. Returns what
/// `body` returned, or "exception: ..." or "ended by signal N".
[[nodiscard]] std::string inChildProcess(const std::function<std::string()>& body);

}  // namespace spindrift::testing
