// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/machine/table_polynomial.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/base/random.h"

namespace spindrift {
namespace {

using ::testing::HasSubstr;
using Field3 = std::function<double(const Eigen::Vector3d&, Component)>;  ///< um

constexpr std::array<Component, 3> table_components{Component::EX, Component::EY, Component::EZ};
constexpr double noise_um = 0.3;

NineVector truth() {
  NineVector p;
  p << -28, 25, 6, 40, 25, 50, 20, 100, -80;
  return p;
}

/// A sagging table: 6 um in the middle.
double sag(const Eigen::Vector3d& p) {
  const double u = (p.x() - 150.0) / 150.0;
  return 6.0 * (1.0 - u * u);
}

double sagging(const Eigen::Vector3d& p, Component c) {
  return nineParameterRow(p, c).dot(truth()) + (c == Component::EZ ? sag(p) : 0.0);
}

double rigid(const Eigen::Vector3d& p, Component c) {
  return nineParameterRow(p, c).dot(truth());
}

/// Twelve fiducials in two states; the first is the reference.
ObservationSet measured(const Field3& field, Random& random, int nx = 4, int ny = 3) {
  ObservationSet set;
  for (int state = 0; state < 2; ++state) {
    for (int i = 0; i < nx * ny; ++i) {
      const Eigen::Vector3d at(20.0 + 260.0 * (i % nx) / (nx - 1), 15.0 + 100.0 * (i / nx) / (ny - 1), 0.0);
      for (const Component c : table_components) {
        Observation o;
        o.time_s = 1000.0 * state;
        o.state = state == 0 ? "M0" : "M1";
        o.point = "F" + std::to_string(i + 1);
        o.position_mm = at;
        o.component = c;
        o.sigma = noise_um;
        o.value = (state == 0 ? 0.0 : field(at, c)) + random.normal(0, noise_um);
        set.rows.push_back(o);
      }
    }
  }
  return set;
}

TEST(TablePolynomial, EvidenceNamesTheComponentThatBends) {
  Random random(1);
  const TableOrderChoice choice = chooseTableOrder(fitNineParameters(measured(sagging, random)));
  ASSERT_EQ(choice.status, FitStatus::Converged);
  EXPECT_EQ(choice.orders, (TableOrders{1, 1, 2})) << choice.reason;
  EXPECT_LT(choice.probability_of_nine, 1e-6);
  EXPECT_THAT(choice.reason, HasSubstr("second order in EZ is needed"));
  EXPECT_LT(*choice.left_out_chosen_um, 0.7);
  EXPECT_GT(*choice.left_out_nine_um, 1.5);
  DeviationQuery middle;
  middle.position_mm = {150.0, 65.0, 0.0};
  const PredictedComponent p = choice.model->predict(middle, Component::EZ);
  EXPECT_NEAR(p.value, sagging(middle.position_mm, Component::EZ), 4.0 * p.sigma);
  EXPECT_LT(p.sigma, 0.5);
}

TEST(TablePolynomial, TheNineParametersStayWhereTheyAreEnough) {
  int richer = 0;
  constexpr int seeds = 60;
  for (int seed = 0; seed < seeds; ++seed) {
    Random random(100 + static_cast<std::uint64_t>(seed));
    richer += chooseTableOrder(fitNineParameters(measured(rigid, random))).richer() ? 1 : 0;
  }
  EXPECT_LE(richer, 1) << "of " << seeds;
}

TEST(TablePolynomial, StatedUncertaintyHoldsAtOtherPlaces) {
  // 95 % intervals of the chosen model, and those of the nine parameters with what they do not describe.
  int inside = 0, inside_nine = 0, inside_before = 0, all = 0;
  for (int seed = 0; seed < 60; ++seed) {
    Random random(200 + static_cast<std::uint64_t>(seed));
    const NineParameterFit fit = fitNineParameters(measured(sagging, random));
    EXPECT_TRUE(fit.rejected());
    const TableOrderChoice choice = chooseTableOrder(fit);
    ASSERT_TRUE(choice.richer());
    const NineParameterModel nine = fit.predictingModel();
    const NineParameterModel before = fit.model();
    for (int n = 0; n < 20; ++n) {
      DeviationQuery q;
      q.position_mm = {random.uniform(20.0, 280.0), random.uniform(15.0, 115.0), 0.0};
      const double value = sagging(q.position_mm, Component::EZ);
      const auto holds = [&](const ErrorModel& model) {
        const PredictedComponent p = model.predict(q, Component::EZ);
        return std::abs(p.value - value) < 1.96 * p.sigma ? 1 : 0;
      };
      inside += holds(*choice.model);
      inside_nine += holds(nine);
      inside_before += holds(before);
      ++all;
    }
  }
  EXPECT_GT(inside, 0.92 * all);
  EXPECT_GT(inside_nine, 0.92 * all);
  EXPECT_LT(inside_before, 0.4 * all) << "without the lack of fit the uncertainty is a fiction";
}

TEST(TablePolynomial, LackOfFitIsThatOfTheComponentThatHasIt) {
  Random random(5);
  const NineParameterFit bent = fitNineParameters(measured(sagging, random));
  EXPECT_GT(bent.lack_of_fit_um.z(), 1.0);
  EXPECT_LT(bent.lack_of_fit_um.head<2>().maxCoeff(), 0.5);
  const NineParameterFit good = fitNineParameters(measured(rigid, random));
  EXPECT_TRUE(good.lack_of_fit_um.isZero()) << good.lack_of_fit_um.transpose();
  EXPECT_FALSE(good.rejected());
}

TEST(TablePolynomial, ADisturbedPointIsNoHigherOrder) {
  Random random(6);
  ObservationSet set = measured(rigid, random, 4, 4);
  for (Observation& o : set.rows)
    if (o.point == "F6" && o.state == "M1" && o.component == Component::EZ) o.value += 8.0;
  const NineParameterFit fit = fitNineParameters(set);
  EXPECT_TRUE(fit.rejected());
  const TableOrderChoice choice = chooseTableOrder(fit);
  EXPECT_FALSE(choice.richer()) << choice.reason;
}

TEST(TablePolynomial, ManyPointsCostNoMoreThanAHundred) {
  Random random(9);
  const NineParameterFit fit = fitNineParameters(measured(sagging, random, 25, 12));
  const TableOrderChoice choice = chooseTableOrder(fit);
  EXPECT_EQ(choice.orders, (TableOrders{1, 1, 2})) << choice.reason;
  EXPECT_EQ(predictLeftOut(fit, choice.orders).rows.size(), 3U * 100U);
}

TEST(TablePolynomial, FewPointsAskForNothing) {
  Random random(7);
  const TableOrderChoice choice = chooseTableOrder(fitNineParameters(measured(sagging, random, 2, 2)));
  EXPECT_FALSE(choice.richer());
  EXPECT_THAT(choice.reason, HasSubstr("too few points"));
  ObservationSet line = measured(rigid, random, 2, 2);
  std::erase_if(line.rows, [](const Observation& o) { return o.point == "F3" || o.point == "F4"; });
  EXPECT_EQ(chooseTableOrder(fitNineParameters(line)).status, FitStatus::Degenerate);
}

TEST(TablePolynomial, BasisIsThatOfTheHeader) {
  const TableBasis basis({1, 2, 3}, {100.0, 50.0}, 100.0);
  EXPECT_EQ(basis.size(), 9 + 3 + 7);
  const Eigen::VectorXd row = basis.row({150.0, 70.0, 0.0}, Component::EZ);
  EXPECT_EQ(row.head<9>(), nineParameterRow({150.0, 70.0, 0.0}, Component::EZ));
  EXPECT_TRUE(row.segment<3>(9).isZero());
  EXPECT_NEAR(row(12), 0.25, 1e-12);        // u^2
  EXPECT_NEAR(row(13), 0.1, 1e-12);         // u w
  EXPECT_NEAR(row(14), 0.04, 1e-12);        // w^2
  EXPECT_NEAR(row(16), 0.25 * 0.2, 1e-12);  // u^2 w
  EXPECT_EQ(basis.names()[9], "EY_x2_um");
  EXPECT_EQ(basis.names()[16], "EZ_x2y_um");
  EXPECT_EQ(orderText({1, 2, 3}), "second order in EY, third order in EZ");
}

}  // namespace
}  // namespace spindrift
