// SPDX-License-Identifier: GPL-3.0-or-later
// The finite-element example machine: its mesh, its deck, and what CalculiX makes of it where `ccx` is installed.
#include "core/simulator/c_frame.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/finite_elements/fe_deviation.h"
#include "core/machine/campaign.h"
#include "core/machine/simulation_table.h"
#include "core/simulator/child_program.h"
#include "core/simulator/deck_template.h"
#include "core/simulator/log_tables.h"
#include "core/simulator/simulator_file.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr double coarse_mm = 120.0;
constexpr double fine_mm = 70.0;

const CFrameMachine& machine(double largest_cell_mm = coarse_mm) {
  static const CFrameMachine coarse(CFrameDimensions{}, coarse_mm);
  static const CFrameMachine fine(CFrameDimensions{}, fine_mm);
  return largest_cell_mm == coarse_mm ? coarse : fine;
}

/// Smallest Jacobian determinant over the corners of an element, and its volume, from the places of its nodes.
std::pair<double, double> jacobianAndVolume(const BrickMesh& mesh, const BrickElement& element) {
  const auto node = [&](std::size_t corner) { return mesh.nodes_mm()[element.nodes[corner]]; };
  // Neighbours of each corner along the three directions of the element.
  constexpr std::array<std::array<std::size_t, 3>, 8> next{
      {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7}, {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}}};
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d a = node(next[corner][0]) - node(corner);
    const Eigen::Vector3d b = node(next[corner][1]) - node(corner);
    const Eigen::Vector3d c = node(next[corner][2]) - node(corner);
    smallest = std::min(smallest, a.cross(b).dot(c));
  }
  const Eigen::Vector3d size = node(6) - node(0);
  return {smallest, size.prod()};
}

double volumeOf(const CFrameMachine& m, const std::string& part) {
  double sum = 0.0;
  for (const std::size_t e : m.elementsOf(part)) sum += jacobianAndVolume(m.mesh(), m.mesh().elements()[e]).second;
  return sum;
}

double areaOf(const CFrameMachine& m, const std::string& set) {
  const CFrameFaces& faces = m.faces().at(set);
  double sum = 0.0;
  for (const std::size_t e : faces.elements) {
    std::array<Eigen::Vector3d, 4> p;
    for (std::size_t i = 0; i < 4; ++i) {
      p[i] = m.mesh().nodes_mm()[m.mesh().elements()[e].nodes[BrickMesh::cornersOf(faces.side)[i]]];
    }
    sum += 0.5 * (p[2] - p[0]).cross(p[3] - p[1]).norm();
  }
  return sum;
}

TEST(CFrameMesh, ElementsAreTurnedTheRightWayAndFillTheCastings) {
  const CFrameDimensions d;
  for (const double cell : {coarse_mm, fine_mm}) {
    const CFrameMachine& m = machine(cell);
    for (const BrickElement& element : m.mesh().elements()) {
      const auto [jacobian, volume] = jacobianAndVolume(m.mesh(), element);
      ASSERT_GT(jacobian, 0.0);
      ASSERT_NEAR(jacobian, volume, 1e-6 * volume);
    }
    const double bed = 2.0 * d.bed_half_width_mm * (d.bed_front_mm + d.bedRear_mm()) * d.bed_height_mm;
    const double hollow = 2.0 * (d.bed_half_width_mm - d.bed_wall_mm) *
                          (d.bed_front_mm + d.bedRear_mm() - 2.0 * d.bed_wall_mm) *
                          (d.bed_height_mm - 2.0 * d.bed_wall_mm);
    EXPECT_NEAR(volumeOf(m, "BED"), bed - hollow, 1e-6 * bed);
    const double table = 2.0 * d.table_half_length_mm * 2.0 * d.table_half_width_mm * d.table_thickness_mm;
    EXPECT_NEAR(volumeOf(m, "TABLE"), table, 1e-6 * table);
    const double height = d.column_top_mm + d.table_thickness_mm + d.saddle_height_mm;
    const double column = 2.0 * d.column_half_width_mm * d.column_depth_mm * height -
                          2.0 * (d.column_half_width_mm - d.column_wall_mm) *
                              (d.column_depth_mm - 2.0 * d.column_wall_mm) * (height - d.column_wall_mm);
    EXPECT_NEAR(volumeOf(m, "COLUMN"), column, 1e-6 * column);
    const double section = 4.0 * d.spindle_half_width_mm * d.spindle_half_width_mm;
    EXPECT_NEAR(volumeOf(m, "BEARING"), section * (d.front_bearing_mm + d.rear_bearing_mm), 1e-3);
    EXPECT_NEAR(volumeOf(m, "MOTOR"), section * d.motor_height_mm, 1e-3);
  }
  EXPECT_GT(machine(fine_mm).mesh().nodes_mm().size(), 2 * machine().mesh().nodes_mm().size());
}

