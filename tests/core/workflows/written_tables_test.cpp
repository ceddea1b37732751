// SPDX-License-Identifier: GPL-3.0-or-later
// Tables that are written for people: a name that a spreadsheet would run as a formula, or that holds a comma and a
// quote, stands in them as text and is read back as it was.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/csv.h"
#include "core/workflows/compensation_workflow.h"
#include "core/workflows/thermal_outputs.h"
#include "core/workflows/thermal_tracking.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

using ::testing::ElementsAre;

constexpr const char* formula = "=1+1,\"x\"";

TEST(WrittenTables, NamesOfPointsAreText) {
  Campaign campaign;
  for (const char* name : {"X", "Y", "Z"}) {
    LinearAxis axis;
    axis.name = name;
    axis.travel_mm = {0.0, 300.0};
    campaign.machine.axes.push_back(axis);
  }
  ObservationSet set;
  for (int state = 0; state < 2; ++state) {
    for (int i = 0; i < 12; ++i) {
      for (const Component c : {Component::EX, Component::EY, Component::EZ}) {
        Observation o;
        o.time_s = 1000.0 * state;
        o.state = state == 0 ? "M0" : "M1";
        o.point = i == 0 ? formula : "F" + std::to_string(i);
        o.position_mm = {80.0 * (i % 4), 120.0 * (i / 4 % 3), 0.0};
        o.component = c;
        o.value = state * (2.0 + 0.01 * o.position_mm.x() + 0.1 * (i % 3));
        o.sigma = 0.3;
        set.rows.push_back(o);
      }
    }
  }
  campaign.observations = set;
  CompensationRequest request;
  request.positions = 3;
  JobContext job;
  const CompensationPlan plan = planCompensation(campaign, set, request, job);
  ASSERT_EQ(plan.files.front().name, "compensation_points.csv");
  const CsvTable table = CsvTable::parse(plan.files.front().content, "compensation_points.csv");
  EXPECT_EQ(table.text(0, table.column("point")), formula);
}

TEST(WrittenTables, NamesOfPredictedOutputsAreText) {
  SeveralOutputs outputs;
  outputs.names = {formula};
  IdentifyResult& one = outputs.results.emplace_back();
  one.time_s = {0.0, 1.0};
  one.measured = {1.0, 2.0};
  one.predicted = {1.5, 2.5};
  const testing::TempFolder folder;
  outputs.writePrediction(folder / "prediction.csv");
  EXPECT_THAT(CsvTable::read(folder / "prediction.csv").columnNames(),
              ElementsAre("time_s", std::string("measured_") + formula, std::string("predicted_") + formula));
}

TEST(WrittenTables, NamesOfCompensatedOutputsAreText) {
  CompensateResult result;
  result.time_s = {0.0, 1.0};
  CompensateResult::Output& one = result.outputs.emplace_back();
  one.name = formula;
  one.compensation = {1.0, 2.0};
  const testing::TempFolder folder;
  result.write(folder / "compensation.csv");
  EXPECT_THAT(CsvTable::read(folder / "compensation.csv").columnNames(),
              ElementsAre("time_s", std::string("compensation_") + formula));
}

}  // namespace
}  // namespace spindrift
