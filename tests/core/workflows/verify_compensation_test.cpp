// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/workflows/verify_compensation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/workflows/compensated_data.h"
#include "core/workflows/verify_map.h"
#include "tests/support/refusal.h"

namespace spindrift {
namespace {

/// Points P0 ... P7 in states M0 ... M3, one every 1000 s; EX grows to `growth` um, noise `sigma` um.
ObservationSet measured(double growth, double sigma, std::uint64_t seed, double from_s = 0.0) {
  Random random(seed);
  ObservationSet set;
  for (int m = 0; m < 4; ++m) {
    for (int p = 0; p < 8; ++p) {
      Observation o;
      o.time_s = from_s + 1000.0 * m + 10.0 * p;
      o.state = "M" + std::to_string(m);
      o.point = "P" + std::to_string(p);
      o.position_mm = {50.0 * p, 0.0, 0.0};
      o.component = Component::EX;
      o.value = 3.0 + growth * m / 3.0 + random.normal(0.0, sigma);
      o.sigma = sigma;
      set.rows.push_back(o);
    }
  }
  return set;
}

Campaign campaignWith(std::vector<double> on) {
  Campaign c;
  c.log = OperatingLog({0.0, 1500.0, 10000.0});
  c.log.edit().setSignal("compensation_on", std::move(on));
  return c;
}

/// What an evaluation makes of touches: every row is compared with the first cycle, whose noise its sigma holds.
ObservationSet againstFirst(double deviation, double own, std::uint64_t seed) {
  ObservationSet set = measured(0.0, own, seed);
  Random random(1000 + seed);
  for (int p = 0; p < 8; ++p) {
    const double first = random.normal(0.0, own);
    SharedNoise::Factor loads;
    for (std::size_t i = 0; i < set.rows.size(); ++i) {
      Observation& o = set.rows[i];
      if (o.point != "P" + std::to_string(p)) continue;
      const bool zero = o.state == "M0";
      o.value = zero ? 0.0 : o.value - 3.0 - first + ((p + o.state[1]) % 2 == 0 ? deviation : -deviation);
      o.sigma = std::sqrt(2.0) * own;
      loads.push_back({i, own});
    }
    set.shared.addFactor(std::move(loads));
  }
  return set;
}

TEST(Verify, NoiseThatRowsShareIsCountedOnce) {
  constexpr double true_um = 1.5;
  constexpr int campaigns = 200;
  double mean_um = 0.0;
  double squares = 0.0;
  for (int seed = 1; seed <= campaigns; ++seed) {
    const auto s = static_cast<std::uint64_t>(seed);
    const VerifyResult result = verifyCompensation(againstFirst(20.0, 1.0, s), againstFirst(true_um, 1.0, s + 500), {});
    const VerifyComponent& ex = result.components.at(0);
    EXPECT_NEAR(result.points.front().after_sigma, std::sqrt(2.0), 1e-9) << "not twice";
    mean_um += ex.after.rms / campaigns;
    squares += std::pow((ex.after.rms - true_um) / ex.after.rms_sigma, 2) / campaigns;
  }
  EXPECT_NEAR(mean_um, true_um, 0.1);
  EXPECT_NEAR(std::sqrt(squares), 1.0, 0.2);
}

TEST(Verify, AReversalErrorIsNoChange) {
  // 12 um of backlash. The cold state from one side alone, the others from both, or from the other one alone.
  const auto from = [](const ObservationSet& set, bool both) {
    ObservationSet out;
    for (const Observation& o : set.rows) {
      for (const double side : {1.0, -1.0}) {
        if (o.state == "M0" ? side < 0.0 : !both && side > 0.0) continue;
        out.rows.push_back(o);
        out.rows.back().approach = {side, 0.0, 0.0};
        out.rows.back().value += 6.0 * side;
      }
    }
    return out;
  };
  const VerifyResult both =
      verifyCompensation(from(measured(30.0, 0.2, 1), true), from(measured(0.0, 0.2, 2), true), {});
  EXPECT_LT(both.components.at(0).after.largest, 1.0);
  EXPECT_TRUE(both.notes.empty());
  const VerifyResult one =
      verifyCompensation(from(measured(30.0, 0.2, 1), false), from(measured(0.0, 0.2, 2), false), {});
  EXPECT_GT(one.components.at(0).after.largest, 10.0);
  ASSERT_EQ(one.notes.size(), 1U);
  EXPECT_NE(one.notes[0].find("Compared with readings that were approached from another side: 24 of 24 values"),
            std::string::npos)
      << one.notes[0];
}

TEST(Verify, PointsAreListedAsPeopleCount) {
  ObservationSet before = measured(30.0, 0.2, 1);
  ObservationSet after = measured(2.0, 0.2, 2);
  for (ObservationSet* set : {&before, &after})
    for (Observation& o : set->rows) o.point = "F" + std::to_string(2 + 2 * std::stoi(o.point.substr(1)));
  std::vector<std::string> points;
  for (const VerifyPoint& p : verifyCompensation(before, after, VerifyRequest{}).points)
    if (points.empty() || points.back() != p.point) points.push_back(p.point);
  EXPECT_EQ(points, (std::vector<std::string>{"F2", "F4", "F6", "F8", "F10", "F12", "F14", "F16"}));
}

TEST(Verify, PointsThatStandElsewhereAreNotCompared) {
  const ObservationSet before = measured(30.0, 0.2, 1);
  ObservationSet after = measured(2.0, 0.2, 2);
  for (Observation& o : after.rows)
    if (o.point == "P3") o.position_mm.x() += 20.0;
  const VerifyResult result = verifyCompensation(before, after, {});
  EXPECT_EQ(result.components.at(0).values, 21U) << "three states of seven points";
  for (const VerifyPoint& p : result.points) EXPECT_NE(p.point, "P3");
  ASSERT_EQ(result.notes.size(), 1U);
  EXPECT_NE(result.notes[0].find("P3 stood more than 1 mm elsewhere"), std::string::npos) << result.notes[0];
  for (Observation& o : after.rows) o.position_mm.y() += 20.0;
  EXPECT_THROW((void)verifyCompensation(before, after, {}), InputError);
}

TEST(Verify, AngleOfTheTableIsPartOfAPlace) {
  // Every point at 0 and at 90 degrees, where it grows the other way: the mean of both would be nothing.
  const auto atTwoAngles = [](ObservationSet set) {
    for (std::size_t i = 0, all = set.rows.size(); i < all; ++i) {
      Observation turned = set.rows[i];
      turned.c_deg = 90.0;
      turned.value = -turned.value;
      set.rows.push_back(turned);
    }
    return set;
  };
  const VerifyResult result =
      verifyCompensation(atTwoAngles(measured(30.0, 0.2, 1)), atTwoAngles(measured(2.0, 0.2, 2)), {});
  EXPECT_EQ(result.components.at(0).values, 2U * 24U);
  EXPECT_NEAR(result.components.at(0).before.largest, 30.0, 1.0);
  const std::vector<VerifyPose> poses = posesOf(result);
  ASSERT_EQ(poses.size(), 6U) << "three states at two angles";
  EXPECT_EQ(poses[1], (VerifyPose{"M1", 90.0}));
  const VerifyMap map = verifyMap(result, {}, Component::EX, poses[1]);
  EXPECT_EQ(map.points[0].size(), 8U) << "each point once";
  for (const Field::Marker& p : map.points[0]) EXPECT_LT(p.value, 0.0) << p.point;
  EXPECT_EQ(anglesOf(result), (std::vector<double>{0.0, 90.0}));
  EXPECT_EQ(verifyMap(result, {}, Component::EX, std::nullopt).pose, worstPose(result, Component::EX));
}

TEST(Verify, FiguresOfAPointAreOfOneAngleOfTheTable) {
  VerifyResult result;
  for (const char* state : {"M1", "M2"})
    for (const double c_deg : {0.0, 90.0})
      result.points.push_back({"P1", state, {0, 0, 0}, Component::EX, c_deg == 0.0 ? 3.0 : -9.0, 0.0, 0.5, 0.0, c_deg});
  result.points.push_back({"P2", "M1", {0, 0, 0}, Component::EX, 1.0, 0.0, 0.5, 0.0, 90.0});
  ASSERT_EQ(verifyFiguresOfPoints(result, Component::EX, 0.0).size(), 1U) << "P2 was measured at 90 degrees alone";
  EXPECT_DOUBLE_EQ(verifyFiguresOfPoints(result, Component::EX, 0.0)[0].before.rms, 3.0);
  EXPECT_DOUBLE_EQ(verifyFiguresOfPoints(result, Component::EX, 90.0).at(0).before.rms, 9.0);
  EXPECT_EQ(verifyFiguresOfPoints(result, Component::EX, 90.0).at(1).point, "P2");
}

TEST(Verify, MachinesOfDifferentNamesAreSaid) {
  Campaign one = campaignWith({0.0, 0.0, 0.0}), other = campaignWith({1.0, 1.0, 1.0});
  one.machine.name = "mill";
  other.machine.name = "lathe";
  const VerifyResult result =
      verifyCampaigns(one, measured(30.0, 0.2, 1), other, measured(2.0, 0.2, 2), VerifyRequest{});
  EXPECT_NE(result.json()["notes"].dump().find("different names"), std::string::npos) << result.summary();
}

TEST(Verify, AGoalFarAboveWhatIsLeftIsMetAndFarBelowIsNot) {
  const ObservationSet before = measured(30.0, 0.2, 1);
  const ObservationSet after = measured(2.0, 0.2, 2);
  VerifyRequest request;
  request.goal_um = 5.0;
  const VerifyResult met = verifyCompensation(before, after, request);
  EXPECT_EQ(met.verdict, VerifyVerdict::Met);
  ASSERT_EQ(met.components.size(), 1U);
  EXPECT_EQ(met.components[0].values, 24U);
  EXPECT_NEAR(met.components[0].before.largest, 30.0, 1.0);
  EXPECT_NEAR(met.components[0].before.rms, 30.0 * std::sqrt(14.0 / 27.0), 0.4);
  request.goal_um = 1.0;
  EXPECT_EQ(verifyCompensation(before, after, request).verdict, VerifyVerdict::NotMet);
  request.goal_um = 2.2;
  const VerifyResult open = verifyCompensation(before, after, request);
  EXPECT_EQ(open.verdict, VerifyVerdict::Undecided);
  EXPECT_NE(open.reason.find("cannot be decided"), std::string::npos);
}

TEST(Verify, TheRmsIsFreeOfNoiseAndItsUncertaintyHolds) {
  // Nothing is left: the rms must be compatible with zero although the readings scatter by 1 um.
  int inside = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const VerifyResult r = verifyCompensation(measured(20.0, 1.0, seed), measured(3.0, 1.0, 1000 + seed), {});
    const VerifyFigures& f = r.components[0].after;
    const double truth = 3.0 * std::sqrt(14.0 / 27.0);
    inside += std::abs(f.rms - truth) <= 2.0 * f.rms_sigma;
  }
  EXPECT_GE(inside, 180);
  EXPECT_LE(inside, 200);
}

TEST(Verify, TheSameDataTwiceIsNoProof) {
  const ObservationSet before = measured(30.0, 0.2, 1);
  try {
    (void)verifyCompensation(before, before, {});
    ADD_FAILURE() << "accepted";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("all 24 values equal those before compensation"), std::string::npos)
        << e.what();
  }
  // Some of them copied: said.
  ObservationSet after = measured(2.0, 0.2, 2);
  for (std::size_t i = 0; i < after.rows.size(); ++i)
    if (after.rows[i].point == "P2") after.rows[i].value = before.rows[i].value;
  const VerifyResult result = verifyCompensation(before, after, {});
  ASSERT_EQ(result.notes.size(), 1U);
  EXPECT_NE(result.notes[0].find("The same as before to the last digit: 3 of 24 values."), std::string::npos)
      << result.notes[0];
}

