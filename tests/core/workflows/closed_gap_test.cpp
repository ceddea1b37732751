// SPDX-License-Identifier: GPL-3.0-or-later
// From the gap to the closed gap on finite elements, with the real solver: the C-frame machine of which the simulation
// lacks the friction of its spindle. A coarse mesh, so that it stays below a minute.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "core/base/atomic_file.h"
#include "core/simulator/c_frame.h"
#include "core/workflows/discrepancy_workflow.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

using ::testing::Contains;

TEST(ClosedGap, FrictionGoesIntoTheDeckAndTheSolverAgrees) {
  if (!calculixIsInstalled()) GTEST_SKIP() << "CalculiX (ccx) is not installed";
  const testing::TempFolder folder;
  ASSERT_EQ(setenv("SPINDRIFT_CACHE", (folder / "cache").c_str(), 1), 0);
  CFrameCampaignOptions options;
  options.coarse_cell_mm = 200.0;
  options.fine_cell_mm = 130.0;
  options.states = 16;
  options.state_interval_s = 1800.0;
  options.increment_s = 600.0;
  JobContext job;
  const CFrameCampaign made = writeCFrameCampaign(CFrameStory::Friction, folder / "machine", 3, job, options);
  const std::string deck = readFile(folder / "machine/fe/simulator.json");
  DiscrepancyRequest request;
  request.campaign = folder / "machine";
  request.into_simulation = folder / "closed";
  const DiscrepancyRun run = runDiscrepancy(request, job);
  ASSERT_FALSE(run.result.effects.empty()) << run.result.message << run.result.leftover;
  EXPECT_EQ(run.result.effects.front().id, "simulation.friction");
  ASSERT_TRUE(run.update.has_value());
  const SimulationUpdate& update = *run.update;
  EXPECT_EQ(update.status, FitStatus::Converged) << update.message;
  EXPECT_THAT(update.mechanisms, Contains("friction"));
  EXPECT_LT(update.heldout_rms_after_um, 0.4 * update.heldout_rms_before_um) << update.message;
  EXPECT_LT(update.heldout_rms_after_um, 1.5 * update.noise_um) << update.message;
  for (const FittedSimulatorParameter& p : update.parameters) {
    if (p.parameter.name != "friction") continue;
    const double truth = made.truth.at("hidden").at("friction").get<double>();
    EXPECT_NEAR(p.value, truth, 0.25 * truth);
    EXPECT_GT(p.standard_uncertainty, 0.0);
  }
  // Few runs: each counts on a real model.
  EXPECT_LE(update.runs_to_search, 20U);
  EXPECT_LE(update.runs, 16U) << "once more for each parameter: friction changes what they do";
  EXPECT_EQ(readFile(folder / "machine/fe/simulator.json"), deck) << "the simulator in use is not touched";
  EXPECT_TRUE(std::filesystem::exists(folder / "closed/mesh.inp"));
  EXPECT_TRUE(std::filesystem::exists(folder / "closed/simulation.csv"));
}

}  // namespace
}  // namespace spindrift
