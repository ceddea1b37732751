// SPDX-License-Identifier: GPL-3.0-or-later
// Hidden effects made by a small plant of its own (explicit Euler steps, two-lag spindle, friction that is not linear),
// not by the formulas of the catalogue.
#include "core/discrepancy/discrepancy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "core/base/random.h"
#include "core/discrepancy/drivers.h"
#include "core/discrepancy/effect_model.h"

namespace spindrift {
namespace {

struct Plant {
  std::vector<double> time, rpm, feed_x, bearing, housing, screw, table, room;
};

Plant runPlant(Random& random) {
  Plant p;
  double bearing = 0.0;
  double housing = 0.0;
  double screw = 0.0;
  double table = 0.0;
  double rpm = 0.0;
  double feed = 0.0;
  for (int i = 0; i < 1440; ++i) {
    const double t = 30.0 * i;
    if (i % 60 == 0 && i > 60) {
      rpm = 1500.0 * static_cast<double>(random.index(5));
      feed = 4000.0 * static_cast<double>(random.index(4));
    }
    const double room = 1.5 * std::sin(t / 9000.0) + 0.00003 * t;
    const double heat = 0.4 * rpm * 1e-3 + 0.5 * std::pow(rpm * 1e-3, 1.4);
    bearing += 30.0 * ((6.0 * heat - (bearing - housing)) / 900.0 - (1.0 + 0.0001 * rpm) * (bearing - room) / 2800.0);
    housing += 30.0 * (0.5 * (bearing - housing) / 1800.0 - (housing - room) / 2600.0);
    screw += 30.0 * (0.3 * feed * 1e-3 - (screw - room)) / 2200.0;
    table += 30.0 * (room - table) / 5000.0;
    p.time.push_back(t);
    p.rpm.push_back(rpm);
    p.feed_x.push_back(feed);
    p.bearing.push_back(bearing);
    p.housing.push_back(housing);
    p.screw.push_back(screw);
    p.table.push_back(table);
    p.room.push_back(room);
  }
  return p;
}

MachineDescription machine() {
  return MachineDescription::parse(
      JsonNode::parse(R"({"format":"spindrift-machine","version":1,"name":"m","chain":"V [w-X'-Y'-b-Z-t]",
  "axes":[{"name":"X","travel_mm":[0,480],"drive":{"type":"ball_screw","pitch_mm":10,"fixed_bearing_mm":0}},
          {"name":"Y","travel_mm":[0,400],"drive":{"type":"ball_screw","pitch_mm":10,"fixed_bearing_mm":0}},
          {"name":"Z","travel_mm":[0,400],"drive":{"type":"ball_screw","pitch_mm":10,"fixed_bearing_mm":0}}],
  "table":{"centre_mm":[240,200]},"column":{"base_mm":-180},
  "temperature_sensors":[{"name":"T_spindle_degC","place":"front bearing"},{"name":"T_room_degC","place":"room"}]})",
                      "machine.json"),
      "machine.json");
}

enum class Hidden { Nothing, SpindleDrift, Screw, Slip, Wave };

DiscrepancyInput campaign(Hidden hidden, std::uint64_t seed, double strength = 5.0) {
  Random random(seed);
  const Plant plant = runPlant(random);
  DiscrepancyInput input;
  input.machine = machine();
  OperatingLog log(plant.time);
  log.setSignal("spindle_rpm", plant.rpm);
  log.setSignal("feed_x_mm_min", plant.feed_x);
  std::vector<double> bearing;
  std::vector<double> room;
  for (std::size_t i = 0; i < plant.time.size(); ++i) {
    bearing.push_back(20.0 + plant.bearing[i] + random.normal(0.0, 0.05));
    room.push_back(20.0 + plant.room[i] + random.normal(0.0, 0.05));
  }
  log.setSignal("T_spindle_degC", bearing);
  log.setSignal("T_room_degC", room);
  input.log = log;
  const double sigma = 0.5;
  const std::array<Eigen::Vector3d, 6> points{Eigen::Vector3d(40, 40, 0),     Eigen::Vector3d(440, 60, 20),
                                              Eigen::Vector3d(420, 360, 100), Eigen::Vector3d(50, 350, 200),
                                              Eigen::Vector3d(200, 150, 300), Eigen::Vector3d(300, 250, 390)};
  for (int state = 0; state < 32; ++state) {
    const auto at = static_cast<std::size_t>(state * 44);
    for (std::size_t p = 0; p < points.size(); ++p) {
      for (int c = 0; c < 3; ++c) {
        Observation o;
        o.time_s = plant.time[at];
        o.state = "M" + std::to_string(state);
        o.point = "F" + std::to_string(p + 1);
        o.position_mm = points[p];
        o.component = static_cast<Component>(c);
        o.sigma = sigma;
        o.use = state >= 26 ? ObservationUse::Holdout : ObservationUse::Fit;
        double truth = c == 2 ? 0.5 * plant.housing[at] : 0.0;
        const double simulated = truth * 1.006;
        switch (hidden) {
          case Hidden::Nothing:
            break;
          case Hidden::SpindleDrift:
            if (c == 1) truth += strength * sigma * plant.housing[at] / 12.0;
            break;
          case Hidden::Screw:
            if (c == 0) truth += strength * sigma * plant.screw[at] / 2.0 * points[p].x() / 300.0;
            break;
          case Hidden::Slip:
            if (p == 2 && state > 14) truth += 2.0 * strength * sigma * (c == 0 ? 1.0 : -0.5);
            break;
          case Hidden::Wave:
            if (c == 0) truth += 1.4 * strength * sigma * std::sin(o.time_s / 500.0);
            break;
        }
        o.value = truth + random.normal(0.0, sigma);
        input.observations.rows.push_back(o);
        input.predicted.push_back(simulated);
      }
    }
  }
  return input;
}

