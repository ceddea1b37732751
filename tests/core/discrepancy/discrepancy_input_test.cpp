// SPDX-License-Identifier: GPL-3.0-or-later
// Bad and incomplete input: refused with a sentence, or worked with and said so.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <utility>

#include "core/base/error.h"
#include "core/discrepancy/comparable_rows.h"
#include "core/discrepancy/drivers.h"
#include "core/discrepancy/log_gaps.h"
#include "core/finite_elements/fe_simulation.h"
#include "tests/core/discrepancy/small_plant.h"
#include "tests/support/refusal.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

using namespace small_plant;
using ::testing::Contains;
using ::testing::HasSubstr;

std::string refusal(const DiscrepancyInput& input) {
  return testing::refusal([&] { (void)run(input); });
}

/// The log again from the rows that `keep` wants, with the signals but those left out.
template <typename Keep>
OperatingLog filtered(const OperatingLog& log, const std::vector<std::string>& without, const Keep& keep) {
  std::vector<double> time;
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < log.time_s().size(); ++i) {
    if (!keep(log.time_s()[i])) continue;
    time.push_back(log.time_s()[i]);
    rows.push_back(i);
  }
  OperatingLog out(time);
  for (const std::string& name : log.names()) {
    if (std::find(without.begin(), without.end(), name) != without.end() || log.signal(name) == nullptr) continue;
    std::vector<double> values;
    for (const std::size_t i : rows) values.push_back((*log.signal(name))[i]);
    out.setSignal(name, values);
  }
  return out;
}

const auto all_rows = [](double) { return true; };

TEST(DiscrepancyInput, CountsObservationsThatTheSimulationLacks) {
  DiscrepancyInput input = campaign(Hidden::SpindleDrift, 31);
  for (std::size_t i = 0; i < input.predicted.size(); i += 10) {
    input.predicted[i] = std::numeric_limits<double>::quiet_NaN();
  }
  const DiscrepancyResult result = run(input);
  EXPECT_EQ(result.unmatched, (input.predicted.size() + 9) / 10);
  EXPECT_THAT(result.warnings, Contains(HasSubstr("no prediction in the simulation")));
  ASSERT_EQ(result.effects.size(), 1u);
  EXPECT_EQ(result.effects[0].id, "spindle.drift.y");
}

TEST(DiscrepancyInput, NamesTheSimulationWhenItMatchesTooLittle) {
  DiscrepancyInput input = campaign(Hidden::Nothing, 32);
  input.base_table = "simulation.csv";
  for (std::size_t i = 0; i < input.predicted.size() * 6 / 10; ++i) {
    input.predicted[i] = std::numeric_limits<double>::quiet_NaN();
  }
  EXPECT_THAT(refusal(input), HasSubstr("simulation.csv"));
}

TEST(DiscrepancyInput, RefusesSigmaThatIsNotPositive) {
  for (const double sigma : {0.0, -0.5, std::numeric_limits<double>::quiet_NaN()}) {
    DiscrepancyInput input = campaign(Hidden::Nothing, 33);
    input.observations.rows[17].sigma = sigma;
    const std::string text = refusal(input);
    EXPECT_THAT(text, HasSubstr("sigma"));
    EXPECT_THAT(text, HasSubstr("18"));
  }
}

TEST(DiscrepancyInput, WorksWithOnePointAlone) {
  for (const Hidden hidden : {Hidden::Nothing, Hidden::SpindleDrift}) {
    DiscrepancyInput whole = campaign(hidden, 34, 8.0);
    DiscrepancyInput input = whole;
    input.observations.rows.clear();
    input.predicted.clear();
    for (std::size_t i = 0; i < whole.predicted.size(); ++i) {
      if (whole.observations.rows[i].point != "F4") continue;
      input.observations.rows.push_back(whole.observations.rows[i]);
      input.predicted.push_back(whole.predicted[i]);
    }
    const DiscrepancyResult result = run(input);
    if (hidden == Hidden::Nothing) {
      EXPECT_EQ(result.verdict, DiscrepancyVerdict::None);
    } else {
      EXPECT_NE(result.verdict, DiscrepancyVerdict::None);
      // One point cannot tell a drift from what grows along an axis: no other component may be named.
      for (const FoundEffect& e : result.effects) EXPECT_NE(e.id, "spindle.growth.z");
    }
  }
}

