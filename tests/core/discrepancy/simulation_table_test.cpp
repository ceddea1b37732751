// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/finite_elements/fe_simulation.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/discrepancy/drivers.h"
#include "tests/core/discrepancy/small_plant.h"
#include "tests/support/refusal.h"
#include "tests/support/source_folder.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

using ::testing::Contains;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using Answer = SimulationTable::Answer;

const Eigen::Vector3d nowhere = Eigen::Vector3d::Zero();

SimulationTable tableOf(const std::string& text) {
  const testing::TempFolder folder;
  return SimulationTable::read(folder.write("simulation.csv", text));
}

std::string refusal(const std::string& text) {
  return testing::refusal([&] { (void)tableOf(text); });
}

TEST(SimulationTable, IsLinearBetweenRowsAndNothingBeyond) {
  const SimulationTable table = tableOf(
      "time_s,point,component,predicted\n0,F1,EX,1\n0,F1,EY,5\n100,F1,EX,3\n400,F1,EX,0\n400,F1,EY,5\n10,F2,EX,7\n");
  const auto at = [&](double t, const char* point, Component c) { return table.at(t, point, nowhere, c); };
  EXPECT_DOUBLE_EQ(at(0, "F1", Component::EX).value, 1.0);
  EXPECT_DOUBLE_EQ(at(50, "F1", Component::EX).value, 2.0);
  EXPECT_DOUBLE_EQ(at(250, "F1", Component::EX).value, 1.5);
  EXPECT_DOUBLE_EQ(at(400, "F1", Component::EX).value, 0.0);
  EXPECT_DOUBLE_EQ(at(123, "F1", Component::EY).value, 5.0);
  // Times written with few digits still count as the first and the last.
  EXPECT_DOUBLE_EQ(at(400.0009, "F1", Component::EX).value, 0.0);
  EXPECT_DOUBLE_EQ(at(-0.0009, "F1", Component::EX).value, 1.0);
  EXPECT_EQ(at(400.1, "F1", Component::EX).answer, Answer::BeforeOrAfter);
  EXPECT_TRUE(std::isnan(at(400.1, "F1", Component::EX).value));
  EXPECT_EQ(at(-1, "F1", Component::EX).answer, Answer::BeforeOrAfter);
  // A point that is predicted once is known at this time only.
  EXPECT_DOUBLE_EQ(at(10, "F2", Component::EX).value, 7.0);
  EXPECT_EQ(at(11, "F2", Component::EX).answer, Answer::BeforeOrAfter);
  EXPECT_EQ(at(10, "F2", Component::EZ).answer, Answer::UnknownComponent);
  EXPECT_EQ(at(10, "F3", Component::EX).answer, Answer::UnknownPoint);
}

double field(const Eigen::Vector3d& p, double t, Component c) {
  const double scale = c == Component::EX ? 1.0 : -0.5;
  return scale * t * 1e-3 * (2.0 + 0.01 * p.x() - 0.02 * p.y() + 0.005 * p.z());
}

/// Rows of a simulation by place: linear in place and time.
std::string placedTable(Random& random, int places, int states, std::vector<Eigen::Vector3d>* where = nullptr) {
  std::vector<Eigen::Vector3d> list;
  for (int i = 0; i < places; ++i) {
    list.emplace_back(400.0 * random.uniform(), 300.0 * random.uniform(), 200.0 * random.uniform());
  }
  for (int i = 0; i < 8; ++i) list.emplace_back(400.0 * (i & 1), 300.0 * ((i >> 1) & 1), 200.0 * ((i >> 2) & 1));
  std::string text = "time_s,x_mm,y_mm,z_mm,component,predicted\n";
  for (int k = 0; k < states; ++k) {
    for (const Eigen::Vector3d& p : list) {
      for (const Component c : {Component::EX, Component::EZ}) {
        text += fmt::format("{},{},{},{},{},{}\n", 600 * k, p.x(), p.y(), p.z(), toString(c), field(p, 600.0 * k, c));
      }
    }
  }
  if (where != nullptr) *where = list;
  return text;
}