TEST(Verify, TheRmsOfOneValueIsThatValue) {
  const VerifyPoint one{"F1", "M1", {0, 0, 0}, Component::EX, 8.0, 1.0, -2.0, 1.0};
  const VerifyFigures f = verifyFigures({&one}, true);
  EXPECT_DOUBLE_EQ(f.rms, 2.0);
  EXPECT_DOUBLE_EQ(f.rms, f.largest);
  EXPECT_DOUBLE_EQ(f.rms_sigma, f.largest_sigma);
  const VerifyPoint two{"F2", "M1", {0, 0, 0}, Component::EX, 8.0, 1.0, 1.0, 1.0};
  const VerifyFigures both = verifyFigures({&one, &two}, true);
  EXPECT_LE(both.rms, both.largest);
}

TEST(Verify, OnlyWhatBothHaveIsComparedAndTheRestIsCounted) {
  ObservationSet after = measured(1.0, 0.2, 3);
  std::erase_if(after.rows, [](const Observation& o) { return o.point == "P3"; });
  const VerifyResult r = verifyCompensation(measured(10.0, 0.2, 4), after, {});
  EXPECT_EQ(r.components[0].values, 21U);
  ASSERT_EQ(r.notes.size(), 1U);
  EXPECT_THROW(static_cast<void>(verifyCompensation(measured(10.0, 0.2, 4), {}, {})), InputError);
  VerifyRequest bad;
  bad.goal_um = 0.0;
  EXPECT_THROW(static_cast<void>(verifyCompensation(measured(10.0, 0.2, 4), after, bad)), InputError);
}

