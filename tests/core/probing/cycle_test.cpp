// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>

#include "core/math/least_squares.h"
#include "core/probing/artefact_certificate.h"
#include "tests/core/probing/probing_machines.h"
#include "tests/support/refusal.h"

namespace spindrift {
namespace {

using namespace probing_test;

CycleEvaluation evaluate(const MachineDescription& machine, const TouchList& list) {
  const Artefact& artefact = machine.artefacts.front();
  if (artefact.kind == "hole_bar") return evaluateHoleCycles(list, machine, artefact);
  return evaluateBallCycles(list, machine, artefact, nullptr);
}

class CycleKind : public ::testing::TestWithParam<bool> {
 protected:
  [[nodiscard]] MachineDescription machine() const {
    return machineFrom(GetParam() ? holeMachineText() : ballMachineText());
  }
};

TEST_P(CycleKind, WithoutNoiseTheTruthComesBack) {
  const MachineDescription m = machine();
  VirtualProbeOptions options;
  options.noise_um = options.surface_noise_um = 0.0;
  options.pre_travel_um = 3.0;
  options.form_error_um = 2.0;
  const VirtualRun run = runCycles(m, 4, options, 5);
  const CycleEvaluation evaluation = evaluate(m, run.list);
  ASSERT_EQ(evaluation.status, FitStatus::Converged) << evaluation.message;
  EXPECT_TRUE(evaluation.rejected.empty());
  for (std::size_t k = 1; k < run.truth.size(); ++k) {
    for (std::size_t p = 0; p < evaluation.names.size(); ++p) {
      // Second order: 25 urad times 25 um.
      EXPECT_NEAR(evaluation.parameters[k][p].value, run.truth[k][p], 0.02) << evaluation.names[p];
    }
  }
}

/// 2,000 virtual cycles: the truth lies inside the 95 % interval in 94-96 %, the error is what the noise allows.
TEST_P(CycleKind, TwoThousandCyclesCoverTheTruthAndReachTheBound) {
  const MachineDescription m = machine();
  const int campaigns = 400;
  const int cycles = 6;
  VirtualProbeOptions options;
  options.noise_um = GetParam() ? 0.2 : 0.7;
  options.surface_noise_um = 0.15;
  options.form_error_um = 1.0;
  options.pre_travel_um = 4.0;
  int inside = 0;
  int total = 0;
  std::vector<double> squares;
  std::vector<double> bound;
  for (int c = 0; c < campaigns; ++c) {
    const VirtualRun run = runCycles(m, cycles, options, 1000 + static_cast<std::uint64_t>(c));
    const CycleEvaluation evaluation = evaluate(m, run.list);
    ASSERT_EQ(evaluation.status, FitStatus::Converged);
    const auto n = evaluation.names.size();
    squares.resize(n, 0.0);
    for (std::size_t k = 1; k < run.truth.size(); ++k) {
      for (std::size_t p = 0; p < n; ++p) {
        const double error = evaluation.parameters[k][p].value - run.truth[k][p];
        squares[p] += error * error;
        ++total;
        if (std::abs(error) < 1.959964 * evaluation.parameters[k][p].standard_uncertainty) ++inside;
      }
    }
    if (c > 0) continue;
    // Cramer-Rao: differences of two cycles with the true noise, solved independently of the evaluation.
    std::vector<Eigen::Index> rows;
    for (std::size_t r = 0; r < evaluation.problem.rows.size(); ++r) {
      if (evaluation.problem.rows[r].cycle == 1) rows.push_back(static_cast<Eigen::Index>(r));
    }
    Eigen::MatrixXd A(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(n));
    Eigen::VectorXd sigma(A.rows());
    for (Eigen::Index i = 0; i < A.rows(); ++i) {
      const auto r = static_cast<std::size_t>(rows[static_cast<std::size_t>(i)]);
      for (Eigen::Index p = 0; p < A.cols(); ++p) {
        A(i, p) = evaluation.problem.jacobian(rows[static_cast<std::size_t>(i)], p) /
                  evaluation.unit[static_cast<std::size_t>(p)];
      }
      const bool surface = GetParam() && evaluation.problem.rows[r].group == 1;
      sigma(i) = std::sqrt(2.0) * (surface ? options.surface_noise_um : options.noise_um) * 1e-3;
    }
    const LinearFitResult fit = solveLinear(A, Eigen::VectorXd::Zero(A.rows()), sigma);
    for (std::size_t p = 0; p < n; ++p) bound.push_back(fit.standardUncertainty(static_cast<int>(p)));
  }
  const double rate = static_cast<double>(inside) / total;
  EXPECT_GT(rate, 0.94);
  EXPECT_LT(rate, 0.96);
  double worst = 0.0;
  double mean_square = 0.0;
  for (std::size_t p = 0; p < bound.size(); ++p) {
    const double ratio = std::sqrt(squares[p] / (campaigns * (cycles - 1))) / bound[p];
    worst = std::max(worst, ratio);
    mean_square += ratio * ratio / static_cast<double>(bound.size());
  }
  EXPECT_LT(std::sqrt(mean_square), 1.1);
  EXPECT_LT(worst, 1.15);  // the rms of one parameter itself scatters by 3 %
  RecordProperty("coverage", std::to_string(rate));
  RecordProperty("rms_over_cramer_rao", std::to_string(std::sqrt(mean_square)));
  std::printf("coverage %.4f, rms / Cramer-Rao %.4f (worst parameter %.3f)\n", rate, std::sqrt(mean_square), worst);
}

TEST_P(CycleKind, ATouchFarOffTakesNoOthersOfItsFeatureAlong) {
  // 0.3 mm off, the centre that its feature is linearised about is off as well, and with it all its other touches.
  const MachineDescription m = machine();
  VirtualRun run = runCycles(m, 6, {}, 9);
  const std::size_t per_cycle = run.list.touches.size() / 6;
  const std::size_t bad = 3 * per_cycle + 17;
  run.list.touches[bad].position_mm += 0.3 * run.list.touches[bad].approach;
  const CycleEvaluation evaluation = evaluate(m, run.list);
  ASSERT_EQ(evaluation.rejected.size(), 1U) << evaluation.rejected.back().reason;
  EXPECT_EQ(evaluation.rejected.front().touch, bad);
}

TEST_P(CycleKind, OneBadTouchIsNamedAndLeftOut) {
  const MachineDescription m = machine();
  VirtualProbeOptions options;
  VirtualRun run = runCycles(m, 6, options, 9);
  const std::size_t per_cycle = run.list.touches.size() / 6;
  const std::size_t bad = 3 * per_cycle + 17;
  run.list.touches[bad].position_mm += 0.02 * run.list.touches[bad].approach;
  const std::size_t bad_first = 8;  // in the reference cycle, which all others hang on
  run.list.touches[bad_first].position_mm -= 0.015 * run.list.touches[bad_first].approach;
  const CycleEvaluation evaluation = evaluate(m, run.list);
  std::vector<std::size_t> rejected;
  for (const RejectedTouch& r : evaluation.rejected) rejected.push_back(r.touch);
  std::sort(rejected.begin(), rejected.end());
  EXPECT_EQ(rejected, (std::vector<std::size_t>{bad_first, bad}));
  for (std::size_t k = 1; k < run.truth.size(); ++k) {
    for (std::size_t p = 0; p < evaluation.names.size(); ++p) {
      const CycleParameter& q = evaluation.parameters[k][p];
      EXPECT_LT(std::abs(q.value - run.truth[k][p]), 4.5 * q.standard_uncertainty) << evaluation.names[p];
    }
  }
}

TEST_P(CycleKind, NoiseOfTheFirstCycleIsCommonToAllOthers) {
  const MachineDescription m = machine();
  VirtualProbeOptions options;
  const CycleEvaluation evaluation = evaluate(m, runCycles(m, 5, options, 3).list);
  const Eigen::MatrixXd between = evaluation.fit.covarianceBetween(1, 2);
  for (Eigen::Index p = 0; p < between.rows(); ++p) {
    EXPECT_NEAR(between(p, p) / evaluation.fit.cycles[1].covariance(p, p), 0.5, 0.02);
  }
}

INSTANTIATE_TEST_SUITE_P(Probing, CycleKind, ::testing::Values(true, false),
                         [](const auto& kind) { return kind.param ? "holes" : "balls"; });

TEST(HoleCycle, TheLargestDeviationFromTheLineHasTheNoiseOfItsOwnCycle) {
  const MachineDescription m = machineFrom(holeMachineText());
  VirtualRun run = runCycles(m, 6, {}, 9);
  const auto linearity = [&] { return evaluateHoleCycles(run.list, m, m.artefacts.front()).linearity; };
  std::map<std::string, LinearityDeviation> whole;
  for (const LinearityDeviation& d : linearity()) whole[d.feature] = d;
  const std::string last = run.list.touches.back().cycle;
  std::erase_if(run.list.touches, [&](const Touch& t) { return t.cycle == last && t.approach.x() > 0.5; });
  int compared = 0;
  for (const LinearityDeviation& d : linearity()) {
    EXPECT_GT(d.sigma_um, 0.0);
    if (d.largest_cycle == last || whole.at(d.feature).largest_cycle == last) continue;
    EXPECT_NEAR(d.sigma_um, whole.at(d.feature).sigma_um, 0.1 * d.sigma_um) << d.feature;
    ++compared;
  }
  EXPECT_GE(compared, 3);
}

TEST(HoleCycle, MissingTouchesLeaveTheRestAndNameWhatIsOpen) {
  const MachineDescription m = machineFrom(holeMachineText());
  VirtualProbeOptions options;
  VirtualRun run = runCycles(m, 5, options, 21);
  // M2 loses one touch; M3 loses everything but the holes at c = 0.
  removeTouches(run.list, [](const Touch& t) {
    return (t.cycle == "M2" && t.feature == "H4" && t.c_deg == 0.0 && t.touch == 1) ||
           (t.cycle == "M3" && t.c_deg != 0.0);
  });
  const HoleCycleResult result = evaluateHoleCycles(run.list, m, m.artefacts.front());
  EXPECT_EQ(result.status, FitStatus::Degenerate);
  for (const CycleParameter& p : result.parameters[2]) EXPECT_TRUE(p.determined);
  const auto open = [&](const char* name) {
    return !result.parameters[3][static_cast<std::size_t>(result.indexOf(name))].determined;
  };
  // Without reversal EXX and EME, and EX0C and ER0T, cannot be told apart; the height is still known.
  EXPECT_TRUE(open("EXX_um_per_m"));
  EXPECT_TRUE(open("EME_um_per_m"));
  EXPECT_TRUE(open("ER0T_um"));
  const nlohmann::json json = cyclesJson(result);
  EXPECT_TRUE(json["cycles"][3]["parameters"]["EXX_um_per_m"]["value"].is_null());
  EXPECT_FALSE(json["cycles"][4]["parameters"]["EXX_um_per_m"]["value"].is_null());
  for (const std::size_t k : {1U, 2U, 4U}) {
    for (std::size_t p = 0; p < 9; ++p) {
      const CycleParameter& q = result.parameters[k][p];
      EXPECT_LT(std::abs(q.value - run.truth[k][p]), 4.5 * q.standard_uncertainty);
    }
  }
}

TEST(HoleCycle, AxesFollowTheMachineFile) {
  // A bar along Y on a table that turns about Z in another chain, and one on a table that turns about Y.
  std::string along_y = holeMachineText();
  const auto replace = [](std::string& text, const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace(along_y, "V [w-C2'-A'-X'-b-Y-Z-C1-t]", "V [w-C'-Y'-b-X-Z-(C1)-t]");
  replace(along_y, "\"C2\"", "\"C\"");
  replace(along_y, "[-143,17,0]", "[20,-143,0]");
  replace(along_y, "\"direction_at_c0\":[1,0,0]", "\"direction_at_c0\":[0,1,0]");
  std::string table_b = holeMachineText();
  replace(table_b, "V [w-C2'-A'-X'-b-Y-Z-C1-t]", "H [w-B'-Z'-b-X-Y-(C)-t]");
  replace(table_b, "\"C2\"", "\"B\"");
  replace(table_b, "[-143,17,0]", "[-143,0,17]");
  VirtualProbeOptions options;
  options.noise_um = options.surface_noise_um = 0.0;
  for (const std::string& text : {along_y, table_b}) {
    const MachineDescription m = machineFrom(text);
    const VirtualRun run = runCycles(m, 3, options, 4);
    const HoleCycleResult result = evaluateHoleCycles(run.list, m, m.artefacts.front());
    ASSERT_EQ(result.status, FitStatus::Converged) << result.message;
    for (std::size_t p = 0; p < 9; ++p) {
      EXPECT_NEAR(result.parameters[2][p].value, run.truth[2][p], 0.02) << result.names[p];
    }
  }
  EXPECT_EQ(HoleBarSetup::of(machineFrom(along_y), machineFrom(along_y).artefacts.front()).parameterNames().front(),
            "EYY_um_per_m");
  const std::vector<std::string> names =
      HoleBarSetup::of(machineFrom(table_b), machineFrom(table_b).artefacts.front()).parameterNames(true);
  EXPECT_EQ(names, (std::vector<std::string>{"EXX_um_per_m", "EX0B_um", "EZ0B_um", "EY0T_um", "ER0T_um", "EA0B_urad",
                                             "EB0B_urad", "EC0B_urad", "EME_um_per_m", "EZZ_um_per_m"}));
}

TEST(HoleCycle, ExpandingSecondAxisBiasesAndAStableLengthRemovesIt) {
  const MachineDescription m = machineFrom(holeMachineText());
  VirtualProbeOptions options;
  options.noise_um = options.surface_noise_um = 0.02;
  const double drift = 20.0;  // um/m of Y
  const VirtualRun run = runCycles(m, 4, options, 8, [&](int k, Random&) {
    std::vector<double> p(10, 0.0);
    if (k > 0) p = {12, 1, -2, 3, 2, 4, -3, 5, 0.5, drift};
    return p;
  });
  const HoleCycleResult plain = evaluateHoleCycles(run.list, m, m.artefacts.front());
  const SecondAxisBias bias = secondAxisBias(plain, run.list);
  EXPECT_EQ(bias.second, "Y");
  for (std::size_t p = 0; p < 9; ++p) {
    EXPECT_NEAR(plain.parameters[2][p].value - run.truth[2][p], drift * bias.bias_per_um_per_m[p], 0.5)
        << plain.names[p];
  }
  EXPECT_GT(std::abs(plain.parameters[2][0].value - 12.0), 10.0) << "EXX must take the blame";

  HoleCycleOptions extended;
  extended.second_axis = true;
  extended.stable_length = StableLength{0.5, 0.1, {}};
  const HoleCycleResult removed = evaluateHoleCycles(run.list, m, m.artefacts.front(), extended);
  ASSERT_EQ(removed.status, FitStatus::Converged) << removed.message;
  for (std::size_t p = 0; p < 10; ++p) {
    const CycleParameter& q = removed.parameters[2][p];
    EXPECT_LT(std::abs(q.value - run.truth[2][p]), 4.0 * q.standard_uncertainty) << removed.names[p];
    EXPECT_LT(std::abs(q.value - run.truth[2][p]), 1.0) << removed.names[p];
  }
  // Without a stable length the ten parameters are one too many, and the result says so.
  extended.stable_length.reset();
  const HoleCycleResult open = evaluateHoleCycles(run.list, m, m.artefacts.front(), extended);
  EXPECT_EQ(open.status, FitStatus::Degenerate);
  EXPECT_FALSE(open.parameters[2][0].determined);
  EXPECT_FALSE(open.parameters[2][9].determined);
}

TEST(HoleCycle, TheSecondAxisOfOneCycleIsNotDetermined) {
  const MachineDescription m = machineFrom(holeMachineText());
  VirtualRun run = runCycles(m, 3, {}, 9);
  const std::string first = run.list.touches.front().cycle;
  std::erase_if(run.list.touches, [&](const Touch& t) { return t.cycle != first; });
  const SecondAxisBias bias = secondAxisBias(evaluateHoleCycles(run.list, m, m.artefacts.front()), run.list);
  ASSERT_FALSE(bias.bias_per_um_per_m.empty());
  for (const double value : bias.bias_per_um_per_m) EXPECT_TRUE(std::isnan(value)) << "not 0: nothing tells it";
}

TEST(HoleCycle, SwappedAndWrongFeaturesAreTold) {
  const MachineDescription m = machineFrom(holeMachineText());
  VirtualRun run = runCycles(m, 5, {}, 31);
  for (Touch& t : run.list.touches) {
    if (t.cycle != "M2" || t.c_deg != 0.0) continue;
    if (t.feature == "H3") {
      t.feature = "H4";
      t.touch += 10;
    } else if (t.feature == "H4") {
      t.feature = "H3";
    }
  }
  for (Touch& t : run.list.touches) {
    if (t.feature == "H4" && t.touch >= 10) t.touch -= 10;
  }
  const HoleCycleResult result = evaluateHoleCycles(run.list, m, m.artefacts.front());
  EXPECT_EQ(result.rejected.size(), 10U);
  for (const RejectedTouch& r : result.rejected) {
    EXPECT_EQ(run.list.touches[r.touch].cycle, "M2");
    EXPECT_NE(r.reason.find("swapped"), std::string::npos) << r.reason;
  }
  for (std::size_t p = 0; p < 9; ++p) {
    const CycleParameter& q = result.parameters[2][p];
    EXPECT_TRUE(q.determined);
    EXPECT_LT(std::abs(q.value - run.truth[2][p]), 4.5 * q.standard_uncertainty);
  }
}

/// Another work offset, the artefact clamped anew: the cycle is left out with its reason, the others are evaluated.
TEST_P(CycleKind, ACycleThatIsShiftedAsAWholeIsLeftOut) {
  const MachineDescription m = machine();
  for (const double shift_mm : {1.05, 1.2, 20.0}) {
    VirtualRun run = runCycles(m, 4, {}, 71);
    for (Touch& t : run.list.touches)
      if (t.cycle == "M2") t.position_mm.x() += shift_mm;
    const CycleEvaluation evaluation = evaluate(m, run.list);
    EXPECT_EQ(evaluation.rejected.size(), run.list.touches.size() / 4);
    for (const RejectedTouch& r : evaluation.rejected) EXPECT_EQ(run.list.touches[r.touch].cycle, "M2");
    EXPECT_EQ(evaluation.fit.cycles[2].touches_used, 0);
    EXPECT_THAT(evaluation.fit.cycles[2].message, ::testing::HasSubstr("none of its touches is left"));
    for (const std::size_t k : {1U, 3U}) {
      for (std::size_t p = 0; p < evaluation.names.size(); ++p) {
        const CycleParameter& q = evaluation.parameters[k][p];
        EXPECT_TRUE(q.determined);
        EXPECT_FALSE(evaluation.parameters[2][p].determined);
        EXPECT_LT(std::abs(q.value - run.truth[k][p]), 4.5 * q.standard_uncertainty) << evaluation.names[p];
      }
    }
  }
}

/// A bar of another place on the table than the machine file says, and a little skew: the holes are found there.
TEST(HoleCycle, ABarThatIsClampedBesideItsPlaceIsFound) {
  const MachineDescription m = machineFrom(holeMachineText());
  MachineDescription clamped = m;
  Artefact& bar = clamped.artefacts.front();
  bar.reference_in_table_mm += Eigen::Vector3d(2.4, -3.1, 0.0);
  bar.direction_at_c0 = Eigen::AngleAxisd(0.01, Eigen::Vector3d::UnitZ()) * bar.direction_at_c0;
  const VirtualRun run = runCycles(clamped, 4, {}, 41);
  const HoleCycleResult result = evaluateHoleCycles(run.list, m, m.artefacts.front());
  EXPECT_TRUE(result.rejected.empty()) << result.rejected.front().reason;
  EXPECT_THAT(result.warnings, ::testing::Contains(::testing::HasSubstr("mm beside its place and turned by 0.57°")));
  EXPECT_TRUE(result.good_enough);
}

TEST(HoleCycle, WhatFitsInNoCycleIsTheMachineFilesOrTheAnglesFault) {
  const MachineDescription m = machineFrom(holeMachineText());
  const VirtualRun run = runCycles(m, 3, {}, 97);
  MachineDescription wrong = m;
  wrong.artefacts.front().nominal_positions_mm[3] -= 11.0;
  const HoleCycleResult of_feature = evaluateHoleCycles(run.list, wrong, wrong.artefacts.front());
  EXPECT_FALSE(of_feature.good_enough);
  EXPECT_THAT(of_feature.warnings,
              ::testing::Contains(::testing::HasSubstr("All touches of H4 lie some 11.0 mm from")));
  TouchList turned = run.list;
  for (Touch& t : turned.touches)
    if (t.c_deg == 90.0) t.c_deg = -90.0;
  const HoleCycleResult of_angle = evaluateHoleCycles(turned, m, m.artefacts.front());
  EXPECT_FALSE(of_angle.good_enough);
  EXPECT_THAT(of_angle.warnings, ::testing::Contains(::testing::HasSubstr("All touches of bar at -90° lie some")));
}

/// The stylus was changed for one cycle: what it measured is left out with its reason.
TEST_P(CycleKind, AnotherStylusInOneCycleIsTold) {
  const MachineDescription m = machine();
  VirtualRun run = runCycles(m, 5, {}, 43);
  for (Touch& t : run.list.touches)
    if (t.cycle == "M2" && t.stylus == "p0") t.position_mm -= 0.5 * t.approach;
  const CycleEvaluation evaluation = evaluate(m, run.list);
  EXPECT_FALSE(evaluation.good_enough);
  EXPECT_THAT(
      evaluation.warnings,
      ::testing::Contains(::testing::HasSubstr("In M2 the touches with stylus p0 lie on a radius that differs by ")));
  for (const RejectedTouch& r : evaluation.rejected) {
    EXPECT_EQ(run.list.touches[r.touch].cycle, "M2");
    EXPECT_EQ(run.list.touches[r.touch].stylus, "p0");
  }
  for (std::size_t p = 0; p < evaluation.names.size(); ++p) {
    const CycleParameter& q = evaluation.parameters[3][p];
    EXPECT_LT(std::abs(q.value - run.truth[3][p]), 4.5 * q.standard_uncertainty) << evaluation.names[p];
  }
}

TEST(HoleCycle, ARadiusThatIsNotThatOfTheMachineFileIsOneSentence) {
  MachineDescription m = machineFrom(holeMachineText());
  const VirtualRun run = runCycles(m, 3, {}, 47);
  m.styli.front().radius_mm = 1.25;
  const HoleCycleResult result = evaluateHoleCycles(run.list, m, m.artefacts.front());
  const auto told = [](const std::string& w) {
    return w.find("the touches lie on a radius of 4.5") != std::string::npos;
  };
  EXPECT_EQ(std::count_if(result.warnings.begin(), result.warnings.end(), told), 1);
  EXPECT_THAT(result.warnings, ::testing::Contains(::testing::HasSubstr("± ")));
  EXPECT_TRUE(result.good_enough);
}

/// Artefact or probe is knocked in the middle of a cycle: the place of the step is told, the cycle is left out.
TEST_P(CycleKind, AKnockInsideACycleIsToldAndTheCycleLeftOut) {
  const MachineDescription m = machine();
  for (const std::uint64_t seed : {51U, 52U, 53U}) {
    VirtualRun run = runCycles(m, 5, {}, seed);
    std::vector<std::size_t> of_cycle;
    for (std::size_t i = 0; i < run.list.touches.size(); ++i)
      if (run.list.touches[i].cycle == "M2") of_cycle.push_back(i);
    const std::size_t first_after = of_cycle[of_cycle.size() / 2];
    for (std::size_t i = first_after; i < run.list.touches.size(); ++i)
      run.list.touches[i].position_mm += Eigen::Vector3d(0.02, -0.01, 0.0);
    const CycleEvaluation evaluation = evaluate(m, run.list);
    EXPECT_FALSE(evaluation.good_enough);
    EXPECT_THAT(evaluation.warnings, ::testing::Contains(::testing::HasSubstr("In the middle of M2, between ")));
    EXPECT_EQ(evaluation.fit.cycles[2].touches_used, 0);
    for (const RejectedTouch& r : evaluation.rejected) EXPECT_EQ(run.list.touches[r.touch].cycle, "M2");
    for (std::size_t p = 0; p < evaluation.names.size(); ++p) {
      const CycleParameter& q = evaluation.parameters[1][p];
      EXPECT_LT(std::abs(q.value - run.truth[1][p]), 4.5 * q.standard_uncertainty) << evaluation.names[p];
    }
  }
}

TEST_P(CycleKind, WithoutAKnockNoneIsFound) {
  const MachineDescription m = machine();
  for (std::uint64_t seed = 60; seed < 90; ++seed) {
    VirtualRun run = runCycles(m, 4, {}, seed);
    // A bad touch is no step.
    run.list.touches[run.list.touches.size() / 3].position_mm.x() += 0.03;
    const CycleEvaluation evaluation = evaluate(m, run.list);
    EXPECT_TRUE(evaluation.good_enough) << evaluation.warnings.back();
  }
}

/// Bad touches anywhere, some of which are the only ones of their side that feel a direction.
TEST(HoleCycle, SomeBadTouchesAreNoKnock) {
  const MachineDescription m = machineFrom(holeMachineText());
  int left_out = 0;
  for (std::uint64_t seed = 300; seed < 380; ++seed) {
    VirtualRun run = runCycles(m, 2, {}, seed);
    Random random(seed);
    for (int k = 0; k < 3; ++k) {
      Touch& t = run.list.touches[random.index(run.list.touches.size())];
      t.position_mm += 0.005 * t.approach;
    }
    const HoleCycleResult result = evaluateHoleCycles(run.list, m, m.artefacts.front());
    left_out += result.fit.cycles[1].touches_used == 0 ? 1 : 0;
  }
  EXPECT_EQ(left_out, 0);
}

TEST(HoleCycle, TouchesThatNoOtherCycleHasAreTold) {
  const MachineDescription m = machineFrom(holeMachineText());
  const VirtualRun run = runCycles(m, 3, {}, 92);
  const auto with = [&](const std::function<double(double)>& angle) {
    VirtualRun changed = run;
    for (Touch& t : changed.list.touches)
      if (t.cycle == "M1") t.c_deg = angle(t.c_deg);
    return evaluateHoleCycles(changed.list, m, m.artefacts.front()).warnings;
  };
  double turned_deg = 0.0;
  for (const Touch& t : run.list.touches) turned_deg = std::max(turned_deg, t.c_deg);
  ASSERT_GT(turned_deg, 0.0);
  const auto expectTold = [&](double other_deg, const char* why) {
    const std::vector<std::string> warnings = with([&](double c) { return c == turned_deg ? other_deg : c; });
    EXPECT_THAT(warnings, ::testing::Contains(::testing::AllOf(::testing::HasSubstr("of M1 at a table angle of"),
                                                               ::testing::HasSubstr(why))));
  };
  expectTold(turned_deg + 0.001, "Touches of one place have one c_deg in all cycles");
  EXPECT_THAT(with([](double c) { return c; }),
              ::testing::Not(::testing::Contains(::testing::HasSubstr("No other cycle has"))));
}

/// A table that counts on, or back, in a later cycle: the same places, so the same answer.
TEST(HoleCycle, WholeTurnsOfTheTableAreTheSamePlace) {
  const MachineDescription m = machineFrom(holeMachineText());
  const VirtualRun run = runCycles(m, 3, {}, 92);
  const auto evaluated = [&](double turns_deg) {
    TouchList list = run.list;
    for (Touch& t : list.touches)
      if (t.cycle == "M1") t.c_deg += turns_deg;
    return evaluateHoleCycles(TouchList::parse(list.csv(), "touches.csv"), m, m.artefacts.front());
  };
  const HoleCycleResult as_is = evaluated(0.0);
  for (const double turns_deg : {-360.0, 720.0}) {
    const HoleCycleResult turned = evaluated(turns_deg);
    EXPECT_EQ(turned.warnings, as_is.warnings);
    EXPECT_EQ(turned.row_touch, as_is.row_touch) << "no touch is lost";
    EXPECT_THAT(turned.fit.residual_mm, ::testing::Pointwise(::testing::DoubleNear(1e-9), as_is.fit.residual_mm));
  }
}

TEST(BallCycle, OffsetsThatTheTouchesContradictAreTold) {
  const VirtualRun run = runCycles(machineFrom(ballMachineText()), 3, {}, 91);
  const auto told = [&](const std::function<void(MachineDescription&)>& change) {
    MachineDescription m = machineFrom(ballMachineText());
    change(m);
    const BallCycleResult result = evaluateBallCycles(run.list, m, m.artefacts.front(), nullptr);
    EXPECT_NE(result.good_enough, !result.warnings.empty());
    return result.warnings;
  };
  EXPECT_TRUE(told([](MachineDescription&) {}).empty());
  EXPECT_THAT(told([](MachineDescription& m) { m.styli[1].offset_mm.y() *= -1.0; }),
              ::testing::ElementsAre(::testing::HasSubstr(
                  "Stylus p1 touched on the whole along (0.0, 1.0, 0.0), but its offset (0, -50, -20) mm")));
  EXPECT_THAT(told([](MachineDescription& m) { std::swap(m.styli[1].offset_mm, m.styli[2].offset_mm); }),
              ::testing::ElementsAre(::testing::HasSubstr("Stylus p1"), ::testing::HasSubstr("Stylus p2")));
  EXPECT_THAT(told([](MachineDescription& m) { m.styli[1].offset_mm *= 1e-3; }),
              ::testing::ElementsAre(::testing::HasSubstr("The offset of stylus p1 is 0.0539 mm long")));
}

/// With two cycles only: the labels of two balls are swapped in the second one.
TEST(BallCycle, SwappedBallsOfTwoCyclesAreLeftOut) {
  const MachineDescription m = machineFrom(ballMachineText());
  VirtualRun run = runCycles(m, 2, {}, 93);
  for (Touch& t : run.list.touches)
    if (t.cycle == "M1" && (t.feature == "B1" || t.feature == "B2")) t.feature = t.feature == "B1" ? "B2" : "B1";
  const BallCycleResult result = evaluateBallCycles(run.list, m, m.artefacts.front(), nullptr);
  EXPECT_EQ(result.rejected.size(), 30U);
  for (const RejectedTouch& r : result.rejected) {
    EXPECT_EQ(run.list.touches[r.touch].cycle, "M1");
    EXPECT_THAT(r.reason, ::testing::HasSubstr("wrong or swapped feature?"));
  }
}

TEST(BallCycle, WhatCyclesLeaveOpenIsOneSentenceAndNotGoodEnough) {
  const MachineDescription m = machineFrom(ballMachineText());
  VirtualRun run = runCycles(m, 6, {}, 95);
  removeTouches(run.list, [](const Touch& t) { return t.stylus != "p0"; });
  const BallCycleResult result = evaluateBallCycles(run.list, m, m.artefacts.front(), nullptr);
  EXPECT_FALSE(result.good_enough);
  EXPECT_THAT(result.warnings, ::testing::ElementsAre(::testing::HasSubstr("M1 to M5: not determined by the touches")));
}

TEST(BallCycle, DistancesAgreeWithTheCertificate) {
  const MachineDescription m = machineFrom(ballMachineText());
  VirtualProbeOptions options;
  options.noise_um = 0.3;
  const BallCycleResult result = evaluateBallCycles(runCycles(m, 3, options, 2).list, m, m.artefacts.front(), nullptr);
  ASSERT_EQ(result.distances.size(), 3U * 3U * 6U);
  double chi2 = 0.0;
  int count = 0;
  for (const BallDistance& d : result.distances) {
    if (d.cycle != "M0") continue;
    chi2 += std::pow(d.error_um / d.standard_uncertainty_um, 2);
    EXPECT_GT(d.standard_uncertainty_um, 0.4 * std::sqrt(2.0));
    ++count;
  }
  EXPECT_LT(chi2 / count, 2.0);
}

TEST(BallCycle, GrowthOfAWarmArtefactIsTakenOff) {
  std::string text = ballMachineText();
  const std::string key = "\"certificate_uncertainty_um\":0.4";
  text.replace(text.find(key), key.size(), key + ",\"expansion_um_per_m_K\":11.5");
  const MachineDescription m = machineFrom(text);
  VirtualProbeOptions options;
  options.noise_um = 0.0;
  VirtualRun run = runCycles(m, 3, options, 2);
  OperatingLog log({0.0, 600.0, 1200.0, 1800.0});
  log.setSignal("T_balls_degC", {20.0, 22.0, 24.0, 24.0});
  for (Touch& t : run.list.touches) {
    for (const ArtefactBall& b : m.artefacts.front().balls) {
      if (b.id == t.feature) t.position_mm += 11.5e-6 * (log.at("T_balls_degC", t.time_s) - 20.0) * b.certified_mm;
    }
  }
  const BallCycleResult result = evaluateBallCycles(run.list, m, m.artefacts.front(), &log);
  for (std::size_t p = 0; p < 12; ++p) {
    EXPECT_NEAR(result.parameters[2][p].value, run.truth[2][p], 0.05) << result.names[p];
  }
  for (const BallDistance& d : result.distances) {
    if (d.cycle == "M0") {
      EXPECT_LT(std::abs(d.error_um), 0.5);
    }
  }
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

/// The artefact stands turned on the machine: its certificate is in its own frame.
Eigen::Matrix3d clamping() {
  return (Eigen::AngleAxisd(1.3, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

MachineDescription turned(MachineDescription machine) {
  for (ArtefactBall& b : machine.artefacts.front().balls) b.certified_mm = clamping() * b.certified_mm;
  return machine;
}

void grow(TouchList& list, const MachineDescription& standing, const std::function<double(double)>& strain) {
  for (Touch& t : list.touches) {
    for (const ArtefactBall& b : standing.artefacts.front().balls) {
      if (b.id == t.feature) t.position_mm += strain(t.time_s) * b.certified_mm;
    }
  }
}

TEST(BallCycle, GrowthIsTakenOffAlongTheArtefactAsItStands) {
  const MachineDescription m =
      machineFrom(replaced(ballMachineText(), "\"certificate_uncertainty_um\":0.4",
                           "\"certificate_uncertainty_um\":0.4,\"expansion_um_per_m_K\":11.5,"
                           "\"expansion_uncertainty_um_per_m_K\":0,\"temperature_uncertainty_K\":0"));
  const MachineDescription standing = turned(m);
  VirtualProbeOptions options;
  options.noise_um = 0.0;
  options.first_ball_mm = {320.0, 120.0, 60.0};
  VirtualRun run = runCycles(standing, 3, options, 2);
  OperatingLog log({0.0, 600.0, 1200.0, 1800.0});
  log.setSignal("T_balls_degC", {20.0, 22.0, 24.0, 24.0});
  grow(run.list, standing, [&](double t) { return 11.5e-6 * (log.at("T_balls_degC", t) - 20.0); });
  const BallCycleResult result = evaluateBallCycles(run.list, m, m.artefacts.front(), &log);
  for (std::size_t p = 0; p < 12; ++p) {
    EXPECT_NEAR(result.parameters[2][p].value, run.truth[2][p], 0.05) << result.names[p];
  }
  EXPECT_TRUE(result.warnings.empty()) << result.warnings.front();
}

/// Kelvin, the value of a broken sensor, a log of another day: nothing is corrected by them.
TEST(BallCycle, ATemperatureThatNoArtefactHasIsRefused) {
  const MachineDescription m =
      machineFrom(replaced(ballMachineText(), "\"certificate_uncertainty_um\":0.4",
                           "\"certificate_uncertainty_um\":0.4,\"expansion_um_per_m_K\":11.5"));
  const VirtualRun run = runCycles(m, 3, {}, 11);
  const auto refusal = [&](const std::vector<double>& time_s, double value_degC) -> std::string {
    OperatingLog log(time_s);
    log.setSignal("T_balls_degC", std::vector<double>(time_s.size(), value_degC));
    try {
      (void)evaluateBallCycles(run.list, m, m.artefacts.front(), &log);
    } catch (const InputError& e) {
      return e.what();
    }
    return "taken";
  };
  const std::vector<double> whole{0.0, 3600.0};
  EXPECT_EQ(refusal(whole, 21.0), "taken");
  EXPECT_EQ(refusal({0.0, 100.0}, 21.0), "taken") << "held for a while";
  for (const double wrong : {-999.0, 294.15, 94.0})
    EXPECT_THAT(refusal(whole, wrong), ::testing::HasSubstr("allowed: -20 to 80")) << wrong;
  EXPECT_THAT(refusal({-90000.0, -80000.0}, 21.0), ::testing::HasSubstr("the log runs from -90000 to -80000 s"));
  EXPECT_EQ(refusal(whole, std::nan("")), "taken") << "an empty column is no temperature at all";
}

/// One cycle has nothing to compare with, and no touch checks another.
TEST(BallCycle, NoiseThatNothingTellsIsNotTakenForNone) {
  const MachineDescription m = machineFrom(ballMachineText());
  const VirtualRun run = runCycles(m, 1, {}, 11);
  const BallCycleResult result = evaluateBallCycles(run.list, m, m.artefacts.front(), nullptr);
  for (const double sigma_mm : result.fit.group_sigma_mm) EXPECT_EQ(sigma_mm, CycleFitOptions::assumed_sigma_mm);
  EXPECT_THAT(result.warnings, ::testing::Contains(::testing::HasSubstr("nothing is known of the noise of a touch")));
}

/// Touches lie some tens of micrometres from where they lay in the cycle before: what is seen is seen in all.
TEST(BallCycle, WhatOneBallShowsIsTheSameInEveryCycle) {
  const MachineDescription m = machineFrom(ballMachineText());
  VirtualProbeOptions options;
  options.noise_um = 0.3;
  VirtualRun run = runCycles(m, 8, options, 5);
  std::erase_if(run.list.touches, [&](const Touch& t) { return t.feature != run.list.touches.front().feature; });
  const BallCycleResult result = evaluateBallCycles(run.list, m, m.artefacts.front(), nullptr);
  ASSERT_GE(result.cycles.size(), 8U);
  std::size_t seen = 0;
  for (std::size_t p = 0; p < 12; ++p) {
    for (std::size_t k = 2; k < result.cycles.size(); ++k)
      EXPECT_EQ(result.parameters[k][p].determined, result.parameters[1][p].determined) << result.names[p] << k;
    seen += result.parameters[1][p].determined ? 1U : 0U;
  }
  EXPECT_GT(seen, 0U);
  EXPECT_LT(seen, 12U);
}

TEST(BallCycle, UncertaintyOfCoefficientAndTemperatureIsInEveryValue) {
  const MachineDescription m =
      machineFrom(replaced(ballMachineText(), "\"certificate_uncertainty_um\":0.4",
                           "\"certificate_uncertainty_um\":0.4,\"expansion_um_per_m_K\":11.5,"
                           "\"expansion_uncertainty_um_per_m_K\":0.6,\"temperature_uncertainty_K\":0.05"));
  const MachineDescription standing = turned(m);
  VirtualProbeOptions options;
  options.noise_um = 0.2;
  options.first_ball_mm = {320.0, 120.0, 60.0};
  int inside = 0, inside_without = 0, inside_difference = 0, inside_row = 0, count = 0, differences = 0, rows = 0;
  constexpr int seeds = 120;
  for (int seed = 0; seed < seeds; ++seed) {
    VirtualRun run = runCycles(standing, 3, options, 1000 + static_cast<std::uint64_t>(seed));
    Random random(5000 + static_cast<std::uint64_t>(seed));
    const double alpha = random.normal(11.5e-6, 0.6e-6);
    const std::array<double, 3> warm{0.0, 5.0, 8.0};
    std::array<double, 3> read{};
    for (std::size_t k = 0; k < 3; ++k) read[k] = 20.0 + warm[k] + random.normal(0.0, 0.05);
    grow(run.list, standing, [&](double t) { return alpha * warm[static_cast<std::size_t>(t / 600.0)]; });
    OperatingLog log({0.0, 599.0, 600.0, 1199.0, 1200.0, 1799.0});
    log.setSignal("T_balls_degC", {read[0], read[0], read[1], read[1], read[2], read[2]});
    const BallCycleResult result = evaluateBallCycles(run.list, m, m.artefacts.front(), &log);
    for (int p = 9; p < 12; ++p) {
      const auto i = static_cast<std::size_t>(p);
      for (std::size_t k = 1; k < 3; ++k) {
        const double error = result.parameters[k][i].value - run.truth[k][i];
        inside += std::abs(error) < 1.96 * result.parameters[k][i].standard_uncertainty ? 1 : 0;
        const double touches = std::sqrt(result.covariance(static_cast<int>(k), p, p) -
                                         std::pow(result.fit.causes[k].row(p).norm() * result.unit[i], 2));
        inside_without += std::abs(error) < 1.96 * touches ? 1 : 0;
        ++count;
      }
      // Both cycles share the coefficient and the first temperature: their difference is known better than either.
      const double variance = result.covariance(1, p, p) + result.covariance(2, p, p) -
                              2.0 * result.fit.covarianceBetween(1, 2)(p, p) * result.unit[i] * result.unit[i];
      const double error =
          (result.parameters[2][i].value - run.truth[2][i]) - (result.parameters[1][i].value - run.truth[1][i]);
      inside_difference += std::abs(error) < 1.96 * std::sqrt(variance) ? 1 : 0;
      ++differences;
    }
    const ObservationSet set = cycleObservations(result, run.list, m, m.artefacts.front());
    const auto causes = static_cast<std::size_t>(result.growth_factors.cols());
    ASSERT_GE(set.shared.factors().size(), causes);
    for (std::size_t q = 0; q < causes; ++q) {
      for (const SharedNoise::Load& l : set.shared.factors()[set.shared.factors().size() - causes + q]) {
        const Observation& o = set.rows[l.row];
        const auto cycle = static_cast<Eigen::Index>(o.state.back() - '0');
        EXPECT_NEAR(l.load,
                    -1e3 * result.growth_arm_mm.at(o.point.substr(0, o.point.find('/')))(axisIndex(o.component)) *
                        result.growth_factors(cycle, static_cast<Eigen::Index>(q)),
                    1e-12);
      }
    }
    for (const Observation& o : set.rows) {
      if (o.state != "M2" || !o.point.starts_with("B4/")) continue;
      const TipDeviation deviation = ballDeviation(m, run.truth[2]);
      const Eigen::Vector3d d = deviation({o.time_s, o.position_mm, o.tool_offset_mm, 0.0, "B4", {}});
      inside_row += std::abs(o.value - 1e3 * d(axisIndex(o.component))) < 1.96 * o.sigma ? 1 : 0;
      ++rows;
    }
  }
  EXPECT_GT(inside, 0.92 * count);
  EXPECT_LT(inside, 0.98 * count);
  EXPECT_LT(inside_without, 0.75 * count) << "the touches alone do not know it";
  EXPECT_GT(inside_difference, 0.92 * differences);
  EXPECT_LT(inside_difference, 0.985 * differences);
  EXPECT_GT(inside_row, 0.91 * rows);
}

TEST(BallCycle, AnUncertaintyThatIsNotStatedIsSaid) {
  const MachineDescription m =
      machineFrom(replaced(ballMachineText(), "\"certificate_uncertainty_um\":0.4", "\"expansion_um_per_m_K\":11.5"));
  const VirtualRun run = runCycles(m, 2, {}, 2);
  OperatingLog log({0.0, 599.0, 600.0, 1200.0});
  log.setSignal("T_balls_degC", {20.0, 20.0, 24.0, 24.0});
  const BallCycleResult result = evaluateBallCycles(run.list, m, m.artefacts.front(), &log);
  ASSERT_FALSE(result.warnings.empty());
  EXPECT_EQ(
      result.warnings.back(),
      "The machine file states no uncertainty of the expansion coefficient and the temperature of balls: taken as "
      "exact, though lengths were corrected by up to 46.0 µm/m.");
}

TEST(HoleCycle, WhatTheLengthsRestOnWithoutUncertaintyIsSaid) {
  const auto warningsOf = [](const std::string& keys) {
    const MachineDescription m = machineFrom(
        replaced(holeMachineText(), "\"hole_diameter_mm\":12",
                 "\"hole_diameter_mm\":12,\"certificate_uncertainty_um\":0.5,\"temperature_degC\":25" + keys));
    const VirtualRun run = runCycles(m, 2, {}, 2);
    return evaluateHoleCycles(run.list, m, m.artefacts.front(), {}, nullptr).warnings;
  };
  EXPECT_THAT(warningsOf(",\"expansion_um_per_m_K\":11.5"),
              ::testing::Contains("The machine file states no uncertainty of the expansion coefficient and the "
                                  "temperature of bar: taken as exact, though lengths were corrected by up to 57.5 "
                                  "µm/m."));
  EXPECT_THAT(warningsOf(""), ::testing::Contains(::testing::HasSubstr("not corrected for 5.0 K")));
}

TEST(HoleCycle, WithoutADiameterItIsTakenFromTheTouchesAndSaid) {
  const MachineDescription m = machineFrom(replaced(holeMachineText(), ",\"hole_diameter_mm\":12", ""));
  const VirtualRun run = runCycles(machineFrom(holeMachineText()), 3, {}, 2);
  const HoleCycleResult result = evaluateHoleCycles(run.list, m, m.artefacts.front(), {}, nullptr);
  EXPECT_TRUE(result.rejected.empty()) << result.rejected.front().reason;
  EXPECT_THAT(result.warnings, ::testing::Contains(::testing::HasSubstr("states no hole_diameter_mm of bar")));
}

TEST(HoleCycle, LengthsAtATemperatureThatNobodyKnowsAreSaid) {
  const MachineDescription m =
      machineFrom(replaced(holeMachineText(), "\"hole_diameter_mm\":12",
                           "\"hole_diameter_mm\":12,\"certificate_uncertainty_um\":0.5,\"expansion_um_per_m_K\":11.5"));
  const VirtualRun run = runCycles(m, 2, {}, 2);
  EXPECT_THAT(evaluateHoleCycles(run.list, m, m.artefacts.front(), {}, nullptr).warnings,
              ::testing::Contains("The temperature of bar is not known: its lengths are compared with the certificate "
                                  "as if it were at 20 °C; with every kelvin they are 11.5 µm/m off, beyond the stated "
                                  "uncertainty."));
}

TEST(BallCycle, DistancesThatAreNotCorrectedForATemperatureAreSaid) {
  const auto warningsOf = [](const std::string& keys) {
    const MachineDescription m = machineFrom(replaced(ballMachineText(), "\"certificate_uncertainty_um\":0.4", keys));
    const VirtualRun run = runCycles(m, 2, {}, 2);
    return evaluateBallCycles(run.list, m, m.artefacts.front(), nullptr).warnings;
  };
  using ::testing::Contains;
  using ::testing::HasSubstr;
  EXPECT_THAT(warningsOf("\"temperature_degC\":26"), Contains(HasSubstr("not corrected for 6.0 K")));
  EXPECT_THAT(warningsOf("\"expansion_um_per_m_K\":11.5"), Contains(HasSubstr("as if it were at 20 °C")));
  EXPECT_THAT(warningsOf("\"certificate_uncertainty_um\":0.4"), ::testing::IsEmpty());
}

TEST(HoleCycle, UncertaintiesOfAnotherUnitAreRefused) {
  const auto refusal = [](const std::string& key) {
    const MachineDescription m =
        machineFrom(replaced(holeMachineText(), "\"hole_diameter_mm\":12",
                             "\"hole_diameter_mm\":12,\"expansion_um_per_m_K\":11.5,\"temperature_degC\":22," + key));
    return testing::refusal([&] { (void)ArtefactCertificate::of(m, m.artefacts.front()); });
  };
  EXPECT_THAT(refusal("\"expansion_uncertainty_um_per_m_K\":6e-7"), ::testing::HasSubstr("not 1/K"));
  EXPECT_THAT(refusal("\"temperature_uncertainty_K\":293"), ::testing::HasSubstr("from 0 to 20"));
}

TEST(HoleCycle, OneTemperatureForAllCyclesContradictsNoGrowth) {
  const MachineDescription m =
      machineFrom(replaced(holeMachineText(), "\"hole_diameter_mm\":12",
                           "\"hole_diameter_mm\":12,\"expansion_um_per_m_K\":11.5,\"temperature_degC\":20"));
  const VirtualRun run = runCycles(
      m, 3, {}, 9, [&](int k, Random&) { return std::vector<double>{0, 0, 0, 0, 0, 0, 0, 0, k == 0 ? 0.0 : 70.0}; });
  const HoleCycleResult result = evaluateHoleCycles(run.list, m, m.artefacts.front(), {}, nullptr);
  EXPECT_NEAR(result.parameters[2][8].value, 70.0, 3.0);
  EXPECT_TRUE(result.growth.empty()) << "nothing is known of a growth";
  EXPECT_TRUE(result.warnings.empty()) << result.warnings.front();
}

// A knock looks like a displacement of the table; heat takes its time, whatever the time constant.
TEST(HoleCycle, AKnockOfTheStylusIsToldFromAMachineThatWarms) {
  const MachineDescription m = machineFrom(holeMachineText());
  int told = 0;
  int told_of_heat = 0;
  constexpr int seeds = 30;
  for (int seed = 1; seed <= seeds; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    const double tau_s = random.uniform(300.0, 6000.0);
    const int knocked_in = 2 + static_cast<int>(random.index(5));
    VirtualProbeOptions options;
    options.noise_um = 0.3;
    VirtualRun run = runCycles(m, 9, options, static_cast<std::uint64_t>(seed), [&](int k, Random&) {
      const double warm = -std::expm1(-600.0 * k / tau_s);
      return std::vector<double>{20 * warm, 15 * warm, -10 * warm, 25 * warm, 3 * warm, 8 * warm, -6 * warm, 0, 0};
    });
    const auto says = [&](const std::string& part) {
      const HoleCycleResult result = evaluateHoleCycles(run.list, m, m.artefacts.front(), {}, nullptr);
      return std::any_of(result.warnings.begin(), result.warnings.end(),
                         [&](const std::string& w) { return w.find(part) != std::string::npos; });
    };
    told_of_heat += says("at once, which heat does not do") ? 1 : 0;
    for (Touch& t : run.list.touches)
      if (t.time_s >= 600.0 * knocked_in - 1.0) t.position_mm += Eigen::Vector3d(0.016, -0.008, 0.009);
    told += says(fmt::format("From M{} to M{} all holes of", knocked_in - 1, knocked_in)) ? 1 : 0;
  }
  EXPECT_EQ(told_of_heat, 0);
  EXPECT_GE(told, seeds - 2);
}

TEST(HoleCycle, LengthsAgainstTheCertificateKnowWhatTheyRestOn) {
  const std::string text = replaced(holeMachineText(), "\"hole_diameter_mm\":12",
                                    "\"hole_diameter_mm\":12,\"certificate_uncertainty_um\":0.5,"
                                    "\"expansion_um_per_m_K\":11.5,\"expansion_uncertainty_um_per_m_K\":0.6,"
                                    "\"temperature_uncertainty_K\":0.1");
  const MachineDescription m = machineFrom(text);
  VirtualProbeOptions options;
  options.noise_um = options.surface_noise_um = 0.2;
  constexpr double slope = 15.0;  // um/m of the cold axis
  constexpr double warm_K = 6.0;  // of the bar above 20 degC
  int inside = 0, inside_touches = 0;
  constexpr int seeds = 150;
  for (int seed = 0; seed < seeds; ++seed) {
    Random random(300 + static_cast<std::uint64_t>(seed));
    const double strain = random.normal(11.5e-6, 0.6e-6) * warm_K;
    const double read = 20.0 + warm_K + random.normal(0.0, 0.1);
    MachineDescription real = m;
    for (double& s : real.artefacts.front().nominal_positions_mm) {
      s = s * (1.0 + strain) + random.normal(0.0, 0.5e-3);
    }
    const VirtualRun run = runCycles(real, 2, options, 700 + static_cast<std::uint64_t>(seed),
                                     [&](int, Random&) { return std::vector<double>{slope, 0, 0, 0, 0, 0, 0, 0, 0}; });
    OperatingLog log({0.0, 5000.0});
    log.setSignal("T_bar_degC", {read, read});
    const HoleCycleResult result = evaluateHoleCycles(run.list, m, m.artefacts.front(), {}, &log);
    ASSERT_EQ(result.against_certificate.size(), 2U);
    const CertifiedLengths& lengths = result.against_certificate.front();
    EXPECT_EQ(lengths.holes.size(), 6U);
    EXPECT_NEAR(*lengths.temperature_degC, read, 1e-9);
    inside += std::abs(lengths.slope_um_per_m - slope) < 1.96 * lengths.standard_uncertainty_um_per_m ? 1 : 0;
    inside_touches += std::abs(lengths.slope_um_per_m - slope) < 1.96 * 1.0 ? 1 : 0;
    // Without the temperature the bar would be 69 um/m too long.
    EXPECT_GT(lengths.standard_uncertainty_um_per_m, 3.5);
  }
  EXPECT_GT(inside, 0.91 * seeds);
  EXPECT_LT(inside, 0.99 * seeds);
  EXPECT_LT(inside_touches, 0.6 * seeds);
}

TEST(CycleFit, WhatIsKnownFromElsewhereIsOneLeastSquaresWithTheTouches) {
  constexpr int cycles = 4, keys = 7, n = 2;
  constexpr double sigma = 2e-3;
  Random random(17);
  CycleProblem problem;
  problem.cycles = cycles;
  problem.keys = keys;
  problem.parameters = {"a", "b"};
  problem.jacobian.resize(cycles * keys, n);
  for (int k = 0; k < cycles; ++k) {
    for (int key = 0; key < keys; ++key) {
      for (int p = 0; p < n; ++p) problem.jacobian(k * keys + key, p) = random.normal(0.0, 1.0);
      problem.rows.push_back({k, key, 0, random.normal(0.0, 0.01)});
    }
  }
  KnownCombination known;
  known.row = Eigen::RowVector2d(0.4, 1.3);
  known.cycles = {1, 2, 3};
  known.value = Eigen::Vector3d(0.004, -0.003, 0.006);
  Eigen::MatrixXd factors(3, 3);  // two common causes and one of the first entry alone
  factors << 2e-3, 1e-3, 3e-3, 2e-3, -2e-3, 0.0, 2e-3, 4e-3, 0.0;
  known.covariance = factors * factors.transpose();
  CycleFitOptions options;
  options.sigma_mm = sigma;
  options.outlier_threshold = 0.0;
  CycleFitResult fit = fitCycles(problem, options);
  const CycleFitResult touches = fit;
  combineWith(problem, known, fit);

  // Everything at once: theta of cycles 1 ... 3, then the constants.
  constexpr int unknowns = 3 * n + keys;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(cycles * keys + 3, unknowns);
  Eigen::VectorXd y(A.rows());
  Eigen::MatrixXd V = Eigen::MatrixXd::Zero(A.rows(), A.rows());
  for (int r = 0; r < cycles * keys; ++r) {
    const CycleRow& row = problem.rows[static_cast<std::size_t>(r)];
    if (row.cycle > 0) A.block<1, n>(r, (row.cycle - 1) * n) = problem.jacobian.row(r);
    A(r, 3 * n + row.key) = 1.0;
    y(r) = row.value_mm;
    V(r, r) = sigma * sigma;
  }
  for (int i = 0; i < 3; ++i) A.block<1, n>(cycles * keys + i, i * n) = known.row;
  y.tail<3>() = known.value;
  V.bottomRightCorner<3, 3>() = known.covariance;
  const Eigen::MatrixXd W = V.inverse();
  const Eigen::MatrixXd covariance = (A.transpose() * W * A).inverse();
  const Eigen::VectorXd x = covariance * (A.transpose() * W * y);
  const Eigen::VectorXd left = y - A * x;
  for (int k = 1; k < cycles; ++k) {
    const CycleSolution& solution = fit.cycles[static_cast<std::size_t>(k)];
    EXPECT_LT((solution.theta - x.segment<n>((k - 1) * n)).norm(), 1e-9);
    EXPECT_GT((solution.theta - touches.cycles[static_cast<std::size_t>(k)].theta).norm(), 1e-4);
    for (int l = 1; l < cycles; ++l) {
      const Eigen::MatrixXd block = k == l ? solution.covariance : fit.covarianceBetween(k, l);
      EXPECT_LT((block - covariance.block<n, n>((k - 1) * n, (l - 1) * n)).norm(), 1e-12) << k << l;
    }
  }
  EXPECT_LT((fit.constant_mm - x.tail<keys>()).norm(), 1e-9);
  for (std::size_t r = 0; r < problem.rows.size(); ++r)
    EXPECT_NEAR(fit.residual_mm[r], left(static_cast<Eigen::Index>(r)), 1e-9);
}

TEST(HoleCycle, CertificateCoefficientAndTemperatureEnterTheGrowthAndTheSlopeOfTheAxis) {
  const MachineDescription m = machineFrom(replaced(holeMachineText(), "\"hole_diameter_mm\":12",
                                                    "\"hole_diameter_mm\":12,\"certificate_uncertainty_um\":0.5,"
                                                    "\"expansion_um_per_m_K\":11.5,"
                                                    "\"expansion_uncertainty_um_per_m_K\":0.1,"
                                                    "\"temperature_uncertainty_K\":0.02"));
  const MachineDescription unstated = machineFrom(
      replaced(holeMachineText(), "\"hole_diameter_mm\":12", "\"hole_diameter_mm\":12,\"expansion_um_per_m_K\":11.5"));
  VirtualProbeOptions options;
  options.noise_um = options.surface_noise_um = 0.4;
  const std::array<double, 4> warm{0.0, 2.0, 3.0, 4.0};
  constexpr int seeds = 150;
  constexpr std::array<std::size_t, 2> both{0, 8};  // EXX, EME
  std::array<int, 2> inside{}, inside_difference{};
  std::array<double, 2> squares{}, squares_touches{};
  for (int seed = 0; seed < seeds; ++seed) {
    Random random(900 + static_cast<std::uint64_t>(seed));
    const double alpha = random.normal(11.5, 0.1);
    std::array<double, 4> read{};
    for (std::size_t k = 0; k < warm.size(); ++k) read[k] = 20.0 + warm[k] + random.normal(0.0, 0.02);
    const VirtualRun run = runCycles(m, 4, options, 4000 + static_cast<std::uint64_t>(seed), [&](int k, Random& r) {
      std::vector<double> p = k == 0 ? std::vector<double>(9, 0.0) : randomParameters(true, r);
      p[8] = alpha * warm[static_cast<std::size_t>(k)];
      return p;
    });
    OperatingLog log({0.0, 599.0, 600.0, 1199.0, 1200.0, 1799.0, 1800.0, 5000.0});
    log.setSignal("T_bar_degC", {read[0], read[0], read[1], read[1], read[2], read[2], read[3], read[3]});
    const HoleCycleResult result = evaluateHoleCycles(run.list, m, m.artefacts.front(), {}, &log);
    const HoleCycleResult touches = evaluateHoleCycles(run.list, unstated, unstated.artefacts.front(), {}, &log);
    ASSERT_TRUE(result.growth_combined);
    ASSERT_FALSE(touches.growth_combined) << "a growth without uncertainty is no measurement";
    for (std::size_t i = 0; i < both.size(); ++i) {
      const std::size_t p = both[i];
      const auto e = static_cast<Eigen::Index>(p);
      for (std::size_t k = 1; k < 4; ++k) {
        const double error = result.parameters[k][p].value - run.truth[k][p];
        inside[i] += std::abs(error) < 1.96 * result.parameters[k][p].standard_uncertainty ? 1 : 0;
        squares[i] += error * error;
        squares_touches[i] += std::pow(touches.parameters[k][p].value - run.truth[k][p], 2);
        EXPECT_LT(result.parameters[k][p].standard_uncertainty, touches.parameters[k][p].standard_uncertainty);
      }
      const double variance = result.covariance(1, static_cast<int>(p), static_cast<int>(p)) +
                              result.covariance(3, static_cast<int>(p), static_cast<int>(p)) -
                              2.0 * result.fit.covarianceBetween(1, 3)(e, e) * result.unit[p] * result.unit[p];
      const double error =
          (result.parameters[3][p].value - run.truth[3][p]) - (result.parameters[1][p].value - run.truth[1][p]);
      inside_difference[i] += std::abs(error) < 1.96 * std::sqrt(variance) ? 1 : 0;
    }
  }
  for (std::size_t i = 0; i < both.size(); ++i) {
    EXPECT_GT(inside[i], 0.92 * 3 * seeds) << i;
    EXPECT_LT(inside[i], 0.98 * 3 * seeds) << i;
    EXPECT_GT(inside_difference[i], 0.90 * seeds) << i;
    EXPECT_LT(inside_difference[i], 0.99 * seeds) << i;
    EXPECT_LT(squares[i], 0.8 * squares_touches[i]) << i;
    std::printf("%s: rms %.3f um/m with the certificate, %.3f of the touches alone, inside %.3f\n",
                i == 0 ? "EXX" : "EME", std::sqrt(squares[i] / (3 * seeds)),
                std::sqrt(squares_touches[i] / (3 * seeds)), inside[i] / (3.0 * seeds));
  }
}

/// EME counts per metre of distances that the certificate states: a hole that lies elsewhere changes it in proportion
/// to the growth, and EXX with it.
TEST(HoleCycle, ACertificateThatIsOffMovesGrowthAndSlopeAsTheirUncertaintySays) {
  constexpr double place_um = 40.0;  // as coarse as to be seen beside the touches
  constexpr double growth = 400.0;   // um/m
  const MachineDescription m = machineFrom(replaced(holeMachineText(), "\"hole_diameter_mm\":12",
                                                    "\"hole_diameter_mm\":12,\"certificate_uncertainty_um\":40"));
  VirtualProbeOptions options;
  options.noise_um = options.surface_noise_um = 0.0;
  std::array<double, 2> squares{}, stated{};
  constexpr int seeds = 200;
  for (int seed = 0; seed < seeds; ++seed) {
    Random random(100 + static_cast<std::uint64_t>(seed));
    MachineDescription real = m;
    for (double& s : real.artefacts.front().nominal_positions_mm) s += random.normal(0.0, 1e-3 * place_um);
    const VirtualRun run = runCycles(real, 2, options, 1, [&](int k, Random&) {
      return std::vector<double>{0, 0, 0, 0, 0, 0, 0, 0, k == 0 ? 0.0 : growth};
    });
    const HoleCycleResult result = evaluateHoleCycles(run.list, m, m.artefacts.front());
    const Eigen::MatrixXd& causes = result.fit.causes.at(1);
    for (const auto& [i, p] : {std::pair{0U, 0U}, std::pair{1U, 8U}}) {
      squares[i] += std::pow(result.parameters[1][p].value - (p == 8 ? growth : 0.0), 2) / seeds;
      stated[i] += std::pow(causes.row(p).norm() * result.unit[p], 2) / seeds;
    }
  }
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_NEAR(std::sqrt(squares[i]), std::sqrt(stated[i]), 0.15 * std::sqrt(stated[i])) << i;
  EXPECT_GT(std::sqrt(stated[1]), 0.01);
}

TEST(HoleCycle, AGrowthThatCoefficientAndTemperatureDoNotExplainIsSaid) {
  const MachineDescription m = machineFrom(replaced(holeMachineText(), "\"hole_diameter_mm\":12",
                                                    "\"hole_diameter_mm\":12,\"expansion_um_per_m_K\":11.5,"
                                                    "\"expansion_uncertainty_um_per_m_K\":0.5,"
                                                    "\"temperature_uncertainty_K\":0.1"));
  const auto evaluated = [&](double growth_um_per_m) {
    const VirtualRun run = runCycles(m, 3, {}, 9, [&](int k, Random&) {
      return std::vector<double>{0, 0, 0, 0, 0, 0, 0, 0, k == 0 ? 0.0 : growth_um_per_m};
    });
    OperatingLog log({0.0, 599.0, 600.0, 5000.0});
    log.setSignal("T_bar_degC", {20.0, 20.0, 23.0, 23.0});
    return evaluateHoleCycles(run.list, m, m.artefacts.front(), {}, &log);
  };
  const HoleCycleResult as_expected = evaluated(11.5 * 3.0);
  ASSERT_EQ(as_expected.growth.size(), 2U);
  EXPECT_NEAR(as_expected.growth[1].expected_um_per_m, 34.5, 1e-6);
  EXPECT_NEAR(as_expected.growth[1].expected_sigma_um_per_m, std::hypot(1.5, 11.5 * 0.1 * std::sqrt(2.0)), 1e-6);
  EXPECT_TRUE(as_expected.warnings.empty()) << as_expected.warnings.front();
  EXPECT_TRUE(as_expected.growth_combined);
  const HoleCycleResult other = evaluated(70.0);
  EXPECT_FALSE(other.growth_combined) << "what contradicts is not mixed in";
  EXPECT_NEAR(other.parameters[2][8].value, 70.0, 3.0);
  ASSERT_FALSE(other.warnings.empty());
  EXPECT_NE(other.warnings.back().find("expansion coefficient and temperature say"), std::string::npos);
}

TEST(BallCycle, ClosedFormsStandBesideTheJointEvaluationAndTakeTranslationsForRotations) {
  Campaign campaign;
  campaign.machine = machineFrom(ballMachineText());
  VirtualProbeOptions options;
  options.noise_um = 0.0;
  const auto closedForms = [&](std::vector<double> warm) {
    const VirtualRun run = runCycles(campaign.machine, 2, options, 3,
                                     [&](int k, Random&) { return k == 0 ? std::vector<double>(12, 0.0) : warm; });
    JobContext job;
    const TouchEvaluation evaluation = evaluateTouchList(campaign, run.list, {}, {}, job);
    return describeTouches(evaluation, campaign.machine).details["artefacts"][0]["closed_forms"];
  };
  const nlohmann::json head = closedForms({20, -15, 30, 0, 0, 0, 0, 0, 0, 0, 0, 0});
  ASSERT_EQ(head.size(), 4U) << "one per ball";
  const std::array<double, 3> truth{20.0, -15.0, 30.0};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(head[0]["head_rotation_urad"][i].get<double>(), truth[i], 0.05) << i;
    EXPECT_NEAR(head[0]["joint_head_rotation_urad"][i].get<double>(), truth[i], 0.05) << i;
  }
  const nlohmann::json drift = closedForms({20, -15, 30, 0, 0, 0, 5, -8, 10, 0, 0, 0});
  EXPECT_NEAR(drift[1]["joint_head_rotation_urad"][0].get<double>(), 20.0, 0.05);
  EXPECT_GT(std::abs(drift[1]["head_rotation_urad"][0].get<double>() - 20.0), 50.0) << "8 um over 50 mm";
  EXPECT_GT(drift[1]["spindle_drift_um"].get<double>(), 10.0);
  EXPECT_NEAR(drift[1]["joint_spindle_drift_um"].get<double>(), std::hypot(5.0, 8.0, 10.0), 0.05);
  EXPECT_GE(drift[1]["joint_standard_uncertainty_urad"][0].get<double>(), 0.0);
}

/// Own variances and loads of a set as one matrix.
Eigen::MatrixXd covarianceOf(const ObservationSet& set, const std::vector<std::size_t>& rows) {
  const Eigen::SparseMatrix<double> loads = set.shared.loads(rows);
  Eigen::MatrixXd out = Eigen::MatrixXd(loads * loads.transpose());
  for (std::size_t i = 0; i < rows.size(); ++i)
    out.diagonal()(static_cast<Eigen::Index>(i)) += set.shared.ownVariance(rows[i], set.rows[rows[i]].sigma);
  return out;
}

/// With touches missing in some cycles: the noise of the first cycle then differs from row to row.
TEST_P(CycleKind, WhatObservationsShareIsTheNoiseOfTheTouches) {
  const MachineDescription m = machine();
  VirtualProbeOptions options;
  options.noise_um = 0.5;
  options.surface_noise_um = 0.3;
  double chi2 = 0.0, count = 0.0, chi2_difference = 0.0, differences = 0.0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    VirtualRun run = runCycles(m, 4, options, 7000 + seed,
                               [&](int, Random&) { return std::vector<double>(GetParam() ? 9 : 12, 0.0); });
    removeTouches(run.list, [](const Touch& t) { return t.cycle == "M2" && t.touch == 1; });
    const CycleEvaluation evaluation = evaluate(m, run.list);
    const ObservationSet set = cycleObservations(evaluation, run.list, m, m.artefacts.front());
    std::map<std::string, std::vector<std::size_t>> of_point;
    std::map<std::pair<std::string, Component>, std::size_t> first;
    for (std::size_t r = 0; r < set.rows.size(); ++r) {
      const Observation& o = set.rows[r];
      EXPECT_GE(o.sigma * o.sigma * (1.0 + 1e-12), set.shared.variance(r));
      if (o.state == "M0") first[{o.point, o.component}] = r;
      if (o.state != "M0") of_point[o.point].push_back(r);
    }
    for (const auto& [point, rows] : of_point) {
      // The machine stands still: the rows are their noise.
      Eigen::VectorXd y(static_cast<Eigen::Index>(rows.size()));
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const Observation& o = set.rows[rows[i]];
        y(static_cast<Eigen::Index>(i)) = o.value;
        const auto reference = first.find({o.point, o.component});
        ASSERT_NE(reference, first.end());
        const Eigen::MatrixXd both = covarianceOf(set, {reference->second, rows[i]});
        EXPECT_NEAR(both(0, 0) + both(1, 1) - 2.0 * both(0, 1), o.sigma * o.sigma, 1e-4 * o.sigma * o.sigma);
      }
      const Eigen::MatrixXd c = covarianceOf(set, rows);
      chi2 += y.dot(c.llt().solve(y));
      count += static_cast<double>(rows.size());
      // Change between two later cycles: the first cancels where the touches are the same.
      for (std::size_t i = 0; i < rows.size(); ++i)
        for (std::size_t j = i + 1; j < rows.size(); ++j) {
          if (set.rows[rows[i]].component != set.rows[rows[j]].component) continue;
          const auto a = static_cast<Eigen::Index>(i), b = static_cast<Eigen::Index>(j);
          chi2_difference += std::pow(y(a) - y(b), 2) / (c(a, a) + c(b, b) - 2.0 * c(a, b));
          differences += 1.0;
        }
    }
  }
  EXPECT_NEAR(chi2 / count, 1.0, 0.06);
  EXPECT_NEAR(chi2_difference / differences, 1.0, 0.06);
}

TEST(CycleObservations, AreMinusTheChangeOfTheMeasuredPosition) {
  const MachineDescription m = machineFrom(holeMachineText());
  VirtualProbeOptions options;
  options.noise_um = options.surface_noise_um = 0.0;
  const VirtualRun run = runCycles(m, 3, options, 6);
  const HoleCycleResult result = evaluateHoleCycles(run.list, m, m.artefacts.front());
  const ObservationSet set = cycleObservations(result, run.list, m, m.artefacts.front());
  EXPECT_EQ(set.rows.size(), 3U * 12U * 3U);
  for (const Observation& o : set.rows) {
    const std::size_t k = o.state == "M0" ? 0 : o.state == "M1" ? 1 : 2;
    const TipDeviation deviation = holeBarDeviation(m, m.artefacts.front(), run.truth[k]);
    const std::string feature = o.point.substr(0, o.point.find('@'));
    const Eigen::Vector3d d =
        deviation({o.time_s, o.position_mm, o.tool_offset_mm, o.c_deg, feature, Eigen::Vector3d::UnitX()});
    EXPECT_NEAR(o.value, 1e3 * d(axisIndex(o.component)), 0.02) << o.point << " " << toString(o.component);
  }
}

}  // namespace
}  // namespace spindrift
