// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/machine/nine_parameter_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "core/base/random.h"
#include "core/machine/field.h"
#include "core/math/distributions.h"

namespace spindrift {
namespace {

using ::testing::HasSubstr;

constexpr std::array<Component, 3> translations{Component::EX, Component::EY, Component::EZ};

std::vector<Eigen::Vector3d> eightFiducials() {
  return {{20, 15, 0},  {280, 15, 0}, {280, 115, 0}, {20, 115, 0},
          {110, 40, 0}, {190, 40, 0}, {110, 90, 0},  {190, 90, 0}};
}

NineVector someTruth(Random& random) {
  NineVector p;
  p << random.normal(0, 30), random.normal(0, 30), random.normal(0, 10), random.normal(0, 50), random.normal(0, 50),
      random.normal(0, 50), random.normal(0, 50), random.normal(0, 100), random.normal(0, 100);
  return p;
}

/// Rows of a state; `truth` null: the reference state.
void addState(ObservationSet& set, const std::string& state, const std::vector<Eigen::Vector3d>& points,
              const NineVector& truth, const std::vector<double>& constant, double sigma_xy, double sigma_z,
              Random& random, bool noise = true) {
  std::size_t k = 0;
  const double time = set.rows.empty() ? 0.0 : set.rows.back().time_s + 100.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (const Component c : translations) {
      Observation o;
      o.time_s = time;
      o.state = state;
      o.point = "F" + std::to_string(i + 1);
      o.position_mm = points[i];
      o.component = c;
      o.sigma = c == Component::EZ ? sigma_z : sigma_xy;
      o.value = nineParameterRow(points[i], c).dot(truth) + constant[k++] + (noise ? random.normal(0, o.sigma) : 0.0);
      o.instrument = "microscope";
      set.rows.push_back(o);
    }
  }
}

TEST(NineParameterModel, EquationIsThatOfThePaperAsCorrected) {
  NineVector p;
  p << 1, 2, 3, 10, 20, 30, 40, 50, 60;
  const Eigen::Vector3d at(100, 50, 0);
  EXPECT_DOUBLE_EQ(nineParameterRow(at, Component::EX).dot(p), 1 - (30 + 40) * 0.05 + 50 * 0.1);
  EXPECT_DOUBLE_EQ(nineParameterRow(at, Component::EY).dot(p), 2 + 30 * 0.1 + 60 * 0.05);
  EXPECT_DOUBLE_EQ(nineParameterRow(at, Component::EZ).dot(p), 3 + 10 * 0.05 - 20 * 0.1);
  const Eigen::Vector3d above(100, 50, 10);
  EXPECT_NEAR(nineParameterRow(above, Component::EX).dot(p) - nineParameterRow(at, Component::EX).dot(p), 20 * 0.01,
              1e-12);
  EXPECT_NEAR(nineParameterRow(above, Component::EY).dot(p) - nineParameterRow(at, Component::EY).dot(p), -10 * 0.01,
              1e-12);
}

TEST(NineParameterModel, RecoversTruthWithoutNoiseWhateverTheConstants) {
  Random random(1);
  const NineVector truth = someTruth(random);
  std::vector<double> constants;
  for (int i = 0; i < 24; ++i) constants.push_back(random.normal(0, 500));
  ObservationSet set;
  addState(set, "M0", eightFiducials(), NineVector::Zero(), constants, 0.3, 0.8, random, false);
  addState(set, "M1", eightFiducials(), truth, constants, 0.3, 0.8, random, false);
  const NineParameterFit fit = fitNineParameters(set, {.state = "M1", .points = {}});
  ASSERT_EQ(fit.status, FitStatus::Converged) << fit.message;
  EXPECT_EQ(fit.reference_state, "M0");
  EXPECT_LT((fit.parameters - truth).cwiseAbs().maxCoeff(), 1e-7);
  EXPECT_NEAR(*fit.rms_fit_um, 0.0, 1e-9);
  EXPECT_FALSE(fit.rms_validation_um.has_value());
  EXPECT_GT(fit.condition_number, 1.0);
  EXPECT_LT(fit.condition_number, 100.0);
}

TEST(NineParameterModel, ReadingsFromTwoSidesAreEachReferencedToTheirOwn) {
  Random random(7);
  const NineVector truth = someTruth(random);
  ObservationSet set;
  for (const double side : {1.0, -1.0}) {
    // A backlash of 10 um in every state.
    const std::vector<double> constants(24, 5.0 * side);
    ObservationSet one;
    addState(one, "M0", eightFiducials(), NineVector::Zero(), constants, 0.3, 0.8, random);
    addState(one, "M1", eightFiducials(), truth, constants, 0.3, 0.8, random);
    for (Observation& o : one.rows) {
      o.approach = {side, 0.0, 0.0};
      set.rows.push_back(o);
    }
  }
  const NineParameterFit fit = fitNineParameters(set, {.state = "M1", .points = {}});
  ASSERT_EQ(fit.status, FitStatus::Converged) << fit.message;
  EXPECT_LT(*fit.rms_fit_um, 1.0);
  for (int i = 0; i < nine_parameter_count; ++i)
    EXPECT_NEAR(fit.parameters[i], truth[i], 4.0 * std::sqrt(fit.covariance(i, i))) << nine_parameter_names[i];
}

TEST(NineParameterModel, TruthLiesWithin95PercentIntervalsIn94To96PercentOf2000Campaigns) {
  Random random(20260131);
  int inside = 0;
  int total = 0;
  std::array<int, 9> each{};
  constexpr int campaigns = 2000;
  const double z95 = normalQuantile(0.975);
  double chi2 = 0.0;
  for (int n = 0; n < campaigns; ++n) {
    const NineVector truth = someTruth(random);
    std::vector<double> constants;
    for (int i = 0; i < 24; ++i) constants.push_back(random.normal(0, 100));
    ObservationSet set;
    const std::vector<Eigen::Vector3d> points = eightFiducials();
    addState(set, "M0", points, NineVector::Zero(), constants, 0.4, 0.9, random);
    addState(set, "M1", points, truth, constants, 0.25, 0.6, random);
    // An error common to EX of all points of the warm state, as the pooled centre of rotation makes it.
    const double common = random.normal(0, 0.3);
    SharedNoise::Factor centre;
    for (std::size_t i = 24; i < 48; ++i) {
      if (set.rows[i].component != Component::EX) continue;
      set.rows[i].value += common;
      set.rows[i].sigma = std::hypot(set.rows[i].sigma, 0.3);
      centre.push_back({i, 0.3});
    }
    set.shared.addFactor(centre);
    const NineParameterFit fit = fitNineParameters(set, {.state = "M1", .points = {"F1", "F2", "F3", "F4", "F6"}});
    ASSERT_EQ(fit.status, FitStatus::Converged);
    chi2 += fit.chi2 / fit.degrees_of_freedom / campaigns;
    for (int i = 0; i < nine_parameter_count; ++i) {
      const bool in = std::abs(fit.parameters(i) - truth(i)) < z95 * fit.standardUncertainty(i);
      inside += in ? 1 : 0;
      each[static_cast<std::size_t>(i)] += in ? 1 : 0;
      ++total;
    }
  }
  EXPECT_GT(inside, 0.94 * total);
  EXPECT_LT(inside, 0.96 * total);
  for (const int n : each) {
    EXPECT_GT(n, 0.935 * campaigns);
    EXPECT_LT(n, 0.965 * campaigns);
  }
  EXPECT_NEAR(chi2, 1.0, 0.05);
}

TEST(NineParameterModel, CovariancesThatAreNoneAreRefusedWithTheReason) {
  Random random(11);
  const std::vector<double> constants(24, 0.0);
  const auto fitWith = [&](double correlation) {
    ObservationSet set;
    addState(set, "M0", eightFiducials(), NineVector::Zero(), constants, 0.3, 0.8, random);
    addState(set, "M1", eightFiducials(), someTruth(random), constants, 0.3, 0.8, random);
    std::vector<CovarianceEntry> entries;
    std::vector<std::size_t> rows;
    for (std::size_t i = 24; i < 48; ++i)
      if (set.rows[i].component == Component::EX) rows.push_back(i);
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (std::size_t j = i + 1; j < rows.size(); ++j)
        entries.push_back({rows[i], rows[j], correlation * set.rows[rows[i]].sigma * set.rows[rows[j]].sigma});
    set.setCovariances(entries);
    return fitNineParameters(set, {.state = "M1", .relative_to_reference = false});
  };
  EXPECT_EQ(fitWith(0.5).status, FitStatus::Converged);
  const NineParameterFit impossible = fitWith(-0.5);  // of eight rows: not below -1/7
  EXPECT_EQ(impossible.status, FitStatus::Rejected);
  EXPECT_EQ(impossible.message, "the covariance of the observations is not positive definite of state M1");
  for (int i = 0; i < nine_parameter_count; ++i) {
    EXPECT_FALSE(impossible.determined(i));
    EXPECT_TRUE(std::isnan(impossible.parameters(i)));
    EXPECT_TRUE(std::isinf(impossible.standardUncertainty(i)));
  }
  EXPECT_TRUE(std::isnan(impossible.condition_number));
  for (const NineParameterResidual& r : impossible.residuals) EXPECT_TRUE(std::isnan(r.residual_um));
  EXPECT_FALSE(std::isfinite(impossible.predictingModel().predict({}, Component::EX).sigma));
  EXPECT_EQ(fitWith(1.0).status, FitStatus::Rejected) << "singular, however it is rounded";
}

TEST(NineParameterModel, ValidationPointsAreNotFitted) {
  Random random(3);
  const NineVector truth = someTruth(random);
  const std::vector<double> constants(24, 0.0);
  ObservationSet set;
  addState(set, "M0", eightFiducials(), NineVector::Zero(), constants, 0.3, 0.8, random);
  addState(set, "M1", eightFiducials(), truth, constants, 0.3, 0.8, random);
  for (Observation& o : set.rows) {
    if (o.point == "F6" && o.state == "M1" && o.component == Component::EX) o.value += 40.0;
  }
  const NineParameterFit fit = fitNineParameters(set, {.state = "M1", .points = {"F1", "F2", "F3", "F4"}});
  ASSERT_EQ(fit.residuals.size(), 24u);
  for (const NineParameterResidual& r : fit.residuals) {
    EXPECT_EQ(r.used, r.point <= "F4");
    if (r.point == "F6" && r.component == Component::EX) {
      EXPECT_NEAR(r.residual_um, 40.0, 3.0);
    }
  }
  EXPECT_GT(*fit.rms_validation_um, 5.0);
  EXPECT_LT(*fit.rms_fit_um, 1.5);
  EXPECT_NEAR(fit.parameters(0), truth(0), 4.0 * fit.standardUncertainty(0));
}

TEST(NineParameterModel, ThreePointsOnALineNameWhatIsNotDetermined) {
  Random random(4);
  const NineVector truth = someTruth(random);
  const std::vector<double> constants(9, 0.0);
  ObservationSet set;
  const std::vector<Eigen::Vector3d> line{{20, 65, 0}, {150, 65, 0}, {280, 65, 0}};
  addState(set, "M0", line, NineVector::Zero(), constants, 0.3, 0.8, random, false);
  addState(set, "M1", line, truth, constants, 0.3, 0.8, random, false);
  const NineParameterFit fit = fitNineParameters(set, {.state = "M1", .points = {}});
  EXPECT_EQ(fit.status, FitStatus::Degenerate);
  EXPECT_THAT(fit.message, HasSubstr("do not determine EX, EY, EZ, EA, EC0Y and αY;"));
  for (const int i : {4, 5, 7}) {  // EB, EC, alphaX hold
    EXPECT_TRUE(fit.determined(i)) << i;
    EXPECT_NEAR(fit.parameters(i), truth(i), 1e-6);
  }
  // On the line everything is known, beside it nothing of EX is.
  const NineParameterModel model = fit.model();
  DeviationQuery query;
  query.position_mm = {200, 65, 0};
  EXPECT_NEAR(model.predict(query, Component::EX).value, nineParameterRow(query.position_mm, Component::EX).dot(truth),
              1e-6);
  EXPECT_LT(model.predict(query, Component::EX).sigma, 1.0);
  query.position_mm = {200, 100, 0};
  EXPECT_TRUE(std::isinf(model.predict(query, Component::EX).sigma));
}

TEST(NineParameterModel, OneComponentDeterminesOnlyItsOwnParameters) {
  Random random(5);
  const NineVector truth = someTruth(random);
  const std::vector<double> constants(24, 0.0);
  ObservationSet set;
  addState(set, "M1", eightFiducials(), truth, constants, 0.3, 0.8, random, false);
  std::erase_if(set.rows, [](const Observation& o) { return o.component != Component::EZ; });
  const NineParameterFit fit = fitNineParameters(set, {.state = "M1", .points = {}});
  EXPECT_EQ(fit.status, FitStatus::Degenerate);
  EXPECT_EQ(fit.undetermined, (std::vector<int>{0, 1, 5, 6, 7, 8}));
  EXPECT_NEAR(fit.parameters(3), truth(3), 1e-6);
  EXPECT_EQ(fit.model().predict({}, Component::EZ).value, fit.parameters(2));
}

TEST(NineParameterModel, RobustFitIgnoresADisturbedFiducialAndKeepsItsCoverage) {
  for (const RobustLoss loss : {RobustLoss::Huber, RobustLoss::Tukey}) {
    Random random(6);
    int inside = 0;
    int total = 0;
    double worst = 0.0;
    for (int n = 0; n < 300; ++n) {
      const NineVector truth = someTruth(random);
      const std::vector<double> constants(24, 0.0);
      ObservationSet set;
      addState(set, "M1", eightFiducials(), truth, constants, 0.4, 0.9, random);
      const bool disturbed = n % 2 == 0;
      for (Observation& o : set.rows) {
        if (disturbed && o.point == "F6" && o.component != Component::EZ) o.value += 25.0;
      }
      const NineParameterFit fit = fitNineParameters(set, {.state = "M1", .points = {}, .robust = loss});
      ASSERT_EQ(fit.status, FitStatus::Converged);
      for (int i = 0; i < nine_parameter_count; ++i) {
        const double z = std::abs(fit.parameters(i) - truth(i)) / fit.standardUncertainty(i);
        worst = std::max(worst, z);
        if (disturbed && loss == RobustLoss::Huber) continue;  // Huber's influence is bounded, not zero
        inside += z < 1.96 ? 1 : 0;
        ++total;
      }
    }
    EXPECT_GT(inside, 0.92 * total) << static_cast<int>(loss);
    EXPECT_LT(inside, 0.98 * total) << static_cast<int>(loss);
    EXPECT_LT(worst, loss == RobustLoss::Tukey ? 6.0 : 8.0);
  }
}

TEST(NineParameterModel, SigmaOfTheFieldIsThatOfRepeatedCampaigns) {
  Random random(8);
  const NineVector truth = someTruth(random);
  const std::vector<double> constants(24, 0.0);
  const FieldGrid grid{0, 300, 0, 130, 0, 4, 3};
  std::vector<double> sum_squares(grid.size(), 0.0);
  Field field;
  constexpr int campaigns = 400;
  for (int n = 0; n < campaigns; ++n) {
    ObservationSet set;
    addState(set, "M0", eightFiducials(), NineVector::Zero(), constants, 0.4, 0.9, random);
    addState(set, "M1", eightFiducials(), truth, constants, 0.4, 0.9, random);
    const NineParameterFit fit = fitNineParameters(set);
    field = evaluateField(fit.model(), grid, Component::EX, {}, {{20, 15}, {280, 15}, {280, 115}, {20, 115}});
    for (int iy = 0; iy < grid.ny; ++iy) {
      for (int ix = 0; ix < grid.nx; ++ix) {
        const double error = field.value[grid.index(ix, iy)] -
                             nineParameterRow({grid.x_mm(ix), grid.y_mm(iy), 0}, Component::EX).dot(truth);
        sum_squares[grid.index(ix, iy)] += error * error / campaigns;
      }
    }
  }
  for (std::size_t i = 0; i < grid.size(); ++i) {
    EXPECT_NEAR(std::sqrt(sum_squares[i]) / field.sigma[i], 1.0, 0.15);
  }
}

TEST(NineParameterModel, ComparisonFindsADisturbedSetAndNotAnUndisturbedOne) {
  Random random(9);
  int false_alarms = 0;
  int found = 0;
  constexpr int campaigns = 300;
  for (int n = 0; n < campaigns; ++n) {
    const NineVector truth = someTruth(random);
    const std::vector<double> constants(24, 0.0);
    ObservationSet set;
    addState(set, "M0", eightFiducials(), NineVector::Zero(), constants, 0.4, 0.9, random);
    addState(set, "M1", eightFiducials(), truth, constants, 0.4, 0.9, random);
    const NineParameterOptions a{.state = "M1", .points = {"F1", "F2", "F3", "F4"}};
    const NineParameterOptions b{.state = "M1", .points = {"F2", "F4", "F5", "F7"}};
    false_alarms += compareNineParameters(set, a, b).p_value_all < 0.05 ? 1 : 0;
    for (Observation& o : set.rows) {
      if (o.point == "F5" && o.state == "M1" && o.component == Component::EX) o.value += 15.0;
    }
    const NineParameterComparison comparison = compareNineParameters(set, a, b);
    found += comparison.p_value_all < 0.05 ? 1 : 0;
  }
  EXPECT_LT(false_alarms, 0.09 * campaigns);
  EXPECT_GT(false_alarms, 0.02 * campaigns);
  EXPECT_GT(found, 0.95 * campaigns);
}

TEST(NineParameterModel, SameSetTwiceDoesNotDiffer) {
  Random random(10);
  const std::vector<double> constants(24, 0.0);
  ObservationSet set;
  addState(set, "M1", eightFiducials(), someTruth(random), constants, 0.4, 0.9, random);
  const NineParameterComparison comparison = compareNineParameters(set, {}, {});
  EXPECT_TRUE(comparison.significant.empty());
  EXPECT_EQ(comparison.p_value_all, 1.0);
}

TEST(NineParameterModel, ComparesThePointsThatAreFittedWithAllOthers) {
  Random random(14);
  const std::vector<double> constants(24, 0.0);
  ObservationSet set;
  addState(set, "M1", eightFiducials(), someTruth(random), constants, 0.4, 0.9, random);
  const auto compared = [&](const NineParameterOptions& options) {
    return compareWithOthers(set, fitNineParameters(set, options), options);
  };
  EXPECT_FALSE(compared({.state = "M1", .points = {}}).has_value()) << "there are no others";
  EXPECT_FALSE(compared({.state = "M1", .points = {"F1", "F2", "F3", "F4", "F5", "F6"}}).has_value())
      << "two points determine no plane";
  const NineParameterOptions a{.state = "M1", .points = {"F1", "F2", "F3", "F4"}};
  const NineParameterOptions b{.state = "M1", .points = {"F5", "F6", "F7", "F8"}};
  const auto others = compared(a);
  ASSERT_TRUE(others.has_value());
  EXPECT_EQ(others->difference, compareNineParameters(set, a, b).difference);
}

TEST(NineParameterModel, SaysWhichStateOrPointIsNotThere) {
  Random random(11);
  const std::vector<double> constants(24, 0.0);
  ObservationSet set;
  addState(set, "M0", eightFiducials(), NineVector::Zero(), constants, 0.4, 0.9, random);
  addState(set, "M1", eightFiducials(), NineVector::Zero(), constants, 0.4, 0.9, random);
  set.file = "observations.csv";
  const auto messageOf = [&](const NineParameterOptions& options) -> std::string {
    try {
      (void)fitNineParameters(set, options);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(messageOf({.state = "M7", .points = {}}),
            "observations.csv: state \"M7\" is not there; allowed: M0 or M1.");
  EXPECT_THAT(messageOf({.state = "M1", .points = {"F1", "F99"}}),
              HasSubstr("point \"F99\" was not measured in state M1"));
}

TEST(NineParameterModel, AReversalErrorThatCountsAsAChangeIsSaid) {
  // Cold from one side, warm from the other but for F3, with a backlash of 12 um.
  Random random(13);
  ObservationSet set;
  addState(set, "M0", eightFiducials(), NineVector::Zero(), std::vector<double>(24, 6.0), 0.3, 0.8, random);
  addState(set, "M1", eightFiducials(), NineVector::Zero(), std::vector<double>(24, 6.0), 0.3, 0.8, random);
  for (Observation& o : set.rows) {
    const bool other = o.state == "M1" && o.point != "F3";
    o.approach = Eigen::Vector3d::Constant(other ? -1.0 : 1.0);
    if (other) o.value -= 12.0;
  }
  const StateDifferences change = differencesFromReference(set, "M1");
  EXPECT_EQ(change.rows.size(), 24U);
  ASSERT_EQ(change.warnings.size(), 1U);
  EXPECT_THAT(change.warnings[0],
              HasSubstr("Compared with readings of M0 that were approached from another side: 21 of 24 values."));
  // From both sides each has its own; where nobody stated a side, readings are compared as they are.
  const ObservationSet once = set;
  for (Observation o : once.rows) {
    if (o.state != "M0") continue;
    o.approach.setConstant(-1.0);
    o.value -= 12.0;
    set.rows.push_back(o);
  }
  const StateDifferences both = differencesFromReference(set, "M1");
  EXPECT_TRUE(both.warnings.empty());
  EXPECT_LT(both.value_um.cwiseAbs().maxCoeff(), 5.0);
  for (Observation& o : set.rows)
    if (o.state == "M1") o.approach.setZero();
  EXPECT_TRUE(differencesFromReference(set, "M1").warnings.empty());
}

TEST(NineParameterModel, APointWithoutReferenceIsLeftOutAndNamed) {
  Random random(12);
  const std::vector<double> constants(24, 0.0);
  ObservationSet set;
  addState(set, "M0", eightFiducials(), NineVector::Zero(), constants, 0.4, 0.9, random);
  addState(set, "M1", eightFiducials(), NineVector::Zero(), constants, 0.4, 0.9, random);
  std::erase_if(set.rows, [](const Observation& o) { return o.state == "M0" && o.point == "F3"; });
  const NineParameterFit fit = fitNineParameters(set);
  EXPECT_EQ(fit.residuals.size(), 21u);
  ASSERT_EQ(fit.warnings.size(), 1u);
  EXPECT_THAT(fit.warnings[0], HasSubstr("EX of F3, EY of F3 and EZ of F3"));
}

}  // namespace
}  // namespace spindrift