TEST(SimulationTable, RecoversAKnownFieldInPlaceAndTime) {
  Random random(7);
  std::vector<Eigen::Vector3d> places;
  const SimulationTable table = tableOf(placedTable(random, 40, 6, &places));
  EXPECT_TRUE(table.byPlace());
  for (const Component c : {Component::EX, Component::EZ}) {
    EXPECT_NEAR(table.at(600.0, "", places[3], c).value, field(places[3], 600.0, c), 1e-12);
    for (int i = 0; i < 100; ++i) {
      const Eigen::Vector3d p(400.0 * random.uniform(), 300.0 * random.uniform(), 200.0 * random.uniform());
      const double t = 3000.0 * random.uniform();
      const auto found = table.at(t, "any", p, c);
      EXPECT_NEAR(found.value, field(p, t, c), 1e-8);
      EXPECT_EQ(found.answer, Answer::Known);
    }
  }
  const auto outside = table.at(900.0, "", {450.0, 100.0, 100.0}, Component::EX);
  EXPECT_EQ(outside.answer, Answer::OutsidePlaces);
  EXPECT_NEAR(outside.outside_mm, 50.0, 1e-6);
  EXPECT_NEAR(outside.value, field({450.0, 100.0, 100.0}, 900.0, Component::EX), 1e-6);
  EXPECT_EQ(table.at(3001.0, "", places[0], Component::EX).answer, Answer::BeforeOrAfter);
  EXPECT_EQ(table.at(0.0, "", places[0], Component::EA).answer, Answer::UnknownComponent);
}

TEST(SimulationTable, PlacesCountOnlyWhileTheirRowsReach) {
  // Four places to the end, one at x = 1000 only to 100 s.
  std::string text = "time_s,x_mm,y_mm,z_mm,component,predicted\n";
  for (const int t : {0, 100, 200}) {
    for (const auto& [x, y] : std::vector<std::pair<int, int>>{{0, 0}, {100, 0}, {0, 100}, {100, 100}, {1000, 50}}) {
      if (x == 1000 && t == 200) continue;
      text += fmt::format("{},{},{},0,EX,{}\n", t, x, y, x == 1000 ? 99 : x + t);
    }
  }
  const SimulationTable table = tableOf(text);
  EXPECT_EQ(table.at(50.0, "", {600.0, 50.0, 0.0}, Component::EX).answer, Answer::Known);
  const auto late = table.at(150.0, "", {600.0, 50.0, 0.0}, Component::EX);
  EXPECT_EQ(late.answer, Answer::OutsidePlaces);
  EXPECT_NEAR(late.outside_mm, 500.0, 1e-6);
  EXPECT_NEAR(table.at(150.0, "", {50.0, 50.0, 0.0}, Component::EX).value, 200.0, 1e-9);
}

TEST(SimulationTable, RefusesWhatIsWrongInOneSentence) {
  const std::string head = "time_s,point,component,predicted\n";
  EXPECT_THAT(refusal("time_s,component,predicted\n0,EX,1\n"), HasSubstr("point"));
  EXPECT_THAT(refusal("time_s,x_mm,y_mm,component,predicted\n0,1,1,EX,1\n"), HasSubstr("z_mm"));
  EXPECT_THAT(refusal(head), HasSubstr("at least one row"));
  EXPECT_THAT(refusal(head + "0,F1,EQ,1\n"), HasSubstr("EQ"));
  EXPECT_THAT(refusal(head + "0,,EX,1\n"), HasSubstr("line 2"));
  EXPECT_THAT(refusal(head + "0,F1,EX,inf\n"), HasSubstr("inf"));
  EXPECT_THAT(refusal(head + "nan,F1,EX,1\n"), HasSubstr("nan"));
  EXPECT_THAT(refusal(head + "5,F1,EX,1\n0,F1,EX,1\n"), HasSubstr("backwards from 5 s to 0 s"));
  EXPECT_THAT(refusal(head + "5,F1,EX,1\n5,F2,EX,1\n5,F1,EX,1\n"), HasSubstr("duplicate EX of point F1 at 5 s"));
  const std::string placed = "time_s,x_mm,y_mm,z_mm,component,predicted\n";
  EXPECT_THAT(refusal(placed + "5,1,2,3,EX,1\n5,1,2,3,EX,1\n"), HasSubstr("place (1, 2, 3) mm at 5 s"));
  EXPECT_THAT(refusal(placed + "5,1,2,3,EX,1\n4,1,2,3,EX,1\n"), HasSubstr("backwards"));
  EXPECT_THAT(refusal(placed + "5,1,2,x,EX,1\n"), HasSubstr("column z_mm"));
}