TEST(DiscrepancyInput, PromisesNothingFromWhereOnePointSaysNothing) {
  for (std::uint64_t seed = 34; seed < 38; ++seed) {
    const DiscrepancyInput whole = campaign(Hidden::Screw, seed, 8.0);
    DiscrepancyInput input = whole;
    input.observations.rows.clear();
    input.predicted.clear();
    for (std::size_t i = 0; i < whole.predicted.size(); ++i) {
      if (whole.observations.rows[i].point != "F3") continue;
      input.observations.rows.push_back(whole.observations.rows[i]);
      input.predicted.push_back(whole.predicted[i]);
    }
    const DiscrepancyResult result = run(input);
    const double promised = result.suggestion ? result.suggestion->expected_delta_bic : 0.0;
    EXPECT_LT(promised, 1e6) << "seed " << seed;
  }
}

TEST(DiscrepancyInput, SaysWhenTheLogIsShorterThanTheObservations) {
  DiscrepancyInput input = campaign(Hidden::SpindleDrift, 35);
  input.log = filtered(*input.log, {}, [](double t) { return t < 22000.0; });
  const DiscrepancyResult result = run(input);
  EXPECT_THAT(result.warnings, Contains(HasSubstr("later than the end of the log")));
  for (const FoundEffect& e : result.effects) EXPECT_EQ(e.id, "spindle.drift.y");
}

TEST(DiscrepancyInput, SaysWhereTheLogHasAGap) {
  DiscrepancyInput input = campaign(Hidden::Nothing, 36);
  input.log = filtered(*input.log, {}, [](double t) { return t < 20000.0 || t > 24000.0; });
  const DiscrepancyResult result = run(input);
  EXPECT_THAT(result.warnings, Contains(HasSubstr("gap")));
  EXPECT_EQ(result.verdict, DiscrepancyVerdict::None);
}

TEST(DiscrepancyInput, NamesAnEffectThoughTheLogHasAGapOfTwoHours) {
  for (std::uint64_t seed = 51; seed < 55; ++seed) {
    DiscrepancyInput input = campaign(Hidden::SpindleDrift, seed, 8.0);
    input.log = filtered(*input.log, {"T_spindle_degC"}, [](double t) { return t < 10000.0 || t > 17200.0; });
    const DiscrepancyResult result = run(input);
    EXPECT_THAT(result.warnings, Contains(HasSubstr("what the machine did in it is not known")));
    ASSERT_EQ(result.effects.size(), 1u) << "seed " << seed << ": " << result.summary();
    EXPECT_EQ(result.effects[0].id, "spindle.drift.y") << "seed " << seed << ": " << result.summary();
  }
}

TEST(LogGaps, AreLongStepsAndTheTimeUntilTheirHeatHasGone) {
  std::vector<double> time;
  for (int i = 0; i < 100; ++i) time.push_back(60.0 * i);
  for (int i = 0; i < 100; ++i) time.push_back(5940.0 + 2400.0 + 60.0 * i);
  for (int i = 0; i < 100; ++i) time.push_back(time[199] + 9000.0 + 60.0 * i);
  const std::vector<LogGap> gaps = logGaps(time);
  ASSERT_EQ(gaps.size(), 2u);
  EXPECT_EQ(gaps[0].row_before, 99u);
  EXPECT_DOUBLE_EQ(gaps[0].known_from_s, 5940.0 + 2400.0 + 4800.0);
  EXPECT_DOUBLE_EQ(gaps[1].known_from_s, gaps[1].to_s + 7200.0);
  EXPECT_FALSE(inGap(gaps, 5940.0));
  EXPECT_TRUE(inGap(gaps, 6000.0));
  EXPECT_TRUE(inGap(gaps, 13000.0));
  EXPECT_FALSE(inGap(gaps, 13140.0));
  // A step of 20 minutes is none, and of slow logs neither is one of 40.
  EXPECT_TRUE(logGaps(std::vector<double>{0.0, 60.0, 120.0, 180.0, 1380.0, 1440.0}).empty());
  EXPECT_TRUE(logGaps(std::vector<double>{0.0, 600.0, 1200.0, 1800.0, 4200.0, 4800.0}).empty());
}

