// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/study_campaigns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace spindrift {
namespace {

/// A campaign that hides `id`, of the first seed that can.
std::uint64_t seedFor(const std::string& id, std::uint64_t from = 1) {
  for (std::uint64_t seed = from; seed < from + 2000; ++seed) {
    const std::vector<std::string> ids = hideable(seed);
    if (std::find(ids.begin(), ids.end(), id) != ids.end()) return seed;
  }
  ADD_FAILURE() << "no campaign can hide " << id;
  return from;
}

StudyCampaign make(std::uint64_t seed, const std::vector<std::string>& hide, const StudyConditions& conditions = {},
                   StudyKind kind = StudyKind::One) {
  StudyOptions options;
  options.kind = kind;
  options.hide = hide;
  options.conditions = conditions;
  options.strength = 6.0;
  return simulateStudy(studyCase(options, seed), {});
}

const std::vector<Observation>& rowsOf(const StudyCampaign& study) {
  return study.campaign.campaign.observations->rows;
}

/// rms over the rows to be fitted in the component where it is largest, in sigma.
double strengthOf(const std::vector<double>& signal, const std::vector<Observation>& rows) {
  std::map<Component, std::pair<double, int>> sums;
  for (std::size_t i = 0; i < signal.size(); ++i) {
    if (rows[i].use != ObservationUse::Fit) continue;
    sums[rows[i].component].first += std::pow(signal[i] / rows[i].sigma, 2);
    ++sums[rows[i].component].second;
  }
  double strength = 0.0;
  for (const auto& [component, sum] : sums) strength = std::max(strength, std::sqrt(sum.first / sum.second));
  return strength;
}

void expectSameLog(const OperatingLog& a, const OperatingLog& b) {
  ASSERT_EQ(a.names(), b.names());
  ASSERT_EQ(a.time_s(), b.time_s());
  for (const std::string& name : a.names()) EXPECT_EQ(*a.signal(name), *b.signal(name)) << name;
}

TEST(StudyCampaigns, EveryEffectOfTheCatalogueCanBeHiddenAtTheStatedStrength) {
  std::set<std::string> seen;
  for (std::size_t i = 0; i < studyEffects().size(); ++i) {
    const std::string& id = studyEffects()[i];
    const StudyCampaign study = make(seedFor(id, 100 + i), {id});
    const std::vector<std::string>& hidden = study.campaign.truth.hidden;
    ASSERT_EQ(hidden.size(), 1u);
    EXPECT_TRUE(hidden.front().starts_with(id));
    EXPECT_GE(study.campaign.truth.base.size(), 2u);
    EXPECT_NEAR(strengthOf(study.campaign.truth.hidden_signal, rowsOf(study)), 6.0, 1e-6) << id;
    seen.insert(id.substr(0, id.find('.')));
  }
  EXPECT_GE(seen.size(), 15u);
}

TEST(StudyCampaigns, KindsHideWhatTheySay) {
  for (const StudyKind kind :
       {StudyKind::Two, StudyKind::Three, StudyKind::Nothing, StudyKind::Outside, StudyKind::Confounded}) {
    for (std::size_t turn = 0; turn < 4; ++turn) {
      StudyOptions options;
      options.kind = kind;
      options.turn = turn;
      const StudyCase made = studyCase(options, 7 + turn);
      const StudyCampaign study = simulateStudy(made, {});
      const std::size_t count = kind == StudyKind::Nothing ? 0
                                : kind == StudyKind::Two   ? 2
                                : kind == StudyKind::Three ? 3
                                                           : 1;
      EXPECT_EQ(study.campaign.truth.hidden.size(), count);
      EXPECT_GE(rowsOf(study).size(), 1080u);
      std::set<std::string> families;
      for (const std::string& id : made.hidden) families.insert(id.substr(0, id.find('.')));
      EXPECT_EQ(families.size(), count);
      if (kind == StudyKind::Outside) {
        EXPECT_TRUE(study.campaign.truth.hidden.front().starts_with("unknown."));
      }
    }
  }
}

TEST(StudyCampaigns, AreTheSameForTheSameSeed) {
  StudyOptions options;
  options.kind = StudyKind::Three;
  options.conditions = StudyConditions::together();
  const StudyCampaign a = simulateStudy(studyCase(options, 5), {});
  const StudyCampaign b = simulateStudy(studyCase(options, 5), {});
  ASSERT_EQ(rowsOf(a).size(), rowsOf(b).size());
  for (std::size_t i = 0; i < rowsOf(a).size(); ++i) EXPECT_EQ(rowsOf(a)[i].value, rowsOf(b)[i].value);
  expectSameLog(*a.campaign.campaign.log, *b.campaign.campaign.log);
}

TEST(StudyCampaigns, WhatIsMeasuredDoesNotDependOnWhatIsHidden) {
  for (std::uint64_t seed = 20; seed < 28; ++seed) {
    const std::vector<std::string> ids = hideable(seed);
    const StudyCampaign nothing = make(seed, {}, {}, StudyKind::Nothing);
    for (std::size_t turn = 0; turn < ids.size(); turn += 9) {
      SCOPED_TRACE(ids[turn]);
      const StudyCampaign study = make(seed, {ids[turn]});
      EXPECT_EQ(study.campaign.campaign.machine.source, nothing.campaign.campaign.machine.source);
      expectSameLog(*study.campaign.campaign.log, *nothing.campaign.campaign.log);
      ASSERT_EQ(rowsOf(study).size(), rowsOf(nothing).size());
      for (std::size_t i = 0; i < rowsOf(study).size(); ++i) {
        const Observation& a = rowsOf(study)[i];
        const Observation& b = rowsOf(nothing)[i];
        ASSERT_EQ(a.time_s, b.time_s);
        ASSERT_EQ(a.point, b.point);
        ASSERT_EQ(a.component, b.component);
        ASSERT_EQ(a.sigma, b.sigma);
        ASSERT_EQ(a.c_deg, b.c_deg);
        ASSERT_EQ(a.approach, b.approach);
        // Nor does the noise.
        ASSERT_NEAR(a.value - study.campaign.truth.total[i], b.value - nothing.campaign.truth.total[i], 2e-4);
      }
    }
  }
}

TEST(StudyCampaigns, EveryMachineOfAFamilyHasTheSameSensors) {
  std::map<std::string, std::set<std::vector<std::string>>> sensors;
  for (std::uint64_t seed = 1; seed < 60; ++seed) {
    StudyOptions options;
    options.turn = seed;
    const StudyCase made = studyCase(options, seed);
    std::vector<std::string> names;
    for (const SensorOptions& sensor : made.scenario.sensors) names.push_back(sensor.name);
    sensors[made.scenario.machine.name].insert(names);
  }
  EXPECT_EQ(sensors.size(), 4u);
  for (const auto& [machine, sets] : sensors) EXPECT_EQ(sets.size(), 1u) << machine;
  const std::vector<std::string>& gantry = *sensors["gantry milling machine"].begin();
  EXPECT_NE(std::find(gantry.begin(), gantry.end(), "T_beam_degC"), gantry.end());
  const std::vector<std::string>& five = *sensors["five-axis machining centre"].begin();
  EXPECT_NE(std::find(five.begin(), five.end(), "T_artefact_degC"), five.end());
}

TEST(StudyConditions, StatedSigmasAreOffByComponentAndNothingElseIs) {
  StudyConditions conditions;
  conditions.sigma = true;
  std::set<double> factors;
  for (std::uint64_t seed = 30; seed < 36; ++seed) {
    const StudyCampaign off = make(seed, {}, conditions, StudyKind::Nothing);
    const StudyCampaign clean = make(seed, {}, {}, StudyKind::Nothing);
    for (std::size_t i = 0; i < rowsOf(off).size(); ++i) {
      const double factor = off.applied.stated_over_real_sigma.at(rowsOf(off)[i].component);
      EXPECT_NEAR(rowsOf(off)[i].sigma, factor * rowsOf(clean)[i].sigma, 1e-12);
      EXPECT_EQ(rowsOf(off)[i].value, rowsOf(clean)[i].value);
      EXPECT_GE(factor, 0.6);
      EXPECT_LE(factor, 1.6);
      factors.insert(factor);
    }
  }
  EXPECT_GE(factors.size(), 18u);
}

TEST(StudyConditions, TailsAreHeavyWithTheVarianceThatIsStated) {
  StudyConditions conditions;
  conditions.tails = true;
  double square = 0.0;
  double fourth = 0.0;
  int count = 0;
  std::size_t outliers = 0;
  std::size_t rows = 0;
  for (std::uint64_t seed = 40; seed < 60; ++seed) {
    const StudyCampaign study = make(seed, {}, conditions, StudyKind::Nothing);
    const std::set<std::size_t> off(study.applied.outliers.begin(), study.applied.outliers.end());
    outliers += off.size();
    rows += rowsOf(study).size();
    for (std::size_t i = 0; i < rowsOf(study).size(); ++i) {
      const double e = (rowsOf(study)[i].value - study.campaign.truth.total[i]) / rowsOf(study)[i].sigma;
      if (off.contains(i)) {
        EXPECT_GT(std::abs(e), 2.0);
        continue;
      }
      square += e * e;
      fourth += std::pow(e, 4);
      ++count;
    }
  }
  EXPECT_NEAR(square / count, 1.0, 0.06);
  EXPECT_GT(fourth / count / std::pow(square / count, 2), 6.0) << "3 for a normal distribution";
  EXPECT_NEAR(static_cast<double>(outliers) / static_cast<double>(rows), 0.01, 0.002);
}

TEST(StudyConditions, ACommonShiftIsCommonToAllPointsOfAState) {
  StudyConditions conditions;
  conditions.common = true;
  const StudyCampaign shifted = make(61, {}, conditions, StudyKind::Nothing);
  const StudyCampaign clean = make(61, {}, {}, StudyKind::Nothing);
  double square = 0.0;
  for (std::size_t i = 0; i < rowsOf(shifted).size(); ++i) {
    const Observation& row = rowsOf(shifted)[i];
    const double shift = shifted.applied.shifts.at({row.state, row.component});
    EXPECT_NEAR(row.value - rowsOf(clean)[i].value, shift, 2e-4);
    square += std::pow(shift / row.sigma, 2);
  }
  EXPECT_NEAR(std::sqrt(square / static_cast<double>(rowsOf(shifted).size())), 0.6, 0.12);
}

TEST(StudyConditions, AWarmMachineIsWarmWhenTheLogBegins) {
  StudyConditions conditions;
  conditions.warm_start = true;
  int warm = 0;
  for (std::uint64_t seed = 70; seed < 76; ++seed) {
    const std::vector<std::string> ids = hideable(seed);
    const StudyCampaign study = make(seed, {ids[seed % ids.size()]}, conditions);
    const Campaign& campaign = study.campaign.campaign;
    EXPECT_GE(study.applied.warm_start_s, 7200.0);
    EXPECT_LE(study.applied.warm_start_s, 10800.0);
    EXPECT_EQ(campaign.log->time_s().front(), 0.0);
    EXPECT_EQ(campaign.log->time_s().size(), 1440u);
    EXPECT_EQ(campaign.log->at("instrument_on", 0.0), 1.0);
    EXPECT_LT(rowsOf(study).front().time_s, 1.0);
    if (campaign.log->at("T_spindle_degC", 0.0) > campaign.log->at("T_ambient_degC", 0.0) + 2.0) ++warm;
    std::set<std::pair<std::string, Component>> series;
    for (const SimulatedRow& row : study.campaign.simulation) {
      if (series.insert({row.point, row.component}).second) {
        EXPECT_EQ(row.predicted, 0.0);
      }
    }
    // The strength counts from the first state.
    std::vector<double> motion = study.campaign.truth.hidden_signal;
    std::map<std::pair<std::string, Component>, double> first;
    for (std::size_t i = 0; i < motion.size(); ++i) {
      const Observation& row = rowsOf(study)[i];
      motion[i] -= first.try_emplace({row.point, row.component}, motion[i]).first->second;
    }
    EXPECT_NEAR(strengthOf(motion, rowsOf(study)), 6.0, 1e-6);
  }
  EXPECT_GE(warm, 3);
}

TEST(StudyConditions, ClocksDifferByMinutes) {
  StudyConditions conditions;
  conditions.clock = true;
  double largest = 0.0;
  for (std::uint64_t seed = 80; seed < 88; ++seed) {
    const StudyCampaign study = make(seed, {}, conditions, StudyKind::Nothing);
    const double offset = study.applied.clock_offset_s;
    largest = std::max(largest, std::abs(offset));
    EXPECT_NEAR(rowsOf(study).front().time_s, 300.0 + offset, 1e-9);
    EXPECT_GE(rowsOf(study).front().time_s, 0.0);
    EXPECT_EQ(study.campaign.simulation.front().time_s, rowsOf(study).front().time_s);
  }
  EXPECT_GT(largest, 60.0);
  EXPECT_LE(largest, 240.0);
}

TEST(StudyConditions, PoorSensorsAreCoarseOrSlow) {
  StudyConditions coarse;
  coarse.coarse_sensors = true;
  StudyConditions slow;
  slow.slow_sensors = true;
  const StudyCampaign rough = make(90, {}, coarse, StudyKind::Nothing);
  const StudyCampaign late = make(90, {}, slow, StudyKind::Nothing);
  const StudyCampaign clean = make(90, {}, {}, StudyKind::Nothing);
  for (const std::string& name : clean.campaign.campaign.log->temperatureNames()) {
    const std::vector<double>& steps = *rough.campaign.campaign.log->signal(name);
    const std::vector<double>& lagging = *late.campaign.campaign.log->signal(name);
    const std::vector<double>& exact = *clean.campaign.campaign.log->signal(name);
    double off = 0.0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      EXPECT_NEAR(2.0 * steps[i], std::round(2.0 * steps[i]), 1e-9);
      EXPECT_NEAR(steps[i], exact[i], 0.2501);
      off = std::max(off, std::abs(lagging[i] - exact[i]));
    }
    EXPECT_GT(off, 0.02) << name;
  }
  // The front bearing starts within half an hour of work: a slow sensor shows its steps later.
  const std::vector<double>& exact = *clean.campaign.campaign.log->signal("T_spindle_degC");
  const std::vector<double>& lagging = *late.campaign.campaign.log->signal("T_spindle_degC");
  double ahead = 0.0;
  for (std::size_t i = 20; i < exact.size(); ++i) {
    ahead += (exact[i] - lagging[i]) * (exact[i] - exact[i - 20]);
  }
  EXPECT_GT(ahead, 0.0);
}