TEST(CFrameMesh, LoadedAreasDoNotDependOnTheSizeOfTheCells) {
  const CFrameDimensions d;
  const double sun =
      2.0 * d.column_half_width_mm * d.column_top_mm - 2.0 * d.head_half_width_mm * (d.head_top_mm - d.head_bottom_mm);
  const double wet = 2.0 * d.column_half_width_mm * 2.0 * (d.table_half_width_mm - d.table_rim_mm);
  for (const double cell : {coarse_mm, fine_mm}) {
    EXPECT_NEAR(areaOf(machine(cell), "SUN_3"), sun, 1e-3);
    EXPECT_NEAR(areaOf(machine(cell), "WET_2"), wet, 1e-3);
  }
  ASSERT_EQ(machine().faces().size(), machine(fine_mm).faces().size());
  for (const auto& [name, faces] : machine().faces()) {
    EXPECT_NEAR(areaOf(machine(), name), areaOf(machine(fine_mm), name), 1e-3) << name;
  }
}

TEST(CFrameMesh, EveryFreeFaceStandsInOneSet) {
  std::set<std::pair<std::size_t, int>> seen;
  std::size_t count = 0;
  // A closed surface: the faces of each direction cancel.
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& [name, faces] : machine().faces()) {
    for (const std::size_t e : faces.elements) seen.emplace(e, faces.side);
    count += faces.elements.size();
    constexpr std::array<std::array<double, 3>, 6> outward{
        {{0, 0, -1}, {0, 0, 1}, {0, -1, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}}};
    const auto& n = outward[static_cast<std::size_t>(faces.side - 1)];
    sum += areaOf(machine(), name) * Eigen::Vector3d(n[0], n[1], n[2]);
  }
  EXPECT_EQ(seen.size(), count);
  EXPECT_EQ(count, machine().mesh().freeFaces().size());
  EXPECT_NEAR(sum.norm(), 0.0, 1e-2);
}

TEST(CFrameMesh, DimensionsThatMakeNoMachineAreRefused) {
  CFrameDimensions d;
  d.column_wall_mm = 300.0;
  EXPECT_THROW(CFrameMachine(d, coarse_mm), InputError);
  d = {};
  d.bed_half_width_mm = d.table_half_length_mm + 0.5;  // two planes 0.5 mm apart
  EXPECT_THROW(CFrameMachine(d, coarse_mm), InputError);
  EXPECT_THROW(CFrameMachine(CFrameDimensions{}, 0.0), InputError);
}

/// Value of an observation for given displacements (mm): um or urad.
template <typename Displacement>
double observed(const CFrameMachine& m, const CFrameObserved& row, const Displacement& u_mm) {
  double sum = 0.0;
  for (const auto& [key, weight] : row.weights) sum += weight * u_mm(m.mesh().nodes_mm()[key.first])[key.second];
  return 1000.0 * sum;
}

TEST(CFrameObservation, RigidMotionOfTheMachineIsNoDeviation) {
  for (const double cell : {coarse_mm, fine_mm}) {
    const CFrameMachine& m = machine(cell);
    for (const CFrameObserved& row : m.observed()) {
      for (int axis = 0; axis < 3; ++axis) {
        const Eigen::Vector3d unit = Eigen::Vector3d::Unit(axis);
        // 1 mm, and 1 mrad.
        EXPECT_NEAR(observed(m, row, [&](const Eigen::Vector3d&) { return unit; }), 0.0, 1e-5)
            << row.point << toString(row.component);
        EXPECT_NEAR(observed(m, row, [&](const Eigen::Vector3d& p) { return Eigen::Vector3d(1e-3 * unit.cross(p)); }),
                    0.0, 1e-5)
            << row.point << toString(row.component);
      }
    }
  }
}

