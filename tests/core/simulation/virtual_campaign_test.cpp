// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/virtual_campaign.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "core/base/atomic_file.h"
#include "core/math/statistics.h"
#include "core/probing/hole_cycle.h"
#include "tests/support/source_folder.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

Scenario shipped(const std::string& name) {
  return Scenario::read(spindrift::testing::sourceFolder() / "resources/scenarios" / name);
}

std::map<std::string, std::string> files(const std::filesystem::path& folder) {
  std::map<std::string, std::string> content;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) content[entry.path().filename()] = readFile(entry.path());
  }
  return content;
}

TEST(VirtualCampaign, TheSameSeedWritesTheSameFilesAndAnotherSeedOthers) {
  const Scenario scenario = shipped("discrepancy_vertical.json");
  const testing::TempFolder temp;
  writeCampaign(simulateCampaign(scenario, 5, {}), temp / "a");
  writeCampaign(simulateCampaign(scenario, 5, {}), temp / "b");
  writeCampaign(simulateCampaign(scenario, 6, {}), temp / "c");
  const auto a = files(temp / "a");
  EXPECT_EQ(a, files(temp / "b"));
  const auto c = files(temp / "c");
  EXPECT_NE(a.at("observations.csv"), c.at("observations.csv"));
  EXPECT_NE(a.at("log.csv"), c.at("log.csv"));
}

TEST(VirtualCampaign, TheFolderIsReadBackAndHoldsNothingOfTheTruth) {
  const Scenario scenario = shipped("discrepancy_gantry.json");
  const testing::TempFolder temp;
  const VirtualCampaign made = simulateCampaign(scenario, {}, {});
  writeCampaign(made, temp / "campaign");
  const Campaign read = Campaign::read(temp / "campaign");
  EXPECT_EQ(read.observations->rows.size(), 1080u);
  EXPECT_EQ(read.log->time_s().size(), 1440u);
  EXPECT_EQ(read.simulation, "simulation.csv");
  EXPECT_EQ(read.machine.temperature_sensors.size(), 6u);
  ASSERT_EQ(made.truth.hidden, std::vector<std::string>{"crossbeam.sag.z"});
  for (const auto& [name, content] : files(temp / "campaign")) {
    for (const char* word : {"sag", "effect", "hidden", "strength", "seed", "truth", "spindle.growth"}) {
      EXPECT_EQ(content.find(word), std::string::npos) << name << " holds \"" << word << '"';
    }
  }
  EXPECT_THROW(writeCampaign(made, temp / "campaign"), InputError) << "never over another campaign";
}

TEST(VirtualCampaign, HiddenIsThePlantMinusTheBase) {
  Scenario scenario = shipped("discrepancy_vertical.json");
  scenario.simulation->parameter_error = 0.0;
  const VirtualCampaign exact = simulateCampaign(scenario, 3, {});
  const auto& rows = exact.campaign.observations->rows;
  ASSERT_EQ(exact.simulation.size(), rows.size());
  std::vector<double> noise;
  double largest_base_error = 0.0;
  double squares = 0.0;
  std::size_t fit = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    noise.push_back((rows[i].value - exact.simulation[i].predicted - exact.truth.hidden_signal[i]) / rows[i].sigma);
    largest_base_error = std::max(largest_base_error, std::abs(exact.truth.base_error[i]));
    if (rows[i].component == Component::EY && rows[i].use == ObservationUse::Fit) {
      squares += exact.truth.hidden_signal[i] * exact.truth.hidden_signal[i];
      ++fit;
    }
  }
  EXPECT_LT(largest_base_error, 1e-9);
  EXPECT_NEAR(rootMeanSquare(noise), 1.0, 0.08);
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(fit)), 6.0 * 0.5, 1e-6) << "strength 6 at a sigma of 0.5 um";

  scenario.simulation->parameter_error = 0.01;
  const VirtualCampaign off = simulateCampaign(scenario, 3, {});
  double worst = 0.0;
  double largest = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    worst = std::max(worst, std::abs(off.truth.base_error[i]));
    largest = std::max(largest, std::abs(off.simulation[i].predicted));
  }
  EXPECT_GT(worst, 1e-3 * largest);
  EXPECT_LT(worst, 0.05 * largest);
}

TEST(VirtualCampaign, OneSwitchChangesOnlyWhatItShould) {
  Scenario scenario = shipped("discrepancy_vertical.json");
  const VirtualCampaign with = simulateCampaign(scenario, 3, {});
  scenario.effects.at("column.bending.a").setting.on = false;
  const VirtualCampaign without = simulateCampaign(scenario, 3, {});
  EXPECT_TRUE(without.truth.hidden.empty());
  for (std::size_t i = 0; i < with.simulation.size(); ++i) {
    EXPECT_EQ(with.simulation[i].predicted, without.simulation[i].predicted);
    const double change = with.campaign.observations->rows[i].value - without.campaign.observations->rows[i].value;
    EXPECT_NEAR(change, with.truth.hidden_signal[i], 2e-4);
  }
  for (const std::string& name : with.campaign.log->names()) {
    EXPECT_EQ(*with.campaign.log->signal(name), *without.campaign.log->signal(name)) << name;
  }
}

