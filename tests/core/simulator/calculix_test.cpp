// SPDX-License-Identifier: GPL-3.0-or-later
// CalculiX itself on a rod of eight elements that grows as its room warms up: u = alpha L (T - T0). And what it says
// and leaves when it goes wrong, from a script in its place.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/text.h"
#include "core/simulator/c_frame.h"
#include "core/simulator/program_simulator.h"
#include "tests/core/simulator/small_simulator.h"

namespace spindrift {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using testing::expectOneSentence;
using testing::failure;
using ::testing::HasSubstr;
using testing::observation;
using testing::parameter;
using testing::refusal;

constexpr int elements = 8;
constexpr double length_mm = 80.0;
constexpr int states = 4;

/// Nodes 4 i + 1 ... 4 i + 4 at x = i L / 8.
std::string mesh() {
  std::string text = "*NODE, NSET=ALL\n";
  for (int i = 0; i <= elements; ++i) {
    const double x = i * length_mm / elements;
    const double corner[4][2] = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};
    for (int k = 0; k < 4; ++k) text += fmt::format("{}, {}, {}, {}\n", 4 * i + k + 1, x, corner[k][0], corner[k][1]);
  }
  text += "*ELEMENT, TYPE=C3D8, ELSET=ROD\n";
  for (int i = 0; i < elements; ++i) {
    const int n = 4 * i;
    text += fmt::format("{}, {}, {}, {}, {}, {}, {}, {}, {}\n", i + 1, n + 1, n + 2, n + 3, n + 4, n + 5, n + 6, n + 7,
                        n + 8);
  }
  return text + fmt::format("*NSET, NSET=OBSERVED\n1, {}\n", 4 * elements + 1);
}

std::string material() {
  return "*INCLUDE, INPUT=mesh.inp\n*MATERIAL, NAME=IRON\n*ELASTIC\n1.1e5, 0.28\n*EXPANSION, ZERO=0.\n{{alpha*1e-6}}\n"
         "*CONDUCTIVITY\n46.\n*SPECIFIC HEAT\n5e8\n*DENSITY\n7.2e-9\n*SOLID SECTION, ELSET=ROD, MATERIAL=IRON\n"
         "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nALL, 0.\n";
}

std::string heat() {
  std::string text = material() + "*AMPLITUDE, NAME=ROOM, TIME=TOTAL TIME\n{{table:ROOM}}\n";
  for (int k = 0; k < states; ++k) {
    text += "*STEP, INC=1000\n*HEAT TRANSFER, DIRECT\n300., 900.\n";
    if (k == 0) text += "*BOUNDARY, AMPLITUDE=ROOM\nALL, 11, 11, {{room_gain}}\n";
    text += "*NODE FILE, FREQUENCY=1000\nNT\n*END STEP\n";
  }
  return text;
}

std::string statics() {
  std::string text = material() + "*BOUNDARY\n1, 1, 3\n2, 1, 1\n2, 3, 3\n4, 1, 1\n";
  for (int k = 0; k < states; ++k) {
    text += fmt::format(
        "*STEP\n*STATIC\n*TEMPERATURE, FILE=heat.frd, BSTEP={}\n*NODE PRINT, NSET=OBSERVED\nU\n*END STEP\n", k + 1);
  }
  return text;
}

class CalculixTest : public testing::SimulatorTest {
 protected:
  CalculixTest() : log(std::vector<double>{0, 1000, 2000, 3600}) {
    log->setSignal("T_room_degC", {20, 22, 21, 25});
    temp.write("sim/mesh.inp", mesh());
    temp.write("sim/heat.inp.in", heat());
    temp.write("sim/mech.inp.in", statics());
    temp.write("sim/observe.csv",
               fmt::format("point,component,node,dof,weight\nTIP,EX,{0},1,1\nTIP,EX,1,1,-1\nTIP,EC,{0},1,0.5\n",
                           4 * elements + 1));
    json = nlohmann::json::parse(R"({"format": "spindrift-simulator", "version": 1, "kind": "calculix",
      "templates": ["heat.inp.in", "mech.inp.in"], "include": ["mesh.inp"],
      "run": [["ccx", "-i", "heat"], ["ccx", "-i", "mech"]], "displacements": "mech.dat",
      "unit_of_displacement": "mm", "observe": "observe.csv", "first_state_s": 0, "state_interval_s": 900,
      "increment_s": 300, "time_limit_s": 60, "tables": {"ROOM": {"column": "T_room_degC", "minus_first": true}}})");
    json["parameters"] = nlohmann::json::array({parameter("alpha", 11, 5, 20), parameter("room_gain", 1, 0, 2)});
    for (int k = 0; k <= states; ++k) at.rows.push_back(observation("TIP", Component::EX, 900.0 * k));
  }
  [[nodiscard]] std::unique_ptr<ProgramSimulator> open() const {
    return std::make_unique<ProgramSimulator>(openSimulatorFile(temp.write("sim/simulator.json", json.dump(1))), log);
  }
  /// A program in place of CalculiX.
  void replaceProgram(const std::string& script) {
    temp.write("sim/solve.sh", script);
    json["include"].push_back("solve.sh");
    json["run"] = nlohmann::json::parse(R"([["sh", "solve.sh"]])");
  }
  /// A .dat of `count` states with u = (state, 0, 0) um of the tip.
  static std::string dat(int count, const std::string& first = "1.000000E-03") {
    std::string text;
    for (int k = 1; k <= count; ++k) {
      text += fmt::format(" displacements (vx,vy,vz) for set OBSERVED and time  {:.7E}\n\n", static_cast<double>(k));
      text += "         1  0.000000E+00  0.000000E+00  0.000000E+00\n";
      text += fmt::format("        {}  {}  0.000000E+00  0.000000E+00\n", 4 * elements + 1,
                          k == 1 ? first : fmt::format("{:.6E}", 1e-3 * k));
    }
    return text;
  }

  nlohmann::json json;
  std::optional<OperatingLog> log;
  ObservationSet at;
};

