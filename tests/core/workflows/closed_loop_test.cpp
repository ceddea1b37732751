// SPDX-License-Identifier: GPL-3.0-or-later
// Plan, measuring programme and judgement of the closed loop; the loop itself runs at a real control (skipped without).
#include "core/workflows/closed_loop.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <thread>

#include "core/base/error.h"
#include "core/connect/linuxcnc_shell.h"
#include "core/connect/source.h"
#include "core/control/private_control.h"
#include "core/workflows/closed_loop_demo.h"
#include "core/workflows/machine_beside_control.h"
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
                          {"/touches/0/point", "F1)\nG0 Z-300\n(", "cannot stand in a program"},
                          {"/programme/1/from_s", 0, "out of order"},
                          {"/duration_s", 0, "duration_s"},
                          {"/when_silent", "jump", "hold"},
                          {"/discrepancy_s", 100, "without a simulation"},
                          {"/accept", "all", "ask"},
                          {"/accept", 3, "list of ids"},
                          {"/limits", {{"rate_um_s", -1}}, "rate_um_s"}};
  for (const Fault& fault : faults) {
    nlohmann::json spoilt = planJson();
    spoilt[nlohmann::json::json_pointer(fault.pointer)] = fault.value;
    EXPECT_THAT(refusal([&] { (void)read(folder, spoilt); }), HasSubstr(fault.said)) << fault.pointer;
  }
}

