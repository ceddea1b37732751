// SPDX-License-Identifier: GPL-3.0-or-later
// Touches judged as they come in, and read from files that are still being written.
#include "core/probing/live_touches.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/probing/surface_heights.h"
#include "core/probing/touch_stream.h"
#include "tests/core/probing/probing_machines.h"

namespace spindrift {
namespace {

using namespace probing_test;

class LiveKind : public ::testing::TestWithParam<bool> {
 protected:
  MachineDescription machine() const { return machineFrom(GetParam() ? holeMachineText() : ballMachineText()); }
  static LiveTouches fed(const MachineDescription& m, const TouchList& list) {
    LiveTouches live(m);
    for (const Touch& t : list.touches) EXPECT_TRUE(live.add(t));
    return live;
  }
};

TEST_P(LiveKind, GoodCyclesNeedNoRetakeAndProgressCountsUp) {
  const MachineDescription m = machine();
  const VirtualRun run = runCycles(m, 4, {}, 31);
  LiveTouches live(m);
  int in_cycle = 0;
  for (const Touch& t : run.list.touches) {
    if (!live.touches().empty() && live.touches().back().touch.cycle != t.cycle) in_cycle = 0;
    live.add(t);
    EXPECT_EQ(live.progress().done, ++in_cycle);
    EXPECT_EQ(live.progress().cycle, t.cycle);
  }
  EXPECT_TRUE(live.retakes().empty()) << live.retakes().front();
  const auto per_cycle = static_cast<int>(run.list.touches.size() / 4);
  EXPECT_EQ(live.progress().expected, per_cycle);
  EXPECT_TRUE(live.progress().next.empty());
  EXPECT_EQ(live.takeFinished(true).size(), run.list.touches.size());
  EXPECT_TRUE(live.takeFinished(true).empty());
  // The same file read again brings nothing new.
  for (const Touch& t : run.list.touches) EXPECT_FALSE(live.add(t));
}

TEST_P(LiveKind, ABadTouchIsAskedForAgainWhileItsFeatureIsStillThere) {
  const MachineDescription m = machine();
  VirtualRun run = runCycles(m, 3, {}, 32);
  const std::string feature = GetParam() ? "H3" : "B3";
  LiveTouches live(m);
  Touch good;
  for (Touch t : run.list.touches) {
    if (t.cycle == "M1" && t.feature == feature && t.touch == 1 && t.stylus == "p0" && t.c_deg == 0.0) {
      good = t;
      t.position_mm += 0.06 * t.approach;
    }
    live.add(t);
  }
  const std::vector<std::string> asked = live.retakes();
  ASSERT_FALSE(asked.empty());
  EXPECT_EQ(asked.size(), 1U) << "one sentence a feature";
  EXPECT_NE(asked.front().find(feature), std::string::npos) << asked.front();
  // Taken again: everything that was asked for.
  std::vector<Touch> again;
  for (const LiveTouch& l : live.touches()) {
    if (l.plausible || l.replaced) continue;
    Touch t = l.touch;
    if (t.touch == good.touch) t.position_mm = good.position_mm;
    again.push_back(t);
  }
  double time = run.list.touches.back().time_s;
  for (Touch& t : again) {
    t.time_s = time += 3.0;
    live.add(t);
  }
  EXPECT_TRUE(live.retakes().empty()) << live.retakes().front();
  EXPECT_EQ(live.takeFinished(true).size(), run.list.touches.size());
}

TEST_P(LiveKind, WrongFeatureInchesAndUnknownNamesAreToldAtOnce) {
  const MachineDescription m = machine();
  const VirtualRun run = runCycles(m, 2, {}, 33);
  const std::string first = GetParam() ? "H1" : "B1";
  const std::string second = GetParam() ? "H2" : "B2";
  const auto reasonOf = [&](const std::function<void(Touch&)>& spoil) {
    LiveTouches live(m);
    for (Touch t : run.list.touches) {
      const bool hit = t.cycle == "M1" && t.feature == second && t.touch == 0 && t.stylus == "p0";
      if (hit) spoil(t);
      live.add(t);
      if (hit) return live.touches().back().reason;
    }
    return std::string();
  };
  EXPECT_NE(reasonOf([&](Touch& t) { t.feature = first; }).find("wrong feature"), std::string::npos);
  EXPECT_NE(reasonOf([](Touch& t) { t.position_mm /= 25.4; }).find("inches"), std::string::npos);
  EXPECT_NE(reasonOf([](Touch& t) { t.feature = "Q9"; }).find("Q9"), std::string::npos);
  EXPECT_NE(reasonOf([](Touch& t) { t.stylus = "p7"; }).find("radius is unknown"), std::string::npos);
  EXPECT_NE(reasonOf([](Touch& t) { t.artefact = "brick"; }).find("brick"), std::string::npos);
  EXPECT_NE(reasonOf([](Touch& t) { t.time_s = 1.0; }).find("does not come after"), std::string::npos);
  EXPECT_NE(reasonOf([](Touch& t) { t.position_mm += 0.9 * t.approach; }).find("since M0"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Probing, LiveKind, ::testing::Values(true, false),
                         [](const auto& p) { return p.param ? "Holes" : "Balls"; });

bool isSurface(const Touch& t) {
  return std::abs(t.approach.z()) > 0.7;
}

TEST(LiveTouches, ASurfaceTouchOffThePlaneOfTheOthersIsSuspectInTheFirstCycle) {
  const MachineDescription m = machineFrom(holeMachineText());
  VirtualProbeOptions options;
  options.form_error_um = 4.0;  // the other surfaces agree within 0.02 mm
  for (const std::string feature : {"H1", "H3", "H6", "H7"}) {
    const VirtualRun run = runCycles(m, 1, options, 51);
    LiveTouches live(m);
    Touch good;
    std::size_t rows = 0;
    for (Touch t : run.list.touches) {
      if (t.feature == feature && t.c_deg == 0.0 && isSurface(t)) {
        good = t;
        t.position_mm.z() -= 0.1;
      }
      live.add(t);
      rows += live.takeFinished(false).size();
    }
    ASSERT_EQ(live.retakes().size(), 1U) << feature;
    EXPECT_NE(live.retakes().front().find(feature + " again, touch 4: its height deviates by -"), std::string::npos)
        << live.retakes().front();
    rows += live.takeFinished(true).size();
    EXPECT_EQ(rows, run.list.touches.size() - 1) << "it has not reached the campaign";
    good.time_s = run.list.touches.back().time_s + 5.0;
    live.add(good);
    EXPECT_TRUE(live.retakes().empty());
    EXPECT_EQ(live.takeFinished(true).size(), 1U);
  }
}

TEST(LiveTouches, ABarWithAStepIsConfirmedByTouchingItAgain) {
  const MachineDescription m = machineFrom(holeMachineText());
  const VirtualRun run = runCycles(m, 1, {}, 52);
  LiveTouches live(m);
  Touch again;
  for (Touch t : run.list.touches) {
    if (t.feature == "H6" && isSurface(t)) {
      t.position_mm.z() -= 0.1;
      again = t;
    }
    live.add(t);
  }
  ASSERT_EQ(live.retakes().size(), 1U);
  again.time_s = run.list.touches.back().time_s + 5.0;
  again.position_mm.z() += 0.001;
  live.add(again);
  EXPECT_TRUE(live.retakes().empty());
  EXPECT_EQ(live.takeFinished(true).size(), run.list.touches.size());
}

TEST(LiveTouches, ALaterSurfaceTouchIsHeldAgainstTheChangesOfTheOthers) {
  const MachineDescription m = machineFrom(holeMachineText());
  const VirtualRun run = runCycles(m, 2, {}, 53);
  LiveTouches live(m);
  for (Touch t : run.list.touches) {
    if (t.cycle == "M1" && t.feature == "H6" && isSurface(t)) t.position_mm.z() -= 0.05;
    live.add(t);
  }
  ASSERT_EQ(live.retakes().size(), 1U);
  EXPECT_NE(live.retakes().front().find("M1, H6 again, touch 4"), std::string::npos) << live.retakes().front();
}

TEST(LiveTouches, ATableThatCountsOnIsHeldAgainstTheSamePlace) {
  const MachineDescription m = machineFrom(holeMachineText());
  const VirtualRun run = runCycles(m, 2, {}, 54);
  double turned_deg = 0.0;
  for (const Touch& t : run.list.touches) turned_deg = std::max(turned_deg, t.c_deg);
  ASSERT_GT(turned_deg, 0.0);
  const auto retakes = [&](double turns_deg, double wrong_mm) {
    LiveTouches live(m);
    for (Touch t : run.list.touches) {
      if (t.cycle == "M1" && t.touch == 1 && t.c_deg == turned_deg) t.position_mm += wrong_mm * t.approach;
      if (t.cycle == "M1") t.c_deg += turns_deg;
      live.add(t);
    }
    if (wrong_mm == 0.0) {
      EXPECT_EQ(live.progress().done, static_cast<int>(run.list.touches.size() / 2));
    }
    return live.retakes();
  };
  EXPECT_TRUE(retakes(-360.0, 0.0).empty());
  EXPECT_EQ(retakes(0.0, 0.06).size(), 1U);
  EXPECT_EQ(retakes(-360.0, 0.06), retakes(0.0, 0.06));
}

TEST(TouchList, APlaceThatACycleHasAtBothAnglesIsReadAtBoth) {
  const std::string head = "time_s,cycle,artefact,feature,stylus,c_deg,touch,x_mm,y_mm,z_mm,nx,ny,nz\n";
  const TouchList both =
      TouchList::parse(head + "0,M0,bar,H1,p0,-90,0,1,2,3,1,0,0\n1,M0,bar,H1,p0,270,0,1,2,3,1,0,0\n", "touches.csv");
  ASSERT_EQ(both.touches.size(), 2U);
  EXPECT_EQ(both.touches[0].c_deg, -90.0);
  EXPECT_EQ(both.touches[1].c_deg, 270.0);
  const TouchList later =
      TouchList::parse(head + "0,M0,bar,H1,p0,-90,0,1,2,3,1,0,0\n1,M1,bar,H1,p0,270,0,1,2,3,1,0,0\n", "touches.csv");
  EXPECT_EQ(later.touches[1].c_deg, -90.0);
  EXPECT_THROW((void)TouchList::parse(head + "0,M0,bar,H1,p0,-90,0,1,2,3,1,0,0\n1,M0,bar,H1,p0,-90,0,1,2,3,1,0,0\n",
                                      "touches.csv"),
               InputError);
  // Whole turns alone are none.
  EXPECT_EQ(TouchList::parse(head + "0,M0,bar,H1,p0,360,0,1,2,3,1,0,0\n", "touches.csv").touches[0].c_deg, 0.0);
}

// Stated rate of false alarms: below one in 10,000 touches, with surfaces that differ by 5 um (one sigma) and a machine
// that drifts by 25 um and 25 urad between cycles.
TEST(LiveTouches, HonestDriftIsNotSuspect) {
  const MachineDescription m = machineFrom(holeMachineText());
  VirtualProbeOptions options;
  options.form_error_um = 5.0;
  options.noise_um = 0.5;
  options.surface_noise_um = 1.0;
  std::size_t touches = 0;
  std::size_t suspects = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    options.form_seed = seed;
    const VirtualRun run = runCycles(m, 4, options, 1000 + seed);
    LiveTouches live(m);
    for (const Touch& t : run.list.touches) {
      live.add(t);
      if (!isSurface(t)) continue;
      ++touches;
    }
    for (const LiveTouch& l : live.touches()) suspects += !l.plausible && isSurface(l.touch) ? 1 : 0;
  }
  EXPECT_GT(touches, 4000U);
  EXPECT_EQ(suspects, 0U);
}

TEST(SurfaceHeights, TwoBadTouchesDoNotHideEachOtherAndTiltIsNoError) {
  Random random(3);
  std::vector<PlacedHeight> heights;
  for (const double c : {0.0, 180.0}) {
    for (int k = 0; k < 7; ++k) {
      const double along = (-150.0 + 50.0 * k) * (c == 0.0 ? 1.0 : -1.0);
      // The bar leans against the table, the axis against Z: opposite slopes at opposite angles.
      heights.push_back({{along, c == 0.0 ? 20.0 : -20.0, 5.0},
                         c,
                         0.4 * along + (c == 0.0 ? 1.0 : -1.0) * 0.3 * along + random.normal(0.0, 4.0)});
    }
  }
  for (const SurfaceVerdict& v : judgeSurfaceHeights(heights, {0, 0, 0}, {0, 0, 1})) {
    EXPECT_TRUE(v.judged);
    EXPECT_FALSE(v.suspect) << v.off_um;
  }
  heights[3].height_um += 100.0;
  heights[4].height_um += 90.0;
  const std::vector<SurfaceVerdict> verdicts = judgeSurfaceHeights(heights, {0, 0, 0}, {0, 0, 1});
  for (std::size_t i = 0; i < verdicts.size(); ++i) EXPECT_EQ(verdicts[i].suspect, i == 3 || i == 4) << i;
  EXPECT_NEAR(verdicts[3].off_um, 100.0, 20.0);
  // Too few to say anything.
  heights.resize(4);
  for (const SurfaceVerdict& v : judgeSurfaceHeights(heights, {0, 0, 0}, {0, 0, 1})) EXPECT_FALSE(v.judged);
}

TEST(LiveTouches, WithoutASecondTouchTheFirstOneIsKept) {
  const MachineDescription m = machineFrom(holeMachineText());
  const VirtualRun run = runCycles(m, 1, {}, 34);
  LiveTouches live(m);
  live.add(run.list.touches[0]);
  Touch twice = run.list.touches[0];
  twice.time_s += 1.0;
  twice.position_mm.z() += 0.001;
  EXPECT_TRUE(live.add(twice));
  EXPECT_FALSE(live.touches().back().plausible);
  EXPECT_TRUE(live.retakes().empty());
  EXPECT_THROW(LiveTouches(m, {0.0, 1.0, 1.0, 1.0}), InputError);
}

TEST(TouchStream, HalfALineIsWaitedForAndNotAnError) {
  const MachineDescription m = machineFrom(holeMachineText());
  const VirtualRun run = runCycles(m, 1, {}, 35);
  const std::string text = run.list.csv();
  TouchStream stream("touches.csv", m);
  std::size_t seen = 0;
  // Grown in odd steps, as a slow control writes.
  for (std::size_t at = 0; at < text.size(); at += 37) {
    seen += stream.update(std::string_view(text).substr(at, 37)).size();
    EXPECT_TRUE(stream.problems().empty()) << stream.problems().front().sentence;
  }
  EXPECT_EQ(seen, run.list.touches.size());
  EXPECT_FALSE(stream.waiting());
  EXPECT_TRUE(stream.update("3000,M1,bar,H1").empty());
  EXPECT_TRUE(stream.waiting());
}

TEST(TouchStream, ABadLineIsASentenceAndTheRestIsRead) {
  const MachineDescription m = machineFrom(holeMachineText());
  const VirtualRun run = runCycles(m, 1, {}, 36);
  std::string text = run.list.csv();
  // Line 3 gets an approach of length zero, line 5 a decimal comma.
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  for (int comma = 0; comma < 3; ++comma) lines[2].erase(lines[2].rfind(','));
  lines[2] += ",0,0,0";
  lines[4].replace(0, lines[4].find(','), "abc");
  text.clear();
  for (const std::string& line : lines) text += line + "\n";
  TouchStream stream("touches.csv", m);
  EXPECT_EQ(stream.update(text).size(), run.list.touches.size() - 2);
  ASSERT_EQ(stream.problems().size(), 2U);
  EXPECT_NE(stream.problems()[0].sentence.find("line 3"), std::string::npos) << stream.problems()[0].sentence;
  EXPECT_NE(stream.problems()[1].sentence.find("line 5"), std::string::npos) << stream.problems()[1].sentence;
  // A file that is written anew from its start is read anew.
  stream.restart();
  EXPECT_EQ(stream.update(run.list.csv()).size(), run.list.touches.size());
  EXPECT_TRUE(stream.problems().empty());
}

TEST(TouchStream, AMarkOfUtf8AndNumbersOfCyclesAsAControlPrintsThem) {
  const MachineDescription m = machineFrom(holeMachineText());
  const JsonNode by_line = JsonNode::parse(
      R"({"format":"spindrift-printed-text","version":1,"touch_line":"T {feature} X{x} Y{y} Z{z} I{nx} J{ny} K{nz}",
"cycle_line":"CYCLE {cycle}","cycle_prefix":"M","artefact":"bar","stylus":"S1"})",
      "template.json");
  TouchStream marked("a.txt", m, by_line);
  const std::vector<Touch> first = marked.update(
      "\xEF\xBB\xBF"
      "CYCLE 1.\nT H1 X1 Y2 Z3 I1 J0 K0\n");
  ASSERT_EQ(first.size(), 1U);
  EXPECT_EQ(first[0].cycle, "M1");
  const JsonNode in_line = JsonNode::parse(
      R"({"format":"spindrift-printed-text","version":1,"touch_line":"T N{cycle} {feature} X{x} Y{y} Z{z} I{nx} J{ny} K{nz}",
"cycle_prefix":"M","artefact":"bar","stylus":"S1"})",
      "template.json");
  TouchStream named("b.txt", m, in_line);
  const std::vector<Touch> second = named.update(
      "\xEF\xBB\xBF"
      "T N1. H1 X1 Y2 Z3 I1 J0 K0\n");
  ASSERT_EQ(second.size(), 1U);
  EXPECT_EQ(second[0].cycle, "M1");
}

