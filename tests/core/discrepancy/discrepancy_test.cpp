// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/discrepancy/discrepancy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "core/discrepancy/drivers.h"
#include "core/discrepancy/effect_model.h"
#include "tests/core/discrepancy/small_plant.h"

namespace spindrift {
namespace {

using namespace small_plant;

TEST(Discrepancy, NamesOneHiddenEffect) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const DiscrepancyResult drift = run(campaign(Hidden::SpindleDrift, seed));
    ASSERT_EQ(drift.effects.size(), 1u);
    EXPECT_EQ(drift.effects[0].id, "spindle.drift.y");
    // Held-out states carry little of this signal; what is left there must be close to the noise that nobody can beat.
    EXPECT_LT(drift.gap.heldout_rms_after_um, drift.gap.heldout_rms_before_um);
    constexpr double noise_um = 0.5;
    EXPECT_NEAR(drift.gap.noise_um, noise_um, 0.05);
    EXPECT_LT(drift.gap.heldout_rms_after_um, 1.25 * noise_um);
    const DiscrepancyResult screw = run(campaign(Hidden::Screw, seed));
    ASSERT_GE(screw.effects.size(), 1u);
    EXPECT_EQ(screw.effects[0].id, "ball_screw.expansion.x");
  }
  const DiscrepancyResult slip = run(campaign(Hidden::Slip, 4));
  ASSERT_EQ(slip.effects.size(), 1u);
  EXPECT_EQ(slip.effects[0].id, "fixture.slip.F3");
}

TEST(Discrepancy, NamesWhatIsMissingInReadingsWithoutAnyNoise) {
  // Two virtual machines compared with each other.
  DiscrepancyInput input = campaign(Hidden::SpindleDrift, 1);
  const DiscrepancyResult noisy = run(input);
  ASSERT_EQ(noisy.effects.size(), 1u);
  for (std::size_t i = 0; i < input.observations.rows.size(); ++i)
    input.observations.rows[i].value = input.predicted[i] + noisy.effect_part[i];
  const DiscrepancyResult result = run(std::move(input));
  ASSERT_GE(result.effects.size(), 1u) << result.message;
  EXPECT_EQ(result.effects[0].id, "spindle.drift.y");
  EXPECT_LT(result.gap.rms_after_um, 0.1 * result.gap.rms_before_um);
}

TEST(Discrepancy, NamesNothingWhenNothingIsMissing) {
  for (std::uint64_t seed = 11; seed <= 16; ++seed) {
    const DiscrepancyResult result = run(campaign(Hidden::Nothing, seed));
    EXPECT_EQ(result.verdict, DiscrepancyVerdict::None);
    EXPECT_TRUE(result.effects.empty());
  }
}

TEST(Discrepancy, NothingMissingIsSaidWithTheScatterThatWouldHideIt) {
  // Of readings that scatter ten times as much as they state, that they agree shows little.
  DiscrepancyInput input = campaign(Hidden::Nothing, 12);
  EXPECT_EQ(run(input).message, "Measurement and simulation agree within the noise.");
  for (Observation& o : input.observations.rows) {
    if (o.component == Component::EY) o.sigma /= 10.0;
  }
  const DiscrepancyResult result = run(std::move(input));
  EXPECT_EQ(result.verdict, DiscrepancyVerdict::None);
  EXPECT_EQ(result.message,
            "Nothing stands out of the scatter, but the readings of EY scatter 10 times as much as their stated σ: "
            "what is smaller would not show.");
}

TEST(Discrepancy, AbstainsOutsideTheCatalogue) {
  for (std::uint64_t seed = 21; seed <= 23; ++seed) {
    const DiscrepancyResult result = run(campaign(Hidden::Wave, seed));
    EXPECT_EQ(result.verdict, DiscrepancyVerdict::Unknown);
    EXPECT_TRUE(result.effects.empty());
    EXPECT_FALSE(result.leftover.empty());
  }
}