TEST(VirtualCampaign, CorrelatedNoiseHasTheStatedCorrelationAndVariance) {
  Scenario scenario = shipped("discrepancy_vertical.json");
  scenario.effects.clear();
  scenario.simulation.reset();
  scenario.instrument.ar1 = 0.9;
  scenario.measurement->times_s.clear();
  for (int i = 0; i < 1400; ++i) scenario.measurement->times_s.push_back(30.0 * i);
  scenario.measurement->per_point_s = 1.0;
  const VirtualCampaign made = simulateCampaign(scenario, 11, {});
  std::map<std::pair<std::string, Component>, std::vector<double>> series;
  for (const Observation& row : made.campaign.observations->rows) {
    series[{row.point, row.component}].push_back(row.value / row.sigma);
  }
  double product = 0.0;
  double square = 0.0;
  for (const auto& [key, values] : series) {
    for (std::size_t i = 1; i < values.size(); ++i) {
      product += values[i] * values[i - 1];
      square += values[i] * values[i];
    }
  }
  EXPECT_NEAR(product / square, 0.9, 0.01);
  EXPECT_NEAR(square / static_cast<double>(made.campaign.observations->rows.size()), 1.0, 0.1);
}

TEST(VirtualCampaign, SensorsMayBeMissingDeadOrDropOut) {
  Scenario scenario = shipped("discrepancy_vertical.json");
  scenario.sensors[0].dead = true;
  scenario.sensors[1].dropout = 0.3;
  scenario.omitted_signals = {"coolant", scenario.sensors[2].name};
  const testing::TempFolder temp;
  const VirtualCampaign made = simulateCampaign(scenario, 3, {});
  writeCampaign(made, temp / "campaign");
  const Campaign read = Campaign::read(temp / "campaign");
  EXPECT_FALSE(read.log->has("coolant"));
  EXPECT_FALSE(read.log->has(scenario.sensors[2].name));
  EXPECT_EQ(read.machine.temperature_sensors.size(), 5u);
  const auto& dead = *read.log->signal(scenario.sensors[0].name);
  EXPECT_EQ(dead.front(), dead.back());
  EXPECT_NEAR(static_cast<double>(made.dropouts.at(scenario.sensors[1].name).size()), 0.3 * 1440, 60);
  EXPECT_NE(readFile(temp / "campaign" / "log.csv").find(",,"), std::string::npos);
}

TEST(VirtualCampaign, SensorsMayDriftAndHaveCorrelatedNoise) {
  Scenario scenario = shipped("discrepancy_vertical.json");
  for (SensorOptions& sensor : scenario.sensors) sensor.noise_K = 0.0;
  const VirtualCampaign plain = simulateCampaign(scenario, 3, {});
  scenario.sensors[0].drift_K_per_h = 0.1;
  scenario.sensors[1].noise_K = 0.2;
  scenario.sensors[1].ar1 = 0.9;
  const VirtualCampaign made = simulateCampaign(scenario, 3, {});
  const auto off = [&](std::size_t sensor) {
    const auto& a = *made.campaign.log->signal(scenario.sensors[sensor].name);
    const auto& b = *plain.campaign.log->signal(scenario.sensors[sensor].name);
    std::vector<double> out;
    for (std::size_t i = 0; i < a.size(); ++i) out.push_back(a[i] - b[i]);
    return out;
  };
  EXPECT_NEAR(off(0).front(), 0.0, 0.002);
  EXPECT_NEAR(off(0).back(), 1.2, 0.01);
  const std::vector<double> noise = off(1);
  double product = 0.0;
  double square = 0.0;
  for (std::size_t i = 1; i < noise.size(); ++i) {
    product += noise[i] * noise[i - 1];
    square += noise[i] * noise[i];
  }
  EXPECT_NEAR(product / square, 0.9, 0.04);
  EXPECT_NEAR(std::sqrt(square / static_cast<double>(noise.size())), 0.2, 0.05);
}

TEST(VirtualCampaign, DroppedRowsAreGone) {
  Scenario scenario = shipped("discrepancy_vertical.json");
  const VirtualCampaign all = simulateCampaign(scenario, 3, {});
  scenario.instrument.dropped = 0.2;
  const VirtualCampaign some = simulateCampaign(scenario, 3, {});
  const std::size_t kept = some.campaign.observations->rows.size();
  EXPECT_NEAR(static_cast<double>(kept), 0.8 * 1080, 40);
  EXPECT_EQ(some.truth.hidden_signal.size(), kept);
  EXPECT_EQ(some.simulation.size(), all.simulation.size()) << "a simulation drops nothing";
}

