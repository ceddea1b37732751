// SPDX-License-Identifier: GPL-3.0-or-later
// The completion of bash, asked as bash asks it.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include "tests/package/shell.h"
#include "tests/support/temp_folder.h"

namespace spindrift::testing {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

/// What is offered for the last of the words. `=` is a word of its own, as bash breaks them.
std::vector<std::string> offered(const std::string& program, const std::vector<std::string>& words) {
  std::vector<std::string> quoted;
  for (const std::string& word : words) quoted.push_back("'" + word + "'");
  return linesIn(
      outputOf(fmt::format("source <({0}/{1} --reference bash)\nCOMP_WORDS=({1} {2})\nCOMP_CWORD={3}\n"
                           "_{4}\nfor one in \"${{COMPREPLY[@]}}\"; do echo \"$one\"; done",
                           SPINDRIFT_PROGRAMS, program, fmt::join(quoted, " "), words.size(),
                           program == "spindrift-cli" ? "spindrift_cli" : "spindrift")));
}

TEST(Completion, OffersCommandsOptionsAndTheirValues) {
  EXPECT_THAT(offered("spindrift-cli", {"ev"}), ElementsAre("evaluate"));
  EXPECT_THAT(offered("spindrift-cli", {"thermal", "i"}), ElementsAre("identify", "iso230-3"));
  EXPECT_THAT(offered("spindrift-cli", {"fit", "--ro"}), ElementsAre("--robust"));
  EXPECT_THAT(offered("spindrift-cli", {"fit", "--robust", ""}), ElementsAre("none", "huber", "tukey"));
  EXPECT_THAT(offered("spindrift-cli", {"fit", "--robust", "=", "t"}), ElementsAre("tukey"));
  EXPECT_THAT(offered("spindrift", {"--theme", ""}), ElementsAre("light", "dark"));
  EXPECT_THAT(offered("spindrift", {"--to"}), ElementsAre("--tour"));
}

// A word that is the value of an option is no command, and where files are wanted bash offers its own.
TEST(Completion, KnowsWhereItIs) {
  EXPECT_THAT(offered("spindrift-cli", {"fit", "--state", "thermal", "--js"}), ElementsAre("--json"));
  EXPECT_THAT(offered("spindrift-cli", {"thermal", "track", "--model", "identify", "--interv"}),
              ElementsAre("--interval"));
  EXPECT_THAT(offered("spindrift-cli", {"fit", "--json", ""}), IsEmpty());
  EXPECT_THAT(offered("spindrift-cli", {"fit", ""}), IsEmpty());
  EXPECT_THAT(offered("spindrift-cli", {"thermal", ""}), Not(Contains(StartsWith("evaluate"))));
}

}  // namespace
}  // namespace spindrift::testing
