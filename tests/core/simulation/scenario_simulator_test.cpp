// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/scenario_simulator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/atomic_file.h"
#include "core/simulation/virtual_campaign.h"
#include "tests/support/refusal.h"
#include "tests/support/source_folder.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::refusal;

nlohmann::json parameter(const std::string& name, double value, double min, double max) {
  return {{"name", name}, {"value", value}, {"standard_uncertainty", 0.1}, {"min", min}, {"max", max}};
}

/// The shipped scenario with fewer states, whose truth is known.
class ScenarioSimulatorTest : public ::testing::Test {
 protected:
  ScenarioSimulatorTest() {
    scenario = nlohmann::json::parse(
        readFile(spindrift::testing::sourceFolder() / "resources/scenarios/discrepancy_vertical.json"));
    scenario.erase("simulation");
    scenario["duration_s"] = 14400;
    scenario["measurement"] = {{"every_s", 1800}, {"states", 8}, {"holdout_last", 2}};
    json = {{"format", "spindrift-simulator"},
            {"version", 1},
            {"kind", "scenario"},
            {"scenario", "scenario.json"},
            {"parameters", nlohmann::json::array({parameter("physics.friction", 1, 0, 5)})}};
  }
  void add(const std::string& name, double value, double min, double max) {
    json["parameters"].push_back(parameter(name, value, min, max));
  }
  [[nodiscard]] std::unique_ptr<ScenarioSimulator> open() const {
    temp.write("sim/scenario.json", scenario.dump(1));
    return std::make_unique<ScenarioSimulator>(openSimulatorFile(temp.write("sim/simulator.json", json.dump(1))));
  }
  [[nodiscard]] VirtualCampaign truthOf(const nlohmann::json& of) const {
    return simulateCampaign(Scenario::parse(JsonNode::parse(of.dump(), "truth.json"), "truth.json"), {}, {});
  }
  static void expectEqual(const std::vector<double>& found, const std::vector<double>& truth, double within = 1e-9) {
    ASSERT_EQ(found.size(), truth.size());
    double largest = 0.0;
    double size = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      largest = std::max(largest, std::abs(found[i] - truth[i]));
      size = std::max(size, std::abs(truth[i]));
    }
    EXPECT_LT(largest, within);
    EXPECT_GT(size, 1.0) << "there is something to predict";
  }

  testing::TempFolder temp;
  nlohmann::json scenario;
  nlohmann::json json;
};

TEST_F(ScenarioSimulatorTest, PredictsWhatTheVirtualMachineDoes) {
  const VirtualCampaign truth = truthOf(scenario);
  const auto simulator = open();
  const SimulatorRun run = simulator->run({}, *truth.campaign.observations, {});
  expectEqual(run.predicted, truth.truth.total);
  EXPECT_GT(run.elapsed_s, 0.0);
  EXPECT_EQ(simulator->run({}, *truth.campaign.observations, {}).elapsed_s, 0.0) << "kept";
  ObservationSet later = *truth.campaign.observations;
  later.rows.resize(1);
  later.rows[0].time_s = 20000.0;
  EXPECT_TRUE(std::isnan(simulator->run({}, later, {}).predicted[0])) << "after its end";
}

TEST_F(ScenarioSimulatorTest, AParameterChangesWhatItNames) {
  scenario["programme"] = nlohmann::json::parse(
      R"({"segments": [{"from_s": 0, "spindle_rpm": 0}, {"from_s": 1800, "spindle_rpm": 3000}]})");
  scenario["effects"]["column.bending.a"] = {{"size", 1.0}};
  add("programme.segments.1.spindle_rpm", 3000, 0, 6000);
  add("environment.ramp_K_per_h", 0, -5, 5);
  add("effects.ball_screw.expansion.z.size", 0.4, 0, 2);
  const auto simulator = open();
  const ObservationSet at = *truthOf(scenario).campaign.observations;
  const auto expect = [&](const char* name, double value, const char* pointer) {
    nlohmann::json changed = scenario;
    changed[nlohmann::json::json_pointer(pointer)] = value;
    const std::vector<double> found = simulator->run({{name, value}}, at, {}).predicted;
    expectEqual(found, truthOf(changed).truth.total);
    const std::vector<double> own = simulator->run({}, at, {}).predicted;
    double change = 0.0;
    for (std::size_t i = 0; i < own.size(); ++i) change = std::max(change, std::abs(found[i] - own[i]));
    EXPECT_GT(change, 1e-3) << name;
  };
  expect("physics.friction", 2.0, "/physics/friction");
  expect("programme.segments.1.spindle_rpm", 5000, "/programme/segments/1/spindle_rpm");
  expect("environment.ramp_K_per_h", 1.5, "/environment/ramp_K_per_h");
  expect("simulation.effects.ball_screw.expansion.z.size", 0.8, "/effects/ball_screw.expansion.z/size");
}

