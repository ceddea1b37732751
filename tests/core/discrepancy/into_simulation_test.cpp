// SPDX-License-Identifier: GPL-3.0-or-later
// The missing effect in the simulation itself: named as a parameter of the simulator, put in, and the gap closed by the
// simulator's own new run.
#include "core/discrepancy/into_simulation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

#include "core/discrepancy/discrepancy_numbers.h"
#include "core/discrepancy/mechanism_choice.h"
#include "core/discrepancy/simulator_tangents.h"
#include "tests/core/discrepancy/heated_column.h"

namespace spindrift {
namespace {

using namespace heated_column;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

struct Told {
  DiscrepancyResult found;
  SimulationUpdate update;
};

Told tell(Column& column, const IntoSimulationOptions& options = {}) {
  JobContext job;
  column.input.tangents =
      std::make_shared<const SimulatorTangents>(simulatorTangents(*column.simulator, column.input.observations, job));
  Told out;
  out.found = findDiscrepancy(column.input, {}, job);
  out.update = putIntoSimulation(column.input, out.found, *column.simulator, options, job);
  return out;
}

std::vector<std::string> idsOf(const DiscrepancyResult& result) {
  std::vector<std::string> ids;
  for (const FoundEffect& e : result.effects) ids.push_back(e.id);
  return ids;
}

const FittedSimulatorParameter& parameterOf(const SimulationUpdate& update, const std::string& name) {
  const auto found = std::find_if(update.parameters.begin(), update.parameters.end(),
                                  [&](const FittedSimulatorParameter& p) { return p.parameter.name == name; });
  if (found == update.parameters.end()) throw std::runtime_error(name + " was not fitted");
  return *found;
}

/// What remains of the truth, without noise, on held-out rows, each series free of a constant from its fit rows.
double trueGap(const Column& column, const std::vector<double>& predicted) {
  std::map<std::pair<std::string, Component>, std::pair<double, int>> mean;
  const auto& rows = column.input.observations.rows;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].use != ObservationUse::Fit) continue;
    auto& [sum, count] = mean[{rows[i].point, rows[i].component}];
    sum += column.truth[i] - predicted[i];
    ++count;
  }
  double power = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].use != ObservationUse::Holdout) continue;
    const auto& [sum, n] = mean[{rows[i].point, rows[i].component}];
    power += std::pow(column.truth[i] - predicted[i] - sum / n, 2);
    ++count;
  }
  return std::sqrt(power / count);
}

struct Story {
  const char* name;
  ParameterValues truth;
  ParameterValues simulator;  ///< values that the simulator has in place of the standard ones
  const char* mechanism;
  double h_air_uncertainty = 1.5;
};

std::vector<SimulatorParameter> parametersWith(const ParameterValues& values, double h_air_uncertainty = 1.5) {
  std::vector<SimulatorParameter> out = standardParameters();
  for (SimulatorParameter& p : out) {
    if (p.name == "h_air") p.standard_uncertainty = h_air_uncertainty;
    if (values.contains(p.name)) p.value = values.at(p.name);
  }
  return out;
}

TEST(IntoSimulation, NamesTheMechanismAndClosesTheGap) {
  const std::vector<Story> stories{
      {"sun", {{"sun_front", 120.0}, {"sun_on_s", 7500.0}, {"sun_off_s", 17000.0}}, {}, "sun_front"},
      {"friction", {{"friction", 9.0}}, {{"friction", 0.0}}, "friction"},
      {"coolant", {{"h_coolant", 260.0}, {"coolant_K", -4.3}}, {}, "h_coolant"},
      {"film", {{"h_air", 17.0}}, {}, "h_air"},
      {"sensor", {{"sensor.T_room_degC.gain", 0.3}}, {}, "sensor.T_room_degC.gain", 0.2}};
  for (const Story& story : stories) {
    SCOPED_TRACE(story.name);
    Column column = columnCampaign(story.truth, 11, 0.3, parametersWith(story.simulator, story.h_air_uncertainty));
    const Told told = tell(column);
    ASSERT_FALSE(told.found.effects.empty())
        << trueGap(column, column.input.predicted) << " " << told.found.message << told.found.leftover;
    EXPECT_THAT(idsOf(told.found), Contains(column.simulator->find(story.mechanism)->id()));
    EXPECT_EQ(told.update.status, FitStatus::Converged) << told.update.message;
    EXPECT_THAT(told.update.mechanisms, Contains(story.mechanism));
    const double before = trueGap(column, told.update.before);
    const double after = trueGap(column, told.update.after);
    EXPECT_LT(after, 0.1 * before) << told.update.summary();
    EXPECT_LT(after, 0.15) << told.update.summary();
    const FittedSimulatorParameter& fitted = parameterOf(told.update, story.mechanism);
    EXPECT_NEAR(fitted.value, story.truth.at(story.mechanism), 4.0 * fitted.standard_uncertainty);
    EXPECT_GT(fitted.standard_uncertainty, 0.0);
    EXPECT_TRUE(told.update.as_well_as_fitted_term) << told.update.message;
  }
}