/// A campaign of the small plant, its predictions as a table every 3000 s up to `until_s`.
SimulationMatch matched(DiscrepancyInput& input, double until_s) {
  std::vector<SimulationRow> rows;
  std::map<std::pair<std::string, Component>, double> last;
  for (std::size_t i = 0; i < input.observations.rows.size(); ++i) {
    const Observation& o = input.observations.rows[i];
    if (o.time_s > until_s) continue;
    rows.push_back({o.time_s, o.point, nowhere, o.component, input.predicted[i]});
  }
  SimulationMatch match = matchSimulation(SimulationTable(rows, false, "simulation.csv"), input.observations,
                                          {"F1", "Q9"}, "simulation.csv");
  input.predicted = match.predicted;
  input.notes = match.notes;
  input.why_unmatched = match.why_unmatched;
  input.base_table = "simulation.csv";
  return match;
}

TEST(SimulationTable, HalfOfTheTimeIsCountedAndTold) {
  using namespace small_plant;
  DiscrepancyInput input = campaign(Hidden::SpindleDrift, 41);
  const std::size_t all = input.predicted.size();
  const SimulationMatch match = matched(input, 44.0 * 30.0 * 17);
  const auto missing = static_cast<std::size_t>(
      std::count_if(match.predicted.begin(), match.predicted.end(), [](double p) { return std::isnan(p); }));
  EXPECT_EQ(missing, all - 18U * 18U);
  EXPECT_THAT(match.why_unmatched, HasSubstr(fmt::format("{} lie before or after", missing)));
  const DiscrepancyResult result = run(input);
  EXPECT_EQ(result.unmatched, missing);
  EXPECT_THAT(result.warnings, Contains(HasSubstr("lie before or after the rows of simulation.csv (0 s to 22440 s)")));

  DiscrepancyInput less = campaign(Hidden::SpindleDrift, 41);
  matched(less, 44.0 * 30.0 * 10);
  try {
    (void)run(less);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("at least half"));
    EXPECT_THAT(error.what(), HasSubstr("lie before or after the rows"));
  }
}

TEST(SimulationTable, TellsPointsThatDoNotMatch) {
  using namespace small_plant;
  DiscrepancyInput input = campaign(Hidden::Nothing, 42);
  std::vector<SimulationRow> rows;
  for (std::size_t i = 0; i < input.observations.rows.size(); ++i) {
    const Observation& o = input.observations.rows[i];
    const std::string point = o.point == "F2" ? "f2" : o.point;
    rows.push_back({o.time_s, point, nowhere, o.component, input.predicted[i]});
  }
  const SimulationMatch match =
      matchSimulation(SimulationTable(rows, false, "s.csv"), input.observations, {"F1"}, "s.csv");
  EXPECT_THAT(match.why_unmatched, HasSubstr("at points that s.csv lacks (F2)"));
  EXPECT_THAT(match.notes, Contains(HasSubstr("predicts point f2, which neither machine.json nor the observations")));
}