TEST(LoopPlan, SaysWhoAcceptsWhatIsNamed) {
  using Rule = LoopAcceptance::Rule;
  const TempFolder folder;
  nlohmann::json json = planJson();
  EXPECT_EQ(read(folder, json).accept.rule, Rule::Named);
  json["accept"] = "named";
  EXPECT_EQ(read(folder, json).accept.rule, Rule::Named);
  json["accept"] = "ask";
  EXPECT_EQ(read(folder, json).accept.rule, Rule::Ask);
  json["accept"] = {"spindle.drift.x", "head.tilt.a"};
  const LoopPlan plan = read(folder, json);
  EXPECT_EQ(plan.accept.rule, Rule::Listed);
  EXPECT_EQ(plan.accept.ids, (std::vector<std::string>{"spindle.drift.x", "head.tilt.a"}));
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
  options.factor = 120.0;
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

/// What an operator does at the control beside the loop: a shell of his own, on another port.
std::string operatorsHands() {
  const std::filesystem::path base = "/tmp/hands";
  writeLoopExample(base, 3.0, 130.0);
  LoopPlan plan = LoopPlan::read(base / "plan.json");
  plan.programme = {{0.0, 5000.0}, {3000.0, 0.0}};
  plan.measure_every_s = 500.0;
  plan.discrepancy_s = plan.identify_s = 0.0;
  LinuxcncProcess process(base / "control");
  LinuxcncControl control(plan.control);
  const auto connected = [](auto& what) {
    for (int i = 0; i < 100; ++i) {
      try {
        what.connect({});
        return true;
      } catch (const ConnectionError&) {
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
      }
    }
    return false;
  };
  if (!connected(control)) return "the control does not start";
  const pid_t machine = ::fork();
  if (machine == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    BesideControlOptions beside;
    beside.scenario = Scenario::read(base / "simulation.json");  // nothing is missing
    beside.factor = 130.0;
    beside.reference_mm = plan.reference_mm;
    beside.truth = base / "truth.csv";
    beside.duration_s = 1e6;
    runBesideControl(beside, [] { return false; });
    ::_exit(0);
  }
  const pid_t second = ::fork();
  if (second == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::chdir((base / "control").c_str()) != 0) ::_exit(126);
    ::execlp("linuxcncrsh", "linuxcncrsh", "--port", "5008", "--", "-ini", "spindrift.ini", nullptr);
    ::_exit(127);
  }
  LinuxcncShell::Options options;
  options.peer.port = 5008;
  LinuxcncShell hands(options);
  if (!connected(hands) || !hands.set("enable EMCTOO")) return "the operator is refused";
  // Two shells of one control number their commands each by itself: some are refused at first.
  const auto mode = [&](const char* wanted, const char* shown) {
    for (int i = 0; i < 20 && hands.get("mode") != shown; ++i) (void)hands.set(std::string("mode ") + wanted);
  };
  const auto mdi = [&](const std::string& line) {
    mode("mdi", "MDI");
    (void)hands.set("mdi " + line);
  };

  std::string wrong;
  enum class Step { Waits, OtherTool, ToolBack, Moves, Homed, Done } step = Step::Waits;
  double since_s = 0.0, applied_um = 0.0;
  std::size_t cycles = 0;
  bool off = false;
  LoopOperator who;
  who.confirm = [](const DryRun&) { return true; };
  who.wishes = std::make_shared<LoopWishes>();
  JobContext job;
  const LoopResult result = runClosedLoop(
      plan, control, who, base / "campaign", job, [&](const LoopStatus& status, const LoopResult& so_far) {
        if (status.stopping) return;
        const auto enter = [&](Step next) {
          step = next;
          since_s = status.time_s;
          cycles = so_far.cycles.size();
        };
        const bool still = status.control.ready() && !status.measuring && status.next_cycle_s > status.time_s + 200.0;
        if (step == Step::Waits && status.time_s > 3100.0 && still) {
          mdi("T1 M6");
          enter(Step::OtherTool);
        } else if (step == Step::OtherTool && status.time_s > since_s + 800.0) {
          if (so_far.cycles.size() != cycles) wrong += "measured with another tool; ";
          if (!status.active) wrong += "off with another tool: " + status.reason + "; ";
          applied_um = status.applied_um.z();
          mdi("T0 M6");
          enter(Step::ToolBack);
        } else if (step == Step::ToolBack && so_far.cycles.size() > cycles && still) {
          mdi("G0 Z0");
          mdi("G0 X0.008 Y0");
          enter(Step::Moves);
        } else if (step == Step::Moves && status.control.ready() &&
                   (status.control.position_mm - Eigen::Vector3d(0.008, 0.0, 0.0)).norm() < 1e-4) {
          mode("manual", "MANUAL");
          (void)hands.set("teleop_enable off");  // homing is an affair of the joints
          (void)hands.set("home -1");
          enter(Step::Homed);
        } else if (step == Step::Homed) {
          off = off || (!status.active && status.reason.find("homed anew") != std::string::npos);
          if (so_far.cycles.size() > cycles) enter(Step::Done);
        } else if (step == Step::Done && status.time_s > since_s + 150.0) {
          if (!status.active) wrong += "it does not return: " + status.reason + "; ";
          who.wishes->stop = true;
        }
      });
  ::kill(second, SIGKILL);
  ::kill(machine, SIGKILL);
  std::string told;
  for (const LoopEvent& event : result.events) told += fmt::format("{:.0f} {}\n", event.time_s, event.text);
  if (step != Step::Done) wrong += "not all was done; ";
  if (!off) wrong += "not off after homing; ";
  if (std::abs(applied_um) < 3.0) wrong += fmt::format("{} um applied with another tool; ", applied_um);
  for (const char* part : {"tool 1 is in the spindle", "tool 0 is back", "the zero has moved by X +"}) {
    if (told.find(part) == std::string::npos) wrong += fmt::format("not told: {}; ", part);
  }
  const std::size_t at = told.find("the zero has moved by X +");
  const double shift_um = at == std::string::npos ? 0.0 : std::stod(told.substr(at + 24));
  if (std::abs(shift_um - 8.0) > 2.0) wrong += fmt::format("a shift of {} um; ", shift_um);
  return wrong.empty() ? wrong : wrong + "\n" + told;
}

TEST(ClosedLoop, AToolChangeAndHomingAnewAreNoticedAtARealControl) {
  if (const std::string why = whyNoPrivateControl(); !why.empty()) GTEST_SKIP() << why;
  EXPECT_EQ(isolated(operatorsHands, {}, 150.0), "");
}

}  // namespace
}  // namespace spindrift::testing
