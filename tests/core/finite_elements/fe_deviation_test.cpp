// SPDX-License-Identifier: GPL-3.0-or-later
// tests/data/finite_elements/make.py says what the machine does in its four states.
#include "core/finite_elements/fe_deviation.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "tests/support/outside_folder.h"
#include "tests/support/refusal.h"
#include "tests/support/source_folder.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::filesystem::path data = spindrift::testing::testData() / "finite_elements";

FeNodes set(const std::string& name) {
  return FeNodes::parse(name);
}

FeMap frame() {
  FeMap map;
  map.result = data / "frame.frd";
  map.mesh = data / "mesh.inp";
  map.unit_of_displacement = "mm";
  map.points = {{"P1", set("TOOL"), set("TABLE")}};
  map.components = {all_components.begin(), all_components.end()};
  return map;
}

FeDeviation deviation(const FeMap& map) {
  JobContext job;
  return feDeviation(map, openFeResult, job);
}

double value(const FeDeviation& fe, double time_s, Component component, const std::string& point = "P1") {
  for (const SimulationRow& row : fe.rows) {
    if (row.point == point && row.component == component && row.time_s == time_s) return row.predicted;
  }
  ADD_FAILURE() << "no row";
  return std::nan("");
}

std::string refusal(const FeMap& map) {
  return testing::refusal([&] { (void)deviation(map); });
}

