// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace spindrift::testing {

struct ShellOutcome {
  int status = -1;
  std::string output;  ///< standard output and error
};

/// Runs a line of bash.
[[nodiscard]] ShellOutcome shell(const std::string& line);

/// Expects status 0 and gives what was printed.
[[nodiscard]] std::string outputOf(const std::string& line);

[[nodiscard]] std::vector<std::string> linesIn(const std::string& text);

}  // namespace spindrift::testing
