// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulator/sensitivity_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/simulator/small_simulator.h"

namespace spindrift {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::observation;
using testing::parameter;
using testing::refusal;

class SensitivityTableTest : public testing::SimulatorTest {
 protected:
  SensitivityTableTest() {
    json = {{"format", "spindrift-simulator"},
            {"version", 1},
            {"kind", "sensitivities"},
            {"table", "sensitivities.csv"},
            {"parameters", nlohmann::json::array({parameter("h", 10, 0, 20), parameter("sun", 0, 0, 100)})}};
    at.rows = {observation("P1", Component::EX, 0), observation("P1", Component::EX, 50),
               observation("P1", Component::EX, 100), observation("P2", Component::EZ, 100)};
  }
  [[nodiscard]] SensitivityTable open(const std::string& more = "") const {
    temp.write("sim/sensitivities.csv",
               "time_s,point,component,parameter,d_predicted\n"
               "0,P1,EX,h,0\n100,P1,EX,h,0.4\n0,P1,EX,sun,0\n100,P1,EX,sun,-0.02\n0,P2,EZ,sun,0\n200,P2,EZ,sun,1\n" +
                   more);
    const auto base = [](const ObservationSet& set) {
      std::vector<double> out;
      for (const Observation& o : set.rows) out.push_back(o.time_s / 100.0);
      return out;
    };
    return {openSimulatorFile(temp.write("sim/simulator.json", json.dump())), base};
  }
  nlohmann::json json;
  ObservationSet at;
};

TEST_F(SensitivityTableTest, IsTheBaseAndWhatTheParametersAdd) {
  const SensitivityTable table = open();
  EXPECT_TRUE(table.linear());
  const SimulatorRun own = table.run({}, at, {});
  EXPECT_DOUBLE_EQ(own.predicted[2], 1.0);
  const SimulatorRun run = table.run({{"h", 12}, {"sun", 50}}, at, {});
  EXPECT_DOUBLE_EQ(run.predicted[0], 0.0);
  EXPECT_DOUBLE_EQ(run.predicted[1], 0.5 + 2 * 0.2 - 50 * 0.01);
  EXPECT_DOUBLE_EQ(run.predicted[2], 1.0 + 2 * 0.4 - 50 * 0.02);
  EXPECT_DOUBLE_EQ(run.predicted[3], 1.0 + 50 * 0.5) << "h has no row of P2, so it does not move it";
  EXPECT_DOUBLE_EQ(table.run({{"sun", 50}}, at, {}).predicted[3], 1.0 + 50 * 0.5);
}

TEST_F(SensitivityTableTest, AVersionPredictsWhatItWasWrittenFor) {
  const SensitivityTable table = open();
  table.writeVersion({{"h", 12}}, temp / "v2", {{"what", "h"}});
  const auto base = [](const ObservationSet& set) { return std::vector<double>(set.rows.size(), 1.0); };
  const SensitivityTable second(openSimulatorFile(temp / "v2/simulator.json"), base);
  EXPECT_DOUBLE_EQ(second.find("h")->value, 12.0);
  EXPECT_DOUBLE_EQ(second.run({}, at, {}).predicted[2], 1.0 + 2 * 0.4);
  EXPECT_DOUBLE_EQ(second.run({{"h", 10}}, at, {}).predicted[2], 1.0);
  second.writeVersion({{"h", 13}}, temp / "v3", {{"what", "h"}});
  const SensitivityTable third(openSimulatorFile(temp / "v3/simulator.json"), base);
  EXPECT_DOUBLE_EQ(third.run({}, at, {}).predicted[2], 1.0 + 3 * 0.4);
}

TEST_F(SensitivityTableTest, RefusesParametersThatDoNotMatch) {
  const auto said = [&](const std::string& more) { return refusal([&] { (void)open(more); }); };
  EXPECT_THAT(said("0,P1,EX,friction,1\n"), AllOf(HasSubstr("line 8"), HasSubstr("\"friction\" is not a parameter")));
  EXPECT_THAT(said("100,P1,EX,h,1\n"), HasSubstr("rising times"));
  EXPECT_THAT(said("200,P1,ED,h,1\n"), HasSubstr("\"ED\" is not known"));
  EXPECT_THAT(said("200,P1,EX,h,nan\n"), HasSubstr("not a number"));
  json["parameters"].push_back(parameter("k", 40, 30, 50));
  EXPECT_THAT(said(""), HasSubstr("has no row of parameter k"));
  json["table"] = "../sensitivities.csv";
  EXPECT_THAT(said(""), HasSubstr("within the folder"));
}

}  // namespace
}  // namespace spindrift
