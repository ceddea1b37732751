// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/workflows/review_workflow.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"

namespace spindrift {
namespace {

MachineDescription table() {
  return MachineDescription::parse(
      JsonNode::parse(R"({"format":"spindrift-machine","version":1,"name":"m","chain":"V [w-X'-Y'-b-Z-(C)-t]","axes":[
{"name":"X","travel_mm":[0,300]},{"name":"Y","travel_mm":[0,200]},{"name":"Z","travel_mm":[0,200]}]})",
                      "machine.json"),
      "machine.json");
}

/// Reference M0 reads 1 um everywhere; M1 and M2 rise along X and stand higher.
ObservationSet states(int points) {
  std::string csv = "time_s,state,point,x_mm,y_mm,z_mm,c_deg,component,value,sigma,instrument,use\n";
  for (int s = 0; s < 3; ++s)
    for (int p = 0; p < points; ++p) {
      const double x = 30.0 + 120.0 * (p % 3), y = 20.0 + 80.0 * (p / 3);
      for (const auto& [c, v] : {std::pair<const char*, double>{"EX", s * x / 100.0}, {"EY", 0.0}, {"EZ", 2.0 * s}})
        csv += fmt::format("{},M{},P{},{},{},0,0,{},{},0.3,probe,fit\n", 60 * s, s, p, x, y, c, 1.0 + v);
    }
  return ObservationSet::parse(csv, "observations.csv");
}