TEST_F(ScenarioSimulatorTest, AMechanismThatIsOffCanBeSwitchedOn) {
  scenario["effects"]["column.bending.a"] = {{"size", 1.5}};
  scenario["effects"]["external_heat.a"] = {{"size", 0.7}, {"onset_s", 3600}};
  const VirtualCampaign truth = truthOf(scenario);
  scenario["effects"]["column.bending.a"] = {{"size", 1.0}, {"on", false}};
  scenario["effects"].erase("external_heat.a");
  scenario["effects"]["convection.speed"] = {{"size", 1.0}};
  add("effects.column.bending.a.size", 0, 0, 5);
  add("effects.external_heat.a.onset_s", 0, 0, 14400);
  add("effects.external_heat.a.size", 0, 0, 5);
  add("effects.convection.speed.size", 1, 0, 5);
  add("effects.dynamics.second_lag.size", 1, 0, 5);
  const auto simulator = open();
  const ObservationSet& at = *truth.campaign.observations;
  const ParameterValues on{{"effects.column.bending.a.size", 1.5},
                           {"effects.external_heat.a.size", 0.7},
                           {"effects.external_heat.a.onset_s", 3600}};
  expectEqual(simulator->run(on, at, {}).predicted, truth.truth.total);
  std::vector<double> without = truth.truth.total;
  for (const char* id : {"column.bending.a", "external_heat.a"}) {
    for (std::size_t i = 0; i < without.size(); ++i) without[i] -= truth.truth.signals.at(id)[i];
  }
  expectEqual(simulator->run({}, at, {}).predicted, without);
  const auto off = simulator->run({{"effects.dynamics.second_lag.size", 0}}, at, {}).predicted;
  EXPECT_NE(off, simulator->run({}, at, {}).predicted) << "the heat flow is another one";

  simulator->writeVersion(on, temp / "v2", {{"what", "two mechanisms"}});
  const ScenarioSimulator second(openSimulatorFile(temp / "v2/simulator.json"));
  expectEqual(second.run({}, at, {}).predicted, truth.truth.total);
  const nlohmann::json written = nlohmann::json::parse(readFile(temp / "v2/scenario.json"));
  EXPECT_EQ(written["effects"]["external_heat.a"]["size"], 0.7);
  EXPECT_EQ(written["effects"]["column.bending.a"]["on"], true);
  expectEqual(truthOf(written).truth.total, truth.truth.total);
  EXPECT_EQ(nlohmann::json::parse(readFile(temp / "v2/simulator.json"))["history"][0]["what"], "two mechanisms");
  EXPECT_EQ(readFile(temp / "sim/scenario.json"), scenario.dump(1));
}

TEST_F(ScenarioSimulatorTest, AVersionKeepsTheSizeOfAStrength) {
  const VirtualCampaign truth = truthOf(scenario);
  const ObservationSet& at = *truth.campaign.observations;
  const auto simulator = open();
  const std::vector<double> found = simulator->run({{"physics.friction", 1.4}}, at, {}).predicted;
  simulator->writeVersion({{"physics.friction", 1.4}}, temp / "v2", {{"what", "friction"}});
  const ScenarioSimulator second(openSimulatorFile(temp / "v2/simulator.json"));
  expectEqual(second.run({}, at, {}).predicted, found, 1e-6);
}

TEST_F(ScenarioSimulatorTest, RefusesPathsThatLeadNowhere) {
  const auto said = [&](const std::string& name) {
    nlohmann::json changed = json;
    changed["parameters"].push_back(parameter(name, 0, 0, 5));
    temp.write("sim/scenario.json", scenario.dump(1));
    const fs::path file = temp.write("sim/simulator.json", changed.dump(1));
    return refusal([&] { ScenarioSimulator(openSimulatorFile(file)); });
  };
  for (const char* name : {"friction", "physics.frction", "physics", "environment.ramp", "effects.no.such.effect.size",
                           "effects.column.bending.a.strength", "effects.column.bending.a.onset_s",
                           "instrument.sigma_um", "machine.name", "programme.segments.9.spindle_rpm", "seed"}) {
    EXPECT_THAT(said(name), AllOf(HasSubstr("$.parameters[1].name"), HasSubstr("the path of a number"))) << name;
  }
  json["sensor_values"] = {{"sensor.T_room_degC.gain", 0.1}};
  EXPECT_THAT(said("environment.ramp_K_per_h"),
              AllOf(HasSubstr("$.sensor_values"), HasSubstr("makes its own temperatures")));
  json.erase("sensor_values");
  EXPECT_EQ(open()->find("sensor.T_ambient_degC.gain"), nullptr) << "none that could change a prediction";
  scenario["effects"]["spindle.drift.y"] = 1;
  EXPECT_THAT(said("effects.spindle.drift.y.size"), HasSubstr("the path of a number"));
  scenario["effects"].erase("spindle.drift.y");
  EXPECT_THAT(said("effects.external_heat.a.onset_s"), HasSubstr("whose size is a parameter as well"));
  json["scenario"] = "../scenario.json";
  EXPECT_THAT(said("environment.ramp_K_per_h"), HasSubstr("within the folder"));
  json["scenario"] = "scenario.json";
  json["parameters"][0] = parameter("physics.friction", 0, 0, 5);
  EXPECT_THAT(said("environment.ramp_K_per_h"), HasSubstr("greater than zero"));
}

TEST_F(ScenarioSimulatorTest, AValueThatTheVirtualMachineDoesNotTakeIsAFailedRun) {
  const auto simulator = open();
  ObservationSet at = *truthOf(scenario).campaign.observations;
  try {
    (void)simulator->run({{"physics.friction", 0}}, at, {});
    FAIL();
  } catch (const SimulatorFailed& failure) {
    EXPECT_THAT(failure.what(), HasSubstr("does not run with physics.friction = 0"));
  }
}

}  // namespace
}  // namespace spindrift