TEST(LogGaps, TakeASpeedThatChangedAtItsMeanAndATemperatureStraightOn) {
  OperatingLog log({0.0, 60.0, 120.0, 180.0, 7380.0, 7440.0});
  log.setSignal("spindle_rpm", {1000.0, 1000.0, 1000.0, 1000.0, 4000.0, 4000.0});
  log.setSignal("coolant", {0.0, 1.0, 1.0, 1.0, 1.0, 0.0});
  log.setSignal("T_room_degC", {20.0, 20.0, 20.0, 20.0, 22.0, 22.0});
  const DriverTable drivers(machine(), &log);
  const std::vector<double> in_gap{3000.0};
  EXPECT_NEAR(drivers.response(*drivers.find("spindle_rpm^1"), 0.0, -1.0, in_gap)[0], 2.0, 1e-9);
  EXPECT_NEAR(drivers.response(*drivers.find("coolant"), 0.0, -1.0, in_gap)[0], 1.0, 1e-9);
  EXPECT_NEAR(drivers.response(*drivers.find("T_room_degC"), 0.0, -1.0, in_gap)[0], 2.0 * 2820.0 / 7200.0, 1e-6);
}

TEST(DiscrepancyInput, ComparesNothingHeldOutAfterTheEndOfTheLog) {
  DiscrepancyInput input = campaign(Hidden::SpindleDrift, 35, 8.0);
  const double whole = run(input).gap.heldout_rms_before_um;
  // Beyond the log by far: an error there must not count.
  input.log = filtered(*input.log, {}, [](double t) { return t < 36000.0; });
  const double shorter = run(input).gap.heldout_rms_before_um;
  for (Observation& o : input.observations.rows) {
    if (o.time_s > 37000.0) o.value += 100.0;
  }
  EXPECT_NEAR(run(input).gap.heldout_rms_before_um, shorter, 1e-9);
  EXPECT_NE(whole, shorter);
}

TEST(DiscrepancyInput, SaysThatTenObservationsDecideNothing) {
  DiscrepancyInput input = campaign(Hidden::SpindleDrift, 44, 8.0);
  input.observations.rows.resize(10);
  input.predicted.resize(10);
  const DiscrepancyResult result = run(input);
  EXPECT_FALSE(result.decided);
  EXPECT_TRUE(result.effects.empty());
  EXPECT_THAT(result.message, HasSubstr("10 observations in 1 state: too few observations per series"));
  EXPECT_THAT(result.message, HasSubstr("cannot be decided"));
}

TEST(DiscrepancyInput, FitsNothingFromWhereTheSpindleSpeedChangedUnseen) {
  DiscrepancyInput input = campaign(Hidden::Nothing, 46);
  const std::vector<double>& t = input.log->time_s();
  const std::vector<double>& rpm = *input.log->signal("spindle_rpm");
  std::size_t change = 1;
  while (rpm[change] == rpm[change - 1]) ++change;
  std::vector<std::string> warnings;
  const std::size_t all = comparableRows(input, 0.0, warnings).fit.size();
  EXPECT_TRUE(warnings.empty());
  // Three readings ten seconds before the row with the other speed, one at this row.
  for (std::size_t i = 0; i < 3; ++i) input.observations.rows[i].time_s = t[change] - 10.0;
  input.observations.rows[3].time_s = t[change];
  const ComparableRows left = comparableRows(input, 0.0, warnings);
  EXPECT_EQ(left.fit.size(), all - 3);
  EXPECT_EQ(left.fit.front(), 3U);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_THAT(warnings.front(), HasSubstr("3 observations lie between two rows"));
  // A log that is as coarse everywhere is what there is.
  warnings.clear();
  for (Observation& o : input.observations.rows) o.time_s = t[change] - 10.0;
  EXPECT_EQ(comparableRows(input, 0.0, warnings).fit.size(), all);
  EXPECT_TRUE(warnings.empty());
}

TEST(DiscrepancyInput, LeavesADeadSensorOut) {
  DiscrepancyInput input = campaign(Hidden::SpindleDrift, 37);
  input.log->setSignal("T_spindle_degC", std::vector<double>(input.log->time_s().size(), 20.0));
  const DiscrepancyResult result = run(input);
  EXPECT_THAT(result.warnings, Contains(HasSubstr("T_spindle_degC never moves")));
  ASSERT_EQ(result.effects.size(), 1u);
  EXPECT_EQ(result.effects[0].id, "spindle.drift.y");
}

TEST(DiscrepancyInput, WithoutSpindleSpeedATemperatureOfTheSpindleWillDo) {
  DiscrepancyInput input = campaign(Hidden::SpindleDrift, 38);
  input.log = filtered(*input.log, {"spindle_rpm"}, all_rows);
  const DiscrepancyResult result = run(input);
  EXPECT_THAT(result.warnings, Contains(HasSubstr("no spindle_rpm")));
  ASSERT_EQ(result.effects.size(), 1u);
  EXPECT_EQ(result.effects[0].id, "spindle.drift.y");
}

