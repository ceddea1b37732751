// SPDX-License-Identifier: GPL-3.0-or-later
// Every public header of the core has a page with what stands at its top, and Doxygen has nothing to warn of.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "tests/package/shell.h"
#include "tests/support/source_folder.h"
#include "tests/support/temp_folder.h"

namespace spindrift::testing {
namespace {

std::string contentOf(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

TEST(Documentation, EveryHeaderHasItsPageAndNothingIsWarnedOf) {
  const TempFolder folder;
  EXPECT_EQ(outputOf(fmt::format("cd {} && (cat resources/Doxyfile; echo OUTPUT_DIRECTORY={}) | doxygen -",
                                 sourceFolder().string(), folder.path().string())),
            "");
  std::string pages;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "html")) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with("_8h.html")) pages += contentOf(entry.path());
  }
  const std::filesystem::path sources = sourceFolder();
  int headers = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(sources / "core")) {
    if (entry.path().extension() != ".h") continue;
    ++headers;
    const std::string name = std::filesystem::relative(entry.path(), sources).string();
    EXPECT_NE(pages.find(name + " File Reference"), std::string::npos) << name;
    // The second line of a header is the first of its text.
    std::istringstream lines(contentOf(entry.path()));
    std::string line;
    std::getline(lines, line);
    std::getline(lines, line);
    EXPECT_TRUE(line.starts_with("// ") || line.starts_with("/* ")) << name << " does not say what it is for";
  }
  EXPECT_GE(headers, 200);
  EXPECT_NE(pages.find("A named physical cause of deviation"), std::string::npos);
}

}  // namespace
}  // namespace spindrift::testing
