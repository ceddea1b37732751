// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/tasks/steps.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "core/base/atomic_file.h"
#include "core/base/job_context.h"
#include "core/tasks/task_work.h"
#include "core/workflows/measurement_plan.h"
#include "tests/core/tasks/tasks_support.h"

namespace spindrift {
namespace {

using ::spindrift::testing::TaskSession;
using ::testing::HasSubstr;

nlohmann::json checkOf(int all, int bad, int first = 0) {
  nlohmann::json captures = nlohmann::json::array();
  for (int i = first; i < first + all; ++i)
    captures.push_back({{"image", "captures/images/" + std::to_string(i) + ".jpg"}, {"good", i >= first + bad}});
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
  EXPECT_THAT(step.sentence, HasSubstr("2 of 5 captures failed the check"));
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

TEST(Steps, WhatIsExcludedIsNotMissedAndWhatIsNotLookedAtNotPraised) {
  TaskSession s;
  for (int i = 1; i < 4; ++i) s.capture(i);
  s.session_.exclude(s.id_, "captures/images/0.jpg", "blurred");
  s.run("check", checkOf(3, 0, 1));
  s.session_.exclude(s.id_, "captures/images/1.jpg", "dark");
  EXPECT_EQ(s.step(StepId::Capture).state, StepState::Outdated) << "nothing is left to be checked for the first time";
  s.run("check", checkOf(2, 0, 2));
  EXPECT_EQ(s.step(StepId::Capture).sentence, "All captures are checked.");
  s.session_.addCaptureRows(s.id_, "touches.csv", "time_s", {"1", "2"});
  s.run("check", checkOf(2, 0));
  EXPECT_EQ(s.step(StepId::Capture).state, StepState::Current);
  EXPECT_THAT(s.step(StepId::Capture).sentence, HasSubstr("those of other instruments are judged when"));
}

TEST(Steps, ReadingsAndMasksThatAreTakenOutAreNoCaptures) {
  TaskSession s;
  for (int i = 1; i < 4; ++i) s.capture(i);
  s.run("check", checkOf(4, 0));
  for (const char* item : {"M1/F1/EX", "M1/F1/EY", "mask/captures/a.pcd: erase lasso 0,0 1,0 1,1"})
    s.session_.exclude(s.id_, item, "disturbed");
  EXPECT_EQ(s.step(StepId::Capture).state, StepState::Outdated);
  for (int i = 4; i < 8; ++i) s.capture(i);
  EXPECT_EQ(s.step(StepId::Capture).sentence, "4 of 8 captures are checked.");
  s.session_.exclude(s.id_, "captures/images/7.jpg", "dark");
  EXPECT_EQ(s.step(StepId::Capture).sentence, "5 of 8 captures are checked.") << "it need not be";
}

TEST(Steps, AReportWhoseFileIsGoneIsNotWritten) {
  TaskSession s;
  s.run("evaluate");
  s.run("report", {{"file", "reports/report-1.html"}});
  EXPECT_EQ(s.step(StepId::Report).state, StepState::Attention);
  s.folder_.write("s/reports/report-1.html", "<html>");
  EXPECT_EQ(s.step(StepId::Report).state, StepState::Current);
  EXPECT_EQ(s.step(StepId::Report).sentence, "The report is written.");
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
  s.run("fit", {{"status", "converged"}, {"rejected", true}});
  EXPECT_EQ(s.step(StepId::Model).state, StepState::Attention);
  EXPECT_THAT(s.step(StepId::Model).sentence, HasSubstr("larger than the stated uncertainties"));
  s.run("compensation", {{"warnings", {"The model was rejected."}}});
  EXPECT_EQ(s.step(StepId::Compensate).state, StepState::Attention);
  s.run("verify", {{"verdict", "not met"}, {"reason", "EX is 7 um."}});
  EXPECT_EQ(s.step(StepId::Verify).sentence, "EX is 7 um.");
}

TEST(Steps, WhatIsDoneWithAWarningAsksForAttention) {
  TaskSession s;
  const std::string warning = "M1: 2 of 24 touches are missing; evaluated from the rest.";
  s.run("evaluate", {{"json", {{"warnings", {warning}}}}, {"good_enough", true}});
  EXPECT_EQ(s.step(StepId::Calibrate).state, StepState::Attention);
  EXPECT_EQ(s.step(StepId::Calibrate).sentence, warning);
  s.run("evaluate",
        {{"json", {{"warnings", {"alpha cannot be determined."}}}}, {"warning_kinds", {"calibration_limit"}}});
  EXPECT_EQ(s.step(StepId::Calibrate).state, StepState::Current) << "stands beside its numbers";
  s.run("fit", {{"status", "converged"}, {"warnings", {"EX of P3 was not measured and is left out."}}});
  EXPECT_EQ(s.step(StepId::Model).state, StepState::Attention);
  EXPECT_EQ(s.step(StepId::Model).sentence, "EX of P3 was not measured and is left out.");
  s.run("fit", {{"status", "converged"}, {"warnings", nlohmann::json::array()}});
  EXPECT_EQ(s.step(StepId::Model).state, StepState::Current);
}

TEST(Steps, APointThatAnAxisCannotReachAsksForAttention) {
  TaskSession s;
  EXPECT_EQ(s.step(StepId::Machine).state, StepState::Current);
  nlohmann::json machine = nlohmann::json::parse(readFile(s.folder_ / "s/campaigns/c/machine.json"));
  machine["points"] = {{{"id", "P1"}, {"kind", "fiducial"}, {"x_mm", 301.0}, {"y_mm", 0.0}, {"z_mm", 0.0}}};
  s.folder_.write("s/campaigns/c/machine.json", machine.dump());
  EXPECT_EQ(s.step(StepId::Machine).state, StepState::Attention);
  EXPECT_EQ(s.step(StepId::Machine).sentence,
            "Point P1 lies outside the travel of axis X (301 mm; travel 0 to 300 mm).");
}

TEST(Steps, BlockedOnesSayWhy) {
  TaskSession s;
  EXPECT_EQ(s.step(StepId::Model).state, StepState::Blocked);
  EXPECT_THAT(s.step(StepId::Model).sentence, HasSubstr("Evaluate the captures first"));
  EXPECT_THAT(s.step(StepId::Discrepancy).sentence, HasSubstr("without a simulation"));
  EXPECT_EQ(s.step(StepId::Report).state, StepState::Blocked);
}

TEST(Steps, AnInstrumentThatFailedItsCheckIsNotWarm) {
  TaskSession s;
  s.run("evaluate");
  s.option(option_keys::warm_statement, {{"settled", true}, {"by", "operator"}});
  EXPECT_EQ(s.step(StepId::WarmUp).state, StepState::Current);
  const nlohmann::json failed{{"status", "converged"}, {"passed", false}, {"reason", "EX moves by 3 um."}};
  s.run("check-repeatability", failed);
  EXPECT_EQ(s.step(StepId::WarmUp).state, StepState::Attention);
  EXPECT_EQ(s.step(StepId::WarmUp).sentence, "EX moves by 3 um.");
  s.run("check-repeatability", {{"status", "converged"}, {"passed", true}});
  EXPECT_EQ(s.step(StepId::WarmUp).state, StepState::Current);
  s.run("check-jogs", {{"status", "not run"}, {"passed", false}, {"reason", "There are no jogs."}});
  EXPECT_EQ(s.step(StepId::WarmUp).state, StepState::Current) << "nothing was measured";
}

nlohmann::json warmUpOf(bool settled, const char* cause = "", const char* status = "converged") {
  return {{"status", status},
          {"settled", settled},
          {"reason", "Said of the drift."},
          {"cause", cause},
          {"cause_reason", *cause == '\0' ? "" : "Said of the cause."}};
}

TEST(Steps, TheWarmUpIsWhatItsTaskFound) {
  TaskSession s;
  s.run("evaluate");
  EXPECT_EQ(taskOfStep(s.graph(), StepId::WarmUp), "check-warm-up");
  s.run("check-warm-up", warmUpOf(true));
  EXPECT_EQ(s.step(StepId::WarmUp).state, StepState::Current);
  EXPECT_EQ(s.step(StepId::WarmUp).sentence, "Said of the drift.");
  s.session_.exclude(s.id_, "M1/F1/EX", "disturbed");
  EXPECT_EQ(s.step(StepId::WarmUp).state, StepState::Outdated);
  EXPECT_THAT(s.step(StepId::WarmUp).sentence, HasSubstr("1 exclusion more"));
  s.run("evaluate");
  s.run("check-warm-up", warmUpOf(false, "unknown"));
  EXPECT_EQ(s.step(StepId::WarmUp).state, StepState::Attention);
  EXPECT_EQ(s.step(StepId::WarmUp).sentence, "Said of the drift. Said of the cause.");
  s.option(option_keys::warm_statement, {{"settled", true}, {"by", "operator"}});
  EXPECT_EQ(s.step(StepId::WarmUp).state, StepState::Current) << "it may as well be the machine that drifts";
  s.run("check-warm-up", warmUpOf(false, "instrument"));
  EXPECT_EQ(s.step(StepId::WarmUp).state, StepState::Attention) << "measured against stated";
  s.option(option_keys::warm_statement, nlohmann::json::object());
  s.run("check-warm-up", warmUpOf(false, "", "degenerate"));
  EXPECT_EQ(s.step(StepId::WarmUp).state, StepState::NotStarted) << "nothing was seen";
  EXPECT_THAT(s.step(StepId::WarmUp).sentence, HasSubstr("Said of the drift. Not checked: a drift of the instrument"));
}

TEST(Steps, TheWarmUpIsJudgedByItsOwnMeasurementAndOnTheClockOfTheCampaign) {
  TaskSession s;
  std::string rows = "time_s,state,point,x_mm,y_mm,z_mm,component,value,sigma,instrument\n";
  for (int i = 0; i < 12; ++i) rows += fmt::format("{},W{},F1,0,0,0,EX,{},0.1,microscope\n", 600 * i, i, 5 * i);
  EXPECT_EQ(s.status("check-warm-up").state, TaskState::Blocked) << "neither observations nor a measurement of its own";
  s.folder_.write("s/campaigns/c/warm_up.csv", rows);
  s.session_.setSetting(Session::clocksKey(s.id_),
                        nlohmann::json{{"microscope", {{"offset_s", 60.0}, {"sigma_s", 1.0}, {"how", "entered"}}}});
  const TaskGraph graph = s.graph();
  EXPECT_THAT(graph.needed("check-warm-up"), ::testing::ElementsAre("check-warm-up")) << "no captures are needed";
  TaskInputs inputs;
  inputs.campaign = std::make_shared<const Campaign>(graph.data());
  JobContext job;
  const TaskResult result = prepareTask("check-warm-up", graph, inputs)(job, TaskOutput::Payload);
  s.run("check-warm-up", result.payload);
  EXPECT_EQ(s.step(StepId::WarmUp).state, StepState::Attention);
  EXPECT_THAT(s.step(StepId::WarmUp).sentence, HasSubstr("Not settled: drift of more than 1 µm/h: EX 30"));
  const WarmUpResult read = warmUpFrom(result.payload);
  ASSERT_EQ(read.axes[0].time_s.size(), 12U);
  EXPECT_EQ(read.axes[0].time_s.front(), 60.0);
  EXPECT_EQ(read.axes[0].value_um.back(), 55.0);
  EXPECT_NEAR(read.axes[0].drift_um_per_h, 30.0, 1e-6);
  EXPECT_FALSE(read.axes[1].measured);
  EXPECT_EQ(read.cause, WarmUpCause::Unknown);
  EXPECT_EQ(checkResultOf(read).json, result.payload) << "nothing is lost on the way";
}

TEST(Steps, ASkippedWarmUpSaysWhatItMeans) {
  TaskSession s;
  s.run("evaluate");
  EXPECT_EQ(s.step(StepId::WarmUp).state, StepState::NotStarted);
  EXPECT_THAT(s.step(StepId::WarmUp).sentence, HasSubstr("every deviation"));
}

}  // namespace
}  // namespace spindrift
