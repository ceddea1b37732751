// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/probing/cycle_program.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "core/probing/checked_program.h"
#include "core/probing/cycle_studies.h"
#include "core/probing/printed_text.h"
#include "core/probing/probe_health.h"
#include "core/probing/star_stylus.h"
#include "core/probing/volumetric_error.h"
#include "tests/core/probing/probing_machines.h"

namespace spindrift {
namespace {

using namespace probing_test;

constexpr std::array every_dialect = {ProgramDialect::Fanuc, ProgramDialect::Generic, ProgramDialect::Siemens,
                                      ProgramDialect::Heidenhain};

struct Written {
  MachineDescription machine;
  CyclePlanOptions plan_options;
  ProgramCheckOptions check_options;
  std::string text;
};

std::string withReplaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  if (at != std::string::npos) text.replace(at, from.size(), to);
  return text;
}

Written write(bool holes, ProgramDialect dialect) {
  Written w;
  // The spindle reference stands 60 resp. 50 mm above the tip: the ball machine needs more travel in Z.
  w.machine = machineFrom(
      holes ? holeMachineText()
            : withReplaced(ballMachineText(), "\"Z\",\"travel_mm\":[0,500]", "\"Z\",\"travel_mm\":[0,700]"));
  w.plan_options.first_ball_mm = Eigen::Vector3d(110, 100, 60);
  w.check_options.first_ball_mm = w.plan_options.first_ball_mm;
  const Artefact& artefact = w.machine.artefacts.front();
  ProgramOptions options;
  options.dialect = dialect;
  w.text = writeProgram(planCycle(w.machine, artefact, w.plan_options), w.machine, artefact, w.plan_options, options);
  return w;
}

TEST(CycleProgram, WhatIsWrittenPassesTheIndependentCheck) {
  for (const bool holes : {true, false}) {
    for (const ProgramDialect dialect : every_dialect) {
      const Written w = write(holes, dialect);
      const ProgramCheck check = checkProgram(w.text, w.machine, w.machine.artefacts.front(), w.check_options);
      for (const ProgramIssue& i : check.issues) ADD_FAILURE() << "line " << i.line << ": " << i.what;
      EXPECT_EQ(check.touches, holes ? 60 : 4 * (5 + 4 + 4));
    }
  }
}

TEST(CycleProgram, TheCheckFindsWhatIsWrong) {
  const Written w = write(true, ProgramDialect::Fanuc);
  const auto issues = [&](const std::string& text) {
    return checkProgram(text, w.machine, w.machine.artefacts.front(), w.check_options).issues;
  };
  ASSERT_TRUE(issues(w.text).empty());
  const auto without = [&](const std::string& start) {
    const std::size_t at = w.text.find("\n" + start);
    std::string text = w.text;
    text.erase(at, text.find('\n', at + 1) - at);
    return text;
  };
  EXPECT_FALSE(issues(without("G1 ")).empty()) << "a missing retract";
  EXPECT_FALSE(issues(without("M30")).empty()) << "no end";
  EXPECT_FALSE(issues(without("G21")).empty()) << "no units";
  const std::size_t guarded = w.text.find("G65 P8902");
  const std::string first_guarded = w.text.substr(guarded, w.text.find('\n', guarded) - guarded);
  std::string deeper = w.text;
  const std::size_t z = deeper.find('Z', guarded);
  deeper.replace(z, deeper.find(' ', z) - z, "Z-80.0000");
  EXPECT_FALSE(issues(deeper).empty()) << "outside the travel";
  std::string turned = w.text;
  const std::size_t turn = turned.find("G0 C90.0000");
  turned.replace(turn, 11, "G0 C95.0000");
  EXPECT_FALSE(issues(turned).empty()) << "the holes are elsewhere at this angle";
  std::string wrong = w.text;
  const std::size_t feature = wrong.find(" A1 ");
  wrong.replace(feature, 4, " A2 ");
  EXPECT_FALSE(issues(wrong).empty()) << "another feature than the one that is touched";
  EXPECT_FALSE(issues("G91 G21\nG0 X1 Y1 Z1\nM30\n").empty());
  EXPECT_FALSE(issues("").empty());
}

/// Every dialect commands the same moves, and what is taken out of a programme or put into it is found.
TEST(CycleProgram, TheDialectsSayTheSame) {
  for (const bool holes : {true, false}) {
    const Written fanuc = write(holes, ProgramDialect::Fanuc);
    const auto& artefact = fanuc.machine.artefacts.front();
    const ProgramCheck first = checkProgram(fanuc.text, fanuc.machine, artefact, fanuc.check_options);
    for (const ProgramDialect dialect : {ProgramDialect::Siemens, ProgramDialect::Heidenhain}) {
      const Written other = write(holes, dialect);
      const ProgramCheck check = checkProgram(other.text, other.machine, artefact, other.check_options);
      ASSERT_EQ(check.moves.size(), first.moves.size());
      for (std::size_t i = 0; i < check.moves.size(); ++i) {
        const ParsedMove& a = first.moves[i];
        const ParsedMove& b = check.moves[i];
        EXPECT_EQ(a.kind, b.kind);
        EXPECT_LT((a.reference_mm - b.reference_mm).norm(), 2e-4) << "line " << b.line;
        EXPECT_EQ(a.c_deg, b.c_deg);
        EXPECT_EQ(a.feature, b.feature);
        EXPECT_EQ(a.stylus, b.stylus);
      }
      const auto bad = [&](const std::string& from, const std::string& to) {
        return !checkProgram(withReplaced(other.text, from, to), other.machine, artefact, other.check_options).good();
      };
      if (dialect == ProgramDialect::Siemens) {
        EXPECT_TRUE(bad("IF $AC_MEA[1]==0 GOTOF _SPD_MISSED\n", "")) << "nobody asks for the contact";
        EXPECT_TRUE(bad("T A1 B1", "T A2 B1")) << "another feature than the one that is touched";
        if (holes) {
          EXPECT_TRUE(bad(" C90 ", " C0 ")) << "another angle than that of the table";
        }
        EXPECT_TRUE(bad("\" I1 J0 K0 S", "\" I-1 J0 K0 S")) << "the other side";
        EXPECT_TRUE(bad("$AA_MM[X]", "$AA_MW[X]")) << "not machine coordinates";
        EXPECT_TRUE(bad("SUPA G0", "G0")) << "not machine coordinates";
        EXPECT_TRUE(bad("G710", "G700")) << "inches";
        EXPECT_TRUE(bad("\nM30\n_SPD_HIT", "\n_SPD_HIT")) << "no end";
      } else {
        EXPECT_TRUE(bad("FN 9: IF +Q4 EQU -1 GOTO LBL 99", "FN 0: Q5 = +1")) << "nobody asks for the contact";
        EXPECT_TRUE(bad("FN 0: Q11 = +1\n", "FN 0: Q11 = +2\n")) << "another feature than the one that is touched";
        if (holes) {
          EXPECT_TRUE(bad("FN 0: Q13 = +90\n", "FN 0: Q13 = +0\n")) << "another angle than that of the table";
        }
        EXPECT_TRUE(bad("FN 0: Q15 = +1\n", "FN 0: Q15 = -1\n")) << "the other side";
        EXPECT_TRUE(bad("REFERENCE SYSTEM:1", "REFERENCE SYSTEM:0")) << "not machine coordinates";
        EXPECT_TRUE(bad(" FMAX M91", " FMAX")) << "not machine coordinates";
        EXPECT_TRUE(bad(" M91 M141", " M91")) << "no retract";
        EXPECT_TRUE(bad("BEGIN PGM SPINDRIFT MM", "BEGIN PGM SPINDRIFT INCH")) << "inches";
      }
    }
  }
}

/// What the control prints is what the evaluation believes.
TEST(CycleProgram, WhatIsPrintedIsWhatIsDone) {
  for (const ProgramDialect dialect : {ProgramDialect::Fanuc, ProgramDialect::Generic}) {
    const Written w = write(true, dialect);
    const bool logged = dialect == ProgramDialect::Generic;
    const auto bad = [&](const std::string& from, const std::string& to) {
      return !checkProgram(withReplaced(w.text, from, to), w.machine, w.machine.artefacts.front(), w.check_options)
                  .good();
    };
    EXPECT_TRUE(bad(logged ? " Z#5063 I1 J0 K0" : " I1 J0 K0", logged ? " Z#5063 I-1 J0 K0" : " I-1 J0 K0"))
        << "the other side";
    EXPECT_TRUE(logged ? bad("(LOG,T A1 B1 C90 ", "(LOG,T A1 B1 C0 ") : bad(" C90 D", " C0 D"))
        << "another angle than that of the table";
    if (!logged) continue;
    EXPECT_TRUE(bad("(LOG,T A1 ", "(LOG,T A2 ")) << "another feature";
    EXPECT_TRUE(bad("X#5061 Y#5062", "X#5061 Y#5061")) << "another place";
  }
}

/// The masks of FN 16, filled in as the control fills them, are lines that the template reads.
TEST(CycleProgram, TheMasksOfHeidenhainPrintWhatIsRead) {
  const std::vector<CompanionFile> masks = companionFiles(ProgramDialect::Heidenhain);
  ASSERT_EQ(masks.size(), 2U);
  EXPECT_TRUE(companionFiles(ProgramDialect::Siemens).empty());
  std::map<std::string, double> q = {{"Q1", 12.34567}, {"Q2", -3.0},  {"Q3", 55.5},  {"Q11", 2},
                                     {"Q12", 1},       {"Q13", 90.0}, {"Q14", 3},    {"Q15", -1.0},
                                     {"Q16", 0},       {"Q17", 0},    {"Q20", 1.7e9}};
  std::string printed;
  for (const CompanionFile& mask : masks) {
    const std::size_t quote = mask.content.find('"', 1);
    std::string format = mask.content.substr(1, quote - 1);
    std::string names = mask.content.substr(quote + 2, mask.content.find(';') - quote - 2);
    for (std::size_t at = format.find('%'); at != std::string::npos; at = format.find('%')) {
      const int digits = format[at + 2] - '0';
      const std::string name = names.substr(0, names.find(','));
      names.erase(0, name.size() + 1);
      format.replace(at, 5, fmt::format("{:.{}f}", q.at(name), digits));
    }
    EXPECT_TRUE(names.empty()) << names;
    printed += format + "\r\n";
  }
  const MachineDescription m = machineFrom(holeMachineText());
  ProgramOptions options;
  options.dialect = ProgramDialect::Heidenhain;
  const JsonNode pattern =
      JsonNode::parse(printedTextTemplate(m, m.artefacts.front(), options).dump(), "template.json");
  const PrintedText text = readPrintedText(printed, "TOUCHES.TXT", pattern, m);
  ASSERT_EQ(text.touches.touches.size(), 1U);
  const Touch& t = text.touches.touches.front();
  EXPECT_EQ(t.feature, "H2");
  EXPECT_EQ(t.c_deg, 90.0);
  EXPECT_NEAR((t.position_mm - m.styli.front().offset_mm).x(), 12.3457, 1e-9);
  EXPECT_EQ(t.approach.x(), -1.0);
}

TEST(CycleProgram, ANameCommandsNothing) {
  for (const ProgramDialect dialect : every_dialect) {
    Written w = write(true, dialect);
    Artefact& artefact = w.machine.artefacts.front();
    ProgramOptions options;
    options.dialect = dialect;
    const CyclePlan plan = planCycle(w.machine, artefact, w.plan_options);
    artefact.id = "bar) M3 S9000 (x\nG1 X-5 M8 ;\xC3\xA4" + std::string(500, 'b');
    const std::string text = writeProgram(plan, w.machine, artefact, w.plan_options, options);
    EXPECT_EQ(text.find("bar)"), std::string::npos);
    EXPECT_EQ(text.find("\nG1 X-5"), std::string::npos);
    EXPECT_EQ(text.find('\xC3'), std::string::npos) << "a control shows no UTF-8";
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), std::count(w.text.begin(), w.text.end(), '\n'));
    EXPECT_TRUE(checkProgram(text, w.machine, artefact, w.check_options).good());
  }
}