TEST(TouchStream, PrintedTextIsReadThroughItsTemplateAsItGrows) {
  const MachineDescription m = machineFrom(holeMachineText());
  const JsonNode pattern = JsonNode::parse(
      R"({"format":"spindrift-printed-text","version":1,"touch_line":"T {feature} C{c_deg} X{x} Y{y} Z{z} I{nx} J{ny} K{nz}",
"cycle_line":"CYCLE {cycle}","cycle_prefix":"M","artefact":"bar"})",
      "template.json");
  const VirtualRun run = runCycles(m, 2, {}, 37);
  std::string text;
  std::string cycle;
  for (const Touch& t : run.list.touches) {
    if (t.cycle != cycle) text += "CYCLE " + t.cycle.substr(1) + "\nwarming up\n";
    cycle = t.cycle;
    text += "T " + t.feature + " C" + std::to_string(t.c_deg);
    for (int k = 0; k < 3; ++k) text += std::string(" ") + "XYZ"[k] + std::to_string(t.position_mm(k));
    for (int k = 0; k < 3; ++k) text += std::string(" ") + "IJK"[k] + std::to_string(t.approach(k));
    text += "\n";
  }
  TouchStream stream("printed.txt", m, pattern);
  LiveTouches live(m);
  for (std::size_t at = 0; at < text.size(); at += 101) {
    for (const Touch& t : stream.update(std::string_view(text).substr(at, 101))) live.add(t);
  }
  EXPECT_EQ(live.touches().size(), run.list.touches.size());
  EXPECT_TRUE(live.retakes().empty()) << live.retakes().front();
  EXPECT_EQ(live.progress().cycle, "M1");
}

