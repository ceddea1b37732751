// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace spindrift::testing {

/// Runs `body` in a process of its own, where limits, mounts and user ids may be changed without harm. Returns what
/// `body` returned, or "exception: ..." or "ended by signal N".
[[nodiscard]] std::string inChildProcess(const std::function<std::string()>& body);

/// For a child process: from now on it gets `bytes` more of address space, and std::bad_alloc beyond. False under the
/// address sanitizer, which takes more than any limit.
bool limitMemory(std::size_t bytes);

}  // namespace spindrift::testing