TEST(Review, AStateIsTheChangeFromTheReference) {
  const ReviewPicture m2 = reviewOf(states(9), table(), {"M2", ReviewQuantity::Measured, Component::EX});
  ASSERT_EQ(m2.points.size(), 9U);
  EXPECT_NEAR(m2.points[2].components.at(Component::EX).value, 5.4, 1e-12);
  EXPECT_NEAR(m2.points[2].components.at(Component::EX).sigma, 0.3 * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(m2.largest, 5.4, 1e-12);
  EXPECT_FALSE(m2.field.has_value());
  EXPECT_THROW((void)reviewOf(states(9), table(), {"M7", ReviewQuantity::Measured, Component::EX}), InputError);
}

TEST(Review, ModelAndResidualFollowTheNineParameters) {
  const ReviewPicture model = reviewOf(states(9), table(), {"M2", ReviewQuantity::NineParameters, Component::EX});
  ASSERT_TRUE(model.field.has_value()) << model.message;
  EXPECT_NEAR(model.points[2].components.at(Component::EX).value, 5.4, 1e-6);
  const ReviewPicture rest = reviewOf(states(9), table(), {"M2", ReviewQuantity::NineParametersLeft, Component::EX});
  EXPECT_LT(rest.largest, 1e-6);
  const ReviewSection section = reviewSection(*model.field, true, 77.7);
  ASSERT_EQ(section.place_mm.size(), static_cast<std::size_t>(model.field->grid.nx));
  for (std::size_t i = 0; i < section.place_mm.size(); ++i)
    EXPECT_NEAR(section.value[i], 2.0 * section.place_mm[i] / 100.0, 1e-6);
  // One point determines no heat map: that is said, nothing is invented.
  const ReviewPicture one = reviewOf(states(1), table(), {"M2", ReviewQuantity::NineParameters, Component::EX});
  EXPECT_FALSE(one.field.has_value());
  EXPECT_FALSE(one.message.empty());
}

TEST(Review, TheNineParametersAreThoseThatWereChosenForThePage) {
  ObservationSet disturbed = states(9);
  for (Observation& o : disturbed.rows)
    if (o.point == "P4" && o.component == Component::EX && o.state == "M2") o.value += 50.0;
  ReviewRequest request{"M2", ReviewQuantity::NineParameters, Component::EX};
  const double with = reviewOf(disturbed, table(), request).points[2].components.at(Component::EX).value;
  EXPECT_GT(std::abs(with - 5.4), 1.0);
  for (const char* point : {"P0", "P1", "P2", "P3", "P5", "P6", "P7", "P8"}) request.fit.points.emplace_back(point);
  EXPECT_NEAR(reviewOf(disturbed, table(), request).points[2].components.at(Component::EX).value, 5.4, 1e-6);
}

TEST(Review, AStateThatIsHeldOutHasAMapBetweenItsPointsAndSaysSo) {
  ObservationSet all = states(9);
  ReviewRequest request{"M2", ReviewQuantity::Measured, Component::EX};
  request.heat_map = true;
  ASSERT_TRUE(reviewOf(all, table(), request).field.has_value());
  EXPECT_TRUE(reviewOf(all, table(), request).message.empty());
  for (Observation& o : all.rows)
    if (o.state == "M2") o.use = ObservationUse::Holdout;
  const ReviewPicture m2 = reviewOf(all, table(), request);
  ASSERT_TRUE(m2.field.has_value());
  EXPECT_EQ(m2.message, "Held out: dashed points took no part in any fit.");
}

TEST(Review, DifferenceIsTheSecondMinusTheFirst) {
  const ObservationSet all = states(9);
  const ReviewPicture a = reviewOf(all, table(), {"M1", ReviewQuantity::NineParameters, Component::EX});
  const ReviewPicture b = reviewOf(all, table(), {"M2", ReviewQuantity::NineParameters, Component::EX});
  const ReviewPicture d = reviewDifference(a, b);
  ASSERT_TRUE(d.field.has_value());
  EXPECT_NEAR(d.points[2].components.at(Component::EX).value, 2.7, 1e-6);
  for (std::size_t i = 0; i < d.field->value.size(); ++i) {
    EXPECT_NEAR(d.field->value[i], b.field->value[i] - a.field->value[i], 1e-12);
    EXPECT_NEAR(d.field->sigma[i], std::hypot(a.field->sigma[i], b.field->sigma[i]), 1e-12);
  }
  ReviewPicture nothing;
  EXPECT_FALSE(reviewDifference(nothing, b).message.empty());
}

TEST(Review, WhatTwoStatesHaveInCommonDoesNotCountTwice) {
  ObservationSet all = states(1);  // M0, M1, M2 of one point: EX, EY, EZ each
  // The reading of M2 holds the reference's noise: covariance 0.04 beside 0.09 + 0.09.
  all.shared.addFactor({{0, 0.2}, {6, 0.2}});
  const ReviewPicture m2 = reviewOf(all, table(), {"M2", ReviewQuantity::Measured, Component::EX});
  EXPECT_NEAR(m2.points[0].components.at(Component::EX).sigma, std::sqrt(0.18 - 0.08), 1e-12);
  EXPECT_NEAR(m2.points[0].components.at(Component::EY).sigma, std::sqrt(0.18), 1e-12);
}

TEST(Review, RepeatedReadingsOfAStateAreAveraged) {
  std::string csv = "time_s,state,point,x_mm,y_mm,z_mm,c_deg,component,value,sigma,instrument,use\n";
  const double readings[4] = {1.0, 3.0, 10.0, 14.0};
  for (int i = 0; i < 4; ++i) csv += fmt::format("{},M{},P,0,0,0,0,EX,{},0.2,probe,fit\n", 60 * i, i / 2, readings[i]);
  const ReviewPicture m1 =
      reviewOf(ObservationSet::parse(csv, "o.csv"), table(), {"M1", ReviewQuantity::Measured, Component::EX});
  EXPECT_NEAR(m1.points[0].components.at(Component::EX).value, 10.0, 1e-12);
  EXPECT_NEAR(m1.points[0].components.at(Component::EX).sigma, 0.2, 1e-12);
}

TEST(Review, WhatRepeatedReadingsShareDoesNotAverageOut) {
  std::string csv = "time_s,state,point,x_mm,y_mm,z_mm,c_deg,component,value,sigma,instrument,use\n";
  for (int i = 0; i < 4; ++i) csv += fmt::format("{},M{},P,0,0,0,0,EX,{},0.5,probe,fit\n", 60 * i, i / 2, i);
  ObservationSet set = ObservationSet::parse(csv, "o.csv");
  set.shared.addFactor({{0, 0.1}, {1, 0.1}, {2, 0.1}, {3, 0.1}});  // of all: none is left
  set.shared.addFactor({{2, 0.4}, {3, 0.4}});                      // of the state
  const ReviewPicture m1 = reviewOf(set, table(), {"M1", ReviewQuantity::Measured, Component::EX});
  const double own_cold = 0.24, own_warm = 0.08;
  EXPECT_NEAR(m1.points[0].components.at(Component::EX).sigma, std::sqrt(0.16 + own_cold / 2.0 + own_warm / 2.0),
              1e-12);
}

TEST(Review, HeatMapsBetweenPointsFollowTheTruthWithinTheirUncertainty) {
  const ObservationSet all = states(9);
  ReviewRequest request{"M2", ReviewQuantity::Measured, Component::EX};
  request.heat_map = true;
  const ReviewPicture m2 = reviewOf(all, table(), request);
  ASSERT_TRUE(m2.field.has_value());
  int inside = 0, checked = 0;
  for (int iy = 0; iy < m2.field->grid.ny; ++iy)
    for (int ix = 0; ix < m2.field->grid.nx; ++ix) {
      const std::size_t n = m2.field->grid.index(ix, iy);
      if (m2.field->extrapolated[n]) continue;
      ++checked;
      if (std::abs(m2.field->value[n] - 2.0 * m2.field->grid.x_mm(ix) / 100.0) < 2.0 * m2.field->sigma[n]) ++inside;
    }
  ASSERT_GT(checked, 200);
  EXPECT_EQ(inside, checked) << "values without noise lie well within";
  // Three points in a row span no plane.
  EXPECT_FALSE(reviewOf(states(3), table(), request).field.has_value());
}

// Nine points at each of two angles of the table, EX rising along X at 0 deg and falling at 90 deg; one name for both.
TEST(Review, AMapIsOfOneAngleOfTheTable) {
  std::string csv = "time_s,state,point,x_mm,y_mm,z_mm,c_deg,component,value,sigma,instrument,use\n";
  for (int s = 0; s < 2; ++s)
    for (int p = 0; p < 9; ++p)
      for (const int c : {0, 90}) {
        const double x = 30.0 + 120.0 * (p % 3), y = 20.0 + 80.0 * (p / 3);
        csv += fmt::format("{},M{},P{},{},{},0,{},EX,{},0.3,probe,fit\n", 60 * s + c / 90, s, p, x, y, c,
                           s * x / 100.0 * (c == 0 ? 1.0 : -1.0));
      }
  const ObservationSet all = ObservationSet::parse(csv, "o.csv");
  EXPECT_EQ(tableAngles(all), (std::vector<double>{0.0, 90.0}));
  ReviewRequest request{"M1", ReviewQuantity::Measured, Component::EX};
  request.heat_map = true;
  const ReviewPicture both = reviewOf(all, table(), request);
  EXPECT_EQ(both.points.size(), 18U);
  EXPECT_FALSE(both.field.has_value());
  EXPECT_EQ(both.message, "Points at 2 angles of the table have no common heat map: choose one.");
  for (const double c : {0.0, 90.0}) {
    request.c_deg = c;
    const ReviewPicture one = reviewOf(all, table(), request);
    ASSERT_EQ(one.points.size(), 9U);
    ASSERT_TRUE(one.field.has_value()) << one.message;
    EXPECT_NEAR(one.points[2].components.at(Component::EX).value, c == 0.0 ? 2.7 : -2.7, 1e-12);
    EXPECT_NEAR(one.points[2].components.at(Component::EX).sigma, 0.3 * std::sqrt(2.0), 1e-12);
    // Nowhere more than was measured: 0.3 to 2.7 um, or their negatives.
    for (const double v : one.field->value) {
      EXPECT_GE(std::abs(v), 0.3 - 1e-12);
      EXPECT_LE(std::abs(v), 2.7 + 1e-12);
    }
    EXPECT_LE(one.largest, 2.7 + 1e-12);
  }
  request.c_deg = 45.0;
  EXPECT_TRUE(reviewOf(all, table(), request).points.empty());
  EXPECT_EQ(reviewOf(all, table(), request).message, "M1 was not measured with the table at 45°.");
}

TEST(Review, PointsOnOneLineHaveNoMapAndThatIsSaid) {
  ReviewRequest request{"M2", ReviewQuantity::Measured, Component::EX};
  request.heat_map = true;
  const ReviewPicture line = reviewOf(states(3), table(), request);
  EXPECT_FALSE(line.field.has_value());
  EXPECT_EQ(line.message, "The points lie on one line, so there is no heat map between them.");
}

TEST(Review, SimulationAndItsCompletionAreShownAsChanges) {
  const ObservationSet all = states(9);
  ReviewPrediction half;  // half of EX, and an offset that a change does not show
  for (const Observation& o : all.rows) {
    half.value.push_back(o.component == Component::EX ? 0.5 * o.value + 7.0 : 0.0);
    half.sigma.push_back(0.1);
  }
  half.uncertainty = "± is 1 % of the simulated change";
  ReviewRequest request{"M2", ReviewQuantity::Simulation, Component::EX};
  const ReviewPicture simulated = reviewOf(all, table(), request, &half);
  EXPECT_NEAR(simulated.points[2].components.at(Component::EX).value, 2.7, 1e-12);
  EXPECT_NEAR(simulated.points[2].components.at(Component::EX).sigma, 0.1, 1e-12);
  EXPECT_EQ(simulated.uncertainty, half.uncertainty);
  request.quantity = ReviewQuantity::SimulationLeft;
  const ReviewPicture left = reviewOf(all, table(), request, &half);
  EXPECT_NEAR(left.points[2].components.at(Component::EX).value, 5.4 - 2.7, 1e-12);
  EXPECT_TRUE(left.uncertainty.empty()) << "that of the measurement";
  EXPECT_NEAR(left.points[2].components.at(Component::EX).sigma, 0.3 * std::sqrt(2.0), 1e-12);

  DiscrepancyStory story;
  EXPECT_FALSE(reviewCompleted(story, all).why.empty());
  request.quantity = ReviewQuantity::CompletedLeft;
  const ReviewPrediction none = reviewCompleted(story, all);
  EXPECT_EQ(reviewOf(all, table(), request, &none).message, none.why);
  story.added = {"spindle.growth.z"};
  DiscrepancySeries s;
  s.point = "P2";
  s.component = Component::EX;
  for (const Observation& o : all.rows) {
    if (o.point != s.point || o.component != s.component) continue;
    s.time_s.push_back(o.time_s);
    s.completed.push_back(o.value + 0.25);
    s.completed_sigma.push_back(0.05);
  }
  story.series = {s};
  const ReviewPrediction completed = reviewCompleted(story, all);
  const ReviewPicture after = reviewOf(all, table(), request, &completed);
  EXPECT_NEAR(after.points[2].components.at(Component::EX).value, 0.0, 1e-12);
  EXPECT_TRUE(std::isnan(after.points[0].components.at(Component::EX).value)) << "no prediction, no number";
}

}  // namespace
}  // namespace spindrift
