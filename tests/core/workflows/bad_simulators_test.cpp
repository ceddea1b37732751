// SPDX-License-Identifier: GPL-3.0-or-later
// Simulators that go wrong for some values, from the campaign to the answer: each is told in one sentence, and nothing
// of the campaign and of the simulator's files changes.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>

#include "core/base/atomic_file.h"
#include "core/base/random.h"
#include "core/workflows/discrepancy_workflow.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::HasSubstr;

constexpr double growth_um = 9.0;
constexpr double lag_s = 2400.0;
constexpr double state_s = 1200.0;
constexpr int states = 24;

double grown(double t) {
  return 1.0 - std::exp(-t / lag_s);
}

/// A spindle that grows by 9 um and warms the table; the simulation is a program that lacks the growth and does `wrong`
/// when it is more than 6 um.
class BadSimulatorTest : public ::testing::Test {
 protected:
  void write(const std::string& wrong, const std::string& more_parameters = "", double most = 40.0) {
    folder_.write("c/campaign.json",
                  R"({"format":"spindrift-campaign","version":1,"name":"small","start_utc":"2026-03-01T08:00:00Z",)"
                  R"("simulation":"simulation.csv","simulator":"sim/simulator.json"})");
    Random random(5);
    std::string points;
    std::string observations = "time_s,state,point,x_mm,y_mm,z_mm,c_deg,component,value,sigma,instrument,use\n";
    std::string simulation = "time_s,point,component,predicted\n";
    std::string log = "time_s,spindle_rpm,T_ambient_degC\n";
    for (int state = 0; state < states; ++state) {
      const double t = state_s * state;
      log += fmt::format("{},6000,21\n", t);
      for (int p = 1; p <= 4; ++p) {
        const double x = 90.0 * p;
        if (state == 0)
          points +=
              fmt::format(R"({}{{"id":"P{}","kind":"ball","x_mm":{},"y_mm":100,"z_mm":20}})", p > 1 ? "," : "", p, x);
        for (const char* c : {"EX", "EZ"}) {
          const double known = c[1] == 'X' ? 2e-4 * t * x / 400.0 : 0.0;
          const double hidden = c[1] == 'Z' ? growth_um * grown(t) : 0.0;
          observations += fmt::format("{},M{},P{},{},100,20,0,{},{},0.3,probe,{}\n", t, state, p, x, c,
                                      known + hidden + random.normal(0.0, 0.3), state < 17 ? "fit" : "holdout");
          simulation += fmt::format("{},P{},{},{}\n", t, p, c, known);
        }
      }
    }
    folder_.write("c/observations.csv", observations);
    folder_.write("c/simulation.csv", simulation);
    folder_.write("c/log.csv", log);
    folder_.write(
        "c/machine.json",
        R"({"format":"spindrift-machine","version":1,"name":"mill","chain":"V [w-X'-Y'-b-Z-t]","axes":[)"
        R"({"name":"X","travel_mm":[0,500]},{"name":"Y","travel_mm":[0,400]},{"name":"Z","travel_mm":[0,300]}],)"
        R"("spindle":{"axis":"Z","max_rpm":6000},"points":[)" +
            points + "]}");
    folder_.write("c/sim/values.txt.in", "growth {{growth}}\ndrift {{drift}}\n");
    folder_.write("c/sim/run.sh", fmt::format(R"(growth=$(awk '$1=="growth"{{print $2}}' values.txt)
rows={}
if awk -v g="$growth" 'BEGIN{{exit !(g > 6)}}'; then
  {}
fi
awk -v rows="$rows" '$1=="growth"{{g=$2}} $1=="drift"{{d=$2}} END{{
  print "time_s,point,component,predicted"
  for (i = 0; i < rows; ++i) for (p = 1; p <= 4; ++p) {{
    t = i * {}
    printf "%d,P%d,EX,%.9g\n", t, p, d * t * 90 * p / 400
    printf "%d,P%d,EZ,%.9g\n", t, p, g * (1 - exp(-t / {}))
  }} }}' values.txt > simulation.csv
)",
                                              states, wrong, state_s, lag_s));
    folder_.write(
        "c/sim/simulator.json",
        fmt::format(R"({{"format":"spindrift-simulator","version":1,"kind":"command","templates":["values.txt.in"],
 "include":["run.sh"],"run":[["sh","run.sh"]],"result":"simulation.csv","time_limit_s":2,"parameters":[
 {{"name":"growth","value":0,"unit":"um","standard_uncertainty":4,"min":0,"max":{},"what":"growth of the spindle",
  "effects":["spindle.growth.z"]}},
 {{"name":"drift","value":2e-4,"unit":"um/s","standard_uncertainty":1e-5,"min":0,"max":1e-3,"what":"drift"}}{}]}})",
                    most, more_parameters));
  }
  [[nodiscard]] std::map<std::string, std::string> files() const {
    std::map<std::string, std::string> out;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / "c")) {
      if (entry.is_regular_file()) out[entry.path().string()] = readFile(entry.path());
    }
    return out;
  }
  DiscrepancyRun run() {
    DiscrepancyRequest request;
    request.campaign = folder_ / "c";
    request.into_simulation = folder_ / "new";
    request.mechanisms = {"growth"};
    JobContext job;
    return runDiscrepancy(request, job);
  }
  void SetUp() override {
    fs::create_directories(folder_ / "runs");
    ASSERT_EQ(setenv("SPINDRIFT_CACHE", (folder_ / "cache").c_str(), 1), 0);
    ASSERT_EQ(setenv("TMPDIR", (folder_ / "runs").c_str(), 1), 0);
  }
  void TearDown() override {
    unsetenv("TMPDIR");
    unsetenv("SPINDRIFT_CACHE");
  }

  testing::TempFolder folder_;
};

