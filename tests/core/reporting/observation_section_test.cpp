// SPDX-License-Identifier: GPL-3.0-or-later
// Observations in a report: few moments as a map with a table, many as a small plot for each point.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "core/reporting/plot_picture.h"
#include "core/reporting/point_map.h"
#include "core/reporting/report_parts.h"

namespace spindrift {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

/// F1 ... F4 on a square; each moment adds 2 um in EX, -1 um in EY, 3 um in EZ.
ObservationSet observations(int moments) {
  ObservationSet set;
  for (int m = 0; m < moments; ++m)
    for (int p = 0; p < 4; ++p)
      for (const Component c : {Component::EX, Component::EY, Component::EZ}) {
        Observation o;
        o.time_s = 3600.0 * m;
        o.state = "M" + std::to_string(m);
        o.point = "F" + std::to_string(p + 1);
        o.position_mm = {100.0 * (p % 2), 80.0 * (p / 2), 0.0};
        o.component = c;
        o.sigma = 0.3;
        o.value = 5.0 + m * (c == Component::EX ? 2.0 : c == Component::EY ? -1.0 : 3.0);
        set.rows.push_back(o);
      }
  return set;
}

std::string html(const ObservationSet& set) {
  Report document("t", "s");
  addObservations(document, set);
  return htmlOf(document);
}

TEST(ObservationSection, TwoStatesAreArrowsOverTheTableAndATable) {
  const std::string text = html(observations(2));
  EXPECT_THAT(text, HasSubstr("Displacement in state M1"));
  EXPECT_THAT(text, HasSubstr("times as long")) << "the exaggeration stands beside the arrows";
  EXPECT_THAT(text, HasSubstr("F3: 3.0 ± 0.4")) << "EZ, with the uncertainty of a difference";
  EXPECT_THAT(text, HasSubstr("<td>−1.0 ± 0.4</td>"));
  EXPECT_EQ(count(text, "<circle"), 4U) << "one disc a point";
  EXPECT_THAT(text, Not(HasSubstr("over time")));
}

TEST(ObservationSection, SeveralReadingsOfAStateAreOneChange) {
  // The table showed the last one, the summary the largest.
  ObservationSet set = observations(2);
  for (const Observation& o : observations(2).rows) {
    if (o.state != "M1") continue;
    set.rows.push_back(o);
    set.rows.back().time_s += 60.0;
    set.rows.back().value += 8.0;
  }
  const std::string text = html(set);
  // EY: -1 and 7 um; the uncertainty of a mean of two against one: 0.3 sqrt(1/2 + 1).
  EXPECT_THAT(text, HasSubstr("<td>3.0 ± 0.4</td>"));
  EXPECT_THAT(text, Not(HasSubstr("<td>10.0 ± 0.4</td>")));
  EXPECT_THAT(text, Not(HasSubstr("<td>−1.0 ± 0.4</td>")));
  for (const LargestChange& c : largestChanges(set)) {
    EXPECT_NEAR(c.sigma, 0.3 * std::sqrt(1.5), 1e-9);
    if (c.component == Component::EZ) {
      EXPECT_NEAR(c.value, 7.0, 1e-9);
    }
  }
}

TEST(ObservationSection, CountsWhatIsUsed) {
  ObservationSet set = observations(6);
  for (Observation& o : set.rows)
    if (o.point == "F2" || o.state == "M3") o.use = ObservationUse::Exclude;
  const std::string text = html(set);
  EXPECT_THAT(text, HasSubstr("45 observations of 3 points in 5 states"));
  EXPECT_THAT(text, HasSubstr("Excluded, and shown nowhere: 27 of 72 observations."));
  EXPECT_THAT(text, HasSubstr("Displacement of each point from its first reading"));
}

TEST(ObservationSection, AReversalErrorIsNoChange) {
  ObservationSet both;
  for (const double side : {1.0, -1.0}) {
    for (Observation o : observations(2).rows) {
      o.approach = {side, side, side};
      o.value += 6.0 * side;
      both.rows.push_back(o);
    }
  }
  const std::string text = html(both);
  EXPECT_THAT(text, HasSubstr("F3: 3.0 ± 0.3")) << "the mean of both sides";
  EXPECT_THAT(text, Not(HasSubstr("<td>−9.0")));
  EXPECT_THAT(text, Not(HasSubstr("<td>−13.0")));
}

TEST(ObservationSection, EveryAngleOfTheTableHasAMapOfItsOwn) {
  // F1 and F2 at 0 and at 90 degrees, F3 and F4 at 90 degrees only; F1 moves otherwise there.
  ObservationSet set = observations(2);
  const std::size_t all = set.rows.size();
  for (std::size_t i = 0; i < all; ++i) {
    if (set.rows[i].point == "F3" || set.rows[i].point == "F4") {
      set.rows[i].c_deg = 90.0;
      continue;
    }
    Observation turned = set.rows[i];
    turned.c_deg = 90.0;
    if (turned.state == "M1") turned.value += 40.0;
    set.rows.push_back(turned);
  }
  const std::string text = html(set);
  EXPECT_EQ(count(text, "<figure>"), 2U);
  EXPECT_THAT(text, HasSubstr("Displacement in state M1, table at 0°"));
  EXPECT_THAT(text, HasSubstr("Displacement in state M1, table at 90°"));
  EXPECT_EQ(count(text, "<circle"), 2U + 4U) << "each of the points of its angle";
  EXPECT_THAT(text, HasSubstr("F1, C 0°: 3.0 ± 0.4"));
  EXPECT_THAT(text, HasSubstr("F1, C 90°: 43.0 ± 0.4")) << "changed from its reading at the same angle";
  EXPECT_THAT(text, HasSubstr("F3: 3.0 ± 0.4")) << "one angle needs no name";
}

TEST(ObservationSection, ArrowsEndInsideTheFrameOfTheMap) {
  // The longest arrow, with its bars, points out of the map in every direction in turn.
  for (const Eigen::Vector2d& out : {Eigen::Vector2d(1, 0), Eigen::Vector2d(-1, 0), Eigen::Vector2d(0, 1),
                                     Eigen::Vector2d(0, -1), Eigen::Vector2d(1, 1), Eigen::Vector2d(-1, -1)}) {
    std::vector<PointDisplacement> points;
    for (int p = 0; p < 4; ++p)
      points.push_back({"F" + std::to_string(p + 1),
                        {100.0 * (p % 2), 100.0 * (p / 2), 0.0},
                        {10.0 * out.x(), 10.0 * out.y(), 1.0},
                        {2.0, 2.0, 0.3}});
    const std::optional<Drawing> drawing = pointMap(points, {.title = "t", .subtitle = "s"});
    ASSERT_TRUE(drawing.has_value());
    // The frame is drawn first, in grey: its lines bound what is drawn in grey and ink, width 2 and 1, after it.
    double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
    std::size_t frame = 0;
    const auto& shapes = drawing->shapes();
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      const auto* path = std::get_if<Drawing::Path>(&shapes[i]);
      if (path == nullptr || frame == 4 || path->paint.stroke != PictureColour{120, 130, 140}) continue;
      for (const auto& stroke : path->strokes)
        for (const auto& [x, y] : stroke) {
          left = std::min(left, x), right = std::max(right, x);
          top = std::min(top, y), bottom = std::max(bottom, y);
        }
      ++frame;
    }
    ASSERT_EQ(frame, 4U);
    std::size_t strokes = 0;
    for (const auto& shape : shapes) {
      const auto* path = std::get_if<Drawing::Path>(&shape);
      if (path == nullptr) continue;
      for (const auto& stroke : path->strokes)
        for (const auto& [x, y] : stroke) {
          // Ticks of the colour bar stand at the right, the scale of the arrows below.
          if (x > right + 20.0 || y > bottom + 20.0) continue;
          ++strokes;
          EXPECT_GE(x, left - 0.01);
          EXPECT_LE(x, right + 0.01);
          EXPECT_GE(y, top - 0.01);
          EXPECT_LE(y, bottom + 0.01);
        }
    }
    EXPECT_GT(strokes, 40U);
  }
}