TEST(CycleProgram, TheCheckTakesNothingThatStartsSomething) {
  for (const ProgramDialect dialect : every_dialect) {
    const Written w = write(true, dialect);
    const auto good = [&](const std::string& text) {
      return checkProgram(text, w.machine, w.machine.artefacts.front(), w.check_options).good();
    };
    const bool heidenhain = dialect == ProgramDialect::Heidenhain;
    const std::string rapid = heidenhain ? " R0 FMAX M91" : dialect == ProgramDialect::Siemens ? "SUPA G0 X" : "\nG0 X";
    const auto with = [&](const std::string& words) {
      return withReplaced(w.text, rapid,
                          heidenhain              ? " R0 FMAX M91 " + words
                          : rapid.front() == '\n' ? "\n" + words + " G0 X"
                                                  : words + " SUPA G0 X");
    };
    ASSERT_TRUE(good(with("")));
    EXPECT_FALSE(good(with("M3"))) << "the spindle with the probe in it";
    EXPECT_FALSE(good(with("M8"))) << "a move beside an M code is a move";
    EXPECT_FALSE(good(with("S9000")));
    EXPECT_FALSE(good(with("T5")));
  }
}

TEST(CyclePlan, AFeedThatBreaksTheProbeIsRefused) {
  CyclePlanOptions options;
  options.touch_feed_mm_min = 1e9;
  EXPECT_THROW(options.validate(), InputError);
  options.touch_feed_mm_min = 0.001;  // would be written as F0
  EXPECT_THROW(options.validate(), InputError);
  options = {};
  options.guarded_feed_mm_min = 1e12;
  EXPECT_THROW(options.validate(), InputError);
  EXPECT_NO_THROW(CyclePlanOptions{}.validate());
}

