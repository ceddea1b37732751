// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/package/shell.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <sstream>

#include "tests/support/temp_folder.h"

namespace spindrift::testing {

ShellOutcome shell(const std::string& line) {
  const TempFolder folder;
  // Without a folder of its own for the run Qt complains beside what a program says.
  const std::string command = "XDG_RUNTIME_DIR=" + folder.path().string() + " QT_QPA_PLATFORM=offscreen bash " +
                              folder.write("line.sh", "set -o pipefail\n" + line + "\n").string() + " 2>&1";
  ShellOutcome outcome;
  std::FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return outcome;
  std::array<char, 4096> part{};
  for (std::size_t n = 0; (n = std::fread(part.data(), 1, part.size(), pipe)) > 0;)
    outcome.output.append(part.data(), n);
  const int status = ::pclose(pipe);
  if (WIFEXITED(status)) outcome.status = WEXITSTATUS(status);
  return outcome;
}

std::string outputOf(const std::string& line) {
  const ShellOutcome outcome = shell(line);
  EXPECT_EQ(outcome.status, 0) << line << '\n' << outcome.output;
  return outcome.output;
}

std::vector<std::string> linesIn(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

}  // namespace spindrift::testing