TEST(SimulationTable, NamesPointsOutsideThePlaces) {
  Random random(8);
  const SimulationTable table = tableOf(placedTable(random, 10, 3));
  ObservationSet observations;
  for (int i = 0; i < 4; ++i) {
    Observation o;
    o.point = fmt::format("P{}", i + 1);
    o.position_mm = Eigen::Vector3d(150.0 * i, 100.0, 100.0);  // P4 at 450
    o.time_s = 100.0 * i;
    observations.rows.push_back(o);
  }
  SimulationMatch match = matchSimulation(table, observations, {}, "simulation.csv");
  EXPECT_THAT(match.notes, Contains(HasSubstr("extrapolated at point P4, up to 50 mm outside")));
  EXPECT_THAT(match.predicted, Each(::testing::Truly([](double v) { return std::isfinite(v); })));
  observations.rows.pop_back();
  match = matchSimulation(table, observations, {}, "simulation.csv");
  EXPECT_THAT(match.notes, IsEmpty());
}

/// A campaign whose simulation is `simulation`; EZ at P1 and P2 every 450 s.
std::filesystem::path campaignFolder(const testing::TempFolder& folder, const std::string& simulation) {
  folder.write("campaign.json", R"({"format":"spindrift-campaign","version":1,"name":"c",
    "start_utc":"2026-01-31T08:00:00Z","simulation":")" +
                                    simulation + "\"}");
  folder.write("machine.json", R"({"format":"spindrift-machine","version":1,"name":"m","chain":"V [w-X'-Y'-b-Z-t]",
    "axes":[{"name":"X","travel_mm":[0,400]},{"name":"Y","travel_mm":[0,400]},{"name":"Z","travel_mm":[0,400]}]})");
  std::string rows = "time_s,state,point,x_mm,y_mm,z_mm,c_deg,component,value,sigma,instrument,use\n";
  for (int k = 0; k <= 10; ++k) {
    for (const int p : {1, 2})
      rows += fmt::format("{},M{},P{},{},150,100,0,EZ,0,0.5,touch,fit\n", 450 * k, k, p, 100 * p);
  }
  folder.write("observations.csv", rows);
  return folder.path();
}

TEST(DiscrepancyInputOf, ComparesFiniteElementsThemselves) {
  const testing::TempFolder folder;
  const auto campaign_folder = campaignFolder(folder, "fe.json");
  const std::filesystem::path data = spindrift::testing::testData() / "finite_elements";
  for (const char* file : {"frame.frd", "mesh.inp"}) std::filesystem::copy_file(data / file, campaign_folder / file);
  folder.write("fe.json",
               R"({"format":"spindrift-finite-elements","version":1,"unit_of_displacement":"mm",
    "result":"frame.frd","mesh":"mesh.inp","first_state_s":0,
    "points":[{"point":"P1","tool":{"set":"TOOL"},"table":{"set":"TABLE"}}]})");
  const Campaign campaign = Campaign::read(campaign_folder);
  const DiscrepancyInput input = discrepancyInput(campaign, *campaign.observations);
  ASSERT_EQ(input.predicted.size(), 22u);
  const double expected[] = {0.0, 16.5, 33.0, 49.5, 66.0, 33.0, 0.0};  // P1 from 0 to 2700 s
  for (std::size_t k = 0; k < 7; ++k) EXPECT_NEAR(input.predicted[2 * k], expected[k], 1e-3) << k;
  EXPECT_TRUE(std::isnan(input.predicted[18]));  // 4050 s, after the last state
  EXPECT_TRUE(std::isnan(input.predicted[1]));
  EXPECT_THAT(input.why_unmatched, HasSubstr("2 lie before or after the rows of fe.json (0 s to 3600 s)"));
  EXPECT_THAT(input.why_unmatched, HasSubstr("11 are at points that fe.json lacks (P2)"));
  // A model that stands on this table finds it again.
  std::vector<std::string> notes;
  EXPECT_NEAR(readSimulation(campaign.path("fe.json"), notes).at(450.0, "P1", nowhere, Component::EZ).value, 16.5,
              1e-3);
}