TEST(CFrameObservation, GrowthInAllDirectionsMovesToolAndPointsApart) {
  const double strain = 1e-4;
  const CFrameDimensions d;
  for (const CFrameObserved& row : machine().observed()) {
    const auto point = std::find_if(cFramePoints().begin(), cFramePoints().end(),
                                    [&](const CFramePoint& p) { return p.id == row.point; });
    const Eigen::Vector3d p = point->position_mm;
    // The points grow away from the axis of the spindle, the carriage rises by its height above the table; tool, post
    // and levers do not grow.
    Eigen::Vector3d e = Eigen::Vector3d::Zero();
    if (!isRotation(row.component)) {
      e = 1e3 * strain * Eigen::Vector3d(300.0 - p.x(), 200.0 - p.y(), p.z() + d.tool_length_mm);
    }
    EXPECT_NEAR(observed(machine(), row, [&](const Eigen::Vector3d& at) { return Eigen::Vector3d(strain * at); }),
                e[axisIndex(row.component)], 1e-4)
        << row.point << toString(row.component);
  }
}

TEST(CFrameObservation, LeanOfTheColumnMovesAndTurnsTheTool) {
  // Only what is above the table moves: the column, turned by 1e-4 about X through the table's top. It leans forward.
  const double lean = 1e-4;
  const auto u = [&](const Eigen::Vector3d& p) {
    return p.z() > 1.0 ? Eigen::Vector3d(lean * Eigen::Vector3d::UnitX().cross(p)) : Eigen::Vector3d(0.0, 0.0, 0.0);
  };
  for (const CFrameObserved& row : machine().observed()) {
    if (row.point != "F10") continue;  // middle of the travels, 320 mm above the table
    double expected = 0.0;
    if (row.component == Component::EY) expected = -1e3 * lean * 320.0;
    if (row.component == Component::EA) expected = 1e6 * lean;
    EXPECT_NEAR(observed(machine(), row, u), expected, 1e-4) << toString(row.component);
  }
}

CFrameDeckOptions fewStates(int states = 3) {
  CFrameDeckOptions options;
  options.states = states;
  options.largest_cell_mm = 200.0;
  return options;
}

/// Tables of the deck over its duration, as the simulator makes them.
std::map<std::string, std::string> tablesOf(const CFrameDeck& deck, const OperatingLog& log,
                                            const CFrameValues& values) {
  const testing::TempFolder folder;
  deck.write(folder.path());
  const SimulatorFile file = openSimulatorFile(folder.path() / "simulator.json");
  const LogTables tables(file.root.at("tables"), log, file.parameters);
  ParameterValues all(values.begin(), values.end());
  for (const SimulatorParameter& sensor : tables.sensors()) all[sensor.name] = sensor.value;
  return tables.text({0.0, deck.options.increment_s, deck.options.duration_s()}, all);
}

std::string filled(const std::string& text, const CFrameValues& values,
                   const std::map<std::string, std::string>& tables) {
  std::vector<std::string> names;
  for (const auto& [name, value] : values) names.push_back(name);
  std::vector<std::string> table_names;
  for (const auto& [name, table] : tables) table_names.push_back(name);
  return DeckTemplate(text, "deck.inp.in", names, table_names)
      .filled(ParameterValues(values.begin(), values.end()), tables);
}

TEST(CFrameDeck, FilledFilesHoldNoPlaceholder) {
  const CFrameDeck deck = CFrameDeck::make(fewStates());
  const OperatingLog log = cFrameLog(deck.options.duration_s(), 3);
  const auto tables = tablesOf(deck, log, deck.values());
  for (const std::string& text : {deck.heat_template, deck.mech_template}) {
    EXPECT_THAT(text, HasSubstr("{{"));
    EXPECT_THAT(filled(text, deck.values(), tables), Not(HasSubstr("{{")));
  }
}

TEST(CFrameDeck, EveryElementSetOfTheLoadsIsInTheMesh) {
  const CFrameDeck deck = CFrameDeck::make(fewStates());
  for (const std::string& line : splitList(deck.heat_template, '\n')) {
    const auto fields = splitList(line, ',');
    if (line.starts_with("*") || fields.size() < 3 || !std::isalpha(static_cast<unsigned char>(line[0]))) continue;
    EXPECT_THAT(deck.mesh, HasSubstr("ELSET=" + fields[0] + "\n")) << line;
  }
}