/// The tip stands 60 mm below the spindle reference: no deeper than that goes the spindle into the bar.
TEST(CyclePlan, WhatIsNoPlaceIsRefused) {
  for (const double value : {std::nan(""), -1.0, 0.0, 1e6}) {
    CyclePlanOptions options;
    options.surface_offset_mm = value;
    EXPECT_THROW(options.validate(), InputError) << value;
  }
  CyclePlanOptions options;
  options.first_ball_mm.y() = std::nan("");
  EXPECT_THROW(options.validate(), InputError);
  options.first_ball_mm.y() = 100.0;
  EXPECT_NO_THROW(options.validate());
}

TEST(CycleProgram, TheSpindleStaysAboveTheBar) {
  MachineDescription m = machineFrom(holeMachineText());
  const Artefact& artefact = m.artefacts.front();
  CyclePlanOptions deep;
  deep.depth_mm = 55.0;
  EXPECT_TRUE(makeCheckedProgram(m, artefact, deep, {}).check.good());
  deep.depth_mm = 55.1;
  try {
    (void)planCycle(m, artefact, deep);
    ADD_FAILURE() << "planned";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("55"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("p0"), std::string::npos) << e.what();
  }
  // The check knows it of itself: the same programme for a shorter stylus, the positions those of the tip.
  deep.depth_mm = 50.0;
  const CyclePlan plan = planCycle(m, artefact, deep);
  m.styli.front().offset_mm.z() = -40.0;
  const std::string text = writeProgram(plan, m, artefact, deep);
  const ProgramCheck check = checkProgram(text, m, artefact);
  ASSERT_FALSE(check.good());
  EXPECT_NE(check.issues.front().what.find("spindle reference"), std::string::npos) << check.issues.front().what;
  // A shaft that leans from the spindle into the hole runs into its rim.
  MachineDescription leaning = machineFrom(holeMachineText());
  leaning.styli.front().offset_mm = Eigen::Vector3d(40.0, 0.0, -60.0);
  CyclePlanOptions usual;
  usual.depth_mm = 20.0;
  EXPECT_FALSE(makeCheckedProgram(leaning, leaning.artefacts.front(), usual, {}).check.good());
}