/// Share of 2,000 draws of `states` states with eight values each, a shift common to each state in them, in which the
/// first of two predictions is said to leave more. `worse_um`: how much further from the truth it is.
double shareSaidToLeaveMore(std::size_t states, double worse_um) {
  Random random(17);
  constexpr int draws = 2000;
  int said = 0;
  for (int draw = 0; draw < draws; ++draw) {
    std::vector<Observation> observations;
    std::vector<std::size_t> rows;
    std::vector<double> a;
    std::vector<double> b;
    for (std::size_t state = 0; state < states; ++state) {
      const double shift = random.normal();
      const double wrong_a = random.normal();
      const double wrong_b = random.normal();
      for (int value = 0; value < 8; ++value) {
        Observation o;
        o.state = "M" + std::to_string(state);
        rows.push_back(observations.size());
        observations.push_back(o);
        const double noise = shift + random.normal();
        a.push_back(noise + std::hypot(0.3, worse_um) * wrong_a);
        b.push_back(noise + 0.3 * wrong_b);
      }
    }
    said += probabilityOfLeavingMore(observations, rows, a, b) > 0.95 ? 1 : 0;
  }
  return static_cast<double>(said) / draws;
}

TEST(IntoSimulation, TellsThatThePhysicsLeaveMoreAsOftenByChanceAsStated) {
  EXPECT_NEAR(shareSaidToLeaveMore(10, 0.0), 0.05, 0.02);
  EXPECT_NEAR(shareSaidToLeaveMore(40, 0.0), 0.05, 0.02);
  EXPECT_GT(shareSaidToLeaveMore(40, 2.0), 0.95);
  const std::vector<Observation> one(1);
  EXPECT_EQ(probabilityOfLeavingMore(one, {0}, {3.0}, {1.0}), 0.5);
}

TEST(IntoSimulation, TakesFewRunsAndCountsThem) {
  struct Case {
    const char* name;
    ParameterValues truth;
    ParameterValues simulator;
    std::size_t most_to_fit;
  };
  const std::vector<Case> cases{{"sun", {{"sun_front", 120.0}, {"sun_on_s", 7500.0}, {"sun_off_s", 17000.0}}, {}, 9},
                                {"friction", {{"friction", 9.0}}, {{"friction", 0.0}}, 9}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name);
    Column column = columnCampaign(c.truth, 11, 0.3, parametersWith(c.simulator));
    const int before = column.simulator->runs;
    const Told told = tell(column);
    EXPECT_EQ(told.update.status, FitStatus::Converged) << told.update.message;
    EXPECT_LE(static_cast<std::size_t>(column.simulator->runs - before),
              told.update.runs_to_search + told.update.runs + 1)
        << "what is told is what was run";
    // As it stands, eight parameters, what goes far; a single run tells which load the sun's times belong to. To fit:
    // the first guess, a look around it (each of the others again where what is put in changes what they do), the end.
    EXPECT_LE(told.update.runs_to_search, 14U);
    EXPECT_GE(told.update.runs_to_search, 10U);
    EXPECT_LE(told.update.runs, c.most_to_fit);
  }
}

TEST(SimulatorTangents, OneRunTellsWhichLoadAWindowBelongsTo) {
  Column column = columnCampaign({}, 3, 0.3, parametersWith({{"friction", 0.0}}));
  JobContext job;
  const SimulatorTangents tangents = simulatorTangents(*column.simulator, column.input.observations, job);
  for (const SimulatorTangent& t : tangents.tangents) {
    if (!t.parameter.off()) continue;
    EXPECT_EQ(t.window != nullptr, t.parameter.name == "sun_front") << t.parameter.name;
    if (t.window) {
      EXPECT_EQ(t.window->begin_s, "sun_on_s");
    }
  }
  EXPECT_THAT(tangents.mute, Contains("sun_on_s"));
  EXPECT_THAT(tangents.mute, Contains("sun_off_s"));
}

