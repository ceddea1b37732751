// SPDX-License-Identifier: GPL-3.0-or-later
// What noise alone explains is neither named nor told as left: shifts that all points of a state have in common, judged
// over all axes, beside smooth courses that nobody knows.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/discrepancy/effect_posterior.h"
#include "core/discrepancy/residual_problem.h"

namespace spindrift {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr std::size_t few_points = 8;
constexpr std::size_t states = 24;
constexpr double own_um = 0.6;
constexpr std::array<Component, 3> axes = {Component::EX, Component::EY, Component::EZ};
constexpr std::array<bool, 6> translations = {true, true, true, false, false, false};

/// Readings that hold own noise, shifts of X, Y, Z (standard deviations, um) and a slow wave along Z (amplitude, um)
/// that turns over from one end to the other.
DiscrepancyInput readings(std::uint64_t seed, const std::array<double, 3>& shifts_um, double wave_um,
                          std::size_t points = few_points, std::size_t count = states) {
  Random random(seed);
  DiscrepancyInput in;
  for (std::size_t k = 0; k < count; ++k) {
    std::array<double, 3> common{};
    for (std::size_t c = 0; c < 3; ++c) common[c] = shifts_um[c] * random.normal();
    const double wave = wave_um * std::sin(6.28 * static_cast<double>(k) / static_cast<double>(count));
    for (std::size_t p = 0; p < points; ++p) {
      for (std::size_t c = 0; c < 3; ++c) {
        Observation o;
        o.time_s = 1200.0 * static_cast<double>(k) + 8.0 * static_cast<double>(p);
        o.state = "M" + std::to_string(k);
        o.point = "P" + std::to_string(p);
        o.position_mm = {40.0 * static_cast<double>(p % 4), 60.0 * static_cast<double>(p / 4), 0.0};
        o.component = axes[c];
        o.sigma = own_um;
        o.value = common[c] + own_um * random.normal();
        if (c == 2) o.value += wave * (static_cast<double>(p % 4) - 1.5) / std::sqrt(1.25);
        in.observations.rows.push_back(o);
      }
    }
  }
  in.predicted.assign(in.observations.rows.size(), 0.0);
  return in;
}

/// The same readings by an instrument that drifts: in each axis exponentially correlated, `size_um` (standard
/// deviation), `time_s`.
DiscrepancyInput drifting(DiscrepancyInput in, std::uint64_t seed, double size_um, double time_s) {
  Random random(seed ^ 0xd1f7ULL);
  std::array<double, 3> at{};
  for (double& value : at) value = size_um * random.normal();
  std::string state = in.observations.rows.front().state;
  double begun_s = in.observations.rows.front().time_s;
  for (Observation& o : in.observations.rows) {
    if (o.state != state) {
      const double kept = std::exp(-(o.time_s - begun_s) / time_s);
      for (double& value : at) value = kept * value + size_um * std::sqrt(1.0 - kept * kept) * random.normal();
      state = o.state;
      begun_s = o.time_s;
    }
    o.value += at[static_cast<std::size_t>(std::find(axes.begin(), axes.end(), o.component) - axes.begin())];
  }
  return in;
}

ResidualProblem problemOf(const DiscrepancyInput& in) {
  std::vector<std::size_t> rows(in.observations.rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = i;
  ResidualProblem problem(in, rows, 3000);
  problem.setNoise(estimateNoise(problem, problem.y, true));
  return problem;
}

NoiseProfiles profilesOf(const DiscrepancyInput& in) {
  const ResidualProblem problem = problemOf(in);
  return noiseProfiles(problem, problem.y, translations);
}

/// 2 ln of the odds of something smooth in Z beside the noise.
double smoothOdds(const NoiseProfiles& profiles) {
  return jointDeviance(profiles, &NoiseProfile::noise_alone) - jointDeviance(profiles, &NoiseProfile::with_unknown);
}

/// 2 ln of the odds of shifts along Z against none, whatever X and Y have.
double shiftOdds(NoiseProfiles profiles) {
  const double as_it_is = jointDeviance(profiles, &NoiseProfile::noise_alone);
  std::vector<double>& z = profiles[static_cast<std::size_t>(Component::EZ)].noise_alone;
  constexpr double impossible = 1e6;
  for (std::size_t i = 0; i + 1 < z.size(); ++i) z[i] += impossible;
  return jointDeviance(profiles, &NoiseProfile::noise_alone) - as_it_is;
}

TEST(NoiseAlone, ExplainsShiftsOfStatesAndNoSlowWave) {
  constexpr int campaigns = 30;
  constexpr double told = 10.0;
  int shifts_told = 0;
  int waves_told = 0;
  for (int i = 0; i < campaigns; ++i) {
    const auto seed = 500 + static_cast<std::uint64_t>(i);
    shifts_told += smoothOdds(profilesOf(readings(seed, {0.4, 0.4, 0.4}, 0.0))) >= told ? 1 : 0;
    waves_told += smoothOdds(profilesOf(readings(seed, {0.0, 0.0, 0.0}, 0.8))) >= told ? 1 : 0;
  }
  EXPECT_EQ(shifts_told, 0);
  EXPECT_GE(waves_told, 27);
}

TEST(NoiseAlone, ExplainsAnInstrumentThatDrifts) {
  constexpr int campaigns = 20;
  constexpr double told = 10.0;
  constexpr double drift_um = 0.3;
  constexpr double drift_s = 3600.0;
  int found = 0;
  int independent_found = 0;
  double ln_size = 0.0;
  double ln_time = 0.0;
  for (int i = 0; i < campaigns; ++i) {
    const auto seed = 1300 + static_cast<std::uint64_t>(i);
    const DiscrepancyInput in = drifting(readings(seed, {0.0, 0.0, 0.0}, 0.0, 20, 48), seed, drift_um, drift_s);
    const ResidualProblem problem = problemOf(in);
    const ComponentNoise& x = problem.noise.of(Component::EX);
    EXPECT_THAT(movedTogether(problem, problem.noise), IsEmpty()) << seed;
    EXPECT_LT(smoothOdds(noiseProfiles(problem, problem.y, translations)), told) << seed;
    if (x.drift_part > 0.5) {
      ++found;
      ln_size += std::log(x.common / drift_um);
      ln_time += std::log(x.drift_time_s / drift_s);
    }
    const ResidualProblem still = problemOf(readings(seed, {0.5, 0.5, 0.5}, 0.0, 20, 48));
    for (const Component c : axes) independent_found += still.noise.of(c).drift_part > 0.0 ? 1 : 0;
  }
  EXPECT_GE(found, 16);
  EXPECT_NEAR(ln_size / found, 0.0, 0.25);
  EXPECT_NEAR(ln_time / found, 0.0, 0.7);
  EXPECT_LE(independent_found, 3);
}

TEST(NoiseAlone, AsMuchAsReadingsScatterIsADriftWhereAllAxesDrift) {
  constexpr int campaigns = 20;
  constexpr double told = 10.0;
  constexpr double drift_um = 0.9 * own_um;
  int all_told = 0;
  int one_told = 0;
  for (int i = 0; i < campaigns; ++i) {
    const auto seed = 2300 + static_cast<std::uint64_t>(i);
    const DiscrepancyInput still = readings(seed, {0.0, 0.0, 0.0}, 0.0, 20, 48);
    const DiscrepancyInput all = drifting(still, seed, drift_um, 3000.0);
    DiscrepancyInput one = still;
    for (std::size_t r = 0; r < one.observations.rows.size(); ++r) {
      if (one.observations.rows[r].component == Component::EX)
        one.observations.rows[r].value = all.observations.rows[r].value;
    }
    const auto doubted = [&](const DiscrepancyInput& in) {
      const ResidualProblem problem = problemOf(in);
      return !movedTogether(problem, problem.noise).empty() ||
             smoothOdds(noiseProfiles(problem, problem.y, translations)) >= told;
    };
    all_told += doubted(all) ? 1 : 0;
    one_told += doubted(one) ? 1 : 0;
  }
  EXPECT_LE(all_told, 4);
  EXPECT_GE(one_told, 8);
}

TEST(NoiseAlone, ADriftFarLargerThanReadingsScatterIsNoInstruments) {
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
    const ResidualProblem problem =
        problemOf(drifting(readings(seed, {0.0, 0.0, 0.0}, 0.0, 20), seed, 4.0 * own_um, 5400.0));
    EXPECT_FALSE(movedTogether(problem, problem.noise).empty()) << seed;
    EXPECT_GT(smoothOdds(noiseProfiles(problem, problem.y, translations)), 10.0) << seed;
  }
  // What is re-referenced may be shifted by more.
  ComponentNoise n{1.0, 0.0, 2.0};
  EXPECT_EQ(n.shiftsBeyond(1.0), 0.0);
  n.drift_part = 1.0;
  EXPECT_NEAR(n.shiftsBeyond(1.0), 4.0 - largest_drift_shift * largest_drift_shift, 1e-12);
}

TEST(NoiseAlone, IsDoubtfulWhereReadingsHaveClearlyMoreInCommonThanNothing) {
  ResidualProblem problem = problemOf(readings(1, {0.0, 0.0, 0.0}, 0.0, 20));
  EXPECT_THAT(doubtfulNoise(problem, problem.noise), IsEmpty());
  // Shifts of states and what follows itself in time, each too small to be doubted.
  NoiseModel noise = problem.noise;
  noise.component[0].common = 0.35 * own_um;
  noise.component[1].correlated_part = 0.12;
  EXPECT_THAT(doubtfulNoise(problem, noise), IsEmpty());
  noise.component[0].correlated_part = 0.12;
  noise.component[2].correlated_part = 0.36;
  EXPECT_THAT(doubtfulNoise(problem, noise), ElementsAre(Component::EX, Component::EZ));
}

TEST(NoiseAlone, ShiftsDriftByAPartOfTheirVarianceAboutTheirMean) {
  constexpr Eigen::Index n = 30;
  constexpr double part = 0.9;
  std::vector<double> times_s;
  for (int k = 0; k < n; ++k) times_s.push_back(900.0 * k + 40.0 * (k % 3));
  const auto aboutMean = [](const Eigen::MatrixXd& c) { return (c.trace() - c.sum() / n) / (n - 1); };
  // From as good as independent to far slower than the campaign.
  for (const double drift_s : {100.0, 3600.0, 1e6}) {
    const Eigen::MatrixXd factor = shiftFactor(times_s, part, drift_s);
    const Eigen::MatrixXd covariance = factor * factor.transpose();
    EXPECT_NEAR(aboutMean(covariance), 1.0, 1e-7) << drift_s;
    EXPECT_NEAR(aboutMean(covariance - (1.0 - part) * Eigen::MatrixXd::Identity(n, n)), part, 1e-7) << drift_s;
    EXPECT_NEAR((covariance(3, 9) - covariance(3, 20)) / (covariance(3, 4) - covariance(3, 20)),
                (std::exp(-5400.0 / drift_s) - std::exp(-15380.0 / drift_s)) /
                    (std::exp(-940.0 / drift_s) - std::exp(-15380.0 / drift_s)),
                0.05)
        << drift_s;
  }
}

TEST(NoiseAlone, ReadingsOfOneStateAreNeverMergedWithThoseOfAnotherWhileUnitsSuffice) {
  // A few more readings than merged points may have units: pairs of readings, of states that differed from point to
  // point, hid what states have in common.
  const std::size_t points = 3100 / (states * 3) + 1;
  ASSERT_LE(points, 48U);
  const DiscrepancyInput in = readings(5, {0.5, 0.5, 0.5}, 0.0, points);
  ASSERT_GT(in.observations.rows.size(), 3000U);
  const ResidualProblem problem = problemOf(in);
  EXPECT_EQ(problem.size(), static_cast<Eigen::Index>(in.observations.rows.size()));
  EXPECT_NEAR(problem.noise.of(Component::EX).common, 0.5, 0.15);
  EXPECT_NEAR(problem.noise.of(Component::EX).scale, 1.0, 0.05);
  // Beyond that, the same states are merged in all series.
  std::vector<std::size_t> rows(in.observations.rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = i;
  const ResidualProblem merged(in, rows, 400);
  ASSERT_LT(merged.size(), problem.size());
  std::map<std::string, int> epoch_of;
  for (std::size_t u = 0; u < merged.unit_rows.size(); ++u) {
    for (const std::size_t row : merged.unit_rows[u]) {
      const auto [at, fresh] = epoch_of.try_emplace(in.observations.rows[row].state, merged.epoch[u]);
      EXPECT_EQ(at->second, merged.epoch[u]) << in.observations.rows[row].state;
    }
  }
}

TEST(NoiseAlone, ShiftsOfStatesAreJudgedByReadingsWhereManyOfThemAreMerged) {
  // Many points: a unit is the mean of dozens of readings. The shift of a state is a part of what a reading scatters,
  // and many times what such a mean does.
  constexpr std::size_t many_points = 1000;
  constexpr double told = 10.0;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const DiscrepancyInput in = readings(seed, {0.4, 0.4, 0.4}, 0.0, many_points);
    std::vector<std::size_t> rows(in.observations.rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = i;
    ResidualProblem problem(in, rows, 3000);
    ASSERT_LT(problem.size(), static_cast<Eigen::Index>(rows.size() / 10));
    problem.setNoise(estimateNoise(problem, problem.y, true));
    // As drawn: the means of the states.
    Eigen::VectorXd means = Eigen::VectorXd::Zero(states);
    for (const Observation& o : in.observations.rows)
      if (o.component == Component::EX) means[std::stoi(o.state.substr(1))] += o.value / many_points;
    const double drawn = std::sqrt((means.array() - means.mean()).square().sum() / (states - 1.0));
    EXPECT_NEAR(problem.noise.of(Component::EX).common, drawn, 0.1 * drawn) << seed;
    EXPECT_THAT(movedTogether(problem, problem.noise), IsEmpty()) << seed;
    EXPECT_LT(smoothOdds(noiseProfiles(problem, problem.y, translations)), told) << seed;
    problem.noise.of(Component::EX).common = 1.3 * largest_reference_shift * own_um;
    EXPECT_THAT(movedTogether(problem, problem.noise), ElementsAre(Component::EX)) << seed;
  }
}

TEST(NoiseAlone, TheLargestShiftsAreComparedHoweverManyReadingsAUnitHas) {
  // Shifts as large as a reading scatters: more than twenty times the scatter of a unit of hundreds.
  constexpr std::size_t many_points = 5000;
  constexpr Eigen::Index units = 300;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const DiscrepancyInput in = readings(seed, {own_um, own_um, own_um}, 0.0, many_points);
    std::vector<std::size_t> rows(in.observations.rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = i;
    ResidualProblem problem(in, rows, units);
    ASSERT_GT(problem.reading_sigma.mean(), 20.0 * problem.sigma.mean());
    problem.setNoise(estimateNoise(problem, problem.y, true));
    for (const NoiseProfile& profile : noiseProfiles(problem, problem.y, translations)) {
      if (profile.with_unknown.empty()) continue;
      const auto best = std::min_element(profile.with_unknown.begin(), profile.with_unknown.end());
      EXPECT_LT(best - profile.with_unknown.begin() + 2, static_cast<std::ptrdiff_t>(profile.with_unknown.size()))
          << seed << ": the most probable size is the largest that is compared";
    }
  }
}

TEST(NoiseAlone, ShiftsOfOtherAxesSpeakForThoseOfThis) {
  // As large as the scatter of a state's mean: alone hardly to be seen.
  constexpr double shift_um = 0.25;
  constexpr int campaigns = 30;
  double beside_shifted = 0.0;
  double beside_still = 0.0;
  int never = 0;
  for (int i = 0; i < campaigns; ++i) {
    const auto seed = 900 + static_cast<std::uint64_t>(i);
    beside_shifted += shiftOdds(profilesOf(readings(seed, {shift_um, shift_um, shift_um}, 0.0))) / campaigns;
    beside_still += shiftOdds(profilesOf(readings(seed, {0.0, 0.0, shift_um}, 0.0))) / campaigns;
    never += shiftOdds(profilesOf(readings(seed, {0.0, 0.0, 0.0}, 0.0))) > 4.0 ? 1 : 0;
  }
  EXPECT_GT(beside_shifted, beside_still + 2.0);
  EXPECT_LE(never, 1);
}

TEST(NoiseAlone, AnAnswerPaysForWhatItsNoiseLeavesToTheSimulation) {
  // Few states: a part of the simulation happens to go as their shifts do. Without shifts in the noise it is stretched
  // to follow them, by so many of its standard deviations, which an answer beside such noise has to pay.
  constexpr std::size_t few_states = 8;
  const auto dearer = [&](std::uint64_t seed, double stretched) {
    DiscrepancyInput in = readings(seed, {0.0, 0.0, 0.0}, 0.0, 60, few_states);
    Random random(seed);
    std::array<double, few_states> course{};
    for (double& value : course) value = random.normal();
    const auto partOf = [&](const Observation& o) {
      return o.component == Component::EX ? course[static_cast<std::size_t>(std::stoi(o.state.substr(1)))] : 0.0;
    };
    for (Observation& o : in.observations.rows) o.value += own_um * partOf(o);
    std::vector<std::size_t> rows(in.observations.rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = i;
    ResidualProblem problem(in, rows, 3000);
    Eigen::VectorXd part(problem.size());
    for (Eigen::Index u = 0; u < part.size(); ++u)
      part[u] = partOf(in.observations.rows[problem.unit_rows[static_cast<std::size_t>(u)].front()]);
    problem.setNoise(estimateNoise(problem, problem.y, true));
    EXPECT_GT(problem.noise.of(Component::EX).common, 0.4 * own_um) << seed;
    problem.setNuisances({{part, own_um / stretched, false}});
    ResidualProblem without = problem;
    NoiseModel own = problem.noise;
    for (const Component c : axes) own.of(c).common = 0.0;
    without.setNoise(own);
    const JointFit nothing;
    const double with_shifts = answerDeviance(problem, nothing, 0.0);
    EXPECT_NEAR(answerDeviance(problem, nothing, 7.0), with_shifts + 7.0, 1e-9);
    return answerDeviance(without, nothing, 0.0) - with_shifts;
  };
  for (const std::uint64_t seed : {11U, 12U, 13U, 14U}) {
    EXPECT_GT(dearer(seed, 10.0), 10.0) << seed;
    EXPECT_LT(dearer(seed, 1.0), 5.0) << seed;
  }
}

TEST(NoiseAlone, LikelihoodsOfLargeShiftsStayNumbers) {
  // Without shifts e^-2000 as probable: less than a double holds.
  constexpr double worse = 4000.0;
  NoiseProfiles profiles;
  std::vector<double>& x = profiles[static_cast<std::size_t>(Component::EX)].noise_alone;
  x = profilesOf(readings(3, {0.0, 0.0, 0.0}, 0.0))[static_cast<std::size_t>(Component::EX)].noise_alone;
  std::fill(x.begin(), x.end(), worse);
  x[6] = 0.0;
  // Half of the odds for shifts at all, nine tenths for this axis, a thirteenth for the size.
  EXPECT_NEAR(jointDeviance(profiles, &NoiseProfile::noise_alone), -2.0 * std::log(0.5 * 0.9 / 13.0), 0.5);
}

TEST(NoiseAlone, IsNotToldApartFromWhatIsSmoothByReadingsOnceEach) {
  DiscrepancyInput in = readings(7, {0.0, 0.0, 0.0}, 1.0);
  in.observations.rows.resize(9 * 3);
  in.predicted.resize(in.observations.rows.size());
  const NoiseProfiles profiles = profilesOf(in);
  const NoiseProfile& z = profiles[static_cast<std::size_t>(Component::EZ)];
  EXPECT_FALSE(z.told_apart);
  EXPECT_EQ(z.noise_alone, z.with_unknown);
}

}  // namespace
}  // namespace spindrift
