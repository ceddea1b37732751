// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/probing/touch_verdict.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/core/probing/probing_machines.h"

namespace spindrift {
namespace {

using namespace probing_test;

struct Judged {
  TouchEvaluation evaluation;
  std::vector<TouchVerdict> verdicts;
  [[nodiscard]] int count(TouchState state) const {
    return static_cast<int>(
        std::count_if(verdicts.begin(), verdicts.end(), [&](const TouchVerdict& v) { return v.state == state; }));
  }
};

Judged judge(const TouchList& list, const std::set<std::string>& excluded) {
  Campaign campaign;
  campaign.machine = machineFrom(holeMachineText());
  campaign.excluded_captures = excluded;
  JobContext job;
  Judged judged;
  judged.evaluation = evaluateTouchList(campaign, list, {}, {}, job);
  judged.verdicts = touchVerdicts(judged.evaluation, judged.evaluation.hole_cycles.front());
  return judged;
}

TEST(TouchVerdicts, EveryTouchOfGoodCyclesIsUsed) {
  const VirtualRun run = runCycles(machineFrom(holeMachineText()), 3, {}, 5);
  const Judged judged = judge(run.list, {});
  EXPECT_EQ(judged.verdicts.size(), run.list.touches.size());
  EXPECT_EQ(judged.count(TouchState::Used), static_cast<int>(run.list.touches.size()));
  for (const TouchVerdict& v : judged.verdicts) EXPECT_TRUE(std::isfinite(v.residual_um));
}

TEST(TouchVerdicts, TheFirstTwoCyclesAreJudgedAsWellAsMany) {
  const MachineDescription m = machineFrom(holeMachineText());
  for (const int cycles : {1, 2}) {
    const VirtualRun run = runCycles(m, cycles, {}, 61);
    const HoleCycleResult result = evaluateHoleCycles(run.list, m, m.artefacts.front());
    EXPECT_TRUE(result.rejected.empty()) << result.rejected.front().reason;
  }
}

TEST(TouchVerdicts, ASurfaceTouchOffThePlaneIsLeftOutInOneCycleAndInTwo) {
  VirtualProbeOptions options;
  options.form_error_um = 4.0;
  for (const int cycles : {1, 2}) {
    for (int bad_cycle = 0; bad_cycle < cycles; ++bad_cycle) {
      VirtualRun run = runCycles(machineFrom(holeMachineText()), cycles, options, 62);
      std::string bad;
      for (Touch& t : run.list.touches) {
        if (t.cycle != "M" + std::to_string(bad_cycle) || t.feature != "H6" || t.touch != 4) continue;
        t.position_mm.z() -= 0.1;
        bad = t.id();
      }
      const Judged judged = judge(run.list, {});
      EXPECT_EQ(judged.count(TouchState::LeftOut), 1) << cycles << " cycles";
      for (const TouchVerdict& v : judged.verdicts) {
        if (v.touch.id() != bad) continue;
        EXPECT_EQ(v.state, TouchState::LeftOut);
        EXPECT_NE(v.reason.find("other surface touches"), std::string::npos) << v.reason;
        EXPECT_NEAR(v.residual_um, -100.0, 25.0);
      }
    }
  }
}

TEST(TouchVerdicts, OneCycleIsOneCycleInTheSummary) {
  const VirtualRun run = runCycles(machineFrom(holeMachineText()), 1, {}, 64);
  const std::string summary = describeTouches(judge(run.list, {}).evaluation, machineFrom(holeMachineText())).summary;
  EXPECT_NE(summary.find("bar: 1 cycle, 60 touches, 0 left out"), std::string::npos) << summary;
}

TEST(TouchVerdicts, AStepOfTheBarThatRepeatsIsKept) {
  VirtualRun run = runCycles(machineFrom(holeMachineText()), 3, {}, 63);
  for (Touch& t : run.list.touches) {
    if (t.feature == "H6" && t.touch == 4) t.position_mm.z() -= 0.1;
  }
  EXPECT_EQ(judge(run.list, {}).count(TouchState::LeftOut), 0);
}

TEST(TouchVerdicts, BadMissingAndExcludedTouchesAreToldApart) {
  VirtualRun run = runCycles(machineFrom(holeMachineText()), 5, {}, 6);
  std::string bad, excluded;
  for (Touch& t : run.list.touches) {
    if (t.c_deg != 0.0) continue;
    if (t.cycle == "M2" && t.feature == "H3" && t.touch == 1) {
      t.position_mm += 0.03 * t.approach;
      bad = t.id();
    }
    if (t.cycle == "M4" && t.feature == "H6" && t.touch == 0) excluded = t.id();
  }
  removeTouches(run.list,
                [](const Touch& t) { return t.cycle == "M3" && t.feature == "H5" && t.touch == 2 && t.c_deg == 0.0; });
  const Judged judged = judge(run.list, {excluded});
  EXPECT_EQ(judged.count(TouchState::LeftOut), 1);
  EXPECT_EQ(judged.count(TouchState::Missing), 1);
  EXPECT_EQ(judged.count(TouchState::Excluded), 1);
  EXPECT_EQ(judged.evaluation.touches.touches.size(), run.list.touches.size() - 1);
  for (const TouchVerdict& v : judged.verdicts) {
    if (v.state == TouchState::Used) continue;
    EXPECT_FALSE(v.reason.empty());
    if (v.state == TouchState::LeftOut) {
      EXPECT_EQ(v.touch.id(), bad);
      EXPECT_NEAR(std::abs(v.residual_um), 30.0, 3.0);
    }
    if (v.state == TouchState::Missing) {
      EXPECT_EQ(v.touch.cycle, "M3");
      EXPECT_EQ(v.touch.feature, "H5");
      EXPECT_EQ(v.touch.touch, 2);
    }
    if (v.state == TouchState::Excluded) {
      EXPECT_EQ(v.touch.id(), excluded);
    }
  }
}

TEST(TouchVerdicts, CyclesThatAreShortAreSaidToBeEvenIfMostAre) {
  for (const int cycles : {2, 4}) {
    VirtualRun run = runCycles(machineFrom(holeMachineText()), cycles, {}, 9);
    const auto full = static_cast<std::size_t>(std::count_if(run.list.touches.begin(), run.list.touches.end(),
                                                             [](const Touch& t) { return t.cycle == "M0"; }));
    removeTouches(run.list, [](const Touch& t) {
      return t.cycle != "M0" && t.c_deg == 0.0 && (t.feature == "H5" || t.feature == "H6");
    });
    const std::size_t kept = run.list.touches.size();
    const Judged judged = judge(run.list, {});
    EXPECT_EQ(judged.count(TouchState::Missing), static_cast<int>(full * static_cast<std::size_t>(cycles) - kept));
  }
}

TEST(TouchVerdicts, ATouchTakenOnceMoreIsNotMissingInTheOtherCycles) {
  VirtualRun run = runCycles(machineFrom(holeMachineText()), 2, {}, 10);
  Touch more;
  for (const Touch& t : run.list.touches) {
    if (t.cycle == "M1" && t.feature == "H3" && t.c_deg == 0.0) more = t;
  }
  more.touch += 1;
  more.time_s += 1.0;
  run.list.touches.push_back(more);
  EXPECT_EQ(judge(run.list, {}).count(TouchState::Missing), 0);
}

// The constant of a touch is shared by all cycles: the innocent ones must not go with the bad one.
TEST(TouchVerdicts, OneBadTouchTakesNoOtherWithIt) {
  for (const std::uint64_t seed : {21U, 22U, 23U}) {
    VirtualRun run = runCycles(machineFrom(holeMachineText()), 40, {}, seed);
    std::string bad;
    for (Touch& t : run.list.touches) {
      if (t.cycle != "M2" || t.feature != "H4" || t.touch != 1 || t.c_deg != 0.0) continue;
      t.position_mm += 0.035 * t.approach;
      bad = t.id();
    }
    const Judged judged = judge(run.list, {});
    ASSERT_EQ(judged.count(TouchState::LeftOut), 1) << seed;
    for (const TouchVerdict& v : judged.verdicts) {
      if (v.state == TouchState::LeftOut) {
        EXPECT_EQ(v.touch.id(), bad);
      }
    }
  }
}

TEST(TouchVerdicts, IdsAreUnique) {
  const VirtualRun run = runCycles(machineFrom(ballMachineText()), 2, {}, 7);
  std::set<std::string> ids;
  for (const Touch& t : run.list.touches) EXPECT_TRUE(ids.insert(t.id()).second) << t.id();
}

TEST(TouchVerdicts, ExcludingEverythingIsRefused) {
  const VirtualRun run = runCycles(machineFrom(holeMachineText()), 2, {}, 8);
  std::set<std::string> all;
  for (const Touch& t : run.list.touches) all.insert(t.id());
  EXPECT_THROW(judge(run.list, all), InputError);
}

}  // namespace
}  // namespace spindrift