TEST(CycleProgram, TravelIsChecked) {
  const MachineDescription small =
      machineFrom(withReplaced(holeMachineText(), "\"travel_mm\":[0,520]", "\"travel_mm\":[0,380]"));
  EXPECT_THROW((void)planCycle(small, small.artefacts.front()), InputError);
}

TEST(PrintedText, ComesBackAsTouches) {
  for (const bool holes : {true, false}) {
    for (const ProgramDialect dialect : every_dialect) {
      const MachineDescription m = machineFrom(holes ? holeMachineText() : ballMachineText());
      const Artefact& artefact = m.artefacts.front();
      const VirtualRun run = runCycles(m, 2, {}, 3);
      const std::vector<std::string> names = featureNames(artefact);
      std::string text = "SYSTEM READY\n";
      std::string cycle;
      for (const Touch& t : run.list.touches) {
        if (t.cycle != cycle) {
          cycle = t.cycle;
          text += fmt::format("CYCLE     {}\n", cycle.substr(1));
        }
        const auto feature = std::find(names.begin(), names.end(), t.feature) - names.begin() + 1;
        int stylus = 1;
        while (m.styli[static_cast<std::size_t>(stylus - 1)].id != t.stylus) ++stylus;
        const Eigen::Vector3d p = t.position_mm - m.findStylus(t.stylus)->offset_mm;
        text +=
            fmt::format("T A {:2d} B{} C {} D{} X{:10.6f} Y {:.6f} Z{:.6f} I{:.0f}. J{:.0f}. K {:.0f}", feature, stylus,
                        t.c_deg, t.touch, p.x(), p.y(), p.z(), t.approach.x(), t.approach.y(), t.approach.z());
        text += dialect == ProgramDialect::Fanuc     ? fmt::format(" S {:.0f}\r\n", 5e6 + 1e3 * t.time_s)
                : dialect == ProgramDialect::Generic ? "\n"
                                                     : fmt::format(" S{:.0f}\r\n", 1.7e6 + t.time_s);
      }
      ProgramOptions options;
      options.dialect = dialect;
      const JsonNode pattern = JsonNode::parse(printedTextTemplate(m, artefact, options).dump(), "template.json");
      const PrintedText printed = readPrintedText(text, "printed.txt", pattern, m);
      ASSERT_EQ(printed.touches.touches.size(), run.list.touches.size());
      EXPECT_EQ(printed.ignored_lines, 1);
      for (std::size_t i = 0; i < run.list.touches.size(); ++i) {
        const Touch& a = run.list.touches[i];
        const Touch& b = printed.touches.touches[i];
        EXPECT_EQ(a.feature, b.feature);
        EXPECT_EQ(a.cycle, b.cycle);
        EXPECT_EQ(a.stylus, b.stylus);
        EXPECT_EQ(a.touch, b.touch);
        EXPECT_LT((a.position_mm - b.position_mm).norm(), 2e-6);
        EXPECT_LT((a.approach - b.approach).norm(), 1e-9);
      }
      printed.touches.checkAgainst(m);
    }
  }
}