TEST(Verify, StatesAreTheSameByTheirNames) {
  // M2 was left out after: what is named M3 there was compared with M2 before.
  const ObservationSet before = measured(30.0, 0.01, 4);
  ObservationSet after = measured(24.0, 0.01, 5);
  std::erase_if(after.rows, [](const Observation& o) { return o.state == "M2"; });
  const VerifyResult r = verifyCompensation(before, after, {});
  EXPECT_EQ(r.components[0].values, 16U);
  for (const VerifyPoint& p : r.points) EXPECT_NEAR(p.before, p.state == "M3" ? 30.0 : 10.0, 0.1) << p.state;
  EXPECT_THAT(r.notes, ::testing::Contains("Measured only before, and left out: M2."));
  // Of other names in the same number they are the same by their order.
  for (Observation& o : (after = measured(24.0, 0.01, 5)).rows) o.state = "V" + o.state.substr(1);
  EXPECT_EQ(verifyCompensation(before, after, {}).components[0].values, 24U);
  std::erase_if(after.rows, [](const Observation& o) { return o.state == "V2"; });
  EXPECT_THROW(static_cast<void>(verifyCompensation(before, after, {})), InputError);
}

TEST(Verify, WhatIsLeftIsCountedFromTheStateThatChangesAreRelativeTo) {
  // 8 um are left in every state after the first one; without that one nothing seemed to be left.
  const ObservationSet before = measured(30.0, 0.01, 4);
  ObservationSet after = measured(0.0, 0.01, 5);
  for (Observation& o : after.rows)
    if (o.state != "M0") o.value += 8.0;
  EXPECT_EQ(verifyCompensation(before, after, {}).verdict, VerifyVerdict::NotMet);
  ObservationSet without = after;
  for (Observation& o : without.rows)
    if (o.state == "M0") o.use = ObservationUse::Exclude;
  EXPECT_THAT(testing::refusal([&] { static_cast<void>(verifyCompensation(before, without, {})); }),
              ::testing::HasSubstr("no usable reading of M0, the first state before"));
  // The cold state is taken before the compensation is switched on.
  const Campaign off = campaignWith({0.0, 0.0, 0.0});
  const VerifyResult cold = verifyCampaigns(off, before, campaignWith({0.0, 1.0, 1.0}), after, {});
  EXPECT_EQ(cold.verdict, VerifyVerdict::NotMet);
  EXPECT_NEAR(cold.components[0].after.largest, 8.0, 0.1);
  EXPECT_THAT(cold.notes, ::testing::Contains(::testing::HasSubstr("M0 was taken without compensation; it remains")));
}