DiscrepancyResult run(const DiscrepancyInput& input, const DiscrepancyOptions& options = {}) {
  JobContext job;
  return findDiscrepancy(input, options, job);
}

TEST(Discrepancy, NamesOneHiddenEffect) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const DiscrepancyResult drift = run(campaign(Hidden::SpindleDrift, seed));
    ASSERT_EQ(drift.effects.size(), 1u);
    EXPECT_EQ(drift.effects[0].id, "spindle.drift.y");
    // Held-out states carry little of this signal; what is left there must be close to the noise that nobody can beat.
    EXPECT_LT(drift.gap.heldout_rms_after_um, drift.gap.heldout_rms_before_um);
    EXPECT_LT(drift.gap.heldout_rms_after_um, 1.25 * drift.gap.noise_um);
    const DiscrepancyResult screw = run(campaign(Hidden::Screw, seed));
    ASSERT_GE(screw.effects.size(), 1u);
    EXPECT_EQ(screw.effects[0].id, "ball_screw.expansion.x");
  }
  const DiscrepancyResult slip = run(campaign(Hidden::Slip, 4));
  ASSERT_EQ(slip.effects.size(), 1u);
  EXPECT_EQ(slip.effects[0].id, "fixture.slip.F3");
}

TEST(Discrepancy, NamesNothingWhenNothingIsMissing) {
  for (std::uint64_t seed = 11; seed <= 16; ++seed) {
    const DiscrepancyResult result = run(campaign(Hidden::Nothing, seed));
    EXPECT_EQ(result.verdict, DiscrepancyVerdict::None);
    EXPECT_TRUE(result.effects.empty());
  }
}

TEST(Discrepancy, AbstainsOutsideTheCatalogue) {
  for (std::uint64_t seed = 21; seed <= 23; ++seed) {
    const DiscrepancyResult result = run(campaign(Hidden::Wave, seed));
    EXPECT_EQ(result.verdict, DiscrepancyVerdict::Unknown);
    EXPECT_TRUE(result.effects.empty());
    EXPECT_FALSE(result.leftover.empty());
  }
}

TEST(Discrepancy, RefusesASimulationThatMatchesTooLittle) {
  DiscrepancyInput input = campaign(Hidden::Nothing, 5);
  for (std::size_t i = 0; i < input.predicted.size() * 6 / 10; ++i) {
    input.predicted[i] = std::numeric_limits<double>::quiet_NaN();
  }
  EXPECT_THROW(run(input), InputError);
}

TEST(Discrepancy, TellsMillimetresFromMicrometres) {
  DiscrepancyInput input = campaign(Hidden::Nothing, 6);
  for (double& p : input.predicted) p *= 1e-3;
  EXPECT_THROW(run(input), InputError);
}

TEST(Discrepancy, SaysThatTenObservationsDoNotSuffice) {
  DiscrepancyInput input = campaign(Hidden::SpindleDrift, 7);
  input.observations.rows.resize(10);
  input.predicted.resize(10);
  const DiscrepancyResult result = run(input);
  EXPECT_FALSE(result.decided);
  EXPECT_FALSE(result.message.empty());
}

TEST(Discrepancy, WorksWithoutALog) {
  DiscrepancyInput input = campaign(Hidden::Nothing, 8);
  input.log.reset();
  EXPECT_EQ(run(input).verdict, DiscrepancyVerdict::None);
}

TEST(Discrepancy, JsonKeepsTheContract) {
  const nlohmann::json json = run(campaign(Hidden::SpindleDrift, 1)).json();
  for (const char* key : {"verdict", "effects", "where", "gap", "suggestion", "leftover", "model"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  EXPECT_EQ(json["model"]["format"], "spindrift-error-model");
  EXPECT_EQ(json["verdict"], "named");
}

TEST(DriverTable, LagIsExactOnIrregularRows) {
  OperatingLog log({0.0, 100.0, 130.0, 900.0});
  log.setSignal("spindle_rpm", {0.0, 1000.0, 1000.0, 0.0});
  const MachineDescription m = machine();
  const DriverTable table(m, &log);
  const std::vector<double> times{500.0, 1500.0};
  const Eigen::VectorXd q = table.response(*table.find("spindle_rpm^1"), 300.0, -1.0, times);
  const double at_900 = 1.0 - std::exp(-800.0 / 300.0);
  EXPECT_NEAR(q[0], 1.0 - std::exp(-400.0 / 300.0), 1e-12);
  EXPECT_NEAR(q[1], at_900 * std::exp(-600.0 / 300.0), 1e-12);
}

}  // namespace
}  // namespace spindrift