std::string mapRefusal(const std::string& json) {
  const testing::TempFolder folder;
  try {
    FeMap::read(folder.write("fe.json", json)).validate();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(FeDeviation, RecoversExpansionTurnAndLean) {
  const FeDeviation fe = deviation(frame());
  EXPECT_EQ(fe.states, 4u);
  EXPECT_EQ(fe.nodes, 12u);
  EXPECT_EQ(fe.rows.size(), 24u);
  EXPECT_TRUE(fe.plausible);
  EXPECT_THAT(fe.notes, IsEmpty());
  // Tool 300 mm above the table, 10 K and 20 K, 11 um/(m K).
  EXPECT_NEAR(value(fe, 900.0, Component::EZ), 33.0, 1e-3);
  EXPECT_NEAR(value(fe, 1800.0, Component::EZ), 66.0, 1e-3);
  for (const Component c : {Component::EX, Component::EY, Component::EA, Component::EB, Component::EC}) {
    EXPECT_NEAR(value(fe, 900.0, c), 0.0, 1e-3);
  }
  // Turned as a whole by 100 urad about X: no relative rotation, the tool goes back by 100 urad x 300 mm.
  EXPECT_NEAR(value(fe, 2700.0, Component::EY), -30.0, 1e-3);
  EXPECT_NEAR(value(fe, 2700.0, Component::EZ), 0.0, 1e-3);
  EXPECT_NEAR(value(fe, 2700.0, Component::EA), 0.0, 1e-2);
  // A warm front leans the column back, and the head with it.
  EXPECT_LT(value(fe, 3600.0, Component::EA), -20.0);
  EXPECT_NEAR(value(fe, 3600.0, Component::EX), 0.0, 0.5);
  // Its slope along Y, from the printed displacements themselves.
  const FeMesh mesh = readAbaqusMesh(data / "mesh.inp");
  const std::vector<NodeId>& observed = mesh.sets.at("OBSERVED");
  const FeState last = openFeResult(data / "frame.dat")->states({observed.begin(), observed.end()}).back();
  const auto slope = [&](const char* name) {
    double sum = 0.0;
    for (const NodeId id : mesh.sets.at(name)) {
      sum += last.displacement.at(id).z() * (mesh.nodes.at(id).y() > 150.0 ? 1.0 : -1.0) / 3.0;
    }
    return sum / 100.0 * 1e6;
  };
  EXPECT_NEAR(value(fe, 3600.0, Component::EA), slope("TOOL") - slope("TABLE"), 0.1);
}

TEST(FeDeviation, CarriesADisplacementToAPlace) {
  FeMap map = frame();
  map.points[0].tool.at_mm = Eigen::Vector3d(100.0, 150.0, 500.0);
  const FeDeviation fe = deviation(map);
  EXPECT_NEAR(value(fe, 2700.0, Component::EY), -40.0, 1e-2);
  // Heat only grows: no turn, so no lever.
  EXPECT_NEAR(value(fe, 900.0, Component::EZ), 33.0, 1e-3);
}

TEST(FeDeviation, TurnsIntoTheFrameOfTheMachine) {
  FeMap map = frame();
  // The mesh's Y is the machine's X, its X the machine's -Y; shifted.
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.topLeftCorner<3, 3>() << 0, 1, 0, -1, 0, 0, 0, 0, 1;
  m.topRightCorner<3, 1>() << 1000.0, 50.0, -100.0;
  map.mcf_from_mesh = RigidTransform::fromMatrix(m);
  const FeDeviation fe = deviation(map);
  EXPECT_NEAR(value(fe, 2700.0, Component::EX), -30.0, 1e-3);
  EXPECT_NEAR(value(fe, 2700.0, Component::EY), 0.0, 1e-3);
  EXPECT_NEAR(value(fe, 3600.0, Component::EB), -value(deviation(frame()), 3600.0, Component::EA), 1e-6);
  // Nearest nodes are looked for in the machine's frame: the place of node (0, 100, 400).
  map.points[0].tool = FeNodes::parse("near:1100,50,300");
  map.points[0].table = FeNodes::parse("near:1100,50,0");
  map.components = {Component::EX, Component::EY, Component::EZ};
  const FeDeviation near = deviation(map);
  EXPECT_EQ(near.nodes, 2u);
  EXPECT_NEAR(value(near, 900.0, Component::EZ), 33.0, 1e-3);
  EXPECT_NEAR(value(near, 2700.0, Component::EX), -30.0, 1e-3);
}

TEST(FeDeviation, TakesNodesByNumberAndByPlace) {
  FeMap map = frame();
  map.components = {Component::EZ};
  map.points = {{"A", FeNodes::parse("near:0,100,400"), FeNodes::parse("nodes:1")},
                {"B", FeNodes::parse("near:100,150,390,6"), FeNodes::parse("TABLE")},
                {"C", FeNodes::parse("near:0,100,440"), FeNodes::parse("set:table")}};
  const FeDeviation fe = deviation(map);
  EXPECT_NEAR(value(fe, 900.0, Component::EZ, "A"), 44.0, 1e-3);
  EXPECT_NEAR(value(fe, 900.0, Component::EZ, "B"), 33.0, 1e-3);
  EXPECT_THAT(fe.notes, Contains(HasSubstr("40 mm away")));
}

TEST(FeDeviation, FromAPrintedTableAloneOrWithTheMesh) {
  FeMap map = frame();
  map.result = data / "frame.dat";
  const FeDeviation fe = deviation(map);
  const FeDeviation whole = deviation(frame());
  ASSERT_EQ(fe.rows.size(), whole.rows.size());
  for (std::size_t i = 0; i < fe.rows.size(); ++i) EXPECT_NEAR(fe.rows[i].predicted, whole.rows[i].predicted, 0.05);
  // Without a mesh: the sets printed, and no rotation.
  map.mesh.clear();
  EXPECT_THAT(refusal(map), HasSubstr("allowed: OBSERVED"));
  map.points = {{"P1", FeNodes::parse("nodes:13"), FeNodes::parse("nodes:7")}};
  EXPECT_THAT(refusal(map), HasSubstr("add the mesh"));
  map.components = {Component::EZ};
  EXPECT_NEAR(value(deviation(map), 900.0, Component::EZ), 33.0, 1e-3);
  map.points = {{"P1", FeNodes::parse("nodes:13"), FeNodes::parse("nodes:1")}};
  EXPECT_THAT(refusal(map), HasSubstr("no displacement of node 1 in state 1"));
}

TEST(FeDeviation, WeighsNodesAsObserved) {
  const testing::TempFolder folder;
  FeMap map = frame();
  map.points.clear();
  map.observe = folder.write(
      "observe.csv", "point,component,node,dof,weight\nP1,EZ,13,3,1\nP1,EZ,7,3,-1\nP1,EY,13,2,0.5\nP1,EY,7,2,-0.5\n");
  const FeDeviation fe = deviation(map);
  EXPECT_NEAR(value(fe, 900.0, Component::EZ), 33.0, 1e-3);
  EXPECT_NEAR(value(fe, 2700.0, Component::EY), -15.0, 1e-3);
  const auto said = [&](const std::string& row) {
    map.observe = folder.write("bad.csv", "point,component,node,dof,weight\n" + row);
    return refusal(map);
  };
  EXPECT_THAT(said("P1,EZ,13,4,1\n"), HasSubstr("dof 4"));
  EXPECT_THAT(said("P1,EQ,13,3,1\n"), HasSubstr("EQ"));
  EXPECT_THAT(said("P1,EZ,1300,3,1\n"), HasSubstr("no node 1300"));
  EXPECT_THAT(said(""), HasSubstr("at least one"));
}

TEST(FeDeviation, OneRowForEachNodeOfTheTable) {
  FeMap map = frame();
  map.points.clear();
  map.components = {Component::EX, Component::EZ};
  map.each_table_node = FePoint{"", set("TOOL"), set("TABLE")};
  const FeDeviation fe = deviation(map);
  EXPECT_TRUE(fe.by_place);
  EXPECT_EQ(fe.rows.size(), 4u * 6u * 2u);
  for (const SimulationRow& row : fe.rows) {
    if (row.time_s != 900.0) continue;
    const double expected = row.component == Component::EZ ? 33.0 : 0.11 * (100.0 - row.position_mm.x());
    EXPECT_NEAR(row.predicted, expected, 1e-3);
  }
  map.components = {Component::EA};
  EXPECT_THAT(refusal(map), HasSubstr("rotation of a single table node"));
}

TEST(FeDeviation, TakesTimesAsToldAndDoubtsStepNumbers) {
  FeMap map = frame();
  map.first_state_s = 0.0;
  const FeDeviation with_first = deviation(map);
  EXPECT_EQ(value(with_first, 0.0, Component::EZ), 0.0);
  EXPECT_NEAR(value(with_first, 900.0, Component::EZ), 33.0, 1e-3);
  map.first_state_s = 100.0;
  map.state_interval_s = 600.0;
  const FeDeviation shifted = deviation(map);
  EXPECT_EQ(value(shifted, 100.0, Component::EZ), 0.0);
  EXPECT_NEAR(value(shifted, 700.0, Component::EZ), 33.0, 1e-3);
  EXPECT_DOUBLE_EQ(shifted.last_s, 2500.0);
  map.state_interval_s.reset();
  map.first_state_s = 900.0;
  EXPECT_THAT(refusal(map), HasSubstr("not before the first state"));
  // Steps of a static job are numbered, not timed.
  const testing::TempFolder folder;
  std::string text = readFile(data / "frame.dat");
  const char* written[] = {"0.9000000E+03", "0.1800000E+04", "0.2700000E+04", "0.3600000E+04"};
  for (int k = 0; k < 4; ++k) {
    const std::size_t at = text.find(written[k]);
    ASSERT_NE(at, std::string::npos);
    text.replace(at, 13, fmt::format("0.{}000000E+01", k + 1));
  }
  FeMap steps = frame();
  steps.result = folder.write("steps.dat", text);
  EXPECT_THAT(deviation(steps).notes, Contains(HasSubstr("look like numbers of steps")));
  steps.first_state_s = 0.0;
  steps.state_interval_s = 900.0;
  EXPECT_THAT(deviation(steps).notes, IsEmpty());
  EXPECT_NEAR(value(deviation(steps), 1800.0, Component::EZ), 66.0, 1e-3);
}

TEST(FeDeviation, NoticesTheWrongUnit) {
  FeMap map = frame();
  map.unit_of_displacement = "m";
  const FeDeviation large = deviation(map);
  EXPECT_FALSE(large.plausible);
  EXPECT_THAT(large.notes, Contains(HasSubstr("implausibly large: is it in mm?")));
  EXPECT_THAT(large.notes, Contains(HasSubstr("m large if its unit is m")));
  // Metres, read as mm.
  const testing::TempFolder folder;
  std::string text;
  for (const std::string& line : splitList(readFile(data / "frame.dat"), '\n')) {
    const std::vector<std::string> f = splitList(line, ' ');
    double u[3];
    if (f.size() == 4 && parseNumber(f[1], u[0]) && parseNumber(f[2], u[1]) && parseNumber(f[3], u[2])) {
      text += fmt::format("{} {:.6E} {:.6E} {:.6E}\n", f[0], u[0] / 1e3, u[1] / 1e3, u[2] / 1e3);
    } else {
      text += line + "\n";
    }
  }
  FeMap small = frame();
  small.result = folder.write("metres.dat", text);
  const FeDeviation read_as_mm = deviation(small);
  EXPECT_FALSE(read_as_mm.plausible);
  EXPECT_THAT(read_as_mm.notes, Contains(HasSubstr("implausibly small: is it in m?")));
  small.unit_of_displacement = "m";
  small.unit_of_length = "mm";
  const FeDeviation right = deviation(small);
  EXPECT_TRUE(right.plausible);
  EXPECT_NEAR(value(right, 900.0, Component::EZ), 33.0, 1e-2);
}

TEST(FeDeviation, RefusesWhatIsNotThereInOneSentence) {
  FeMap map = frame();
  map.points[0].tool = set("TOOLTIP");
  const std::string text = refusal(map);
  EXPECT_THAT(text, HasSubstr("no set of nodes \"TOOLTIP\""));
  EXPECT_THAT(text, HasSubstr("ALL, BOTH, EDGE, FIRST_TEN, OBSERVED, TABLE or TOOL"));
  map.mesh.clear();
  EXPECT_THAT(refusal(map), HasSubstr("add the mesh with its sets"));
  map = frame();
  map.points[0].table = FeNodes::parse("nodes:4711");
  EXPECT_THAT(refusal(map), HasSubstr("no node 4711"));
  map.points[0].table = FeNodes::parse("EDGE");
  EXPECT_THAT(refusal(map), HasSubstr("lie on one line"));
  map.points[0].table = FeNodes::parse("TOOL");
  EXPECT_THAT(refusal(map), HasSubstr("is tool and table of point P1"));
  map = frame();
  map.unit_of_displacement.clear();
  EXPECT_THAT(refusal(map), HasSubstr("add --unit mm or --unit m"));
  map = frame();
  map.unit_of_displacement = "um";
  EXPECT_THAT(refusal(map), HasSubstr("allowed: mm or m"));
  map = frame();
  map.points.clear();
  EXPECT_THAT(refusal(map), HasSubstr("--tool and --table"));
  map = frame();
  map.result.clear();
  EXPECT_THAT(refusal(map), HasSubstr("names no result"));
  // The mesh of another result.
  const testing::TempFolder folder;
  map = frame();
  map.mesh = folder.write("other.inp", "*NODE, NSET=TOOL\n5, 1, 2, 3\n");
  EXPECT_THAT(refusal(map), HasSubstr("allowed: the mesh of this result"));
}

TEST(FeMap, ReadsItsFile) {
  const testing::TempFolder folder;
  const FeMap map = FeMap::read(folder.write("fe.json", R"({"format":"spindrift-finite-elements","version":1,
    "result":"mech.frd","mesh":"mesh.inp","unit_of_displacement":"m","unit_of_length":"mm","first_state_s":0,
    "state_interval_s":900,"components":["EX","EA"],"displacement":"U",
    "mcf_from_mesh":[[0,1,0,10],[-1,0,0,20],[0,0,1,30],[0,0,0,1]],
    "points":[{"point":"P1","tool":{"set":"Tool"},"table":{"nodes":[1,2]}},
              {"point":"P2","tool":{"nearest_to_mm":[1,2,3],"count":4,"at_mm":[0,0,1]},"table":{"set":"table"}}]})"));
  EXPECT_EQ(map.result, folder / "mech.frd");
  EXPECT_EQ(map.points[0].tool.set, "TOOL");
  EXPECT_EQ(map.points[1].tool.count, 4);
  EXPECT_EQ(map.components.size(), 2u);
  EXPECT_EQ(map.mcf_from_mesh * Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(12, 19, 33));
  map.validate();
}

TEST(FeMap, RefusesWhatIsWrong) {
  const auto with = [](const std::string& rest) {
    return mapRefusal(R"({"format":"spindrift-finite-elements","version":1,"result":"a.frd",)" + rest + "}");
  };
  const std::string points = R"("points":[{"point":"P1","tool":{"set":"T"},"table":{"set":"B"}}])";
  EXPECT_EQ(with(R"("unit_of_displacement":"mm",)" + points), "");
  EXPECT_THAT(with(points), HasSubstr("add \"unit_of_displacement\": \"mm\" or \"m\""));
  EXPECT_THAT(with(R"("unit_of_displacement":"inch",)" + points), HasSubstr("inch"));
  EXPECT_THAT(with(R"("unit_of_displacement":"mm")"), HasSubstr("one of \"points\""));
  EXPECT_THAT(with(R"("unit_of_displacement":"mm","observe":"o.csv",)" + points), HasSubstr("one of \"points\""));
  EXPECT_THAT(with(R"("unit_of_displacement":"mm","points":[{"point":"P1","tool":{},"table":{"set":"B"}}])"),
              HasSubstr("$.points[0].tool"));
  EXPECT_THAT(
      with(
          R"("unit_of_displacement":"mm","points":[{"point":"P1","tool":{"set":"T","nodes":[1]},"table":{"set":"B"}}])"),
      HasSubstr("exactly one"));
  EXPECT_THAT(with(R"("unit_of_displacement":"mm","points":[{"point":"P1","tool":{"set":"T"},"table":{"set":"B"}},
                   {"point":"P1","tool":{"set":"T"},"table":{"set":"B"}}])"),
              HasSubstr("each point once"));
  EXPECT_THAT(
      with(R"("unit_of_displacement":"mm","mcf_from_mesh":[[1,0,0,0],[0,1,0,0],[0,0,2,0],[0,0,0,1]],)" + points),
      HasSubstr("proper rotation"));
  EXPECT_THAT(with(R"("unit_of_displacement":"mm","components":["EW"],)" + points), HasSubstr("EW"));
  EXPECT_THAT(with(R"("unit_of_displacement":"mm","state_interval_s":0,)" + points), HasSubstr("state_interval_s"));
  EXPECT_THAT(mapRefusal(R"({"format":"spindrift-finite-elements","version":9})"), HasSubstr("version"));
}

TEST(FeMap, NamesFilesInItsFolder) {
  const testing::OutsideFolder outside("mech.frd", "");
  const auto said = [&](const std::string& key, const std::string& name) {
    nlohmann::json map = {{"format", "spindrift-finite-elements"}, {"version", 1}, {"result", "own.frd"}};
    map[key] = name;
    return testing::refusal([&] { (void)FeMap::read(outside.write("fe.json", map.dump())); });
  };
  for (const char* key : {"result", "mesh", "observe"}) {
    for (const std::string& name : outside.names())
      EXPECT_THAT(said(key, name), AllOf(HasSubstr("inside the folder"), HasSubstr(key))) << key << " " << name;
    EXPECT_EQ(said(key, "sub/own.frd"), "");
  }
}

}  // namespace
}  // namespace spindrift