TEST(ObservationSection, StatesStandInTheOrderOfTime) {
  ObservationSet set = observations(3);
  for (Observation& o : set.rows) o.state = o.state == "M0" ? "M8" : o.state == "M1" ? "M9" : "M10";
  const std::string text = html(set);
  EXPECT_LT(text.find("Displacement in state M9"), text.find("Displacement in state M10"));
  EXPECT_LT(text.find("<td class=\"text\">M9</td>"), text.find("<td class=\"text\">M10</td>"));
  EXPECT_NE(text.find("<td class=\"text\">M10</td>"), std::string::npos);
}

TEST(ObservationSection, ManyStatesAreOnePlotAPointInTheColoursOfTheAxes) {
  const std::string text = html(observations(6));
  EXPECT_EQ(count(text, "<figure>"), 1U);
  EXPECT_EQ(count(text, "change / µm"), 4U) << "one plot a point";
  EXPECT_EQ(count(text, "stroke-width=\"1.4\""), 12U) << "a line for each component";
  for (int axis = 0; axis < 3; ++axis) EXPECT_THAT(text, HasSubstr(axisLook(axis).colour));
  EXPECT_THAT(text, HasSubstr("bands: two standard uncertainties"));
}

TEST(ObservationSection, CommonCovarianceLeavesTheDifference) {
  ObservationSet set = observations(2);
  // Rows 0 and 12: EX of F1 in M0 and M1.
  set.setCovariances({{0, 12, 0.05}});
  const auto largest = largestChanges(set);
  ASSERT_EQ(largest.size(), 3U);
  EXPECT_EQ(largest[0].component, Component::EX);
  EXPECT_EQ(largest[0].point, "F1");
  EXPECT_DOUBLE_EQ(largest[0].value, 2.0);
  EXPECT_NEAR(largest[0].sigma, std::sqrt(0.18 - 0.10), 1e-12);
}