TEST(PrintedText, AClockThatBeginsAgainWithTheMonthGoesOn) {
  const MachineDescription m = machineFrom(holeMachineText());
  ProgramOptions options;
  options.dialect = ProgramDialect::Siemens;
  const JsonNode pattern =
      JsonNode::parse(printedTextTemplate(m, m.artefacts.front(), options).dump(), "template.json");
  const auto line = [](int touch, double s) {
    return fmt::format("T A1 B1 C0 D{} X15 Y20 Z47 I1 J0 K0 S{}\n", touch, s);
  };
  // 31 December, 23:59:50, and ten seconds past midnight; then 28 February.
  const PrintedText text = readPrintedText(
      line(0, 31 * 86400 + 86390) + line(1, 86400 + 10) + line(2, 28 * 86400 + 86399) + line(3, 86400 + 1), "t.txt",
      pattern, m);
  ASSERT_EQ(text.touches.touches.size(), 4U);
  EXPECT_EQ(text.touches.touches[1].time_s, 20.0);
  EXPECT_EQ(text.touches.touches[3].time_s - text.touches.touches[2].time_s, 2.0);
}

TEST(PrintedText, ATouchThatIsCutShortIsCounted) {
  const MachineDescription m = machineFrom(holeMachineText());
  const JsonNode pattern = JsonNode::parse(printedTextTemplate(m, m.artefacts.front(), {}).dump(), "template.json");
  const PrintedText text = readPrintedText(
      "HELLO\nT A1 B1 C0 D0 X15 Y20 Z47 I1 J0 K0 S1\nT A1 B1 C0 D1 X1\nT A1 B1\nBYE\n", "t.txt", pattern, m);
  EXPECT_EQ(text.touches.touches.size(), 1U);
  EXPECT_EQ(text.ignored_lines, 4);
  EXPECT_EQ(text.cut_lines, 2);
  EXPECT_EQ(text.first_cut_line, 3U);
}

TEST(PrintedText, BadTemplatesAndLinesAreTold) {
  const MachineDescription m = machineFrom(holeMachineText());
  const auto read = [&](const std::string& line, const std::string& text) {
    const JsonNode pattern = JsonNode::parse(
        R"({"format":"spindrift-printed-text","version":1,"artefact":"bar","touch_line":")" + line + "\"}", "t.json");
    return readPrintedText(text, "p.txt", pattern, m);
  };
  EXPECT_THROW((void)read("{nonsense} {x}", "1 2\n"), InputError);
  EXPECT_THROW((void)read("{feature} {x} {y} {z} {nx} {ny} {nz}", "nothing here\n"), InputError);
  EXPECT_THROW((void)read("{feature} {x} {y} {z} {nx} {ny} {nz}", "H1 1 2 abc 1 0 0\n"), InputError);
  EXPECT_THROW((void)read("{feature} {x} {y} {z} {nx} {ny} {nz}", "H1 1 2 3 0 0 0\n"), InputError);
  EXPECT_EQ(read("{feature} {x} {y} {z} {nx} {ny} {nz}", "H1 1 2 3 1 0 0\n").touches.touches.size(), 1U);
}

TEST(PrintedText, TheSignOfTheTableIsASign) {
  const MachineDescription m = machineFrom(holeMachineText());
  const auto angle = [&](const std::string& sign) {
    const JsonNode pattern =
        JsonNode::parse(R"({"format":"spindrift-printed-text","version":1,"artefact":"bar","c_sign":)" + sign +
                            R"(,"touch_line":"{feature} {c_deg} {x} {y} {z} {nx} {ny} {nz}"})",
                        "t.json");
    return readPrintedText("H1 90 1 2 3 1 0 0\n", "p.txt", pattern, m).touches.touches.front().c_deg;
  };
  EXPECT_EQ(angle("1"), 90.0);
  EXPECT_EQ(angle("-1"), -90.0);
  for (const char* bad : {"2", "0", "-0.5"}) EXPECT_THROW((void)angle(bad), InputError) << bad;
}

