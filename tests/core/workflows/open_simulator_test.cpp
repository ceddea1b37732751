// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/workflows/open_simulator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/discrepancy/discrepancy.h"
#include "core/simulation/virtual_campaign.h"
#include "tests/support/source_folder.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

using ::testing::HasSubstr;

constexpr const char* head = R"({"format": "spindrift-simulator", "version": 1, )";
constexpr const char* parameters =
    R"("parameters": [{"name": "NAME", "value": 1, "standard_uncertainty": 0.1, "min": 0, "max": 5}]})";

std::string simulator(const std::string& keys, const std::string& name) {
  std::string text = head + keys + parameters;
  return text.replace(text.find("NAME"), 4, name);
}

TEST(OpenSimulator, EveryKindForACampaign) {
  const testing::TempFolder temp;
  nlohmann::json scenario = nlohmann::json::parse(
      readFile(spindrift::testing::sourceFolder() / "resources/scenarios/discrepancy_vertical.json"));
  scenario["duration_s"] = 14400;
  scenario["measurement"] = {{"every_s", 1800}, {"states", 8}, {"holdout_last", 2}};
  const auto file = temp.write("sim/scenario.json", scenario.dump());
  writeCampaign(simulateCampaign(Scenario::read(file), {}, {}), temp / "campaign");
  const Campaign campaign = Campaign::read(temp / "campaign");
  const ObservationSet& at = *campaign.observations;
  const std::vector<double> base = discrepancyInput(campaign, at).predicted;

  temp.write("sim/d.csv", "time_s,point,component,parameter,d_predicted\n0,F1,EX,h,2\n99999,F1,EX,h,2\n");
  const auto table = openSimulator(
      temp.write("sim/table.json", simulator(R"("kind": "sensitivities", "table": "d.csv", )", "h")), campaign, at);
  EXPECT_TRUE(table->linear());
  const SimulatorRun own = table->run({}, at, {});
  const SimulatorRun moved = table->run({{"h", 1.5}}, at, {});
  for (std::size_t i = 0; i < at.rows.size(); ++i) {
    EXPECT_DOUBLE_EQ(own.predicted[i], base[i]);
    if (at.rows[i].point != "F1" || at.rows[i].component != Component::EX) continue;
    EXPECT_NEAR(moved.predicted[i], base[i] + 1.0, 1e-9);
  }

  const auto plant =
      openSimulator(temp.write("sim/plant.json",
                               simulator(R"("kind": "scenario", "scenario": "scenario.json", )", "physics.friction")),
                    campaign, at);
  EXPECT_EQ(plant->run({}, at, {}).predicted.size(), at.rows.size());

  temp.write("sim/in.txt.in", "{{h}}\n{{table:ROOM}}\n");
  const auto program = openSimulator(
      temp.write("sim/program.json", simulator(R"("kind": "command", "templates": ["in.txt.in"], "run": [["true"]],
        "result": "out.csv", "increment_s": 600, "tables": {"ROOM": {"column": "T_ambient_degC"}}, )",
                                               "h")),
      campaign, at);
  EXPECT_NE(program->find("sensor.T_ambient_degC.offset"), nullptr);

  Campaign without = campaign;
  without.simulation = "missing.csv";
  try {
    (void)openSimulator(temp / "sim/table.json", without, at);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("missing.csv"));
  }
}

}  // namespace
}  // namespace spindrift