TEST(ObservationSection, NothingIsDrawnOfNothing) {
  EXPECT_THAT(html({}), Not(HasSubstr("Observations")));
  EXPECT_THAT(html(observations(1)), HasSubstr("there is no change to show"));
  ObservationSet excluded = observations(2);
  for (Observation& o : excluded.rows) o.use = ObservationUse::Exclude;
  EXPECT_TRUE(largestChanges(excluded).empty());
}

TEST(InstrumentSection, ExplainsItsParametersAndTellsTheReference) {
  InstrumentEvaluation probe;
  probe.instrument = "touch_probe";
  for (int k = 0; k < 5; ++k)
    probe.details["cycles"].push_back(
        {{"cycle", "C" + std::to_string(k)},
         {"time_s", 3600.0 * k},
         {"parameters",
          {{"EC0C_urad", {{"value", 1.5 * k}, {"standard_uncertainty", k == 0 ? 0.0 : 0.2}}},
           {"EX0C_um", {{"value", -0.5 * k}, {"standard_uncertainty", k == 0 ? 0.0 : 0.1}}}}}});
  Report document("t", "s");
  addInstrument(document, probe);
  const std::string text = htmlOf(document);
  EXPECT_THAT(text, HasSubstr("Measured with: Touch probe"));
  EXPECT_THAT(text, HasSubstr("rotation of the table about Z"));
  EXPECT_EQ(count(text, "0 (reference)"), 2U);
  EXPECT_THAT(text, HasSubstr("6.00 ± 0.20"));
  EXPECT_THAT(text, HasSubstr("No capture was rejected."));
  EXPECT_EQ(count(text, "<figure>"), 1U) << "all trends in one figure";
}

// Artefacts at different places err differently: over one another their bars hide each other.
TEST(InstrumentSection, EveryArtefactHasAPanelOfItsOwnOnTheSameAxes) {
  InstrumentEvaluation profiler;
  profiler.instrument = "profiler";
  for (int k = 0; k < 4; ++k)
    for (int a = 1; a < 4; ++a)
      profiler.details["cycles"].push_back(
          {{"cycle", "C" + std::to_string(k)},
           {"artefact", "A" + std::to_string(a)},
           {"time_s", 3600.0 * k},
           {"parameters",
            {{"EXY_um", {{"value", 10.0 * a * k}, {"standard_uncertainty", k == 0 ? 0.0 : 1.0}}},
             {"EYY_um", {{"value", -1.0 * k}, {"standard_uncertainty", k == 0 ? 0.0 : 1.0}}}}}});
  Report document("t", "s");
  addInstrument(document, profiler);
  const std::string text = htmlOf(document);
  EXPECT_EQ(count(text, "<figure>"), 1U);
  EXPECT_THAT(text, HasSubstr("each artefact by itself"));
  const std::string figure = text.substr(text.find("<figure>"), text.find("</figure>") - text.find("<figure>"));
  for (const char* artefact : {">A1<", ">A2<", ">A3<"}) EXPECT_EQ(count(figure, artefact), 2U) << artefact;
  // The largest value of EXY is 90 um at A3: the scale of A1 reaches as far.
  EXPECT_EQ(count(figure, ">EXY / µm<"), 3U);
  EXPECT_GE(count(figure, ">80<") + count(figure, ">50<"), 3U);
}

TEST(InstrumentSection, LongSeriesAreThinnedInTheTableAndItSaysSo) {
  InstrumentEvaluation probe;
  probe.instrument = "touch_probe";
  for (int k = 0; k < 200; ++k)
    probe.details["cycles"].push_back({{"cycle", "C" + std::to_string(k)},
                                       {"time_s", 3600.0 * k},
                                       {"parameters", {{"EX0C_um", {{"value", k}, {"standard_uncertainty", 0.1}}}}}});
  Report document("t", "s");
  addInstrument(document, probe);
  EXPECT_THAT(htmlOf(document), HasSubstr("40 of 200 cycles"));
  EXPECT_EQ(count(htmlOf(document), "<tr>"), 1U + 40U + 1U + 1U) << "cycles, meanings and their headers";
}

