// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/thermal/output_error.h"

#include <gtest/gtest.h>

#include <cmath>

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
Plant plant(std::uint64_t seed, double rho, double sigma) {
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
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Plant p = plant(1000 + seed, rho, 0.2);
    OutputErrorOptions options;
    options.noise_order = rho > 0.0 ? 2 : 0;
    options.starts = 2;
    const OutputErrorResult r = fitOutputError(p.time, p.y, {{p.u, 2, true}}, options);
    ASSERT_EQ(r.status, FitStatus::Converged) << r.message;
    inside += std::abs(r.gains[0][0] + 20.0) < 1.96 * r.gainSigma(0, 0);
    inside += std::abs(r.gains[0][1] - 5.0) < 1.96 * r.gainSigma(0, 1);
    inside += std::abs(r.taus_s[0][0] - 3600.0) < 1.96 * r.tauSigma_s(0, 0);
    inside += std::abs(r.taus_s[0][1] - 600.0) < 1.96 * r.tauSigma_s(0, 1);
    const auto [gain, sigma] = r.staticGain(0);
    inside += std::abs(gain + 15.0) < 1.96 * sigma;
    total += 5;
  }
  const double rate = static_cast<double>(inside) / total;
  EXPECT_GT(rate, 0.91);
  EXPECT_LT(rate, 0.985);
}

TEST(OutputError, IntervalsHoldForWhiteNoise) {
  expectCoverage(0.0);
}

TEST(OutputError, IntervalsHoldForColouredNoise) {
  expectCoverage(0.9);
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
  const Plant p = plant(5, 0.0, 0.1);
  EXPECT_EQ(chooseOutputErrorOrder(p.time, p.y, {{p.u, 1, true}}).best.na, 2);
}

TEST(OutputError, RefusesConstantAndTooShortData) {
  const Plant p = plant(6, 0.0, 0.1);
  const std::vector<double> constant(p.u.size(), 1.0);
  EXPECT_THROW(static_cast<void>(fitOutputError(p.time, p.y, {{constant, 1, true}})), InputError);
  const auto first = [](const std::vector<double>& v) { return std::span<const double>(v).first(12); };
  EXPECT_THROW(static_cast<void>(fitOutputError(first(p.time), first(p.y), {{first(p.u), 2, true}})), InputError);
}

}  // namespace
}  // namespace spindrift