TEST(Verify, TheLogDecidesWhatBelongsToBeforeAndAfter) {
  const Campaign off = campaignWith({0.0, 0.0, 0.0});
  const Campaign on = campaignWith({1.0, 1.0, 1.0});
  const ObservationSet data = measured(10.0, 0.2, 5);
  EXPECT_THROW(static_cast<void>(verifyCampaigns(off, data, off, data, {})), InputError);
  EXPECT_THROW(static_cast<void>(verifyCampaigns(on, data, on, data, {})), InputError);
  const ObservationSet again = measured(2.0, 0.2, 7);
  EXPECT_TRUE(verifyCampaigns(off, data, on, again, {}).notes.empty());
  Campaign silent;
  EXPECT_EQ(verifyCampaigns(silent, data, silent, again, {}).notes.size(), 1U);
}

TEST(CompensatedData, NeverEntersAFitUnnoticed) {
  ObservationSet set = measured(10.0, 0.2, 6);
  const Campaign half = campaignWith({0.0, 1.0, 1.0});
  const std::string sentence = leaveOutCompensated(set, half.log.get());
  EXPECT_NE(sentence.find("16 of 32 observations"), std::string::npos) << sentence;
  for (const Observation& o : set.rows)
    EXPECT_EQ(o.use, o.time_s < 1500.0 ? ObservationUse::Fit : ObservationUse::Exclude);
  EXPECT_EQ(leaveOutCompensated(set, half.log.get()),
            sentence);  // a stored evaluation has left them out already: told again
  TimeSeries series = parseTimeSeries("time_s,ez_um,compensation_on\n0,1,0\n10,2,1\n20,3,1\n30,4,0\n", "log.csv");
  leaveOutCompensated(series);
  EXPECT_TRUE(std::isnan(series.at("ez_um").values[1]) && std::isnan(series.at("ez_um").values[2]));
  EXPECT_EQ(series.at("ez_um").values[3], 4.0);
  EXPECT_NE(series.notes.back().find("2 of 4 measured values"), std::string::npos) << series.notes.back();
}

}  // namespace
}  // namespace spindrift