TEST(StudyConditions, GapsLeaveOutRowsAndWholeStates) {
  StudyConditions conditions;
  conditions.gaps = true;
  for (std::uint64_t seed = 100; seed < 104; ++seed) {
    const StudyCampaign gaps = make(seed, {}, conditions, StudyKind::Nothing);
    const StudyCampaign clean = make(seed, {}, {}, StudyKind::Nothing);
    const double kept = static_cast<double>(rowsOf(gaps).size()) / static_cast<double>(rowsOf(clean).size());
    EXPECT_LT(kept, 0.82);
    EXPECT_GT(kept, 0.58);
    std::set<std::string> states;
    for (const Observation& row : rowsOf(gaps)) states.insert(row.state);
    EXPECT_LE(states.size(), 34u);
    EXPECT_GE(states.size(), 32u);
    EXPECT_EQ(gaps.campaign.truth.total.size(), rowsOf(gaps).size());
    EXPECT_EQ(gaps.campaign.truth.hidden_signal.size(), rowsOf(gaps).size());
    EXPECT_EQ(gaps.campaign.simulation.size(), rowsOf(clean).size());
  }
}

TEST(StudyConditions, AnUnevenShapeVariesSmoothlyByFifteenPercent) {
  StudyConditions conditions;
  conditions.uneven = true;
  const std::uint64_t seed = seedFor("spindle.growth.z", 110);
  const StudyCampaign uneven = make(seed, {"spindle.growth.z"}, conditions);
  const StudyCampaign clean = make(seed, {"spindle.growth.z"});
  std::map<std::string, double> factors;
  for (std::size_t i = 0; i < rowsOf(clean).size(); ++i) {
    const double whole = clean.campaign.truth.hidden_signal[i];
    if (std::abs(whole) < 1.0) continue;
    const double factor = uneven.campaign.truth.hidden_signal[i] / whole;
    EXPECT_NEAR(factor, factors.try_emplace(rowsOf(clean)[i].point, factor).first->second, 1e-9);
  }
  ASSERT_EQ(factors.size(), 10u);
  double square = 0.0;
  for (const auto& [point, factor] : factors) square += std::pow(factor - 1.0, 2) / 10.0;
  EXPECT_NEAR(std::sqrt(square), 0.15, 1e-6);
}