TEST(IntoSimulation, FindsBeginAndEndOfALoad) {
  Column column =
      columnCampaign({{"sun_front", 120.0}, {"sun_on_s", 7500.0}, {"sun_off_s", 17000.0}, {"h_air", 10.0}}, 5, 0.3);
  const Told told = tell(column);
  for (const auto& [name, truth] : ParameterValues{{"sun_on_s", 7500.0}, {"sun_off_s", 17000.0}, {"h_air", 10.0}}) {
    const FittedSimulatorParameter& fitted = parameterOf(told.update, name);
    EXPECT_NEAR(fitted.value, truth, 4.0 * fitted.standard_uncertainty) << name;
  }
  EXPECT_LT(parameterOf(told.update, "sun_on_s").standard_uncertainty, 600.0);
}

TEST(IntoSimulation, StatesIntervalsThatCoverTheTruth) {
  int covered = 0;
  int of = 0;
  constexpr int campaigns = 24;
  for (int seed = 0; seed < campaigns; ++seed) {
    Random random(static_cast<std::uint64_t>(seed) + 77);
    const double friction = random.uniform(5.0, 14.0);
    const double h = std::max(4.0, random.normal(9.0, 1.5));
    const double k = random.normal(40.0, 3.0);
    Column column = columnCampaign({{"friction", friction}, {"h_air", h}, {"k_wall", k}},
                                   300 + static_cast<std::uint64_t>(seed), 0.3, parametersWith({{"friction", 0.0}}));
    const Told told = tell(column);
    if (told.update.status != FitStatus::Converged) continue;
    const FittedSimulatorParameter& fitted = parameterOf(told.update, "friction");
    covered += std::abs(fitted.value - friction) < 1.96 * fitted.standard_uncertainty ? 1 : 0;
    ++of;
  }
  EXPECT_GE(of, campaigns - 1);
  // 95 % of 24: 21 or more in 97 of 100 such tests.
  EXPECT_GE(covered, of - 3) << "of " << of;
}

TEST(IntoSimulation, NamesNothingWithinTheUncertaintyOfParameters) {
  int named = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Random random(seed);
    Column column = columnCampaign(
        {{"h_air", 9.0 + random.normal(0.0, 1.2)}, {"k_wall", 40.0 + random.normal(0.0, 2.5)}}, 500 + seed, 0.3);
    const Told told = tell(column);
    named += told.found.effects.empty() ? 0 : 1;
    if (!told.found.effects.empty()) continue;
    EXPECT_EQ(told.update.status, FitStatus::Degenerate);
    EXPECT_TRUE(told.update.values.empty());
  }
  EXPECT_LE(named, 1);
}

TEST(IntoSimulation, SaysWhatCannotBe) {
  {
    SCOPED_TRACE("a bound");
    std::vector<SimulatorParameter> parameters = parametersWith({{"friction", 0.0}});
    for (SimulatorParameter& p : parameters) {
      if (p.name == "friction") p.max = 5.0;
    }
    Column column = columnCampaign({{"friction", 9.0}}, 21, 0.3, parameters);
    const Told told = tell(column);
    EXPECT_TRUE(parameterOf(told.update, "friction").at_bound);
    EXPECT_THAT(told.update.warnings, Contains(HasSubstr("friction ends at its bound 5")));
  }
  {
    SCOPED_TRACE("without influence");
    Column column = columnCampaign({{"friction", 9.0}}, 22, 0.3, parametersWith({{"friction", 0.0}}));
    const Told told = tell(column);
    EXPECT_THAT(column.input.tangents->mute, Contains("paint"));
    EXPECT_THAT(told.update.warnings, Contains(HasSubstr("paint changes no prediction")));
    EXPECT_FALSE(told.update.values.contains("paint"));
  }
  {
    SCOPED_TRACE("the simulator fails for some values");
    for (const bool gives_nan : {false, true}) {
      Column column = columnCampaign({{"h_air", 17.0}}, 11, 0.3);
      column.simulator->fails_above = 12.0;
      column.simulator->gives_nan = gives_nan;
      const Told told = tell(column, {{"h_air"}});
      EXPECT_LE(parameterOf(told.update, "h_air").value, 12.0 + 1e-9);
      EXPECT_THAT(told.update.warnings, Contains(HasSubstr(gives_nan ? "gives no value" : "melts")));
    }
  }
  {
    SCOPED_TRACE("a tangent that fails is told");
    Column column = columnCampaign({{"friction", 9.0}}, 24, 0.3, parametersWith({{"friction", 0.0}}));
    column.simulator->fails_above = 9.5;
    const Told told = tell(column);
    EXPECT_THAT(column.input.tangents->notes, Contains(HasSubstr("What h_air does is not known: the column melts")));
    EXPECT_EQ(told.update.status, FitStatus::Converged);
  }
  {
    SCOPED_TRACE("an unknown mechanism");
    Column column = columnCampaign({{"friction", 9.0}}, 24, 0.3, parametersWith({{"friction", 0.0}}));
    EXPECT_THROW(static_cast<void>(tell(column, {{"moon"}})), InputError);
  }
}

