// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/plant/control_chart.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/base/csv.h"
#include "core/base/random.h"
#include "core/plant/plant_overview.h"
#include "tests/core/plant/both_stores.h"
#include "tests/support/refusal.h"

namespace spindrift {
namespace {

using ::spindrift::testing::OnBothStores;
using ::spindrift::testing::onDay;
using ::spindrift::testing::refusal;
using ::spindrift::testing::weeklyCampaign;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

/// Weekly values: scatter 0.5, uncertainties between 0.1 and 1 that are told.
std::vector<TrendPoint> record(std::uint64_t seed, std::size_t count, double (*level)(std::size_t)) {
  Random random(seed);
  std::vector<TrendPoint> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double u = random.uniform(0.1, 1.0);
    points.push_back({static_cast<std::int64_t>(i), "w" + std::to_string(i), onDay(7.0 * static_cast<double>(i)),
                      level(i) + random.normal(0.0, 0.5) + random.normal(0.0, u), u});
  }
  return points;
}

double constantLevel(std::size_t) {
  return 10.0;
}

TEST(ControlChart, NamesNothingWhereThereIsNothing) {
  constexpr int records = 400;
  int named = 0;
  std::size_t outside = 0;
  std::size_t later = 0;
  for (int seed = 0; seed < records; ++seed) {
    const ControlChart chart = controlChart(record(static_cast<std::uint64_t>(seed), 60, constantLevel), {}, "EX_um");
    named += chart.changes.empty() ? 0 : 1;
    for (const ChartPoint& p : chart.points) {
      if (p.baseline) continue;
      ++later;
      outside += p.outside ? 1 : 0;
    }
  }
  // 1 % asked for; 13 of 400 would be seen with a probability below 1e-4.
  EXPECT_LE(named, 12) << named << " of " << records << " records without a change had one named";
  // 0.27 % with a level and a scatter that are known; both are estimated.
  EXPECT_LT(static_cast<double>(outside) / static_cast<double>(later), 0.012);
}

TEST(ControlChart, FindsStepsWithTheirPlaceAndSize) {
  constexpr int records = 100;
  int found = 0;
  int near = 0;
  int covered = 0;
  for (int seed = 0; seed < records; ++seed) {
    const ControlChart chart = controlChart(
        record(1000 + static_cast<std::uint64_t>(seed), 60, [](std::size_t i) { return i < 35 ? 10.0 : 12.0; }), {},
        "EX_um");
    if (chart.changes.size() != 1 || chart.changes[0].kind != ChangeKind::Step) continue;
    ++found;
    const NamedChange& c = chart.changes[0];
    if (std::abs(c.to_s - onDay(35.0 * 7.0)) <= 2.5 * 7.0 * 86'400.0) ++near;
    if (std::abs(c.size - 2.0) <= 2.0 * c.standard_uncertainty) ++covered;
  }
  EXPECT_GE(found, 95);
  EXPECT_GE(near, 85);
  EXPECT_GE(covered, 80);
}

TEST(ControlChart, TellsADriftFromAStepAndASingleValueFromBoth) {
  int drifts = 0;
  int singles = 0;
  for (int seed = 0; seed < 40; ++seed) {
    const ControlChart drift = controlChart(record(2000 + static_cast<std::uint64_t>(seed), 80,
                                                   [](std::size_t i) { return 0.05 * static_cast<double>(i); }),
                                            {}, "EX_um");
    if (drift.changes.size() == 1 && drift.changes[0].kind == ChangeKind::Drift &&
        std::abs(drift.changes[0].size - 0.05 * 79.0) < 3.0 * drift.changes[0].standard_uncertainty)
      ++drifts;
    auto points = record(3000 + static_cast<std::uint64_t>(seed), 60, constantLevel);
    points[30].value = 18.0;
    points[30].standard_uncertainty = 0.3;
    const ControlChart single = controlChart(points, {}, "EX_um");
    if (single.changes.size() == 1 && single.changes[0].kind == ChangeKind::SingleValue &&
        single.changes[0].from_s == onDay(210.0))
      ++singles;
  }
  EXPECT_GE(drifts, 34);
  EXPECT_GE(singles, 36);
}

TEST(ControlChart, EwmaSeesASmallShiftThatStays) {
  const auto points = record(7, 120, [](std::size_t i) { return i < 40 ? 10.0 : 10.9; });
  const ControlChart chart = controlChart(points, {}, "EX_um", {.baseline = 40});
  EXPECT_TRUE(chart.limits);
  EXPECT_FALSE(chart.inControl());
  EXPECT_TRUE(chart.points.back().ewma_outside);
}

TEST(ControlChart, LimitsBeginAnewAfterAnEventAndTheChangeIsNamedByIt) {
  const auto points = record(8, 60, [](std::size_t i) { return i < 30 ? 10.0 : 20.0; });
  const std::vector<MachineEvent> events{{"mill", onDay(7.0 * 29.5), "spindle_changed", "SN 12", "anna"},
                                         {"mill", onDay(7.0 * 50.5), "note", "cleaned", "anna"}};
  const ControlChart chart = controlChart(points, events, "EX_um");
  ASSERT_EQ(chart.changes.size(), 1U);
  EXPECT_EQ(chart.changes[0].event, "spindle changed (SN 12)");
  EXPECT_THAT(chart.changes[0].sentence("um"), HasSubstr("where spindle changed (SN 12) was entered"));
  EXPECT_THAT(chart.changes[0].sentence("um"), HasSubstr("step of +"));
  EXPECT_NEAR(chart.points[10].centre, 10.0, 1.0);
  EXPECT_NEAR(chart.points[55].centre, 20.0, 1.0) << "a note begins nothing anew";
  EXPECT_TRUE(chart.inControl());
}

TEST(ControlChart, ValuesWithLargeUncertaintyAlarmNobody) {
  auto points = record(9, 40, constantLevel);
  points.back().value = 18.0;
  points.back().standard_uncertainty = 8.0;
  const ControlChart chart = controlChart(points, {}, "EX_um");
  EXPECT_FALSE(chart.points.back().outside);
  EXPECT_TRUE(chart.inControl());
  points.back().standard_uncertainty = 0.1;
  EXPECT_TRUE(controlChart(points, {}, "EX_um").points.back().outside);
}

TEST(ControlChart, FewOrEqualValuesAreNoError) {
  EXPECT_THAT(controlChart({}, {}, "EX_um").points, IsEmpty());
  const auto notesOf = [](std::size_t count) {
    return controlChart(record(1, count, constantLevel), {}, "EX_um").notes;
  };
  EXPECT_THAT(notesOf(3), Contains(StartsWith("3 values since 2")));
  EXPECT_THAT(notesOf(1), Contains(StartsWith("One value since 2")));
  auto points = record(1, 20, constantLevel);
  for (TrendPoint& p : points) {
    p.value = 1.0;
    p.standard_uncertainty = 0.0;
  }
  const ControlChart chart = controlChart(points, {}, "EX_um");
  EXPECT_THAT(chart.changes, IsEmpty());
  EXPECT_TRUE(chart.inControl());
  EXPECT_THAT(refusal([&] { (void)controlChart(points, {}, "EX_um", {.baseline = 2}); }), HasSubstr("allowed: 5 to"));
}

TEST(ControlChart, ScatterIsThatOfTheTruthAndAStepDoesNotCount) {
  double without = 0.0;
  double with = 0.0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    for (const bool step : {false, true}) {
      std::vector<double> values;
      std::vector<double> sigma;
      for (const TrendPoint& p : record(seed, 100, constantLevel)) {
        values.push_back(p.value + (step && values.size() > 50 ? 30.0 : 0.0));
        sigma.push_back(p.standard_uncertainty);
      }
      (step ? with : without) += std::sqrt(scatterVariance(values, sigma)) / 50.0;
    }
  }
  EXPECT_NEAR(without, 0.5, 0.08);
  EXPECT_NEAR(with, 0.5, 0.1);
}

class PlantOverviewTest : public OnBothStores {};
INSTANTIATE_TEST_SUITE_P(On, PlantOverviewTest, ::testing::Values("sqlite", "postgresql"), testing::storeName);

TEST_P(PlantOverviewTest, SaysWhatIsDueFirst) {
  PlantStore store = make();
  std::vector<PlantCampaign> campaigns;
  for (int week = 0; week < 6; ++week) campaigns.push_back(weeklyCampaign("mill", week));
  campaigns.push_back(weeklyCampaign("lathe", 5));
  (void)store.publish(campaigns);
  store.setInterval("lathe", 30.0);
  const double now_s = onDay(7.0 * 5 - 365.0 + 10.0);
  const auto states = plantOverview(store, now_s);
  ASSERT_EQ(states.size(), 2U);
  EXPECT_EQ(states[0].machine.name, "mill");
  EXPECT_EQ(states[0].every_days, 7.0);
  EXPECT_NEAR(states[0].overdue_days, 3.0, 1e-9);
  EXPECT_EQ(states[0].dueSentence(), "due for 3 days, every 7 days so far");
  EXPECT_LT(states[1].overdue_days, 0.0);
  EXPECT_THAT(states[1].dueSentence(), HasSubstr("due on 2025-"));
}

TEST_P(PlantOverviewTest, ModelNoLongerHoldsAfterAnEventOrAVerdict) {
  PlantStore store = make();
  std::vector<PlantCampaign> campaigns;
  for (int week = 0; week < 12; ++week) campaigns.push_back(weeklyCampaign("mill", week));
  campaigns[5].results[0].kind = "discrepancy";
  campaigns[5].results[0].model = {{"format", "spindrift-error-model"}};
  (void)store.publish(campaigns);
  ASSERT_TRUE(modelState(store, "mill", {}).model);
  EXPECT_THAT(modelState(store, "mill", {}).reasons, IsEmpty());
  store.addEvent({"mill", onDay(7.0 * 8 - 365.0), "note", "", ""});
  EXPECT_THAT(modelState(store, "mill", {}).reasons, IsEmpty());
  store.addEvent({"mill", onDay(7.0 * 8 - 365.0), "re_levelled", "", ""});
  EXPECT_THAT(modelState(store, "mill", {}).reasons, ::testing::ElementsAre(HasSubstr("re-levelled was entered")));
  PlantCampaign later = weeklyCampaign("mill", 20);
  later.results[0].verdict = "unknown";
  (void)store.publish(std::span(&later, 1));
  EXPECT_THAT(modelState(store, "mill", {}).reasons, ::testing::Contains(HasSubstr("has the verdict \"unknown\"")));
  const std::string html = htmlOf(machineReport(store, "mill", onDay(0.0)).report);
  EXPECT_THAT(html, HasSubstr("no longer holds"));
  EXPECT_THAT(html, HasSubstr("<svg"));
}

TEST_P(PlantOverviewTest, TrendAsksForTheKindWhereTwoHaveTheParameter) {
  PlantStore store = make();
  std::vector<PlantCampaign> campaigns{weeklyCampaign("mill", 1), weeklyCampaign("mill", 2)};
  campaigns[1].results[0].kind = "evaluate";
  (void)store.publish(campaigns);
  EXPECT_THAT(refusal([&] { (void)machineTrend(store, "mill", "EZ_um", "", {}); }),
              HasSubstr("allowed: evaluate/EZ_um or fit/EZ_um"));
  EXPECT_EQ(machineTrend(store, "mill", "fit/EZ_um", "", {}).chart.points.size(), 1U);
  EXPECT_THAT(refusal([&] { (void)machineTrend(store, "mill", "EQ", "", {}); }), HasSubstr("no parameter \"EQ\""));
  EXPECT_THAT(machineTrend(store, "mill", "fit/EZ_um", "", {}).csv(), HasSubstr("week 1,1,0.1,"));
}

TEST(MachineTrend, NamesOfCampaignsAreTextInTheTable) {
  MachineTrend trend;
  trend.chart.points.emplace_back().point.campaign_name = "=1+1,\"x\"";
  const CsvTable table = CsvTable::parse(trend.csv(), "trend.csv");
  EXPECT_EQ(table.text(0, table.column("campaign")), "=1+1,\"x\"");
}

}  // namespace
}  // namespace spindrift