TEST(DiscrepancyInputOf, InterpolatesInPlace) {
  const testing::TempFolder folder;
  const auto campaign_folder = campaignFolder(folder, "simulation.csv");
  std::string text = "time_s,x_mm,y_mm,z_mm,component,predicted\n";
  for (const int t : {0, 4500}) {
    for (const int x : {0, 180}) {
      for (const int y : {100, 200}) text += fmt::format("{},{},{},100,EZ,{}\n", t, x, y, 1e-5 * t * x);
    }
  }
  folder.write("simulation.csv", text);
  const Campaign campaign = Campaign::read(campaign_folder);
  const DiscrepancyInput input = discrepancyInput(campaign, *campaign.observations);
  for (std::size_t k = 0; k <= 10; ++k) {
    EXPECT_NEAR(input.predicted[2 * k], 1e-5 * 450.0 * static_cast<double>(k) * 100.0, 1e-9);
    EXPECT_NEAR(input.predicted[2 * k + 1], 1e-5 * 450.0 * static_cast<double>(k) * 200.0, 1e-9);
  }
  EXPECT_THAT(input.notes, Contains(HasSubstr("extrapolated at point P2, up to 20 mm outside")));
  EXPECT_EQ(input.why_unmatched, "");
  folder.write("campaign.json", R"({"format":"spindrift-campaign","version":1,"name":"c",
    "start_utc":"2026-01-31T08:00:00Z","simulation":"mech.frd"})");
  const Campaign direct = Campaign::read(campaign_folder);
  EXPECT_THROW((void)discrepancyInput(direct, *direct.observations), InputError);
}

TEST(SensorRoles, AreToldWithTheResult) {
  using namespace small_plant;
  DiscrepancyInput input = campaign(Hidden::SpindleDrift, 43);
  input.machine.temperature_sensors = {{"T_spindle_degC", "", SensorRole::SpindleBearing}};
  const DiscrepancyResult result = run(input);
  const nlohmann::json roles = result.json()["sensor_roles"];
  EXPECT_EQ(roles["T_spindle_degC"]["role"], "spindle_bearing");
  EXPECT_EQ(roles["T_spindle_degC"]["from"], "machine.json");
  EXPECT_EQ(roles["T_room_degC"]["role"], "room");
  EXPECT_EQ(roles["T_room_degC"]["from"], "name");
  EXPECT_THAT(result.summary(), HasSubstr("T_room_degC room"));
  EXPECT_THAT(result.warnings, Each(Not(HasSubstr("T_spindle_degC spindle_bearing"))));
}

TEST(SensorRoles, BendingAcrossXUsesLeftAndRight) {
  const std::vector<double> time{0.0, 600.0, 1200.0, 1800.0};
  OperatingLog log(time);
  log.setSignal("T_7_degC", {20.0, 21.0, 23.0, 26.0});
  log.setSignal("T_8_degC", {20.0, 20.5, 21.0, 21.5});
  log.setSignal("T_9_degC", {20.0, 20.0, 20.1, 20.3});
  log.setSignal("T_scale_degC", {20.0, 20.0, 20.2, 20.3});
  MachineDescription machine = small_plant::machine();
  machine.temperature_sensors = {{"T_7_degC", "", SensorRole::ColumnLeft},
                                 {"T_8_degC", "", SensorRole::ColumnRight},
                                 {"T_9_degC", "", SensorRole::ScrewX}};
  const DriverTable drivers(machine, &log);
  ASSERT_TRUE(drivers.has("column_side_difference"));
  EXPECT_FALSE(drivers.has("column_difference"));
  EXPECT_GT(drivers.find("column_side_difference")->values.back(), 3.0);
  EXPECT_THAT(drivers.temperatures(), Not(Contains("column_side_difference")));
  EXPECT_THAT(drivers.temperatures({SensorRole::ScrewX}), ::testing::ElementsAre("T_9_degC"));
  EXPECT_THAT(drivers.temperatures({SensorRole::ScrewY}), IsEmpty());
}

}  // namespace
}  // namespace spindrift
