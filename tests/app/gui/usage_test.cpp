// SPDX-License-Identifier: GPL-3.0-or-later
// What the desktop program says of a command line that it cannot follow.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>

#include "core/base/atomic_file.h"
#include "tests/support/temp_folder.h"

namespace spindrift::testing {
namespace {

struct Outcome {
  int status = -1;  ///< 124: it did not end by itself
  std::string text;
};

/// Standard output and error together, and the exit status.
Outcome start(const std::string& arguments) {
  // Without a folder of its own for the run Qt complains beside what the program says.
  const TempFolder home;
  const std::string command = "QT_QPA_PLATFORM=offscreen XDG_RUNTIME_DIR='" + home.path().string() +
                              "' timeout 30 '" SPINDRIFT_PROGRAM "' " + arguments + " 2>&1";
  Outcome outcome;
  FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return outcome;
  std::array<char, 256> buffer{};
  while (std::fgets(buffer.data(), static_cast<int>(buffer.size()), pipe) != nullptr) outcome.text += buffer.data();
  const int status = ::pclose(pipe);
  if (WIFEXITED(status)) outcome.status = WEXITSTATUS(status);
  return outcome;
}

void expectRefused(const std::string& arguments, const std::string& part, const std::string& allowed) {
  const Outcome outcome = start(arguments);
  EXPECT_EQ(outcome.status, 2) << arguments << '\n' << outcome.text;
  EXPECT_EQ(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 1) << arguments << '\n' << outcome.text;
  EXPECT_NE(outcome.text.find(part), std::string::npos) << arguments << '\n' << outcome.text;
  EXPECT_NE(outcome.text.find(allowed), std::string::npos) << arguments << '\n' << outcome.text;
}

TEST(GuiUsage, WhatIsNotAllowedIsRefusedInOneSentence) {
  expectRefused("--scale 99", "99", "from 0.5 to 4");
  expectRefused("--scale=0.1", "0.1", "from 0.5 to 4");
  expectRefused("--scale big", "big", "from 0.5 to 4");
  expectRefused("--scale nan", "nan", "from 0.5 to 4");
  expectRefused("--demo nonsense", "nonsense", "fiducials, holes, balls, scans, discrepancy or own_pattern");
  expectRefused("--theme pink", "pink", "light or dark");
  expectRefused("--language fr", "fr", "en or de");
  expectRefused("--json x.json", "--json", "--self-test");
  expectRefused("--record x.json --self-test", "--record", "somebody uses the window");
  expectRefused("--record /proc/x.json", "/proc/x.json", "written");
  expectRefused("--language de --manual manual.txt", "manual.txt", ".html or .pdf");
  expectRefused("--manual manual.pdf", "English", "spindrift-cli manual");
  expectRefused("--language de --manual /proc/manual.html", "/proc/manual.html", "written");
  expectRefused("one two", "two", "one session");
  EXPECT_EQ(start("--nonsense").status, 2);
}

TEST(GuiUsage, WhatIsAllowedRuns) {
  EXPECT_EQ(start("--version").status, 0);
  EXPECT_EQ(start("--scale 2 --help").status, 0);
  EXPECT_EQ(start("--scale=1.5 --theme dark --startup-time").status, 0);
}

TEST(GuiUsage, TheManualIsWrittenInTheLanguageThatIsAskedFor) {
  const TempFolder folder;
  const std::string file = (folder / "manual.html").string();
  const Outcome outcome = start("--language de --manual '" + file + "'");
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  const std::string html = readFile(file);
  EXPECT_NE(html.find("lang=\"de\""), std::string::npos);
  EXPECT_NE(html.find("Wie Spindrift denkt"), std::string::npos);
}

}  // namespace
}  // namespace spindrift::testing