TEST(DiscrepancyInput, WithoutAnythingThatShowsTheSpindleASetHoldsItOrNothingIsNamed) {
  for (std::uint64_t seed = 39; seed < 43; ++seed) {
    DiscrepancyInput input = campaign(Hidden::SpindleDrift, seed);
    input.log = filtered(*input.log, {"spindle_rpm", "T_spindle_degC"}, all_rows);
    const DiscrepancyResult result = run(input);
    if (result.verdict == DiscrepancyVerdict::Unknown) {
      EXPECT_TRUE(result.effects.empty());
      EXPECT_FALSE(result.leftover.empty());
      continue;
    }
    ASSERT_EQ(result.verdict, DiscrepancyVerdict::Ambiguous) << result.summary();
    ASSERT_EQ(result.effects.size(), 1u) << result.summary();
    EXPECT_LE(result.effects[0].rivals.size(), 2u);
    EXPECT_THAT(result.effects[0].rivals, Contains("spindle.drift.y")) << result.summary();
    EXPECT_THAT(result.warnings, Contains(HasSubstr("the log lacks what drives the latter")));
  }
}

TEST(DiscrepancyInput, SaysWhichEffectsTheLogCannotDecide) {
  const auto said = [](const DiscrepancyResult& result, const std::string& id) {
    return std::any_of(result.warnings.begin(), result.warnings.end(), [&](const std::string& warning) {
      return warning.starts_with("Not to be decided") && warning.find(id) != std::string::npos;
    });
  };
  DiscrepancyInput input = campaign(Hidden::SpindleDrift, 2);
  EXPECT_TRUE(said(run(input), "heat_source.position.z"));
  std::vector<double> place;
  for (std::size_t i = 0; i < input.log->time_s().size(); ++i) place.push_back(i % 400 < 200 ? 50.0 : 300.0);
  input.log->setSignal("pos_z_mm", place);
  EXPECT_FALSE(said(run(input), "heat_source.position.z"));
  EXPECT_TRUE(said(run(input), "heat_source.position.x"));
}

TEST(DiscrepancyInput, TellsWhichSideIsInMillimetres) {
  DiscrepancyInput simulation = campaign(Hidden::Nothing, 40);
  for (double& p : simulation.predicted) p *= 1e-3;
  EXPECT_THAT(refusal(simulation), HasSubstr("the simulation in mm, or the observations in nm"));
  DiscrepancyInput measured = campaign(Hidden::Nothing, 40);
  for (Observation& o : measured.observations.rows) {
    o.value *= 1e-3;
    o.sigma *= 1e-3;
  }
  EXPECT_THAT(refusal(measured), HasSubstr("the observations in mm, or the simulation in nm"));
}

TEST(DiscrepancyInput, SaysByHowMuchAStatedSigmaIsWrong) {
  // A sigma in mm or in nm: the factor is a number, not 0.00.
  for (const auto& [factor, said_as] : {std::pair{1e-3, "scatters [89][0-9]{2}|scatters 1[01][0-9]{2} times"},
                                        std::pair{1e3, "scatters 0\\.00(1[01]|0[89][0-9]) times"}}) {
    DiscrepancyInput input = campaign(Hidden::Nothing, 40);
    for (Observation& o : input.observations.rows) o.sigma *= factor;
    EXPECT_THAT(run(input).warnings, ::testing::Contains(::testing::ContainsRegex(said_as))) << factor;
  }
}

TEST(DiscrepancyInput, ReadsASimulationTableOnlyWhole) {
  const testing::TempFolder folder;
  const auto read = [&](const std::string& text) -> std::string {
    const auto file = folder.path() / "simulation.csv";
    std::ofstream(file) << text;
    try {
      (void)SimulationTable::read(file);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(read("time_s,point,component,predicted\n0,F1,EX,1\n10,F1,EX,2\n"), "");
  EXPECT_THAT(read("time_s,point,component\n0,F1,EX\n"), HasSubstr("predicted"));
  EXPECT_THAT(read("time_s,point,component,predicted\n0,F1,EQ,1\n"), HasSubstr("EQ"));
  EXPECT_THAT(read("time_s,point,component,predicted\n0,F1,EX,nan\n"), HasSubstr("nan"));
  EXPECT_THAT(read("time_s,point,component,predicted\n9,F1,EX,1\n0,F1,EX,2\n"), HasSubstr("backwards"));
  EXPECT_THAT(read("time_s,point,component,predicted\n0,F1,EX,1\n0,F1,EX,2\n"), HasSubstr("duplicate"));
}

}  // namespace
}  // namespace spindrift
