// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/reporting/discrepancy_report.h"

#include "core/discrepancy/percent_text.h"
#include "core/reporting/discrepancy_figures.h"

#include <gmock/gmock.h>

#include <cmath>

namespace spindrift {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// Four points, three moments in which each is read at its own time; EY grows along X and with time, a tenth of it is
/// left by the model; EX is zero.
DiscrepancyReportData data() {
  DiscrepancyReportData d;
  d.verdict = DiscrepancyVerdict::Named;
  d.message = "Missing in the simulation: ball_screw.expansion.y.";
  for (int moment = 0; moment < 3; ++moment)
    for (int p = 0; p < 4; ++p)
      for (const Component c : {Component::EX, Component::EY}) {
        const double x = 100.0 * (p % 2), y = 80.0 * (p / 2);
        const double before = c == Component::EY ? 0.05 * x * moment : 0.0;
        d.rows.push_back({3600.0 * moment + 60.0 * p,
                          "F" + std::to_string(p + 1),
                          c,
                          {x, y, 10.0},
                          0.2,
                          before,
                          0.1 * before,
                          moment == 2,
                          2.0 * before + 7.0});
      }
  FoundEffect effect;
  effect.id = "ball_screw.expansion.y";
  effect.forced = true;
  d.effects = {effect};
  d.gap.rms_after_um = std::nan("");
  return d;
}

TEST(DiscrepancyReport, MapsAreOfTheWorstMomentBeforeAndAfter) {
  const auto found = discrepancyMaps(data().rows, {0, 100, 0, 80, 0, 11, 9});
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->time_s, 7200.0);
  EXPECT_FALSE(found->c_deg.has_value()) << "there is one angle";
  const auto* maps = &found->fields;
  EXPECT_EQ((*maps)[0].component, Component::EY);
  EXPECT_EQ((*maps)[0].grid.z_mm, 10.0);
  ASSERT_EQ((*maps)[0].markers.size(), 4U);
  EXPECT_FALSE((*maps)[0].markers[0].used) << "held out";
  for (int ix = 0; ix < 11; ++ix) {
    const std::size_t n = (*maps)[0].grid.index(ix, 4);
    EXPECT_NEAR((*maps)[0].value[n], 10.0 * ix / 10.0, 2.0 * (*maps)[0].sigma[n] + 1e-9);
    EXPECT_NEAR((*maps)[1].value[n], 1.0 * ix / 10.0, 2.0 * (*maps)[1].sigma[n] + 1e-9);
  }
  // Along a line there is no map, and that is no failure.
  DiscrepancyReportData line = data();
  for (DiscrepancyReportRow& row : line.rows) row.position_mm.y() = 0.0;
  EXPECT_FALSE(discrepancyMaps(line.rows, {0, 100, 0, 80, 0, 11, 9}).has_value());
}

TEST(DiscrepancyReport, MapsAreOfOneAngleOfTheTable) {
  DiscrepancyReportData d = data();
  std::vector<DiscrepancyReportRow> turned = d.rows;
  for (DiscrepancyReportRow& row : turned) {
    row.c_deg = 90.0;
    row.position_mm = {-row.position_mm.y(), row.position_mm.x(), row.position_mm.z()};
    row.before *= 2.0;
  }
  d.rows.insert(d.rows.end(), turned.begin(), turned.end());
  const auto maps = discrepancyMaps(d.rows, {-80, 100, 0, 100, 0, 11, 9});
  ASSERT_TRUE(maps.has_value());
  EXPECT_EQ(maps->c_deg, 90.0) << "where most is left";
  ASSERT_EQ(maps->fields[0].markers.size(), 4U);
  for (const Field::Marker& point : maps->fields[0].markers) EXPECT_LE(point.position_mm.x(), 0.0);
  EXPECT_THAT(htmlOf(discrepancyDocument("c", d, FieldGrid{-80, 100, 0, 100, 0, 11, 9})), HasSubstr("table at 90°"));
}

TEST(DiscrepancyReport, SaysWhatWasAddedAndWhatIsProposed) {
  DiscrepancyReportData d = data();
  EXPECT_THAT(htmlOf(discrepancyDocument("c", d, std::nullopt)), Not(HasSubstr("(added to the model)")));
  d.user_adds = true;
  const std::string html = htmlOf(discrepancyDocument("c", d, FieldGrid{0, 100, 0, 80, 0, 11, 9}));
  EXPECT_THAT(
      html,
      HasSubstr("Thermal expansion of the Y ball screw <small>ball_screw.expansion.y</small> (added to the model)"));
  // F2 moves by 0, 5 and 10; the last is held out and is no part of the figures, as in the window.
  EXPECT_THAT(html, HasSubstr("3.54 \u2192 0.35"));
  EXPECT_THAT(html, HasSubstr("EY before"));
  EXPECT_THAT(html, HasSubstr("EY after"));
  EXPECT_THAT(html, HasSubstr("Missing in the simulation: thermal expansion of the Y ball screw <small>"));
  EXPECT_THAT(html, Not(HasSubstr(" um")));
  EXPECT_THAT(html, Not(HasSubstr("nan")));
}

