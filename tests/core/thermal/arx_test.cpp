// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/thermal/arx.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "core/base/random.h"
#include "core/math/statistics.h"
#include "core/thermal/output_error.h"
#include "tests/support/step_response_sigma.h"

namespace spindrift {
namespace {

using ::testing::HasSubstr;

std::vector<double> randomSteps(Random& random, std::size_t n) {
  std::vector<double> u(n);
  double level = 0.0;
  for (double& v : u) {
    if (random.uniform() < 0.05) level = random.normal();
    v = level;
  }
  return u;
}

/// y(k) = 1.4 y(k-1) - 0.45 y(k-2) + 0.3 u(k-1) - 0.1 u(k-2) + e: poles 0.9 and 0.5, gain 0.2 / 0.05.
std::vector<double> secondOrder(const std::vector<double>& u, Random& random, double equation_noise) {
  std::vector<double> y(u.size(), 0.0);
  for (std::size_t k = 2; k < u.size(); ++k)
    y[k] = 1.4 * y[k - 1] - 0.45 * y[k - 2] + 0.3 * u[k - 1] - 0.1 * u[k - 2] + random.normal(0.0, equation_noise);
  return y;
}

TEST(Arx, RecoversAKnownSystemWithinItsIntervalsAsOftenAsStated) {
  const Eigen::VectorXd truth = (Eigen::VectorXd(4) << -1.4, 0.45, 0.3, -0.1).finished();
  int inside = 0;
  int gain_inside = 0;
  int tau_inside = 0;
  const int runs = 300;
  for (int run = 0; run < runs; ++run) {
    Random random(100 + static_cast<std::uint64_t>(run));
    const auto u = randomSteps(random, 800);
    const auto y = secondOrder(u, random, 0.05);
    const ArxModel m = fitArx(y, {u}, {2, {2}, {1}}, 10.0);
    ASSERT_EQ(m.status, FitStatus::Converged);
    const Eigen::VectorXd estimate = (Eigen::VectorXd(4) << m.a[0], m.a[1], m.b[0][0], m.b[0][1]).finished();
    for (int i = 0; i < 4; ++i) inside += std::abs(estimate[i] - truth[i]) < 1.96 * std::sqrt(m.covariance(i, i));
    const auto [gain, sigma] = m.staticGain(0);
    gain_inside += std::abs(gain - 0.2 / 0.05) < 1.96 * sigma;
    const auto taus = m.timeConstants();
    if (taus.size() == 2) tau_inside += std::abs(taus[0].value_s + 10.0 / std::log(0.9)) < 1.96 * taus[0].sigma_s;
  }
  const RateInterval rate = wilsonInterval(static_cast<std::size_t>(inside), 4 * runs, 3.3);
  EXPECT_LT(rate.low, 0.95);
  EXPECT_GT(rate.high, 0.95);
  EXPECT_GT(gain_inside, runs * 0.90);
  EXPECT_GT(tau_inside, runs * 0.90);
}

TEST(Arx, TheStepResponseHoldsItsIntervalsAsOftenAsStated) {
  std::size_t inside = 0;
  std::size_t total = 0;
  ArxModel truth;
  truth.order = {2, {2}, {1}};
  truth.a = Eigen::Vector2d(-1.4, 0.45);
  truth.b = {Eigen::Vector2d(0.3, -0.1)};
  const std::vector<double> step = truth.stepResponse(0, 61);
  EXPECT_TRUE(std::isnan(stepResponseSigma(truth, 0, 3)[2]));  // no covariance, no uncertainty
  for (std::uint64_t run = 0; run < 300; ++run) {
    Random random(3000 + run);
    const auto u = randomSteps(random, 800);
    const ArxModel m = fitArx(secondOrder(u, random, 0.05), {u}, truth.order, 10.0);
    const std::vector<double> estimate = m.stepResponse(0, 61);
    const std::vector<double> sigma = stepResponseSigma(m, 0, 61);
    EXPECT_EQ(sigma[0], 0.0);  // nothing moves before the delay
    for (const std::size_t k : {1UL, 8UL, 60UL}) {
      inside += std::abs(estimate[k] - step[k]) < 1.96 * sigma[k];
      ++total;
    }
  }
  const RateInterval rate = wilsonInterval(inside, total, 3.3);
  EXPECT_LT(rate.low, 0.95);
  EXPECT_GT(rate.high, 0.95);
}

TEST(Arx, EqualsAQrOfTheFullRegressionForSlowPolesSampledFast) {
  Random random(3);
  std::vector<std::vector<double>> inputs;
  for (int i = 0; i < 3; ++i) inputs.push_back(randomSteps(random, 6000));
  std::vector<double> y(6000, 0.0);
  for (std::size_t k = 2; k < y.size(); ++k)
    y[k] = 1.9982 * y[k - 1] - 0.99820036 * y[k - 2] +
           1e-4 * (inputs[0][k] + 0.5 * inputs[1][k - 1] - inputs[2][k - 1]) + random.normal(0.0, 1e-3);
  const ArxModel m = fitArx(y, {inputs[0], inputs[1], inputs[2]}, {2, {2, 2, 2}, {0, 0, 0}}, 1.0);
  Eigen::MatrixXd Phi(5998, 8);
  Eigen::VectorXd b(5998);
  for (Eigen::Index k = 0; k < 5998; ++k) {
    const auto t = static_cast<std::size_t>(k) + 2;
    Phi.row(k) << -y[t - 1], -y[t - 2], inputs[0][t], inputs[0][t - 1], inputs[1][t], inputs[1][t - 1], inputs[2][t],
        inputs[2][t - 1];
    b[k] = y[t];
  }
  const Eigen::VectorXd exact = Phi.householderQr().solve(b);
  EXPECT_NEAR(m.a[0], exact[0], 1e-8);
  EXPECT_NEAR(m.a[1], exact[1], 1e-8);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 2; ++j) EXPECT_NEAR(m.b[i][j], exact[2 + 2 * i + j], 1e-8);
}

TEST(Arx, BiasedByOutputNoiseWhereOutputErrorIsNot) {
  // Output noise is not the noise ARX assumes: its pole moves towards fast, the gain with it.
  Random random(8);
  std::vector<double> time(3000);
  for (std::size_t k = 0; k < time.size(); ++k) time[k] = 10.0 * static_cast<double>(k);
  double arx_tau = 0.0;
  double oe_tau = 0.0;
  const int runs = 5;
  for (int run = 0; run < runs; ++run) {
    const auto u = randomSteps(random, time.size());
    auto y = lagFiltered(time, u, 600.0, true);
    for (double& v : y) v = 3.0 * v + random.normal(0.0, 0.2);
    const ArxModel m = fitArx(y, {u}, {1, {1}, {1}}, 10.0);
    arx_tau += m.timeConstants().at(0).value_s / runs;
    OutputErrorInput input{u, 1, true};
    oe_tau += fitOutputError(time, y, {input}).taus_s[0][0] / runs;
  }
  EXPECT_LT(arx_tau, 500.0);
  EXPECT_NEAR(oe_tau, 600.0, 25.0);
}

TEST(Arx, SaysWhatIsWrongWithBadInput) {
  Random random(5);
  const auto u = randomSteps(random, 500);
  const auto y = secondOrder(u, random, 0.05);
  const std::vector<double> constant(500, 1.0);
  const auto refusal = [&](const std::vector<double>& output, const std::vector<std::vector<double>>& inputs,
                           int order) {
    try {
      std::vector<std::span<const double>> spans(inputs.begin(), inputs.end());
      static_cast<void>(fitArx(
          output, spans, {order, std::vector<int>(inputs.size(), order), std::vector<int>(inputs.size(), 1)}, 1.0));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_THAT(refusal(y, {constant}, 2), HasSubstr("input 1 is constant"));
  EXPECT_THAT(refusal(y, {u, y}, 2), HasSubstr("copy of the output"));
  EXPECT_THAT(refusal(y, {u, u}, 2), HasSubstr("identical"));
  EXPECT_THAT(refusal(constant, {u}, 2), HasSubstr("output is constant"));
  EXPECT_THAT(refusal({y.begin(), y.begin() + 50}, {{u.begin(), u.begin() + 50}}, 10),
              HasSubstr("50 samples are too few"));
  auto gap = y;
  gap[100] = std::nan("");
  EXPECT_THAT(refusal(gap, {u}, 2), HasSubstr("missing values"));
}

TEST(Arx, AnUnstableFitIsNamedAndCanBeMadeStable) {
  Random random(6);
  const auto u = randomSteps(random, 300);
  std::vector<double> y(300, 0.0);
  for (std::size_t k = 1; k < y.size(); ++k) y[k] = 1.02 * y[k - 1] + 0.1 * u[k - 1] + random.normal(0.0, 0.01);
  const ArxModel m = fitArx(y, {u}, {1, {1}, {1}}, 1.0);
  EXPECT_FALSE(m.stable());
  EXPECT_THAT(m.message, HasSubstr("unstable"));
  const ArxModel s = stabilised(m, 0.999);
  EXPECT_TRUE(s.stable());
  EXPECT_THAT(s.message, HasSubstr("drawn to"));
}

/// A transfer function given by printed digits (P2, Table 2): 1 - 1.998 z^-1 + ... is near enough to a double
/// integrator that the last digits decide its gain, while its time constants stand.
TEST(Arx, TheDigitsOfP2DoNotDetermineItsGain) {
  const auto printed = [](double a1, double a2) {
    ArxModel model;
    model.order = {2, {3}, {0}};
    model.period_s = 1.0;
    model.a = Eigen::Vector2d(a1, a2);
    model.b = {Eigen::Vector3d(-0.0130427, 0.0130361, 0.0)};
    return model;
  };
  const ArxModel p2 = printed(-1.9982716, 0.9982720);
  EXPECT_NEAR(p2.staticGain(0).first, -16.5, 0.01);
  const auto tau = p2.timeConstants();
  ASSERT_EQ(tau.size(), 2U);
  EXPECT_NEAR(tau[0].value_s, 3640.0, 40.0);
  EXPECT_NEAR(tau[1].value_s, 690.0, 8.0);
  EXPECT_NEAR(p2.stepResponse(0, 30001).back(), -16.5, 0.1);
  // All of this rounds to the same digits (1e-6): gains more than twice as large, and no stable system at all.
  EXPECT_GT(std::abs(printed(-1.9982716 - 0.12e-6, 0.9982720 - 0.12e-6).staticGain(0).first), 2.0 * 16.5);
  EXPECT_FALSE(printed(-1.9982716 - 0.5e-6, 0.9982720 - 0.5e-6).stable());
}

TEST(Arx, HasAnEquivalentInLags) {
  Random random(9);
  const auto u = randomSteps(random, 2000);
  const auto y = secondOrder(u, random, 1e-4);
  const ArxModel m = fitArx(y, {u}, {2, {2}, {1}}, 10.0);
  std::string message;
  const auto terms = lagsOf(m, {true}, message);
  ASSERT_EQ(terms.size(), 3U) << message;
  double gain = 0.0;
  for (const LagTerm& t : terms) gain += t.gain;
  EXPECT_NEAR(gain, 0.2 / 0.05, 0.02);
  EXPECT_NEAR(terms[0].tau_s, -10.0 / std::log(0.9), 0.5);
}

/// What is shipped as lags runs as the equation does, of what holds until the next sample and of what goes straight on.
TEST(Arx, RunsAsItsLagsDo) {
  Random random(21);
  std::vector<double> u = randomSteps(random, 400);
  u.front() = 0.7;
  std::vector<double> time_s;
  for (std::size_t k = 0; k < u.size(); ++k) time_s.push_back(10.0 * static_cast<double>(k));
  ArxModel m;
  m.status = FitStatus::Converged;
  m.period_s = 10.0;
  m.a = (Eigen::VectorXd(2) << -1.4, 0.45).finished();
  m.c = 0.3;
  struct Order {
    int nk;
    std::vector<double> b;
  };
  for (const auto& [nk, b] : {Order{0, {0.2}}, Order{1, {0.3, -0.1}}, Order{2, {0.2}}, Order{0, {0.1, 0.3, -0.1}}}) {
    m.order = {2, {static_cast<int>(b.size())}, {nk}};
    m.b = {Eigen::Map<const Eigen::VectorXd>(b.data(), static_cast<Eigen::Index>(b.size()))};
    const std::vector<double> run = m.simulate({u}, {});
    for (const bool hold : {true, false}) {
      std::string message;
      std::vector<double> by_lags(u.size(), m.c / (1.0 + m.a.sum()));
      const auto terms = lagsOf(m, {hold}, message);
      ASSERT_EQ(terms.size(), 3U) << message;
      for (const LagTerm& t : terms) {
        const std::vector<double> x = lagFiltered(time_s, u, t.tau_s, hold);
        for (std::size_t k = 0; k < u.size(); ++k) by_lags[k] += t.gain * x[k];
      }
      double apart = 0.0;
      for (std::size_t k = 0; k < u.size(); ++k) apart = std::max(apart, std::abs(by_lags[k] - run[k]));
      EXPECT_LT(apart, 1e-9) << nk << ' ' << b.size() << ' ' << hold;
    }
  }
  // A dead time is no lag.
  m.order = {2, {1}, {3}};
  m.b = {Eigen::VectorXd::Constant(1, 0.2)};
  std::string message;
  EXPECT_TRUE(lagsOf(m, {true}, message).empty());
  EXPECT_THAT(message, HasSubstr("dead time"));
}

TEST(Arx, AFreeRunBeginsAtRestOrAfterWhatWasMeasured) {
  Random random(22);
  std::vector<double> u = randomSteps(random, 300);
  for (std::size_t k = 0; k < 20; ++k) u[k] = 1.5;  // at rest at the beginning
  ArxModel m;
  m.order = {2, {2}, {1}};
  m.a = (Eigen::VectorXd(2) << -1.4, 0.45).finished();
  m.b = {(Eigen::VectorXd(2) << 0.3, -0.1).finished()};
  m.c = 0.5;
  const std::vector<double> run = m.simulate({u}, {});
  const double rest = (0.5 + 0.2 * 1.5) / 0.05;
  for (std::size_t k = 0; k < 20; ++k) EXPECT_NEAR(run[k], rest, 1e-9);
  // From the middle on, after its own first values: the same.
  const std::vector<std::vector<double>> later{std::vector<double>(u.begin() + 100, u.end())};
  const std::vector<double> again = m.simulate(later, std::span<const double>(run).subspan(100, 3));
  for (std::size_t k = 0; k < again.size(); ++k) EXPECT_NEAR(again[k], run[100 + k], 1e-9);
}

TEST(Arx, OrderIsChosenOnDataTheFitDidNotSee) {
  Random random(10);
  const auto u = randomSteps(random, 1500);
  const auto y = secondOrder(u, random, 0.02);
  const OrderChoice choice = chooseArxOrder(y, {u}, 1.0);
  EXPECT_GE(choice.best.na, 1);
  EXPECT_LE(choice.best.na, 3);
  EXPECT_EQ(choice.best.nk, 1);
  EXPECT_GT(choice.tried.size(), 20U);
}

}  // namespace
}  // namespace spindrift
