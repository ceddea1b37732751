// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/control/program_approval.h"

#include <gmock/gmock.h>

#include "core/base/error.h"
#include "tests/core/control/private_configuration.h"
#include "tests/support/refusal.h"

namespace spindrift::testing {
namespace {

using ::testing::HasSubstr;

TEST(DryRun, SaysWhatWouldMove) {
  const DryRun run = dryRun(
      "%\nN10 G21 G90 (millimetres)\nG0 X10 Y20 ; there\nZ-5\nG1 Z-10.5 F60\nM3 S3000\nG4 P2\nG38.2 Z-12\nM5\nM30\n%\n",
      threeAxisMill(), Eigen::Vector3d::Zero());
  ASSERT_TRUE(run.good()) << run.issues.front().what;
  ASSERT_EQ(run.moves.size(), 4U);
  EXPECT_EQ(run.moves[1].to_mm, Eigen::Vector3d(10, 20, -5));
  EXPECT_TRUE(run.moves[3].probing);
  EXPECT_EQ(run.touches, 1);
  EXPECT_EQ(run.largest_rpm, 3000.0);
  EXPECT_NEAR(run.estimated_s, 2.0 + 5.5 + 1.5, 0.5);
  EXPECT_THAT(run.summary(), HasSubstr("4 moves within X 0 to 10, Y 0 to 20, Z -12 to 0 mm, 1 touches"));
}

TEST(DryRun, WhatCannotBeForeseenIsNotRun) {
  struct Case {
    const char* program;
    int line;
    const char* what;
  };
  const Case cases[] = {{"G0 X301\nM2\n", 1, "X301 is outside the travel, 0 to 300 mm"},
                        {"G21\nG1 Z-1\nM2\n", 2, "without F"},
                        {"G91\nM2\n", 1, "G91"},
                        {"#1=5\nM2\n", 1, "cannot be foreseen"},
                        {"G0 X[1+2]\nM2\n", 1, "cannot be foreseen"},
                        {"o100 repeat [20]\nM2\n", 1, "cannot be foreseen"},
                        {"G92 X0\nM2\n", 1, "G92"},
                        {"T2 M6\nM2\n", 1, "T2"},
                        {"X10\nM2\n", 1, "before G0"},
                        {"M3 S6001\nM2\n", 1, "6001 rpm"},
                        {"G0 A5\nM2\n", 1, "A5"},
                        {"G0 X1\n", 1, "no end"},
                        {"M2\nG0 X1\n", 2, "after the end"},
                        {"G0 X1 (half\nM2\n", 1, "cannot be foreseen"},
                        {"G0 Xnan\nM2\n", 1, "cannot be foreseen"},
                        {"G4 P-1\nM2\n", 1, "P-1"}};
  for (const Case& each : cases) {
    const DryRun run = dryRun(each.program, threeAxisMill(), Eigen::Vector3d::Zero());
    ASSERT_FALSE(run.good()) << each.program;
    EXPECT_EQ(run.issues[0].line, each.line) << each.program;
    EXPECT_THAT(run.issues[0].what, HasSubstr(each.what)) << each.program;
    bool asked = false;
    EXPECT_NE(refusal([&] {
                (void)ApprovedProgram::approve(each.program, threeAxisMill(), Eigen::Vector3d::Zero(),
                                               [&](const DryRun&) { return asked = true; });
              }),
              "");
    EXPECT_FALSE(asked);  // nobody is asked to agree to what must not run
  }
}

TEST(DryRun, NothingRunsWithoutTheOperator) {
  EXPECT_THAT(refusal([] {
                (void)ApprovedProgram::approve("G0 X1\nM2\n", threeAxisMill(), Eigen::Vector3d::Zero(),
                                               [](const DryRun&) { return false; });
              }),
              HasSubstr("not confirmed (1 moves"));
  EXPECT_THAT(
      refusal([] { (void)ApprovedProgram::approve("G0 X1\nM2\n", threeAxisMill(), Eigen::Vector3d::Zero(), {}); }),
      HasSubstr("not confirmed"));
}

TEST(Configuration, IsRefusedWhereTheMachineCannotBe) {
  const std::filesystem::path nowhere = "/nowhere";
  ControlConfiguration outside = cornerInTheMiddle();
  outside.corner_mm.x() = 400.0;
  EXPECT_THAT(refusal([&] { writeControlConfiguration(threeAxisMill(), outside, nowhere); }), HasSubstr("X = 400 mm"));
  ControlConfiguration deaf = cornerInTheMiddle();
  deaf.watchdog_s = 0.0;
  EXPECT_THAT(refusal([&] { writeControlConfiguration(threeAxisMill(), deaf, nowhere); }), HasSubstr("watchdog_s 0"));
}

}  // namespace
}  // namespace spindrift::testing
