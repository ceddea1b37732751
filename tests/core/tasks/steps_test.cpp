// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/tasks/steps.h"

#include <gmock/gmock.h>

#include "core/workflows/measurement_plan.h"
#include "tests/core/tasks/tasks_support.h"

namespace spindrift {
namespace {

using ::spindrift::testing::TaskSession;
using ::testing::HasSubstr;

nlohmann::json checkOf(int all, int bad) {
  nlohmann::json captures = nlohmann::json::array();
  for (int i = 0; i < all; ++i)
    captures.push_back({{"image", "captures/images/" + std::to_string(i) + ".jpg"}, {"good", i >= bad}});
  return {{"captures", captures}};
}

TEST(Steps, ACaptureThatCannotBeUsedIsNotGreen) {
  TaskSession s;
  for (int i = 1; i < 5; ++i) s.capture(i);
  EXPECT_EQ(s.step(StepId::Capture).state, StepState::NotStarted);
  s.run("check", checkOf(5, 2));
  StepReport step = s.step(StepId::Capture);
  EXPECT_EQ(step.state, StepState::Attention);
  EXPECT_EQ(step.count, 2U);
  EXPECT_EQ(step.of, 5U);
  EXPECT_THAT(step.sentence, HasSubstr("2 of 5 captures cannot be used"));
  for (int i = 0; i < 2; ++i) s.session_.exclude(s.id_, "captures/images/" + std::to_string(i) + ".jpg", "blurred");
  EXPECT_THAT(s.step(StepId::Capture).sentence, HasSubstr("2 exclusions more"));
  s.run("check", checkOf(5, 2));
  EXPECT_EQ(s.step(StepId::Capture).state, StepState::Current) << "what is left can be used";
}

TEST(Steps, ProgressIsCounted) {
  TaskSession s;
  s.run("check", checkOf(1, 0));
  for (int i = 1; i < 4; ++i) s.capture(i);
  const StepReport step = s.step(StepId::Capture);
  EXPECT_EQ(step.state, StepState::InProgress);
  EXPECT_EQ(step.sentence, "1 of 4 captures are checked.");
  EXPECT_EQ(step.count, 1U);
  EXPECT_EQ(step.of, 4U);
}

TEST(Steps, APlanSaysHowMuchIsTaken) {
  TaskSession s;
  MeasurementPlan plan;
  plan.states.push_back({"M0", 0.0, "cold"});
  for (int i = 0; i < 40; ++i) {
    PlannedItem item;
    item.id = "M0_F1_focus_" + std::to_string(i);
    item.state = "M0";
    item.fiducial = "F1";
    item.role = "focus";
    item.index = i;
    plan.items.push_back(item);
  }
  s.option(option_keys::plan, plan.json());
  const StepReport step = s.step(StepId::Capture);
  EXPECT_EQ(step.state, StepState::InProgress);
  EXPECT_EQ(step.of, 40U);
  EXPECT_THAT(step.sentence, HasSubstr("of 40 planned captures are taken"));
}

TEST(Steps, WhatTheResultSaysIsSaid) {
  TaskSession s;
  s.run("evaluate", {{"json", {{"rejected", {{{"capture", "a"}, {"reason", "dark"}}}}}}, {"good_enough", true}});
  EXPECT_EQ(s.step(StepId::Calibrate).state, StepState::Attention);
  EXPECT_EQ(s.step(StepId::Calibrate).count, 1U);
  s.run("evaluate", {{"json", {{"warnings", {"The axes are 3 degrees off."}}}}, {"good_enough", false}});
  EXPECT_EQ(s.step(StepId::Calibrate).sentence, "The axes are 3 degrees off.");
  s.run("fit", {{"status", "degenerate"}, {"message", "Points on a line."}});
  EXPECT_EQ(s.step(StepId::Model).state, StepState::Attention);
  EXPECT_EQ(s.step(StepId::Model).sentence, "Points on a line.");
  s.run("compensation", {{"warnings", {"The model was rejected."}}});
  EXPECT_EQ(s.step(StepId::Compensate).state, StepState::Attention);
  s.run("verify", {{"verdict", "not met"}, {"reason", "EX is 7 um."}});
  EXPECT_EQ(s.step(StepId::Verify).sentence, "EX is 7 um.");
}

TEST(Steps, BlockedOnesSayWhy) {
  TaskSession s;
  EXPECT_EQ(s.step(StepId::Model).state, StepState::Blocked);
  EXPECT_THAT(s.step(StepId::Model).sentence, HasSubstr("Evaluate the captures first"));
  EXPECT_THAT(s.step(StepId::Discrepancy).sentence, HasSubstr("without a simulation"));
  EXPECT_EQ(s.step(StepId::Report).state, StepState::Blocked);
}

TEST(Steps, ASkippedWarmUpSaysWhatItMeans) {
  TaskSession s;
  s.run("evaluate");
  EXPECT_EQ(s.step(StepId::WarmUp).state, StepState::NotStarted);
  EXPECT_THAT(s.step(StepId::WarmUp).sentence, HasSubstr("every deviation"));
}

}  // namespace
}  // namespace spindrift
