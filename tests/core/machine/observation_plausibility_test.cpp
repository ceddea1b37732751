// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/machine/observation_plausibility.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "core/base/error.h"

namespace spindrift {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* header = "time_s,state,point,x_mm,y_mm,z_mm,c_deg,component,value,sigma,instrument,use\n";

/// Three fiducials 90 mm apart, deviations of some micrometres. `swapped`: state in which F1 and F2 have each other's
/// label. Every point comes three times a state.
std::string campaignText(int states, const std::string& swapped, const std::string& use = "fit") {
  std::string text = header;
  int time = 0;
  for (int k = 0; k < states; ++k) {
    const std::string state = fmt::format("M{}", k);
    for (const std::string point : {"F1", "F2", "F3"}) {
      const double x = point == "F1" ? 10.0 : point == "F2" ? 100.0 : 50.0;
      const double y = point == "F3" ? 80.0 : 20.0;
      double ex = 3.0 * k;
      if (state == swapped && point == "F1") ex -= 90000.0;
      if (state == swapped && point == "F2") ex += 90000.0;
      // What counts from a swapped reference has its error everywhere else.
      for (const auto& [component, value] : {std::pair{"EX", ex}, {"EY", -2.0 * k}, {"EZ", 1.0 * k}})
        text += fmt::format("{},{},{},{},{},0,0,{},{},0.5,microscope,{}\n", time, state, point, x, y, component, value,
                            state == swapped ? use : "fit");
      time += 60;
    }
  }
  return text;
}

std::string complaintOf(const std::string& text) {
  try {
    (void)ObservationSet::parse(text, "observations.csv");
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}

TEST(ObservationPlausibility, SwappedLabelsAreNamedWithTheirStateAndLine) {
  const std::string complaint = complaintOf(campaignText(4, "M2"));
  EXPECT_THAT(complaint, HasSubstr("observations.csv, line 20"));
  EXPECT_THAT(complaint, HasSubstr("The labels of F1 and F2 are swapped in state M2: each lies 90.0 mm away"));
}

TEST(ObservationPlausibility, OfTwoStatesEitherMayBeTheSwappedOne) {
  EXPECT_THAT(complaintOf(campaignText(2, "M1")),
              HasSubstr("The labels of F1 and F2 are swapped in state M1 or in M0: each lies 90.0 mm away"));
}

TEST(ObservationPlausibility, DeviationsOfAMachineAreBelieved) {
  EXPECT_EQ(complaintOf(campaignText(4, "")), "");
  EXPECT_EQ(complaintOf(campaignText(4, "M2", "exclude")), "");
  // The constant of a point is free: readings of an indicator that stands anywhere.
  std::string indicator = header;
  for (int k = 0; k < 5; ++k) indicator += fmt::format("{},M{},P,0,0,0,0,EZ,{},1,indicator,fit\n", k, k, 7120.0 + k);
  EXPECT_EQ(complaintOf(indicator), "");
}

TEST(ObservationPlausibility, AFeatureUnderAnotherLabelAndAnotherUnitAreTold) {
  ObservationSet set = ObservationSet::parse(campaignText(4, ""), "memory");
  for (Observation& o : set.rows)
    if (o.state == "M3" && o.point == "F2" && o.component == Component::EX) o.value += 90000.0;
  std::vector<ImplausibleReading> found = implausibleReadings(set);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_THAT(found[0].sentence, HasSubstr("F2 in state M3 lies 90.0 mm from its place in the other states, where F1 "
                                           "lies: F1 was measured under the label F2."));
  EXPECT_THAT(found[0].points, ElementsAre("F2"));
  EXPECT_EQ(found[0].rows.size(), 3U);
  for (Observation& o : set.rows)
    if (o.state == "M3" && o.point == "F2" && o.component == Component::EX) o.value -= 75000.0;
  found = implausibleReadings(set);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_THAT(found[0].sentence, HasSubstr("F2 in state M3 lies 15.0 mm from its place in the other states; allowed: "
                                           "changes below 10 mm"));
}

TEST(ObservationPlausibility, WhatIsLeftOutTakesNothingElseWithIt) {
  ObservationSet set = ObservationSet::parse(campaignText(4, ""), "memory");
  set.setCovariances({{0, 9, 0.1}, {9, 27, 0.05}});
  const ObservationSet rest = withoutRows(set, {1, 2, 3, 12});
  ASSERT_EQ(rest.rows.size(), set.rows.size() - 4);
  EXPECT_EQ(rest.rows[0].point, "F1");
  EXPECT_EQ(rest.rows[1].point, "F2");
  EXPECT_NEAR(rest.shared.covariance(0, 6), 0.1, 1e-12);
  EXPECT_NEAR(rest.shared.covariance(6, 23), 0.05, 1e-12);
}

TEST(ObservationPlausibility, AnEvaluationListsThemAndIsNotGoodEnough) {
  ObservationSet set = ObservationSet::parse(campaignText(4, ""), "memory");
  for (Observation& o : set.rows) {
    if (o.state != "M1" || o.component != Component::EX) continue;
    if (o.point == "F1") o.value -= 90000.0;
    if (o.point == "F2") o.value += 90000.0;
  }
  InstrumentEvaluation evaluation;
  const std::vector<ImplausibleReading> found = implausibleReadings(set);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].rows.size(), 6U);
  rejectReading(found[0], evaluation);
  ASSERT_EQ(evaluation.rejected.size(), 1U);
  EXPECT_EQ(evaluation.rejected[0].capture, "F1 and F2 in state M1");
  ASSERT_EQ(evaluation.warnings.size(), 1U);
  EXPECT_THAT(evaluation.warnings[0].sentence, HasSubstr("are swapped in state M1"));
  EXPECT_FALSE(evaluation.good_enough);
  EXPECT_THAT(implausibleReadings(withoutRows(set, found[0].rows)), IsEmpty());
}

TEST(ObservationPlausibility, PositionsInAnotherUnitAreRefused) {
  MachineDescription machine;
  for (const char* name : {"X", "Y"}) {
    LinearAxis axis;
    axis.name = name;
    axis.travel_mm = {0.0, 300.0};
    machine.axes.push_back(axis);
  }
  ObservationSet set = ObservationSet::parse(campaignText(2, ""), "observations.csv");
  EXPECT_NO_THROW(refusePositionsInAnotherUnit(set, machine));
  for (Observation& o : set.rows) o.position_mm *= 1e-3;
  try {
    refusePositionsInAnotherUnit(set, machine);
    FAIL() << "metres were believed";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("observations.csv: all 3 points lie within 0.1 mm although the axes travel 300 mm: "
                                    "their positions look like metres; allowed: millimetres."));
  }
  for (Observation& o : set.rows) o.position_mm *= 1e6;
  try {
    refusePositionsInAnotherUnit(set, machine);
    FAIL() << "micrometres were believed";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("observations.csv: half of the 3 points lie beyond 80000 mm although the axes "
                                    "travel 300 mm: their positions look like micrometres; allowed: millimetres."));
  }
  // One place is no unit.
  for (Observation& o : set.rows) o.position_mm = {0.01, 0.02, 0.0};
  EXPECT_NO_THROW(refusePositionsInAnotherUnit(set, machine));
}

}  // namespace
}  // namespace spindrift