TEST(StudyConditions, TheSimulationIsOffByWhatIsSaid) {
  StudyConditions conditions;
  conditions.base_error = 0.08;
  std::vector<double> errors;
  for (std::uint64_t seed = 120; seed < 140; ++seed) {
    StudyOptions options;
    options.kind = StudyKind::Nothing;
    options.conditions = conditions;
    const StudyCase made = studyCase(options, seed);
    for (const auto& [id, error] : made.scenario.simulation->size_errors) errors.push_back(error);
  }
  double square = 0.0;
  for (const double error : errors) square += error * error / static_cast<double>(errors.size());
  EXPECT_NEAR(std::sqrt(square), 0.08, 0.02);

  StudyConditions one;
  one.one_base_error = 0.3;
  for (std::uint64_t seed = 140; seed < 144; ++seed) {
    const StudyCampaign study = make(seed, {}, one);
    const CampaignTruth& truth = study.campaign.truth;
    ASSERT_EQ(truth.hidden.size(), 1u);
    EXPECT_NE(std::find(truth.base.begin(), truth.base.end(), truth.hidden.front()), truth.base.end());
    EXPECT_NEAR(strengthOf(truth.hidden_signal, rowsOf(study)), 6.0, 1e-6);
    // Plant minus simulation is what is hidden, up to the parameters that are off by a percent.
    EXPECT_LT(strengthOf(truth.base_error, rowsOf(study)), 1.2);
    EXPECT_GT(strengthOf(truth.base_error, rowsOf(study)), 0.0);
  }
}

}  // namespace
}  // namespace spindrift