TEST(Discrepancy, APatternThatChangesFasterThanItIsMeasuredIsNoNoise) {
  for (std::uint64_t seed = 41; seed <= 43; ++seed) {
    DiscrepancyInput input = campaign(Hidden::Nothing, seed);
    Random random(seed);
    std::map<std::string, double> course;
    for (Observation& o : input.observations.rows) {
      const auto [size, fresh] = course.try_emplace(o.state, 0.0);
      if (fresh) size->second = random.normal(0.0, 3.0);
      if (o.component == Component::EX) o.value += size->second * (o.position_mm.x() - 240.0) / 200.0;
    }
    const DiscrepancyResult result = run(std::move(input));
    EXPECT_EQ(result.verdict, DiscrepancyVerdict::Unknown) << result.message;
    EXPECT_NE(result.leftover.find("EX of all points moves in one pattern"), std::string::npos) << result.leftover;
  }
  // Readings that scatter as much, each for itself, do agree.
  DiscrepancyInput noisy = campaign(Hidden::Nothing, 44);
  Random random(44);
  for (Observation& o : noisy.observations.rows)
    if (o.component == Component::EX) o.value += random.normal(0.0, 1.5);
  EXPECT_EQ(run(std::move(noisy)).verdict, DiscrepancyVerdict::None);
}

TEST(Discrepancy, AReadingFarOutOfAPointThatStandsElsewhereIsNoPattern) {
  // Every point has a constant of its own, large beside the noise; one reading of one of them is far out.
  DiscrepancyInput input = campaign(Hidden::Nothing, 45);
  bool struck = false;
  std::map<std::string, double> constant;
  Random random(45);
  for (Observation& o : input.observations.rows) {
    const auto [value, fresh] = constant.try_emplace(o.point, 0.0);
    if (fresh) value->second = random.normal(0.0, 60.0 * o.sigma);
    o.value += value->second;
    if (struck || o.component != Component::EX) continue;
    struck = true;
    o.value -= 60.0 * o.sigma;
  }
  const DiscrepancyResult result = run(std::move(input));
  EXPECT_EQ(result.verdict, DiscrepancyVerdict::None) << result.leftover;
}

TEST(Discrepancy, TenCandidatesAreWeighedAndWhatWasNotHeldOutHasNoNumber) {
  DiscrepancyInput input = campaign(Hidden::SpindleDrift, 1);
  EXPECT_EQ(run(input).candidates.size(), 10U);
  DiscrepancyInput nothing = campaign(Hidden::Nothing, 11);
  for (Observation& o : nothing.observations.rows) o.use = ObservationUse::Fit;
  const DiscrepancyResult result = run(std::move(nothing));
  EXPECT_EQ(result.candidates.size(), 10U);
  EXPECT_TRUE(std::isnan(result.gap.heldout_rms_before_um));
  EXPECT_TRUE(std::isnan(result.gap.heldout_rms_after_um));
}

TEST(Discrepancy, DescribesAnUnknownCauseHoweverLargeItIs) {
  for (const double strength : {5.0, 60.0}) {  // p-values too small for a double at the end
    const DiscrepancyResult result = run(campaign(Hidden::Wave, 24, strength));
    EXPECT_EQ(result.verdict, DiscrepancyVerdict::Unknown);
    EXPECT_EQ(result.leftover.rfind("EX of all points has a common time history", 0), 0U)
        << result.leftover << " at strength " << strength;
  }
}

TEST(Discrepancy, GainsThatThePointsCannotTellApartAreNotDetermined) {
  // All points at one height: what grows with the height looks like what does not.
  DiscrepancyInput input = campaign(Hidden::Nothing, 31);
  for (std::size_t i = 0; i < input.observations.rows.size(); ++i) {
    Observation& o = input.observations.rows[i];
    o.position_mm.z() = 12.5;
    if (o.component == Component::EZ) o.value += 6.0 * (1.0 - std::exp(-o.time_s / 5000.0));
  }
  const DiscrepancyResult result = run(std::move(input));
  ASSERT_FALSE(result.effects.empty());
  for (const FoundEffect& effect : result.effects) {
    for (const FittedParameter& p : effect.parameters) {
      const double most = p.name.ends_with("_s") ? 1e5 : 1e3;  // s, or µm and µrad for each unit of the driver
      EXPECT_LT(std::abs(p.value), most) << effect.id << ' ' << p.name;
      if (!std::isfinite(p.standard_uncertainty)) {
        EXPECT_EQ(p.value, 0.0) << effect.id << ' ' << p.name;
      } else {
        EXPECT_LT(p.standard_uncertainty, most) << effect.id << ' ' << p.name;
      }
    }
  }
}

TEST(Discrepancy, SaysThatNothingWasTried) {
  DiscrepancyOptions options;
  options.max_effects = 0;
  JobContext job;
  const DiscrepancyResult result = findDiscrepancy(campaign(Hidden::Wave, 24), options, job);
  EXPECT_NE(result.message.find("no effect was tried"), std::string::npos) << result.message;
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
