// SPDX-License-Identifier: Apache-2.0
// Time for waiting and ages, s: from a clock that nobody sets.
#pragma once

#include <chrono>

namespace spindrift {

/// Time since an arbitrary moment, s; never jumps when somebody sets the clock. For waiting and ages, not for files.
[[nodiscard]] inline double steadySeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// How long ago that was, s.
[[nodiscard]] inline double secondsSince(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace spindrift