TEST(CFrameDeck, TablesAreMeansOverTheIncrementOrValuesAtItsEnd) {
  const CFrameDeck deck = CFrameDeck::make(fewStates(1));
  OperatingLog log({0.0, 120.0, 450.0, 900.0});
  log.setSignal("spindle_rpm", {0.0, 4000.0, 0.0, 0.0});
  log.setSignal("coolant", {0.0, 0.0, 1.0, 1.0});
  log.setSignal("T_ambient_degC", {20.0, 20.0, 23.0, 21.2});
  CFrameValues values = deck.values();
  values["sun_on_s"] = 150.0;
  values["sun_off_s"] = 660.0;
  const auto tables = tablesOf(deck, log, values);
  EXPECT_EQ(tables.at("MOTOR"), "0, 0\n300, 2.4\n600, 2\n900, 0");
  EXPECT_EQ(tables.at("FRICTION"), "0, 0\n300, 4.8\n600, 4\n900, 0");
  EXPECT_EQ(tables.at("COOLANT"), "0, 0\n300, 0\n600, 0.5\n900, 1");
  EXPECT_EQ(tables.at("SUN"), "0, 0\n300, 0.5\n600, 1\n900, 0.2");
  EXPECT_EQ(tables.at("ROOM"), "0, 0\n300, 1.63636363636\n600, 2.4\n900, 1.2");
}

TEST(CFrameDeck, OptionsThatCannotBeAreRefused) {
  CFrameDeckOptions options = fewStates();
  options.increment_s = 400.0;
  EXPECT_THROW((void)CFrameDeck::make(options), InputError);
  options = fewStates();
  options.values["h_water"] = 3.0;
  EXPECT_THROW((void)CFrameDeck::make(options), InputError);
  options = fewStates();
  options.values["k_iron"] = 3.0;
  EXPECT_THROW((void)CFrameDeck::make(options), InputError);
  options = fewStates(0);
  EXPECT_THROW((void)CFrameDeck::make(options), InputError);
}

TEST(CFrameDeck, EveryParameterIsDescribed) {
  const CFrameDeck deck = CFrameDeck::make(fewStates());
  for (const nlohmann::json& p : deck.simulator.at("parameters")) {
    const auto name = p.at("name").get<std::string>();
    EXPECT_THAT(deck.heat_template + deck.mech_template + deck.simulator.at("tables").dump(), HasSubstr(name));
    EXPECT_LE(p.at("min").get<double>(), p.at("value").get<double>()) << name;
    EXPECT_GE(p.at("max").get<double>(), p.at("value").get<double>()) << name;
    EXPECT_GT(p.at("standard_uncertainty").get<double>(), 0.0) << name;
    EXPECT_TRUE(p.at("effects").is_array()) << name;
    EXPECT_FALSE(p.at("what").get<std::string>().empty());
  }
}

class CFrameSolved : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!calculixIsInstalled()) GTEST_SKIP() << "CalculiX (ccx) is not installed";
    setenv("SPINDRIFT_CACHE", cache_.path().c_str(), 1);  // NOLINT(concurrency-mt-unsafe): nothing of earlier runs
  }

 private:
  testing::TempFolder cache_;
};

/// Rows by point and component at the end of a state (from 1).
std::map<std::pair<std::string, Component>, double> stateOf(const std::vector<SimulationRow>& rows, double time_s) {
  std::map<std::pair<std::string, Component>, double> out;
  for (const SimulationRow& row : rows) {
    if (row.time_s == time_s) out[{row.point, row.component}] = row.predicted;
  }
  return out;
}

/// Same expansion of all parts: a machine that is evenly warm moves as the closed form says.
double evenlyWarm_um(const SimulationRow& row, double um_per_m) {
  const auto point = std::find_if(cFramePoints().begin(), cFramePoints().end(),
                                  [&](const CFramePoint& p) { return p.id == row.point; });
  const Eigen::Vector3d p = point->position_mm;
  if (isRotation(row.component)) return 0.0;
  const Eigen::Vector3d arm(300.0 - p.x(), 200.0 - p.y(), p.z() + CFrameDimensions().tool_length_mm);
  return 1e-3 * um_per_m * arm[axisIndex(row.component)];
}