TEST(DiscrepancyReport, GapSaysPeakToPeakAndFitOfFittedAndHeldOutRows) {
  const GapFigures fitted = gapFigures(data().rows, false);
  EXPECT_FALSE(fitted.rotations);
  EXPECT_NEAR(fitted.p2p_before, 5.0, 1e-9) << "F2 and F4 move by 0 and 5";
  EXPECT_NEAR(fitted.p2p_after, 0.5, 1e-9);
  // Residuals 0 and 5, measured 7 and 17: about its mean -5 and 5.
  EXPECT_NEAR(fitted.fit_before_percent, 100.0 * (1.0 - std::sqrt(25.0 / 50.0)), 1e-9);
  EXPECT_NEAR(fitted.fit_after_percent, 100.0 * (1.0 - 0.1 * std::sqrt(25.0 / 50.0)), 1e-9);
  // One moment is held out: nothing moves in it.
  const GapFigures held_out = gapFigures(data().rows, true);
  EXPECT_EQ(held_out.p2p_before, 0.0);
  EXPECT_TRUE(std::isnan(held_out.fit_before_percent));
  std::vector<DiscrepancyReportRow> none_held_out = data().rows;
  for (DiscrepancyReportRow& row : none_held_out) row.held_out = false;
  EXPECT_FALSE(gapFigures(none_held_out, true).rotations) << "in the unit of the rows that there are";
  const std::string html = htmlOf(discrepancyDocument("c", data(), std::nullopt));
  EXPECT_THAT(html, HasSubstr("largest peak-to-peak of one series, rows fitted"));
  EXPECT_THAT(html, HasSubstr("fit, rows fitted"));
  EXPECT_THAT(html, HasSubstr("largest peak-to-peak of one series, rows held out"));
}

TEST(DiscrepancyReport, WithoutHeldOutRowsTheFiguresAreOfBlocksLeftOut) {
  DiscrepancyReportData d = data();
  for (DiscrepancyReportRow& row : d.rows) row.held_out = false;
  const std::string html = htmlOf(discrepancyDocument("c", d, std::nullopt));
  EXPECT_THAT(html, HasSubstr("rms of blocks of rows left out in turn"));
  EXPECT_THAT(html, HasSubstr("rms on blocks left out in turn"));
  EXPECT_THAT(html, Not(HasSubstr("rows held out")));
}

TEST(DiscrepancyReport, WhatWasAddedAndTakenOutAgainIsNotSaidToBeIn) {
  DiscrepancyReportData d = data();
  d.steps = {{"ball_screw.expansion.y", true, 50.0, 60.0, "gains"}, {"spindle.drift.x", true, 25.0, 30.0, "gains"}};
  EXPECT_FALSE(takenOutAgain(d.steps[0], d.effects));
  EXPECT_TRUE(takenOutAgain(d.steps[1], d.effects));
  EXPECT_THAT(htmlOf(discrepancyDocument("c", d, std::nullopt)), HasSubstr("added, then taken out again"));
  d.verdict = DiscrepancyVerdict::Unknown;
  d.effects.clear();
  EXPECT_THAT(htmlOf(discrepancyDocument("c", d, std::nullopt)), HasSubstr("with it too something remains"));
}

