// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/workflows/residual_map.h"

#include <gmock/gmock.h>

#include "core/workflows/review_workflow.h"

namespace spindrift {
namespace {

/// One point that the table carries from `at_0` to `at_90` and back; left is 1 um at 0 degrees and 6 um at 90.
DiscrepancySeries turned(const std::string& point, const Eigen::Vector3d& at_0, const Eigen::Vector3d& at_90) {
  DiscrepancySeries s;
  s.point = point;
  s.component = Component::EX;
  s.position_mm = 0.5 * (at_0 + at_90);
  s.places = {{0.0, at_0}, {90.0, at_90}};
  for (int i = 0; i < 4; ++i) {
    s.place.push_back(static_cast<std::size_t>(i % 2));
    s.time_s.push_back(600.0 * i);
    s.value.push_back(i % 2 == 0 ? 1.0 : 6.0);
    s.simulated.push_back(0.0);
    s.completed.push_back(0.5);
    s.completed_sigma.push_back(0.1 * (i + 1));
    s.held_out.push_back(false);
  }
  s.noise = 0.2;
  return s;
}

TEST(ResidualMap, IsOfOneAngleOfTheTable) {
  DiscrepancyStory story;
  story.added = {"spindle.growth.z"};
  story.series = {turned("P1", {100, 0, 0}, {0, 100, 0}), turned("P2", {200, 0, 0}, {0, 200, 0})};
  const std::vector<ResidualMoment> moments = momentsOf(story, Component::EX);
  EXPECT_THAT(moments, ::testing::ElementsAre(ResidualMoment{0, 0}, ResidualMoment{600, 90}, ResidualMoment{1200, 0},
                                              ResidualMoment{1800, 90}));
  EXPECT_EQ(worstMoment(story, Component::EX), 1U);
  for (const ResidualMoment& moment : moments) {
    const std::vector<Field::Marker> points = residualsAt(story, Component::EX, moment, false);
    ASSERT_EQ(points.size(), 2U);
    for (const Field::Marker& p : points) {
      EXPECT_EQ(p.value, moment.c_deg == 0.0 ? 1.0 : 6.0);
      EXPECT_EQ(p.position_mm.y() > 0.0, moment.c_deg == 90.0) << "where the table has it, not the mean of its places";
    }
  }
}

TEST(ResidualMap, OfReadingsAtOneTimeKeepsTheAnglesApart) {
  DiscrepancyStory story;
  story.added = {"spindle.growth.z"};
  story.series = {turned("P1", {100, 0, 0}, {0, 100, 0})};
  story.series.front().time_s = {0.0, 0.0, 1200.0, 1200.0};
  EXPECT_THAT(momentsOf(story, Component::EX),
              ::testing::ElementsAre(ResidualMoment{0, 0}, ResidualMoment{0, 90}, ResidualMoment{1200, 0},
                                     ResidualMoment{1200, 90}));
  EXPECT_EQ(residualsAt(story, Component::EX, {1200, 0}, false).at(0).value, 1.0);
  EXPECT_EQ(residualsAt(story, Component::EX, {1200, 90}, false).at(0).value, 6.0);
  // What the completed model says goes to the reading at the angle at which it was made.
  ObservationSet set;
  for (const double c_deg : {0.0, 90.0}) {
    Observation o;
    o.point = "P1";
    o.component = Component::EX;
    o.time_s = 1200.0;
    o.c_deg = c_deg;
    set.rows.push_back(o);
  }
  EXPECT_THAT(reviewCompleted(story, set).sigma,
              ::testing::ElementsAre(::testing::DoubleNear(0.3, 1e-12), ::testing::DoubleNear(0.4, 1e-12)));
}

TEST(ResidualMap, OfStoriesThatKeepNoPlacesIsAtTheMean) {
  DiscrepancyStory story;
  story.series = {turned("P1", {100, 0, 0}, {0, 100, 0})};
  story.series.front().places.clear();
  story.series.front().place.clear();
  EXPECT_EQ(momentsOf(story, Component::EX).size(), 4U);
  EXPECT_EQ(residualsAt(story, Component::EX, {600.0, 0.0}, false).at(0).position_mm, Eigen::Vector3d(50, 50, 0));
}

}  // namespace
}  // namespace spindrift