TEST(IntoSimulation, SaysWhatIsAskedForAndNotSupported) {
  Column column = columnCampaign({{"friction", 9.0}}, 33, 0.3, parametersWith({{"friction", 0.0}}));
  const Told told = tell(column, {{"friction", "sun_front"}});
  EXPECT_EQ(told.update.mechanisms, (std::vector<std::string>{"friction", "sun_front"}));
  EXPECT_THAT(told.update.warnings, Contains(HasSubstr("sun_front was asked for, but these data do not support it")));
  EXPECT_THAT(told.update.warnings, Not(Contains(HasSubstr("friction was asked for"))));
  EXPECT_LT(trueGap(column, told.update.after), 0.15);
}

TEST(MechanismChoice, SaysWhyParametersCannotBePutInTogether) {
  std::vector<SimulatorParameter> parameters = standardParameters();
  const std::vector<SimulatorWindow> windows{{"sun_on_s", "sun_off_s"}};
  const std::vector<std::pair<std::string, std::string>> twins{{"friction", "h_air"}};
  EXPECT_EQ(whyNotTogether({"friction", "sun_front", "sun_on_s"}, parameters, windows, twins), "");
  EXPECT_THAT(whyNotTogether({"sun_on_s"}, parameters, windows, twins), HasSubstr("together with that load"));
  EXPECT_THAT(whyNotTogether({"h_air", "friction"}, parameters, windows, twins), HasSubstr("have the same effect"));
  parameters.front().min = parameters.front().max = 9.0;
  EXPECT_THAT(whyNotTogether({"h_air"}, parameters, windows, {}), HasSubstr("are both 9 W/m2/K"));
}

TEST(IntoSimulation, TellsTwoThatCannotBeToldApart) {
  std::vector<SimulatorParameter> parameters = parametersWith({{"friction", 0.0}});
  parameters.push_back({"seal", 0.0, "W/krpm", 1.0, 0.0, 60.0, "friction of the seal", {"spindle.growth.z"}});
  Column column = columnCampaign({{"friction", 9.0}}, 31, 0.3, parameters);
  const Told told = tell(column, {{"friction", "seal"}});
  EXPECT_THAT(told.found.warnings, Contains(HasSubstr("friction and seal of the simulation have the same effect")));
  EXPECT_THAT(told.update.warnings, Contains(HasSubstr("cannot be distinguished")));
  // What they do together is known, and closes the gap.
  EXPECT_LT(trueGap(column, told.update.after), 0.15);
  EXPECT_NEAR(parameterOf(told.update, "friction").value + parameterOf(told.update, "seal").value, 9.0, 0.5);
}

TEST(IntoSimulation, IsCancelled) {
  Column column = columnCampaign({{"friction", 9.0}}, 24, 0.3, parametersWith({{"friction", 0.0}}));
  JobContext job;
  column.input.tangents =
      std::make_shared<const SimulatorTangents>(simulatorTangents(*column.simulator, column.input.observations, job));
  const DiscrepancyResult found = findDiscrepancy(column.input, {}, job);
  std::stop_source stop;
  stop.request_stop();
  JobContext cancelled(stop.get_token(), nullptr);
  EXPECT_THROW(static_cast<void>(putIntoSimulation(column.input, found, *column.simulator, {}, cancelled)), Cancelled);
}

}  // namespace
}  // namespace spindrift
