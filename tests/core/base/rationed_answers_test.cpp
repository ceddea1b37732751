// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/rationed_answers.h"

#include <gtest/gtest.h>

#include <thread>

namespace spindrift {
namespace {

using std::chrono::milliseconds;

TEST(RationedAnswers, AShortLookIsTakenEveryTime) {
  RationedAnswers answers;
  int looks = 0;
  const auto look = [&](const std::filesystem::path& place) { return place.string() + std::to_string(++looks); };
  EXPECT_EQ(answers.about("a", look), "a1");
  EXPECT_EQ(answers.about("a", look), "a2") << "what has changed is seen at once";
  EXPECT_EQ(answers.about("b", look), "b3");
}

TEST(RationedAnswers, ALongLookIsTakenATenthOfTheTime) {
  RationedAnswers answers;
  int looks = 0;
  const auto look = [&](const std::filesystem::path&) {
    std::this_thread::sleep_for(milliseconds(40));
    return std::to_string(++looks);
  };
  EXPECT_EQ(answers.about("a", look), "1");
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(answers.about("a", look), "1");
  EXPECT_EQ(answers.about("b", look), "2") << "another place is another question";
  // As long as it took, nine times; a machine that is busy took longer.
  const auto begun = std::chrono::steady_clock::now();
  while (answers.about("a", look) == "1" && std::chrono::steady_clock::now() - begun < std::chrono::seconds(60))
    std::this_thread::sleep_for(milliseconds(10));
  EXPECT_EQ(answers.about("a", look), "3") << "what has changed is seen soon";
}

}  // namespace
}  // namespace spindrift