TEST(VirtualCampaign, TouchesOfAHoleBarLieOnItsHolesAndMoveAgainstTheDeviation) {
  Scenario scenario = shipped("hole_bar.json");
  scenario.touches->sigma_um = 0.0;
  scenario.touches->pretravel_um = 0.0;
  const Scenario warm = scenario;
  scenario.effects.clear();
  const VirtualCampaign still = simulateCampaign(scenario, 1, {});
  ASSERT_EQ(still.touches.size(), 24u * 12u * 5u);
  const TouchRow& first = still.touches.front();
  EXPECT_NEAR(first.position_mm.x(), 250.0 - 140.0 + 3.0, 1e-6);
  EXPECT_NEAR(still.touches[4].position_mm.z(), 2.0, 1e-6) << "beside the hole: surface plus tip radius";

  Scenario one = warm;
  one.effects = {{"rotary.drift.z0t", {}}};
  const VirtualCampaign lifted = simulateCampaign(one, 1, {});
  // The table rises: its deviation is negative, the probe meets it earlier, higher up.
  const std::size_t late = 15 * 60 + 4;
  EXPECT_GT(lifted.touches[late].position_mm.z(), still.touches[late].position_mm.z() + 0.0003);
  EXPECT_NEAR(lifted.touches[late - 1].position_mm.y(), still.touches[late - 1].position_mm.y(), 1e-5)
      << "the walls of the hub are not quite alike, so that the table also turns a little";
}

TEST(VirtualCampaign, ATableThatGrowsTakesAHoleBarAlongAndStretchesNothing) {
  Scenario scenario = shipped("hole_bar.json");
  scenario.touches->sigma_um = 0.0;
  scenario.touches->pretravel_um = 0.0;
  Scenario grown = scenario;
  grown.effects = {{"rotary.expansion.r0t", {}}};
  scenario.effects.clear();
  const VirtualCampaign still = simulateCampaign(scenario, 1, {});
  const VirtualCampaign warm = simulateCampaign(grown, 1, {});
  // The touches along x and against it of every hole at c = 0, half way through.
  const std::size_t cycle = 12 * 60;
  const auto moved_um = [&](std::size_t hole) {
    const std::size_t i = cycle + 5 * hole;
    EXPECT_EQ(warm.touches[i].feature, "H" + std::to_string(hole + 1));
    double sum = 0.0;
    for (const std::size_t k : {i, i + 1}) sum += warm.touches[k].position_mm.x() - still.touches[k].position_mm.x();
    return 1e3 * 0.5 * sum;
  };
  const double reference = moved_um(0);
  EXPECT_GT(std::abs(reference), 2.0);
  // The table turns through no angle in 30 s, but it goes on warming.
  for (std::size_t hole = 1; hole < 7; ++hole) EXPECT_NEAR(moved_um(hole), reference, 0.1) << hole;
}

/// The demo: coefficient, temperature and touches say the same of the bar, while the table under it grows as well.
TEST(VirtualCampaign, TheHoleBarOfTheDemoGrowsAsItsTemperatureSays) {
  const spindrift::testing::TempFolder folder;
  writeCampaign(simulateCampaign(shipped("hole_bar.json"), std::nullopt, {}), folder / "c");
  const Campaign campaign = Campaign::read(folder / "c");
  const TouchList list = TouchList::read(campaign.path("captures/touches.csv"));
  const HoleCycleResult result =
      evaluateHoleCycles(list, campaign.machine, campaign.machine.artefacts.front(), {}, campaign.log.get());
  ASSERT_GT(result.growth.size(), 20U);
  double worst = 0.0;
  for (const ExpectedGrowth& g : result.growth) {
    const double z = std::abs(g.measured_um_per_m - g.expected_um_per_m) /
                     std::hypot(g.measured_sigma_um_per_m, g.expected_sigma_um_per_m);
    worst = std::max(worst, z);
    if (g.cycle == "M15")
      std::printf("M15: touches %.1f +- %.1f um/m, temperature %.1f um/m\n", g.measured_um_per_m,
                  g.measured_sigma_um_per_m, g.expected_um_per_m);
  }
  EXPECT_LT(worst, 4.0);
  for (const std::string& w : result.warnings) EXPECT_EQ(w.find("seems to have grown"), std::string::npos) << w;
}

TEST(VirtualCampaign, TouchesOfBallsLieOnTheBalls) {
  Scenario scenario = shipped("ball_artefact.json");
  scenario.touches->sigma_um = 0.0;
  scenario.touches->pretravel_um = 0.0;
  scenario.effects.clear();
  const VirtualCampaign made = simulateCampaign(scenario, 1, {});
  ASSERT_EQ(made.touches.size(), 12u * 3u * 4u * 5u);
  const Artefact& artefact = scenario.machine.artefacts.front();
  for (const TouchRow& touch : made.touches) {
    for (const ArtefactBall& ball : artefact.balls) {
      if (ball.id != touch.feature) continue;
      const Eigen::Vector3d centre = scenario.touches->origin_mm + ball.certified_mm;
      EXPECT_NEAR((touch.position_mm - centre).norm(), 12.7 + 2.5, 1e-5);
      EXPECT_LT((touch.position_mm - centre).dot(touch.approach), 0.0);
    }
  }
}

TEST(VirtualCampaign, CancelsWithoutWriting) {
  std::stop_source stop;
  stop.request_stop();
  const JobContext job(stop.get_token(), nullptr);
  EXPECT_THROW((void)simulateCampaign(shipped("discrepancy_vertical.json"), 1, job), Cancelled);
}

}  // namespace
}  // namespace spindrift