TEST_F(CFrameSolved, UniformTemperatureGivesTheClosedForm) {
  // The static part alone: 10 K everywhere, one expansion for all parts. No stress, u = alpha dT x.
  CFrameDeckOptions options = fewStates(1);
  options.values = {{"alpha_iron", 11.0}, {"alpha_steel", 11.0}};
  const CFrameDeck deck = CFrameDeck::make(options);
  std::string mech = filled(deck.mech_template, deck.values(), {});
  const std::string from_file = "*TEMPERATURE, FILE=heat.frd, BSTEP=1\n";
  ASSERT_THAT(mech, HasSubstr(from_file));
  mech.replace(mech.find(from_file), from_file.size(), "*TEMPERATURE\nALL, 10.\n");
  const testing::TempFolder folder;
  folder.write("mesh.inp", deck.mesh);
  folder.write("observe.csv", deck.observe);
  folder.write("mech.inp", mech);
  JobContext job;
  const ChildEnd end = runProgram({{"ccx", "-i", "mech"}, folder.path(), folder.path() / "ccx.log", 60.0, {}}, job);
  ASSERT_EQ(end.code, 0) << readFile(folder.path() / "ccx.log");
  FeMap map;
  map.result = folder.path() / "mech.dat";
  map.observe = folder.path() / "observe.csv";
  map.unit_of_displacement = "mm";
  const FeDeviation fe = feDeviation(map, openDat, job);
  EXPECT_EQ(fe.rows.size(), 38u);
  for (const SimulationRow& row : fe.rows) {
    EXPECT_NEAR(row.predicted, evenlyWarm_um(row, 10.0 * 11.0), isRotation(row.component) ? 0.2 : 0.01)
        << row.point << toString(row.component);
  }
}

TEST_F(CFrameSolved, AfterDaysInAWarmerRoomTheMachineIsAsWarm) {
  CFrameDeckOptions options = fewStates(2);
  options.state_interval_s = 4.0 * 86'400.0;
  options.increment_s = 0.25 * 86'400.0;
  options.values = {{"alpha_iron", 11.0}, {"alpha_steel", 11.0}};
  OperatingLog log({0.0, 1.0});
  log.setSignal("spindle_rpm", {0.0, 0.0});
  log.setSignal("coolant", {0.0, 0.0});
  log.setSignal("T_ambient_degC", {21.0, 24.0});
  const JobContext job;
  for (const SimulationRow& row : runDeck(CFrameDeck::make(options), log, {}, job)) {
    if (row.time_s != options.duration_s()) continue;
    EXPECT_NEAR(row.predicted, evenlyWarm_um(row, 3.0 * 11.0), isRotation(row.component) ? 0.2 : 0.02)
        << row.point << toString(row.component);
  }
}