TEST(DiscrepancyReport, TellsCandidatesNoiseShiftsOutliersAndRemainder) {
  DiscrepancyReportData d = data();
  d.effects[0].rivals = {"spindle.drift.y"};
  d.effects[0].confidence = 0.93;
  d.candidates = {{"ball_screw.expansion.y", 0.71}, {"spindle.drift.y", 0.26}, {"head.tilt.a", 0.001}};
  d.noise = {{Component::EX, 1.32, 0.05, 0.0, 0.0, 0.0}, {Component::EY, 0.87, 0.04, 0.8, 0.4, 7200.0}};
  d.shifts = {{"M0", Component::EY, 0.0, -0.52, 0.21}, {"M1", Component::EY, 3600.0, 1.13, 0.21}};
  d.outliers = {{7, 3660.0, "M1", "F2", Component::EY, 14.2, -6.3}};
  d.remainder = {{Component::EX, 0.04, 1.5}, {Component::EY, 0.8, 41.0}};
  d.leftover = "0.80 µm rms in EY that no effect of the catalogue explains";
  d.tail_dof = 4.0;
  d.clock_offset_s = -312.0;
  d.clock_offset_uncertainty_s = 40.0;
  for (DiscrepancyReportRow& row : d.rows) row.remaining = row.component == Component::EY ? 0.8 : 0.0;
  const std::string html = htmlOf(discrepancyDocument("c", d, std::nullopt));
  EXPECT_THAT(html, HasSubstr(">93 %<")) << "the one number of what is named";
  EXPECT_THAT(html, Not(HasSubstr("71 %")));
  EXPECT_THAT(html, HasSubstr("26 %"));
  EXPECT_THAT(html, HasSubstr("&lt; 1 %"));
  EXPECT_THAT(html, HasSubstr("rival of what is named"));
  EXPECT_THAT(html, HasSubstr("What was taken as noise"));
  EXPECT_THAT(html, HasSubstr("Student t with 4 degrees of freedom"));
  EXPECT_THAT(html, HasSubstr("behind that of the observations"));
  EXPECT_THAT(html, HasSubstr("Common shift of every state"));
  EXPECT_THAT(html, HasSubstr("Outlying readings"));
  EXPECT_THAT(html, HasSubstr("What remains in EY at all points over time, beside what the effects explain"));
  EXPECT_THAT(html, Not(HasSubstr("What remains in EX"))) << "it may be noise";
  EXPECT_THAT(html, HasSubstr("Remainder: 0.80"));
  EXPECT_THAT(html, Not(HasSubstr("nan")));
  // Nothing of it is said where nothing of it is known.
  EXPECT_THAT(htmlOf(discrepancyDocument("c", data(), std::nullopt)), Not(HasSubstr("What was taken as noise")));
}

// The text above and the table below speak of the same effect: one number, written in one way.
TEST(DiscrepancyReport, OneNumberSaysHowSureTheNameIs) {
  DiscrepancyReportData d = data();
  ASSERT_FALSE(d.effects.empty());
  d.effects[0].confidence = 0.98;
  d.candidates = {{d.effects[0].id, 0.9999}, {"head.tilt.a", 0.3}};
  EXPECT_EQ(statedProbability(d.candidates[0], d.effects), 0.98);
  EXPECT_EQ(statedProbability(d.candidates[1], d.effects), 0.3);
  const std::string html = htmlOf(discrepancyDocument("c", d, std::nullopt));
  EXPECT_THAT(html, HasSubstr("Probability that the name is right: 98 %."));
  EXPECT_THAT(html, HasSubstr(">98 %<"));
  EXPECT_THAT(html, HasSubstr("30 %"));
  EXPECT_THAT(html, Not(HasSubstr("99 %")));
  EXPECT_THAT(html, Not(HasSubstr("0.98")));
}

TEST(DiscrepancyReport, ProbabilitiesInPercentNeverSayCertain) {
  EXPECT_EQ(percentText(0.714), "71 %");
  EXPECT_EQ(percentText(0.001), "< 1 %");
  EXPECT_EQ(percentText(1.0), "> 99 %");
}

TEST(DiscrepancyReport, ACandidateIsNamedBeforeItIsARival) {
  FoundEffect first;
  first.id = "head.tilt.a";
  first.rivals = {"spindle.drift.y"};
  first.containers = {"ambient.drift.y"};
  FoundEffect second;
  second.id = "spindle.drift.y";
  EXPECT_EQ(candidateRole("spindle.drift.y", {first, second}), CandidateRole::Named);
  EXPECT_EQ(candidateRole("spindle.drift.y", {first}), CandidateRole::Rival);
  EXPECT_EQ(candidateRole("ambient.drift.y", {first}), CandidateRole::Container);
  EXPECT_EQ(candidateRole("backlash.y", {first}), CandidateRole::None);
}

TEST(DiscrepancyReport, TheProbabilityOfARivalIsThatOfTheWholeSet) {
  DiscrepancyReportData d = data();
  EXPECT_THAT(htmlOf(discrepancyDocument("c", d, std::nullopt)), HasSubstr("Probability that the name is right"));
  d.effects[0].rivals = {"spindle.drift.y"};
  EXPECT_THAT(htmlOf(discrepancyDocument("c", d, std::nullopt)),
              HasSubstr("Probability that it or one of its rivals is right"));
}

}  // namespace
}  // namespace spindrift