TEST(TouchStream, ABadPrintedLineIsASentenceAndCountsNothing) {
  const MachineDescription m = machineFrom(holeMachineText());
  const JsonNode pattern = JsonNode::parse(
      R"({"format":"spindrift-printed-text","version":1,"touch_line":"T {feature} X{x} Y{y} Z{z} I{nx} J{ny} K{nz} S{time}",
"artefact":"bar"})",
      "template.json");
  const std::string good = "T H1 X1 Y2 Z3 I1 J0 K0 S5\n";
  TouchStream stream("printed.txt", m, pattern);
  EXPECT_EQ(stream.update("warming up\n" + good).size(), 1U);
  EXPECT_TRUE(stream.update("T H1 Xone Y2 Z3 I1 J0 K0 S6\nT H1 X1 Y2 Z3 I0 J0 K0 S7\n").empty());
  const std::vector<Touch> next = stream.update("T H1 X1 Y2 Z3 I1 J0 K0 S9\n");
  ASSERT_EQ(next.size(), 1U);
  EXPECT_EQ(next[0].touch, 1) << "the bad ones have no number";
  EXPECT_EQ(next[0].time_s, 4.0) << "since the first one";
  EXPECT_EQ(next[0].line, 5U);
  ASSERT_EQ(stream.problems().size(), 2U);
  EXPECT_NE(stream.problems()[0].sentence.find("line 3"), std::string::npos) << stream.problems()[0].sentence;
  EXPECT_NE(stream.problems()[1].sentence.find("approach"), std::string::npos) << stream.problems()[1].sentence;
  // More bad lines than one looks through, and what comes after them.
  std::string bad;
  for (int i = 0; i < 150; ++i) bad += "T H1 Xone Y2 Z3 I1 J0 K0 S6\n";
  EXPECT_EQ(stream.update(bad + good).size(), 1U);
}

}  // namespace
}  // namespace spindrift