TEST_F(CalculixTest, TheRodGrowsAsItShould) {
  if (!calculixIsInstalled()) GTEST_SKIP() << "ccx is not installed (Debian: calculix-ccx)";
  const auto simulator = open();
  EXPECT_NE(simulator->find("sensor.T_room_degC.gain"), nullptr);
  EXPECT_EQ(simulator->find("sensor.T_room_degC.offset"), nullptr);
  const auto expect = [&](const ParameterValues& values, double alpha, double gain) {
    const SimulatorRun run = simulator->run(values, at, {});
    ASSERT_EQ(run.rows.size(), 2u * (states + 1));
    for (int k = 0; k <= states; ++k) {
      const double rise_K = gain * (log->at("T_room_degC", 900.0 * k) - 20.0);
      const double growth_um = alpha * 1e-3 * length_mm * rise_K;
      EXPECT_NEAR(run.predicted[static_cast<std::size_t>(k)], growth_um, 1e-5 * std::abs(growth_um) + 1e-9) << k;
    }
  };
  expect({}, 11.0, 1.0);
  expect({{"alpha", 17.0}, {"room_gain", 0.5}}, 17.0, 0.5);
  expect({{"sensor.T_room_degC.gain", 0.25}}, 11.0, 0.8);
  EXPECT_EQ(foldersLeft(), 0u);
}

TEST_F(CalculixTest, TellsWhatCalculixSaysAndKeepsItsLog) {
  if (!calculixIsInstalled()) GTEST_SKIP() << "ccx is not installed (Debian: calculix-ccx)";
  temp.write("sim/mech.inp.in",
             statics() + "*NONSENSE, NSET=NOWHERE\n*STEP\n*STATIC\n*BOUNDARY\nNOWHERE, 1\n*END STEP\n");
  const std::string wrong = failure([&] { (void)open()->run({{"alpha", 12}}, at, {}); });
  expectOneSentence(wrong);
  EXPECT_THAT(wrong, AllOf(HasSubstr("\"ccx -i mech\""), HasSubstr("*ERROR"), HasSubstr("alpha = 12")));
  // A missing file is a message and status 0.
  std::string text = heat();
  temp.write("sim/heat.inp.in", text.replace(text.find("mesh.inp"), 8, "mush.inp"));
  const std::string missing = failure([&] { (void)open()->run({}, at, {}); });
  expectOneSentence(missing);
  EXPECT_THAT(missing, HasSubstr("\"ccx -i heat\""));
}

TEST_F(CalculixTest, GoesByTheOrderOfStatesAndCountsThem) {
  replaceProgram(fmt::format("cat > mech.dat <<'E'\n{}E\n", dat(states)));
  const SimulatorRun run = open()->run({}, at, {});
  for (int k = 0; k <= states; ++k) EXPECT_NEAR(run.predicted[static_cast<std::size_t>(k)], k, 1e-9);
  const auto said = [&](const std::string& script) {
    temp.write("sim/solve.sh", script);
    const std::string text = failure([&] { (void)open()->run({}, at, {}); });
    expectOneSentence(text);
    return text;
  };
  EXPECT_THAT(said(fmt::format("cat > mech.dat <<'E'\n{}E\n", dat(states - 1))),
              HasSubstr("holds 3 states; allowed: 4"));
  EXPECT_THAT(said(fmt::format("cat > mech.dat <<'E'\n{}E\n", dat(states, "NaN"))), HasSubstr("mech.dat, line 4"));
  EXPECT_THAT(said("echo ' *ERROR reading *BOUNDARY: node'; echo '  set does not exist.'\n"),
              HasSubstr("said \"*ERROR reading *BOUNDARY: node set does not exist\""));
  EXPECT_THAT(said("true\n"), HasSubstr("left no mech.dat"));
  EXPECT_THAT(said(": > mech.dat\n"), HasSubstr("holds no displacements"));
}

TEST_F(CalculixTest, RefusesADeckThatIsNotAsDescribed) {
  const auto said = [&](const char* key, const nlohmann::json& value) {
    nlohmann::json changed = json;
    changed[key] = value;
    const fs::path file = temp.write("sim/simulator.json", changed.dump(1));
    return refusal([&] { ProgramSimulator(openSimulatorFile(file), log); });
  };
  EXPECT_THAT(said("unit_of_displacement", "um"), HasSubstr("mm or m"));
  EXPECT_THAT(said("state_interval_s", 0), HasSubstr("greater than zero"));
  EXPECT_THAT(said("increment_s", -1), HasSubstr("greater than zero"));
  EXPECT_THAT(said("increment_s", 1e-6), HasSubstr("at most a million"));
  EXPECT_THAT(said("displacements", "mech.txt"), HasSubstr("a .dat"));
  EXPECT_THAT(said("observe", "nowhere.csv"), HasSubstr("a file in"));
  EXPECT_THAT(said("tables", nullptr), HasSubstr("names no table"));
  temp.write("sim/observe.csv", "point,component,node,dof,weight\nTIP,EX,1,4,1\n");
  EXPECT_THAT(refusal([&] { (void)open(); }), AllOf(HasSubstr("observe.csv, line 2"), HasSubstr("dof 4")));
}

}  // namespace
}  // namespace spindrift