TEST(StarStylus, ClosedFormsGiveARotationBack) {
  Random random(4);
  for (int run = 0; run < 200; ++run) {
    const StylusCentres before{Eigen::Vector3d(random.uniform(-5, 5), random.uniform(-5, 5), -200.0),
                               Eigen::Vector3d(3, 50, random.uniform(-180, -150)),
                               Eigen::Vector3d(50, random.uniform(5, 20), -160)};
    const Eigen::Vector3d a(random.uniform(-1e-4, 1e-4), random.uniform(-1e-4, 1e-4), random.uniform(-1e-4, 1e-4));
    StylusCentres after;
    for (int i = 0; i < 3; ++i) after[i] = before[i] + a.cross(before[i]);
    const HeadRotation found = closedFormRotation(before, after);
    ASSERT_EQ(found.status, FitStatus::Converged) << found.message;
    EXPECT_LT((found.rotation_rad - a).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST(StarStylus, IgnoredTranslationLooksLikeARotation) {
  const StylusCentres before{Eigen::Vector3d(0, 0, -50), Eigen::Vector3d(0, 50, -20), Eigen::Vector3d(50, 10, -20)};
  // 10 um along X alone: the head seems to turn about Y by 10 um / 50 mm.
  StylusCentres moved = before;
  for (Eigen::Vector3d& centre : moved) centre.x() += 0.010;
  EXPECT_NEAR(std::abs(closedFormRotation(before, moved).rotation_rad.y()), 2e-4, 1e-9);
  EXPECT_NEAR(spindleDrift({0, 0, 0}, {0.003, 0.004, 0.0}), 0.005, 1e-15);
  const StylusCentres flat{Eigen::Vector3d(0, 0, -50), Eigen::Vector3d(0, 0, -20), Eigen::Vector3d(50, 0, -20)};
  EXPECT_EQ(closedFormRotation(flat, flat).status, FitStatus::Degenerate);
}

TEST(VolumetricError, FieldFollowsTheParameters) {
  const MachineDescription m = machineFrom(ballMachineText());
  VirtualProbeOptions options;
  options.noise_um = 0.0;
  const VirtualRun run = runCycles(m, 2, options, 3);
  const BallCycleResult result = evaluateBallCycles(run.list, m, m.artefacts.front(), nullptr);
  const BallCycleModel model(result, 1);
  const TipDeviation deviation = ballDeviation(m, run.truth[1]);
  for (int axis = 0; axis < 3; ++axis) {
    const Field plane = volumetricField(model, m, Component::EX, axis, 120.0, {0, 0, -50}, 4);
    EXPECT_EQ(plane.grid.normal_axis, axis);
    DeviationQuery there;
    there.position_mm = plane.grid.place_mm(plane.grid.x_mm(2), plane.grid.y_mm(1));
    there.tool_offset_mm = {0, 0, -50};
    EXPECT_DOUBLE_EQ(there.position_mm(axis), 120.0);
    EXPECT_DOUBLE_EQ(plane.value[plane.grid.index(2, 1)], model.predict(there, Component::EX).value) << axis;
  }
  const Field field = volumetricField(model, m, Component::EZ, 1, 120.0, {0, 0, -50}, 5);
  for (int iz = 0; iz < 5; ++iz) {
    for (int ix = 0; ix < 5; ++ix) {
      const Eigen::Vector3d p(field.grid.x_mm(ix), 120.0, field.grid.y_mm(iz));
      const Eigen::Vector3d d = deviation({0.0, p, {0, 0, -50}, 0.0, "B1", Eigen::Vector3d::UnitX()});
      EXPECT_NEAR(field.value[field.grid.index(ix, iz)], 1e3 * d.z(), 0.1);
    }
  }
  EXPECT_EQ(volumetricArrows(model, m, {0, 0, -50}, 3).size(), 27U);
  // Seen from above: what lies between the balls is interpolated, the corners of the travel are not.
  const Field above = volumetricField(model, m, Component::EZ, 2, 120.0, {0, 0, -50}, 41);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : model.places_mm()) middle += p / static_cast<double>(model.places_mm().size());
  const auto node = [&](double x_mm, double y_mm) {
    const auto at = [](double from, double to, double v) {
      return static_cast<int>(std::lround(std::clamp((v - from) / (to - from), 0.0, 1.0) * 40.0));
    };
    return above.grid.index(at(above.grid.x_from_mm, above.grid.x_to_mm, x_mm),
                            at(above.grid.y_from_mm, above.grid.y_to_mm, y_mm));
  };
  EXPECT_FALSE(above.extrapolated[node(middle.x(), middle.y())]);
  EXPECT_TRUE(above.extrapolated[node(1e6, 1e6)]);
  EXPECT_TRUE(above.extrapolated[node(-1e6, -1e6)]);
}

/// A ball touched from five or nine sides in ten passes: what is found is what the touches scatter, not what the
/// centres of the passes leave of it.
TEST(ProbeHealth, RepeatabilityIsThatOfTheTouches) {
  const MachineDescription m = machineFrom(ballMachineText());
  const double radius_mm = 0.5 * m.artefacts.front().balls.front().diameter_mm + m.styli.front().radius_mm;
  std::vector<Eigen::Vector3d> sides{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, -1}};
  for (const std::size_t count : {5U, 9U}) {
    if (count == 9U)
      for (const double x : {1.0, -1.0})
        for (const double y : {1.0, -1.0}) sides.emplace_back(Eigen::Vector3d(x, y, -1.0).normalized());
    double squares = 0.0;
    double freedom = 0.0;
    Random random(17);
    for (int run = 0; run < 60; ++run) {
      TouchList list;
      for (int pass = 0; pass < 10; ++pass) {
        const Eigen::Vector3d centre(200.0 + 0.002 * pass, 200.0, 100.0 - 0.003 * pass);
        for (std::size_t k = 0; k < sides.size(); ++k) {
          Touch t;
          t.time_s = 100.0 * pass + 10.0 * static_cast<double>(k);
          t.cycle = "Q" + std::to_string(pass);
          t.artefact = m.artefacts.front().id;
          t.feature = m.artefacts.front().balls.front().id;
          t.stylus = m.styli.front().id;
          t.touch = static_cast<int>(k);
          t.approach = sides[k];
          t.position_mm = centre - (radius_mm + random.normal(0.0, 1.5e-3)) * sides[k];
          list.touches.push_back(t);
        }
      }
      const StylusHealth health = checkProbeHealth(list, m).front();
      EXPECT_EQ(health.repeatability_dof, static_cast<int>(10 * count - count - 27)) << count;
      squares += health.repeatability_dof * std::pow(health.repeatability_um, 2);
      freedom += health.repeatability_dof;
    }
    EXPECT_NEAR(std::sqrt(squares / freedom), 1.5, 0.06) << count << " sides";
  }
}

/// A ball touched from these sides in some passes, with a stylus whose pre-travel is `lobes_um` (rms) off its mean.
TouchList touchesFrom(const MachineDescription& m, const std::vector<Eigen::Vector3d>& sides, int passes,
                      double noise_um, const std::vector<double>& lobes_um, Random& random) {
  const double radius_mm = 0.5 * m.artefacts.front().balls.front().diameter_mm + m.styli.front().radius_mm;
  TouchList list;
  for (int pass = 0; pass < passes; ++pass) {
    const Eigen::Vector3d centre(200.0 + 0.001 * pass, 200.0, 100.0);
    for (std::size_t k = 0; k < sides.size(); ++k) {
      Touch t;
      t.time_s = 100.0 * pass + 10.0 * static_cast<double>(k);
      t.cycle = "Q" + std::to_string(pass);
      t.artefact = m.artefacts.front().id;
      t.feature = m.artefacts.front().balls.front().id;
      t.stylus = m.styli.front().id;
      t.touch = static_cast<int>(k);
      t.approach = sides[k];
      t.position_mm = centre - (radius_mm - 1e-3 * lobes_um[k] + random.normal(0.0, 1e-3 * noise_um)) * sides[k];
      list.touches.push_back(t);
    }
  }
  return list;
}

TEST(ProbeHealth, RadiusAndPreTravelLieInsideWhatIsStated) {
  // Touches of one side tell radius and centre together: the noise of one over the root of their number was a sixth of
  // what it scattered. The centre also takes what looks like a shift from the pre-travels.
  const MachineDescription m = machineFrom(ballMachineText());
  std::vector<Eigen::Vector3d> cap{{0, 0, -1}};
  for (int k = 0; k < 4; ++k)
    cap.emplace_back(Eigen::Vector3d(std::cos(k * M_PI_2), std::sin(k * M_PI_2), -1.0).normalized());
  std::vector<Eigen::Vector3d> half = cap;
  for (int k = 0; k < 8; ++k) half.emplace_back(std::cos(k * M_PI_4), std::sin(k * M_PI_4), 0.0);
  Random random(23);
  for (const auto& sides : {cap, half}) {
    int radius_inside = 0;
    int lobes_inside = 0;
    int lobes_told = 0;
    constexpr int runs = 100;
    for (int run = 0; run < runs; ++run) {
      std::vector<double> none(sides.size(), 0.0);
      const StylusHealth plain = checkProbeHealth(touchesFrom(m, sides, 4, 0.5, none, random), m).front();
      const double error_mm = plain.effective_radius_mm - m.styli.front().radius_mm;
      radius_inside += std::abs(error_mm) <= 2.0 * plain.effective_radius_sigma_mm ? 1 : 0;
      std::vector<double> lobes;
      for (std::size_t k = 0; k < sides.size(); ++k) lobes.push_back(random.normal(0.0, 1.0));
      const double mean = std::accumulate(lobes.begin(), lobes.end(), 0.0) / static_cast<double>(lobes.size());
      const StylusHealth lobed = checkProbeHealth(touchesFrom(m, sides, 4, 0.2, lobes, random), m).front();
      ASSERT_EQ(lobed.directions.size(), sides.size());
      for (std::size_t k = 0; k < sides.size(); ++k) {
        const PreTravel& p = lobed.directions[k];
        if (!std::isfinite(p.standard_uncertainty_um)) continue;
        ++lobes_told;
        lobes_inside += std::abs(p.pre_travel_um - (lobes[k] - mean)) <= 2.0 * p.standard_uncertainty_um ? 1 : 0;
      }
    }
    // Of Student's distribution with the six degrees of freedom that the cap leaves, 91 of 100 (one in a hundred: 84).
    EXPECT_GE(radius_inside, 84) << sides.size();
    EXPECT_LE(radius_inside, 99) << sides.size();
    if (sides.size() == cap.size()) {
      EXPECT_EQ(lobes_told, 0) << "five sides about a centre and a radius leave one";
    } else {
      EXPECT_EQ(lobes_told, runs * static_cast<int>(sides.size()));
      EXPECT_GE(lobes_inside, static_cast<int>(0.88 * lobes_told));
    }
  }
}

TEST(ProbeHealth, NothingThatRepeatsIsNoSoundStylus) {
  const MachineDescription m = machineFrom(ballMachineText());
  const std::vector<Eigen::Vector3d> sides{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, -1}};
  Random random(5);
  const StylusHealth health =
      checkProbeHealth(touchesFrom(m, sides, 1, 3.0, std::vector<double>(5, 0.0), random), m).front();
  EXPECT_EQ(health.status, FitStatus::Converged);
  EXPECT_FALSE(health.healthy);
  EXPECT_FALSE(health.loose);
  EXPECT_TRUE(std::isnan(health.repeatability_um));
  EXPECT_NE(health.message.find("no touch repeats another"), std::string::npos) << health.message;
  ProbeHealthOptions bad;
  bad.healthy_sigma_um = 0.0;
  EXPECT_THROW(static_cast<void>(checkProbeHealth(TouchList{}, m, bad)), InputError);
}