TEST_F(BadSimulatorTest, WhatGoesWrongBeyondAValueIsToldAndTheFitKeepsBelowIt) {
  const std::map<std::string, std::string> cases{
      {"echo 'no licence left'; exit 3", "ended with status 3 and said \"no licence left\""},
      {"sleep 30", "was not done after 2 s"},
      {"exit 0", "left no simulation.csv"},
      {"printf 'time_s,point,component,predicted\\n0,P1,EX,nan\\n' > simulation.csv; exit 0", "is not a number"},
      {"rows=9", "predictions where it gave"}};
  for (const auto& [wrong, said] : cases) {
    SCOPED_TRACE(wrong);
    fs::remove_all(folder_ / "new");
    fs::remove_all(folder_ / "c");
    write(wrong);
    const auto before = files();
    const DiscrepancyRun told = run();
    ASSERT_TRUE(told.update.has_value());
    const SimulationUpdate& update = *told.update;
    EXPECT_THAT(update.warnings, Contains(HasSubstr(said))) << update.summary();
    EXPECT_EQ(update.status, FitStatus::Converged) << update.message;
    for (const FittedSimulatorParameter& p : update.parameters) {
      if (p.parameter.name == "growth") {
        EXPECT_LE(p.value, 6.0);
        EXPECT_GT(p.value, 3.0);
      }
    }
    EXPECT_LT(update.heldout_rms_after_um, update.heldout_rms_before_um);
    EXPECT_EQ(files(), before);
  }
}

TEST_F(BadSimulatorTest, WithoutInfluenceTwinsAndBoundsAreTold) {
  write("rows=24",
        R"(,{"name":"paint","value":1,"unit":"1","standard_uncertainty":0.1,"min":0,"max":2,"what":"colour"})", 5.0);
  const auto before = files();
  const DiscrepancyRun told = run();
  ASSERT_TRUE(told.update.has_value());
  EXPECT_THAT(told.update->warnings, Contains(HasSubstr("paint changes no prediction")));
  EXPECT_THAT(told.update->warnings, Contains(HasSubstr("growth ends at its bound 5 µm")));
  EXPECT_EQ(files(), before);
}

TEST_F(BadSimulatorTest, OneThatNeverWorksIsOneSentence) {
  write("rows=24");
  folder_.write("c/sim/run.sh", "echo 'no licence left'; exit 3\n");
  const auto before = files();
  try {
    (void)run();
    FAIL() << "a simulator that never works";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("no licence left"));
  }
  EXPECT_FALSE(fs::exists(folder_ / "new"));
  EXPECT_EQ(files(), before);
}

}  // namespace
}  // namespace spindrift
