// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "core/math/least_squares.h"
#include "tests/core/probing/probing_machines.h"

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
