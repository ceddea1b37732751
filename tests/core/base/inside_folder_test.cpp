// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/inside_folder.h"

#include <gmock/gmock.h>

#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(InsideFolder, RefusesEveryWayOutAndKeepsWhatIsInside) {
  const testing::TempFolder folder;
  folder.write("secret/a.jpg", "x");
  folder.write("campaign/images/a.jpg", "x");
  std::filesystem::create_directory_symlink(folder / "secret", folder / "campaign/linked");
  std::filesystem::create_symlink(folder / "secret/a.jpg", folder / "campaign/images/link.jpg");
  std::filesystem::create_symlink(folder / "campaign/images/a.jpg", folder / "campaign/images/own.jpg");
  std::filesystem::create_symlink("ring.jpg", folder / "campaign/images/ring.jpg");
  InsideFolder inside(folder / "campaign");
  for (const std::string good :
       {"images/a.jpg", "images/../images/a.jpg", "images/none.jpg", "new/none.jpg", "images/own.jpg", "..a.jpg"})
    EXPECT_EQ(inside.path(good, {"list.csv", "line 2"}), folder / "campaign" / good) << good;
  for (const std::string& bad :
       {std::string("../secret/a.jpg"), std::string("images/../../secret/a.jpg"), (folder / "secret/a.jpg").string(),
        std::string("linked/a.jpg"), std::string("linked/none.jpg"), std::string("images/link.jpg"), std::string(".."),
        std::string(""), std::string("images/ring.jpg"), std::string("/")}) {
    try {
      (void)inside.path(bad, {"list.csv", "line 2"});
      FAIL() << bad;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr("list.csv, line 2: \"" + bad + "\""), HasSubstr("allowed")));
    }
  }
}

TEST(InsideFolder, AFolderThatIsItselfReachedByALinkIsFine) {
  const testing::TempFolder folder;
  folder.write("real/images/a.jpg", "x");
  std::filesystem::create_directory_symlink(folder / "real", folder / "campaign");
  InsideFolder inside(folder / "campaign");
  EXPECT_EQ(inside.path("images/a.jpg", {}), folder / "campaign/images/a.jpg");
}

}  // namespace
}  // namespace spindrift
