// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/math/smoothing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/math/statistics.h"

namespace spindrift {
namespace {

struct Readings {
  std::vector<double> time_s, truth, values;
};

/// A body that warms and cools at 40 min, read every 30 s; `resolution` 0: not rounded.
Readings body(double noise, double resolution, std::uint64_t seed) {
  Readings out;
  Random random(seed);
  double temperature = 20.0;
  for (int i = 0; i < 1440; ++i) {
    out.time_s.push_back(30.0 * i);
    out.truth.push_back(temperature);
    const double reading = temperature + random.normal(0.0, noise);
    out.values.push_back(resolution > 0.0 ? resolution * std::round(reading / resolution) : reading);
    temperature += 30.0 / 2400.0 * (20.0 + ((i / 180) % 2 == 1 ? 4.0 : 0.0) - temperature);
  }
  return out;
}

double errorOf(const Readings& r, const std::vector<double>& values) {
  double sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) sum += std::pow(values[i] - r.truth[i], 2);
  return std::sqrt(sum / static_cast<double>(values.size()));
}

TEST(Smoothing, FindsTheNoiseOfReadings) {
  for (const double noise : {0.02, 0.05, 0.2}) {
    EXPECT_NEAR(noiseOfReadings(body(noise, 0.0, 3).values), noise, 0.1 * noise);
  }
  EXPECT_NEAR(noiseOfReadings(body(0.0, 0.1, 3).values), 0.1 / std::sqrt(12.0), 1e-6);
  EXPECT_EQ(noiseOfReadings(std::vector<double>(50, 21.5)), 0.0);
  EXPECT_EQ(noiseOfReadings(std::vector<double>{1.0, 2.0, 1.0}), 0.0);
}

TEST(Smoothing, FindsTheNoiseOfRoundedReadings) {
  for (const double resolution : {0.02, 0.05, 0.1}) {
    for (const double noise : {0.01, 0.02, 0.04}) {
      double mean = 0.0;
      for (std::uint64_t seed = 1; seed <= 10; ++seed)
        mean += noiseOfReadings(body(noise, resolution, seed).values) /
                std::hypot(noise, resolution / std::sqrt(12.0)) / 10.0;
      EXPECT_NEAR(mean, 1.0, 0.3) << resolution << " " << noise;
    }
  }
}

TEST(Smoothing, TellsItsError) {
  // Also of readings that stand still for an hour before they take one step: that error is no white noise.
  for (const double resolution : {0.0, 0.02, 0.05, 0.1}) {
    for (const double noise : {0.005, 0.02, 0.04}) {
      double actual = 0.0;
      double told = 0.0;
      for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        Readings r;
        Random random(900 + seed);
        const double phase = random.uniform(0.0, 6.0);
        for (int i = 0; i < 720; ++i) {
          r.time_s.push_back(30.0 * i);
          r.truth.push_back(20.0 + 0.5 * std::sin(30.0 * i / 4000.0 + phase));
          const double reading = r.truth.back() + random.normal(0.0, noise);
          r.values.push_back(resolution > 0.0 ? resolution * std::round(reading / resolution) : reading);
        }
        const SmoothedSignal smooth = smoothWithinNoise(r.time_s, r.values, 600.0);
        actual += std::pow(errorOf(r, smooth.values), 2);
        told += std::pow(smooth.error, 2);
        EXPECT_GT(smooth.error_time_s, 0.0);
      }
      // Where readings hardly scatter, their steps lie where the signal is smooth: less is wrong than is told.
      EXPECT_LT(std::sqrt(actual / told), 1.3) << resolution << " " << noise;
      EXPECT_GT(std::sqrt(actual / told), noise > 0.1 * resolution ? 0.7 : 0.4) << resolution << " " << noise;
    }
  }
}

TEST(Smoothing, TakesMostOfTheNoiseAndLittleOfTheSignal) {
  double worst = 0.0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Readings r = body(0.05, 0.0, seed);
    const SmoothedSignal smooth = smoothWithinNoise(r.time_s, r.values, 600.0);
    EXPECT_GT(smooth.bandwidth_s, 100.0);
    worst = std::max(worst, errorOf(r, smooth.values));
  }
  EXPECT_LT(worst, 0.55 * 0.05);
  const Readings rounded = body(0.03, 0.1, 1);
  EXPECT_LT(errorOf(rounded, smoothWithinNoise(rounded.time_s, rounded.values, 600.0).values),
            0.5 * errorOf(rounded, rounded.values));
}

TEST(Smoothing, LeavesTheErrorOfItsKernelOnASlowSignal) {
  double square = 0.0;
  constexpr int trials = 20;
  for (std::uint64_t seed = 1; seed <= trials; ++seed) {
    Readings r;
    Random random(40 + seed);
    for (int i = 0; i < 1440; ++i) {
      r.time_s.push_back(30.0 * i);
      r.truth.push_back(20.0 + std::sin(r.time_s.back() / 20000.0));
      r.values.push_back(r.truth.back() + random.normal(0.0, 0.05));
    }
    const SmoothedSignal smooth = smoothWithinNoise(r.time_s, r.values, 600.0);
    const double expected = 0.05 / std::sqrt(3.8 * smooth.bandwidth_s / 30.0);
    square += std::pow(errorOf(r, smooth.values) / expected, 2) / trials;
  }
  EXPECT_NEAR(std::sqrt(square), 1.0, 0.07);
}

TEST(Smoothing, KeepsAJump) {
  Readings r = body(0.05, 0.0, 5);
  for (std::size_t i = 700; i < r.values.size(); ++i) {
    r.values[i] -= 1.5;
    r.truth[i] -= 1.5;
  }
  const SmoothedSignal smooth = smoothWithinNoise(r.time_s, r.values, 600.0);
  EXPECT_NEAR(smooth.values[704] - smooth.values[695], r.truth[704] - r.truth[695], 0.15);
  EXPECT_LT(errorOf(r, smooth.values), 0.06);
}

TEST(Smoothing, LeavesReadingsWithoutNoiseAndOddTimesAlone) {
  const Readings clean = body(0.0, 0.0, 1);
  EXPECT_LT(errorOf(clean, smoothWithinNoise(clean.time_s, clean.values, 600.0).values), 1e-4);
  Readings twice = body(0.05, 0.0, 1);
  twice.time_s[10] = twice.time_s[9];
  EXPECT_EQ(smoothWithinNoise(twice.time_s, twice.values, 600.0).values, twice.values);
  // A gap of two hours: both sides as good as without it.
  Readings gap = body(0.05, 0.0, 2);
  gap.time_s.erase(gap.time_s.begin() + 500, gap.time_s.begin() + 740);
  gap.values.erase(gap.values.begin() + 500, gap.values.begin() + 740);
  gap.truth.erase(gap.truth.begin() + 500, gap.truth.begin() + 740);
  EXPECT_LT(errorOf(gap, smoothWithinNoise(gap.time_s, gap.values, 600.0).values), 0.4 * 0.05);
}

}  // namespace
}  // namespace spindrift