TEST_F(CFrameSolved, HeatThatCannotLeaveWarmsTheMachineByItsEnergy) {
  // Without films, weeks after twelve hours of friction or sun: dT = energy / (sum of rho c V) everywhere.
  CFrameDeckOptions options = fewStates(1);
  options.state_interval_s = 60.0 * 86'400.0;
  options.increment_s = 86'400.0;
  options.values = {{"alpha_iron", 11.0}, {"alpha_steel", 11.0}, {"sun_on_s", 0.0}, {"sun_off_s", 43'200.0}};
  const CFrameMachine body(options.dimensions, options.largest_cell_mm);
  const CFrameDeck deck = CFrameDeck::make(options, body);
  OperatingLog log({0.0, 43'200.0});
  log.setSignal("spindle_rpm", {4000.0, 0.0});
  log.setSignal("coolant", {0.0, 0.0});
  log.setSignal("T_ambient_degC", {21.0, 21.0});
  double capacity_J_K = 0.0;
  for (const BrickElement& element : body.mesh().elements()) {
    const bool steel = body.mesh().bricks()[element.brick].material == "STEEL";
    const double volume_m3 = 1e-9 * jacobianAndVolume(body.mesh(), element).second;
    capacity_J_K += volume_m3 * (steel ? 7850.0 * 470.0 : 7200.0 * deck.values().at("cp_iron"));
  }
  const double friction_W = 2.0e3 * 1e-9 * volumeOf(body, "BEARING") * std::pow(4.0, 1.5);
  const double sun_W = 50.0 * 1e-6 * areaOf(body, "SUN_3");
  const JobContext job;
  for (const bool sun : {false, true}) {
    const CFrameValues changes{
        {"h_air", 0.0}, {"h_inside", 0.0}, {"friction", sun ? 0.0 : 2.0}, {"sun_front", sun ? 50.0 : 0.0}};
    const double warmer_K = (sun ? sun_W : friction_W) * 43'200.0 / capacity_J_K;
    for (const SimulationRow& row : runDeck(deck, log, changes, job)) {
      if (row.time_s != options.duration_s() || isRotation(row.component)) continue;
      const double expected = evenlyWarm_um(row, warmer_K * 11.0);
      EXPECT_NEAR(row.predicted, expected, 0.005 * std::abs(expected) + 0.01) << row.point << toString(row.component);
    }
  }
}

TEST_F(CFrameSolved, LoadsSuperposeAndMoveTheToolTheRightWay) {
  const CFrameDeckOptions options = fewStates(3);
  const CFrameDeck deck = CFrameDeck::make(options);
  std::vector<double> time_s;
  for (double t = 0.0; t <= deck.options.duration_s(); t += 60.0) time_s.push_back(t);
  OperatingLog log(time_s);
  log.setSignal("spindle_rpm", std::vector<double>(time_s.size(), 6000.0));
  log.setSignal("coolant", std::vector<double>(time_s.size(), 1.0));
  log.setSignal("T_ambient_degC", std::vector<double>(time_s.size(), 21.0));
  const JobContext job;
  const auto run = [&](const CFrameValues& changes) { return runDeck(deck, log, changes, job); };
  const std::vector<SimulationRow> nothing = run({{"friction", 0.0}});
  const std::vector<SimulationRow> friction = run({});
  const std::vector<SimulationRow> sun = run({{"friction", 0.0}, {"sun_front", 200.0}});
  const std::vector<SimulationRow> both = run({{"sun_front", 200.0}});
  ASSERT_EQ(both.size(), 4u * 38u);
  double largest = 0.0;
  for (std::size_t i = 0; i < both.size(); ++i) {
    EXPECT_NEAR(nothing[i].predicted, 0.0, 1e-6);
    EXPECT_NEAR(both[i].predicted, friction[i].predicted + sun[i].predicted, 0.01);
    largest = std::max(largest, std::abs(both[i].predicted));
  }
  EXPECT_GT(largest, 1.0);

  auto first = stateOf(friction, 900.0);
  // The spindle grows towards the table: the tool comes down.
  EXPECT_LT((first[{"F5", Component::EZ}]), -0.5);
  auto warm = stateOf(sun, 2700.0);
  // The warm front is the longer side: the column bends backwards, its top moves along +Y, which is a turn about -X;
  // the head, in front of the column, is lifted by that and by the column's growth.
  EXPECT_GT((warm[{"F10", Component::EY}]), 0.1);
  EXPECT_LT((warm[{"F10", Component::EA}]), -1.0);
  EXPECT_GT((warm[{"F10", Component::EZ}]), 0.1);
  // More at 320 mm than at 20 mm above the table.
  EXPECT_GT((warm[{"F10", Component::EY}]), (warm[{"F5", Component::EY}]));
  // Machine, friction and sun are symmetric about the middle of X.
  EXPECT_NEAR((warm[{"F10", Component::EX}]), 0.0, 0.01);
  EXPECT_NEAR((first[{"F5", Component::EX}]), 0.0, 0.01);
}

TEST_F(CFrameSolved, ARoomThatWarmsUpMakesTheMachineGrow) {
  const CFrameDeck deck = CFrameDeck::make(fewStates(3));
  OperatingLog log({0.0, 1.0, 2700.0});
  log.setSignal("spindle_rpm", {0.0, 0.0, 0.0});
  log.setSignal("coolant", {0.0, 0.0, 0.0});
  log.setSignal("T_ambient_degC", {21.0, 24.0, 24.0});
  const JobContext job;
  auto warm = stateOf(runDeck(deck, log, {}, job), 2700.0);
  EXPECT_GT((warm[{"F10", Component::EZ}]), 0.1);
  EXPECT_GT((warm[{"F10", Component::EZ}]), (warm[{"F5", Component::EZ}]));
  // Points of the table move outwards: the tool is left behind.
  EXPECT_GT((warm[{"F1", Component::EX}]), 0.0);
  EXPECT_LT((warm[{"F2", Component::EX}]), 0.0);
  for (const auto& [key, value] : stateOf(runDeck(deck, log, {{"room_gain", 0.0}}, job), 2700.0)) {
    EXPECT_NEAR(value, 0.0, 1e-6);
  }
}

TEST_F(CFrameSolved, ACancelledCampaignLeavesNothing) {
  const testing::TempFolder folder;
  std::stop_source stop;
  stop.request_stop();
  const JobContext cancelled(stop.get_token(), nullptr);
  const std::filesystem::path out = folder.path() / "campaign";
  EXPECT_THROW((void)writeCFrameCampaign(CFrameStory::Sun, out, 1, cancelled), Cancelled);
  EXPECT_FALSE(std::filesystem::exists(out));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "campaign.truth.json"));
}

TEST_F(CFrameSolved, ACampaignIsWholeAndTheTruthStandsBesideIt) {
  const testing::TempFolder folder;
  CFrameCampaignOptions options;
  options.coarse_cell_mm = 200.0;
  options.fine_cell_mm = 150.0;
  options.states = 4;
  const std::filesystem::path out = folder.path() / "campaign";
  const JobContext job;
  const CFrameCampaign written = writeCFrameCampaign(CFrameStory::Friction, out, 5, job, options);
  const Campaign campaign = Campaign::read(out);
  ASSERT_TRUE(campaign.observations.has_value());
  EXPECT_EQ(campaign.observations->rows.size(), 5u * 38u);
  EXPECT_EQ(written.observations, 5u * 38u);
  std::size_t heldout = 0;
  for (const Observation& row : campaign.observations->rows) heldout += row.use == ObservationUse::Holdout ? 1 : 0;
  EXPECT_EQ(heldout, 2u * 38u);
  EXPECT_EQ(campaign.simulator, "fe/simulator.json");
  for (const char* file : {"simulator.json", "mesh.inp", "heat.inp.in", "mech.inp.in", "observe.csv"}) {
    EXPECT_TRUE(std::filesystem::exists(out / "fe" / file)) << file;
  }
  EXPECT_NO_THROW((void)SimulationTable::read(out / "simulation.csv"));
  const auto truth = nlohmann::json::parse(readFile(folder.path() / "campaign.truth.json"));
  EXPECT_EQ(truth["hidden"]["friction"], hiddenValues(CFrameStory::Friction, 3600.0).at("friction"));
  EXPECT_LT(truth["gap_with_hidden"]["heldout_rms_um"].get<double>(), truth["gap"]["heldout_rms_um"].get<double>());
  EXPECT_THROW((void)writeCFrameCampaign(CFrameStory::Friction, out, 5, job, options), InputError);
}

TEST(CFrameStories, WithoutCalculixASentenceSaysWhatToInstall) {
  const char* path = std::getenv("PATH");  // NOLINT(concurrency-mt-unsafe): one thread
  const std::string before = path == nullptr ? "" : path;
  setenv("PATH", "/nowhere", 1);  // NOLINT(concurrency-mt-unsafe)
  const testing::TempFolder folder;
  const std::filesystem::path out = folder.path() / "campaign";
  try {
    (void)writeCFrameCampaign(CFrameStory::Sun, out, 1, JobContext());
    ADD_FAILURE() << "no error";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("install calculix-ccx"));
  }
  EXPECT_FALSE(std::filesystem::exists(out));
  setenv("PATH", before.c_str(), 1);  // NOLINT(concurrency-mt-unsafe)
}

TEST(CFrameStories, NamesAndHiddenCausesBelongTogether) {
  for (const std::string& name : cFrameStoryNames()) {
    const auto story = cFrameStoryFromString(name);
    ASSERT_TRUE(story.has_value());
    EXPECT_EQ(toString(*story), name);
    CFrameDeckOptions options;
    options.values = simulatedValues(*story);
    for (const auto& [parameter, value] : hiddenValues(*story, options.duration_s())) options.values[parameter] = value;
    EXPECT_NO_THROW(options.validate());
  }
  EXPECT_FALSE(cFrameStoryFromString("rain").has_value());
}

TEST(CFrameLog, IsADayInAShop) {
  const OperatingLog log = cFrameLog(28'800.0, 7);
  EXPECT_EQ(log.time_s().size(), 481u);
  const std::vector<double>& rpm = *log.signal("spindle_rpm");
  EXPECT_EQ(rpm.front(), 0.0);
  EXPECT_EQ(*std::max_element(rpm.begin(), rpm.end()), 8000.0);
  const std::vector<double>& room = *log.signal("T_ambient_degC");
  const auto [low, high] = std::minmax_element(room.begin(), room.end());
  EXPECT_GT(*high - *low, 1.5);
  EXPECT_LT(*high - *low, 5.0);
  EXPECT_NE(room, *cFrameLog(28'800.0, 8).signal("T_ambient_degC"));
}

}  // namespace
}  // namespace spindrift
