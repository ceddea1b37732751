// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/thermal/output_error.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/json_reader.h"
#include "core/base/random.h"
#include "core/math/statistics.h"

namespace spindrift {
namespace {

struct Plant {
  std::vector<double> time;
  std::vector<double> u;
  std::vector<double> y;
};

/// Gains -20 and 5 with time constants 3600 s and 600 s; noise white (rho = 0) or first-order coloured.
Plant outputErrorPlant(std::uint64_t seed, double rho, double sigma) {
  Random random(seed);
  Plant p;
  double level = 0.0;
  for (int k = 0; k < 1200; ++k) {
    p.time.push_back(30.0 * k);
    if (k % 150 == 0) level = random.uniform(0.0, 2.0);
    p.u.push_back(level);
  }
  const auto slow = lagFiltered(p.time, p.u, 3600.0, true);
  const auto fast = lagFiltered(p.time, p.u, 600.0, true);
  double v = 0.0;
  for (std::size_t k = 0; k < p.u.size(); ++k) {
    v = rho * v + random.normal(0.0, sigma * std::sqrt(1.0 - rho * rho));
    p.y.push_back(4.0 - 20.0 * slow[k] + 5.0 * fast[k] + v);
  }
  return p;
}

void expectCoverage(double rho) {
  int inside = 0;
  int total = 0;
  int step_inside = 0;
  int step_total = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Plant p = outputErrorPlant(1000 + seed, rho, 0.2);
    OutputErrorOptions options;
    options.starts = 2;
    const OutputErrorResult r = fitOutputError(p.time, p.y, {{p.u, 2, true}}, options);
    ASSERT_EQ(r.status, FitStatus::Converged) << r.message;
    const double factor = r.coverageFactor();
    const auto logarithm = [&](std::size_t lag, double truth) {
      return std::abs(std::log(r.taus_s[0][lag] / truth)) * r.taus_s[0][lag] / r.tauSigma_s(0, lag);
    };
    inside += std::abs(r.gains[0][0] + 20.0) < factor * r.gainSigma(0, 0);
    inside += std::abs(r.gains[0][1] - 5.0) < factor * r.gainSigma(0, 1);
    inside += logarithm(0, 3600.0) < factor;
    inside += logarithm(1, 600.0) < factor;
    const auto [gain, sigma] = r.staticGain(0);
    inside += std::abs(gain + 15.0) < factor * sigma;
    total += 5;
    // As the model that is written and plotted states it: gains and time constants move together.
    ThermalModel model;
    model.inputs = {{"u", SignalKind::Speed}};
    ThermalOutput output;
    for (std::size_t k = 0; k < 2; ++k) output.terms.push_back({0, r.taus_s[0][k], r.gains[0][k]});
    output.covariance = r.covariance;
    model.outputs = {output};
    const StepResponse step = model.stepResponse(0, "u", 40);
    for (const std::size_t k : {15UL, 25UL, 39UL}) {
      const double t = step.time_s[k];
      const double truth = 20.0 * std::expm1(-t / 3600.0) - 5.0 * std::expm1(-t / 600.0);
      step_inside += std::abs(step.value[k] - truth) < factor * step.sigma[k];
      ++step_total;
    }
  }
  const double rate = static_cast<double>(inside) / total;
  EXPECT_GT(rate, 0.92);
  EXPECT_LT(rate, 0.985);
  const double step_rate = static_cast<double>(step_inside) / step_total;
  EXPECT_GT(step_rate, 0.90);
  EXPECT_LT(step_rate, 0.99);
}

TEST(OutputError, IntervalsHoldForWhiteNoise) {
  expectCoverage(0.0);
}

TEST(OutputError, IntervalsHoldForColouredNoise) {
  expectCoverage(0.9);
}

TEST(OutputError, TheModelKeepsTheUncertaintyOfItsTimeConstants) {
  const Plant p = outputErrorPlant(77, 0.0, 0.2);
  const OutputErrorResult r = fitOutputError(p.time, p.y, {{p.u, 2, true}});
  ThermalModel model;
  model.inputs = {{"u_rpm", SignalKind::Speed, 1.0, 1.0, 0.0, 0.0, 2.0}};
  ThermalOutput output;
  output.name = "y_um";
  output.unit = "um";
  for (std::size_t k = 0; k < 2; ++k) output.terms.push_back({0, r.taus_s[0][k], r.gains[0][k]});
  output.covariance = r.covariance;
  model.outputs = {output};
  TimeSeries series;
  series.time_s = p.time;
  series.signals = {{"u_rpm", SignalKind::Speed, p.u}};
  // The derivative by ln tau against a difference of two predictions.
  const Eigen::MatrixXd x = model.features(series, 0);
  ASSERT_EQ(x.cols(), 5);
  ThermalModel moved = model;
  moved.outputs[0].terms[0].tau_s *= std::exp(1e-4);
  const auto before = model.predict(series, 0);
  const auto after = moved.predict(series, 0);
  double largest = 0.0;
  for (Eigen::Index k = 0; k < x.rows(); ++k)
    largest = std::max(largest, std::abs((after.value[k] - before.value[k]) / 1e-4 - x(k, 3)));
  EXPECT_LT(largest, 1e-4 * x.col(3).cwiseAbs().maxCoeff());
  // Through the file.
  const ThermalModel read = ThermalModel::parse(JsonNode::parse(model.json().dump(), "model.json"));
  ASSERT_EQ(read.outputs[0].covariance.rows(), 5);
  EXPECT_NEAR(read.predict(series, 0).sigma[900], before.sigma[900], 1e-3 * before.sigma[900]);
}

TEST(OutputError, SaysWhenTimeConstantsMayBeOne) {
  Plant p = outputErrorPlant(9, 0.0, 0.2);
  Random random(10);
  const auto one = lagFiltered(p.time, p.u, 1800.0, true);
  for (std::size_t k = 0; k < one.size(); ++k) p.y[k] = -10.0 * one[k] + random.normal(0.0, 0.5);
  const OutputErrorResult r = fitOutputError(p.time, p.y, {{p.u, 2, true}});
  EXPECT_NE(r.message, "") << r.taus_s[0][0] << " " << r.taus_s[0][1];
  EXPECT_EQ(fitOutputError(p.time, outputErrorPlant(9, 0.0, 0.2).y, {{p.u, 2, true}}).message, "");
}

TEST(OutputError, FindsTwoTimeConstantsThatOnlyWorkAsAPair) {
  // A long record whose slow part hides the fast one from a search lag by lag.
  for (const std::uint64_t seed : {6U, 80U, 94U}) {
    Random random(9000 + seed);
    std::vector<double> time;
    std::vector<double> u;
    double level = 0.0;
    for (int k = 0; k < 4000; ++k) {
      if (k % 150 == 0) level = random.uniform(0.0, 2.0);
      time.push_back(30.0 * k);
      u.push_back(level);
    }
    const auto slow = lagFiltered(time, u, 3600.0, true);
    const auto fast = lagFiltered(time, u, 600.0, true);
    std::vector<double> y;
    for (std::size_t k = 0; k < u.size(); ++k) y.push_back(4.0 - 20.0 * slow[k] + 5.0 * fast[k]);
    for (double& v : y) v += random.normal(0.0, 0.2);
    EXPECT_LT(fitOutputError(time, y, {{u, 2, true}}).rms, 0.22);
  }
}

TEST(OutputError, SlowPolesSurviveFastSampling) {
  Random random(7);
  std::vector<double> time;
  std::vector<double> u;
  for (int k = 0; k < 20000; ++k) {
    time.push_back(k);
    u.push_back((k / 4000) % 2 == 0 ? 0.0 : 3.0);
  }
  auto y = lagFiltered(time, u, 3640.0, true);
  for (double& v : y) v = -16.5 * v + random.normal(0.0, 0.5);
  const OutputErrorResult r = fitOutputError(time, y, {{u, 1, true}});
  EXPECT_NEAR(r.taus_s[0][0], 3640.0, 60.0);
  EXPECT_NEAR(r.gains[0][0], -16.5, 0.3);
}

TEST(OutputError, ChoosesTheNumberOfLagsOnUnseenData) {
  const Plant p = outputErrorPlant(5, 0.0, 0.1);
  EXPECT_EQ(chooseOutputErrorOrder(p.time, p.y, {{p.u, 1, true}}).best.na, 2);
}

TEST(OutputError, RefusesConstantAndTooShortData) {
  const Plant p = outputErrorPlant(6, 0.0, 0.1);
  const std::vector<double> constant(p.u.size(), 1.0);
  EXPECT_THROW(static_cast<void>(fitOutputError(p.time, p.y, {{constant, 1, true}})), InputError);
  const auto first = [](const std::vector<double>& v) { return std::span<const double>(v).first(12); };
  EXPECT_THROW(static_cast<void>(fitOutputError(first(p.time), first(p.y), {{first(p.u), 2, true}})), InputError);
}

/// Training begins in the middle of a cooling: what heated the machine before is known from the inputs alone.
TEST(OutputError, WhatHappenedBeforeTheOutputIsItsHistory) {
  const Plant p = outputErrorPlant(77, 0.0, 0.2);
  for (const std::size_t before : {std::size_t{0}, std::size_t{155}, std::size_t{310}}) {
    const OutputErrorResult r = fitOutputError(p.time, std::span<const double>(p.y).subspan(before), {{p.u, 2, true}});
    ASSERT_EQ(r.status, FitStatus::Converged) << r.message;
    EXPECT_LT(std::abs(r.gains[0][0] + 20.0), 4.0 * r.gainSigma(0, 0)) << before;
    EXPECT_LT(std::abs(r.taus_s[0][0] - 3600.0), 4.0 * r.tauSigma_s(0, 0)) << before;
    EXPECT_LT(r.tauSigma_s(0, 0), 400.0) << before;
    EXPECT_LT(r.rms, 0.22) << before;
  }
}

}  // namespace
}  // namespace spindrift