TEST(ProbeHealth, LobesRepeatabilityAndALooseStylus) {
  const MachineDescription m = machineFrom(ballMachineText());
  VirtualProbeOptions options;
  options.noise_um = 0.3;
  options.pre_travel_um = 6.0;
  options.pre_travel_lobing_um = 2.0;
  const auto still = [](int, Random&) { return std::vector<double>(12, 0.0); };
  VirtualRun run = runCycles(m, 12, options, 5, still);
  std::vector<StylusHealth> health = checkProbeHealth(run.list, m);
  ASSERT_EQ(health.size(), 12U);
  for (const StylusHealth& h : health) {
    ASSERT_EQ(h.status, FitStatus::Converged) << h.message;
    EXPECT_TRUE(h.healthy) << h.message;
    EXPECT_LT(h.repeatability_um, 0.6);
  }
  Random random(9);
  for (Touch& t : run.list.touches) {
    if (t.stylus == "p1" && std::abs(t.approach.x()) > 0.5) t.position_mm.x() += random.normal(0.0, 0.02);
  }
  health = checkProbeHealth(run.list, m);
  for (const StylusHealth& h : health) EXPECT_EQ(h.loose, h.stylus == "p1") << h.message;
}

TEST(CycleStudies, RepeatabilityFollowsTheTouchNoiseAndIgnoresDrift) {
  const MachineDescription m = machineFrom(holeMachineText());
  const VirtualRun run = runCycles(m, 100, {}, 12, [](int k, Random&) {
    std::vector<double> p(9, 0.0);
    for (double& v : p) v = 0.2 * k;  // a slow drift far above the noise
    return p;
  });
  const HoleCycleResult result = evaluateHoleCycles(run.list, m, m.artefacts.front());
  const RepeatabilityStudy study = studyRepeatability(result);
  ASSERT_EQ(study.status, FitStatus::Converged) << study.message;
  for (const Repeatability& r : study.parameters) EXPECT_NEAR(r.repeatability / r.expected, 1.0, 0.3) << r.name;
}

TEST(CycleStudies, SensorsFallIntoThreeGroups) {
  OperatingLog log({0.0, 100.0, 200.0});
  const std::vector<std::pair<std::string, double>> changes{
      {"T_head_degC", 9.0},    {"T_up1_degC", 8.2}, {"T_flange_degC", 8.6}, {"T_column1_degC", 3.1},
      {"T_column2_degC", 2.8}, {"T_x_degC", 0.3},   {"T_room_degC", 0.2}};
  for (const auto& [name, change] : changes) log.setSignal(name, {20.0, 20.0 + 0.7 * change, 20.0 + change});
  const std::vector<SensorGroup> groups = groupSensors(log);
  ASSERT_EQ(groups.size(), 3U);
  EXPECT_EQ(groups[0].sensors.size(), 3U);
  EXPECT_EQ(groups[1].sensors.size(), 2U);
  EXPECT_EQ(groups[2].label, "little");
}

}  // namespace
}  // namespace spindrift