TEST(InstrumentSection, ClosedFormsAndCertificateStandBesideTheJointEvaluation) {
  InstrumentEvaluation probe;
  probe.instrument = "touch_probe";
  const auto quantity = [](double value, double sigma) {
    return nlohmann::json{{"value", value}, {"standard_uncertainty", sigma}};
  };
  probe.details["artefacts"].push_back({{"closed_forms",
                                         {{{"cycle", "M1"}, {"ball", "B1"}, {"head_rotation_urad", {1.0, 2.0, 3.0}}},
                                          {{"cycle", "M2"},
                                           {"ball", "B2"},
                                           {"head_rotation_urad", {81.4, -15.0, 30.0}},
                                           {"joint_head_rotation_urad", {20.0, -15.0, 30.0}},
                                           {"joint_standard_uncertainty_urad", {0.5, 0.5, 0.5}},
                                           {"spindle_drift_um", 13.75}}}}});
  probe.details["artefacts"].push_back(
      {{"against_certificate",
        {{{"cycle", "M1"},
          {"temperature_degC", 23.5},
          {"slope_um_per_m", quantity(15.2, 3.8)},
          {"chi2", 4.2},
          {"degrees_of_freedom", 5}}}},
       {"growth_expected",
        {{{"cycle", "M1"}, {"expected_um_per_m", quantity(34.5, 1.6)}, {"measured_um_per_m", quantity(33.1, 0.8)}}}},
       {"growth_combined", true}});
  Report document("t", "s");
  addInstrument(document, probe);
  const std::string text = htmlOf(document);
  EXPECT_THAT(text, HasSubstr("Head rotation in M2"));
  EXPECT_THAT(text, HasSubstr("81.4, −15.0, 30.0"));
  EXPECT_THAT(text, HasSubstr("20.0 ± 0.5"));
  EXPECT_THAT(text, HasSubstr("13.75"));
  EXPECT_THAT(text, HasSubstr("15 ± 4"));
  EXPECT_THAT(text, HasSubstr("34.5 ± 1.6"));
  EXPECT_THAT(text, HasSubstr("EME combines both"));
  EXPECT_EQ(count(text, "81.4"), 1U) << "the last cycle only";
}

TEST(InstrumentSection, AlgebraicCirclesStandBesideTheJointCentre) {
  InstrumentEvaluation microscope;
  microscope.instrument = "microscope";
  microscope.details["camera"] = {{"pixel_length_um", 2.0}};
  microscope.details["fiducials"].push_back({{"fiducial", "F1"},
                                             {"states",
                                              {{{"state", "M0"},
                                                {"centre_of_rotation",
                                                 {{"x_px", {{"value", 400.0}, {"standard_uncertainty", 0.5}}},
                                                  {"y_px", {{"value", 300.0}, {"standard_uncertainty", 0.5}}},
                                                  {"algebraic_px", {396.5, 301.25}},
                                                  {"algebraic_tracks", 9}}}},
                                               {{"state", "M1"}, {"centre_of_rotation", nullptr}}}}});
  Report document("t", "s");
  addInstrument(document, microscope);
  const std::string text = htmlOf(document);
  EXPECT_THAT(text, HasSubstr("algebraic circles"));
  EXPECT_THAT(text, HasSubstr("400.00 ± 0.50"));
  EXPECT_THAT(text, HasSubstr("-7.0"));
  EXPECT_THAT(text, HasSubstr("+2.5"));
}

TEST(OperatingConditions, EverySignalHasALaneAndDisplacementsTheColourOfTheirAxis) {
  OperatingLog log(std::vector<double>{0.0, 3600.0, 7200.0});
  log.setSignal("spindle_rpm", {0.0, 6000.0, 6000.0});
  log.setSignal("feed_x_mm_min", {0.0, 0.0, 12000.0});
  log.setSignal("coolant", {0.0, 0.0, 0.0});
  log.setSignal("T_room_degC", {20.0, 20.5, 21.0});
  log.setSignal("Z_um", {0.0, 5.0, 9.0});
  Report document("t", "s");
  addOperatingConditions(document, log);
  const std::string text = htmlOf(document);
  EXPECT_THAT(text, HasSubstr("spindle speed, up to 6000 rpm"));
  EXPECT_THAT(text, HasSubstr("feed X, up to 12000 mm/min"));
  EXPECT_THAT(text, Not(HasSubstr("coolant"))) << "never on";
  EXPECT_THAT(text, HasSubstr("temperature / °C"));
  EXPECT_THAT(text, HasSubstr("displacement / µm"));
  EXPECT_THAT(text, HasSubstr(axisLook(2).colour));
}

}  // namespace
}  // namespace spindrift
