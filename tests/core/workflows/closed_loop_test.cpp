// SPDX-License-Identifier: GPL-3.0-or-later
// Plan, measuring programme and judgement of the closed loop; the loop itself runs at a real control (skipped without).
#include "core/workflows/closed_loop.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/base/error.h"
#include "core/control/private_control.h"
#include "core/workflows/closed_loop_demo.h"
#include "tests/support/refusal.h"
#include "tests/support/temp_folder.h"

namespace spindrift::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

nlohmann::json planJson() {
  return {{"format", "spindrift-loop-plan"},
          {"version", 1},
          {"machine", "machine.json"},
          {"control", {{"kind", "linuxcnc"}, {"folder", "/nowhere"}}},
          {"temperatures", {"T_spindle_degC"}},
          {"touches",
           {{{"point", "F1"}, {"component", "EZ"}, {"before_mm", {50, 50, -99.7}}, {"target_mm", {50, 50, -101}}}}},
          {"programme", {{{"from_s", 0}, {"spindle_rpm", 0}}, {{"from_s", 600}, {"spindle_rpm", 3000}}}},
          {"reference_mm", {50, 50, -100}},
          {"safe_z_mm", -50},
          {"duration_s", 3600},
          {"when_silent", "hold"}};
}

LoopPlan read(const TempFolder& folder, const nlohmann::json& json) {
  folder.write("machine.json", demoPlan(8.0).machine.source.dump());
  return LoopPlan::read(folder.write("plan.json", json.dump()));
}

TEST(LoopPlan, IsReadAndItsFaultsAreSaid) {
  const TempFolder folder;
  const LoopPlan plan = read(folder, planJson());
  EXPECT_EQ(plan.touches.size(), 1U);
  EXPECT_TRUE(plan.hold_when_silent);
  struct Fault {
    const char* pointer;
    nlohmann::json value;
    const char* said;
  };
  const Fault faults[] = {{"/control/kind", "fanuc", "linuxcnc"},
                          {"/touches/0/component", "EA", "EX"},
                          {"/touches/0/target_mm", {51, 50, -101}, "does not run along its axis"},
                          {"/programme/1/from_s", 0, "out of order"},
                          {"/duration_s", 0, "duration_s"},
                          {"/when_silent", "jump", "hold"},
                          {"/discrepancy_s", 100, "without a simulation"},
                          {"/limits", {{"rate_um_s", -1}}, "rate_um_s"}};
  for (const Fault& fault : faults) {
    nlohmann::json spoilt = planJson();
    spoilt[nlohmann::json::json_pointer(fault.pointer)] = fault.value;
    EXPECT_THAT(refusal([&] { (void)read(folder, spoilt); }), HasSubstr(fault.said)) << fault.pointer;
  }
}

TEST(LoopPlan, TheMeasuringProgrammeOfTheDemonstrationMayRun) {
  const LoopPlan plan = demoPlan(8.0);
  const DryRun run = dryRun(measuringProgram(plan), plan.machine, {0.0, 0.0, 0.0});
  ASSERT_TRUE(run.good()) << run.issues.front().what;
  EXPECT_EQ(run.touches, 6);
  // Between touches nothing moves sideways below what is safe, but away from a wall or beside it.
  for (const DryMove& move : run.moves) {
    const bool sideways = (move.to_mm - move.from_mm).head<2>().norm() > 10.0;
    if (sideways) {
      EXPECT_GE(std::min(move.from_mm.z(), move.to_mm.z()), plan.safe_z_mm) << "line " << move.line;
    }
  }
}

TEST(LoopJudgement, IsRelativeToTheFirstCycleAndCountsWhatWasApplied) {
  const TempFolder folder;
  std::string csv = "time_s,ex_um,ey_um,ez_um,cx_um,cy_um,cz_um,spindle_rpm\n";
  csv += "0,1,0,5,0,0,0,0\n30,4,0,5,-3,0,0,0\n60,4,0,9,-3,0,-2,0\n90,50,50,50,0,0,0,0\n";
  const nlohmann::json loop = {{"cycles", {{{"time_s", 0.0}}}},
                               {"stages", {{{"stage", "simulation"}, {"from_s", 30.0}}}},
                               {"events", {{{"time_s", 90.0}, {"text", "end"}}}}};
  const std::vector<LoopJudgement> judged = judgeLoop(loop, folder.write("truth.csv", csv));
  ASSERT_EQ(judged.size(), 1U);
  EXPECT_NEAR(judged[0].without_um.x(), 3.0, 1e-12);
  EXPECT_NEAR(judged[0].with_um.x(), 0.0, 1e-12);
  EXPECT_NEAR(judged[0].without_um.z(), std::sqrt(8.0), 1e-12);
  EXPECT_NEAR(judged[0].with_um.z(), std::sqrt(2.0), 1e-12);
}

TEST(ClosedLoop, TheSimulationIsCompensatedAtARealControl) {
  if (const std::string why = whyNoPrivateControl(); !why.empty()) GTEST_SKIP() << why;
  const TempFolder folder;
  LoopDemoOptions options;
  options.folder = folder / "demo";
  options.hours = 1.0;
  const nlohmann::json json = runLoopDemo(options);
  EXPECT_TRUE(json["completed"].get<bool>());
  EXPECT_GE(json["measurements"].get<int>(), 2);
  ASSERT_FALSE(json["truth"].empty());
  const nlohmann::json& stage = json["truth"][0];
  EXPECT_EQ(stage["stage"], "simulation");
  // The simulation knows what happens along Z, and lacks what happens along X.
  EXPECT_GT(stage["rms_without_um"]["EZ"].get<double>(), 5.0);
  EXPECT_LT(stage["rms_with_um"]["EZ"].get<double>(), 0.15 * stage["rms_without_um"]["EZ"].get<double>());
  EXPECT_GT(stage["rms_with_um"]["EX"].get<double>(), 0.9 * stage["rms_without_um"]["EX"].get<double>());
  EXPECT_LE(json["largest_rate_um_s"].get<double>(), 0.2 + 1e-9);
}

}  // namespace
}  // namespace spindrift::testing
