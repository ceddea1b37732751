// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/thermal/measurement_update.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/thermal/thermal_model.h"

namespace spindrift {
namespace {

struct Record {
  std::vector<double> time;
  std::vector<double> truth;
  std::vector<double> simulated;
};

/// A model of the right shape whose gain is wrong and which lacks a slow drift.
Record updateRecord(std::uint64_t seed, double true_gain) {
  Random random(seed);
  Record r;
  std::vector<double> u;
  std::vector<double> w;
  double level = 0.0;
  double drift = 0.0;
  for (int k = 0; k < 2880; ++k) {
    r.time.push_back(30.0 * k);
    if (k % 240 == 0) level = k % 480 == 0 ? 0.0 : random.uniform(0.5, 2.0);
    u.push_back(level);
    drift = 0.998 * drift + random.normal(0.0, 0.06);
    w.push_back(drift);
  }
  r.simulated = lagFiltered(r.time, u, 3000.0, true);
  for (std::size_t k = 0; k < u.size(); ++k) {
    r.simulated[k] *= -20.0;
    r.truth.push_back(true_gain * r.simulated[k] + w[k] + random.normal(0.0, 0.3));
  }
  return r;
}

TEST(MeasurementUpdate, KalmanBeatsTheGainRatioAndNoUpdate) {
  double none = 0.0;
  double gain = 0.0;
  double kalman = 0.0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Record r = updateRecord(seed, 0.6);
    UpdateOptions options;
    options.offset_sigma = 1.5;
    options.kind = UpdateKind::Kalman;
    const auto k = sweepIntervals(r.time, r.truth, r.simulated, options, {3600.0});
    options.kind = UpdateKind::Gain;
    const auto g = sweepIntervals(r.time, r.truth, r.simulated, options, {3600.0});
    none += k[0].rms;
    kalman += k[1].rms;
    gain += g[1].rms;
  }
  EXPECT_LT(kalman, 0.4 * none);
  EXPECT_LT(kalman, 0.6 * gain);
}

TEST(MeasurementUpdate, TheRatioExplodesNearZeroAndABoundHelps) {
  const std::vector<double> time = {0.0, 100.0, 200.0, 300.0};
  const std::vector<double> measured = {0.0, 2.0, 2.0, 10.0};
  const std::vector<double> simulated = {0.0, 0.001, 0.002, 8.0};
  UpdateOptions options;
  options.kind = UpdateKind::Gain;
  options.interval_s = 100.0;
  EXPECT_NEAR(runWithUpdates(time, measured, simulated, options).predicted[3], 8000.0, 1e-6);
  options.gain_bound = 3.0;
  EXPECT_NEAR(runWithUpdates(time, measured, simulated, options).predicted[3], 24.0, 1e-9);
  options.smallest_simulated = 1.0;
  EXPECT_NEAR(runWithUpdates(time, measured, simulated, options).predicted[3], 8.0, 1e-9);
}

TEST(MeasurementUpdate, KalmanUncertaintyHoldsAsOftenAsStated) {
  int inside = 0;
  int total = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Random random(500 + seed);
    UpdateOptions options;
    options.offset_sigma = 2.0;
    options.offset_tau_s = 5000.0;
    options.gain_sigma = 0.2;
    options.gain_drift_per_sqrt_h = 0.0;
    options.measurement_sigma = 0.3;
    options.interval_s = 1800.0;
    const double gain = random.normal(1.0, 0.2);
    double offset = random.normal(0.0, 2.0);
    std::vector<double> time;
    std::vector<double> truth;
    std::vector<double> measured;
    std::vector<double> simulated;
    const double keep = std::exp(-60.0 / 5000.0);
    for (int k = 0; k < 400; ++k) {
      time.push_back(60.0 * k);
      simulated.push_back(10.0 * std::sin(k / 60.0));
      truth.push_back(gain * simulated.back() + offset);
      measured.push_back(truth.back() + random.normal(0.0, 0.3));
      offset = keep * offset + random.normal(0.0, 2.0 * std::sqrt(1.0 - keep * keep));
    }
    const UpdateRun r = runWithUpdates(time, measured, simulated, options);
    for (std::size_t k = 50; k < time.size(); k += 37) {
      inside += std::abs(r.predicted[k] - truth[k]) < 1.96 * r.sigma[k];
      ++total;
    }
  }
  EXPECT_NEAR(static_cast<double>(inside) / total, 0.95, 0.03);
}

/// The gain is 1 - 0.5 c with c = -1 or 1 in turns; the filter that knows c predicts through a change.
TEST(MeasurementUpdate, AGainThatDependsOnAKnownSignalIsLearnedOnce) {
  Random random(11);
  Record r;
  UpdateOptions options;
  options.interval_s = 7200.0;
  options.offset_sigma = 0.5;
  std::vector<double> c;
  for (int k = 0; k < 2000; ++k) {
    r.time.push_back(60.0 * k);
    r.simulated.push_back(20.0 + 10.0 * std::sin(k / 90.0));
    c.push_back((k / 170) % 2 == 0 ? -1.0 : 1.0);
    r.truth.push_back((1.0 - 0.5 * c.back()) * r.simulated.back() + random.normal(0.0, 0.3));
  }
  const auto late = [&r](const UpdateRun& run) {
    double sum = 0.0;
    for (std::size_t k = 1000; k < r.time.size(); ++k) sum += std::pow(run.predicted[k] - r.truth[k], 2);
    return std::sqrt(sum / 1000.0);
  };
  const double blind = late(runWithUpdates(r.time, r.truth, r.simulated, options));
  options.context = {c};
  const UpdateRun run = runWithUpdates(r.time, r.truth, r.simulated, options);
  EXPECT_GT(blind, 5.0);
  EXPECT_LT(late(run), 1.5);
}

/// A drifting gain with one wild measurement, or with a jump that stays.
TEST(MeasurementUpdate, OneWildMeasurementIsRefusedAndAJumpThatStaysIsBelieved) {
  const Record r = updateRecord(5, 0.8);
  UpdateOptions options;
  options.interval_s = 3600.0;
  const UpdateRun quiet = runWithUpdates(r.time, r.truth, r.simulated, options);
  for (const UpdateEvent& e : quiet.events) EXPECT_TRUE(e.used) << e.time_s;
  const std::size_t third = quiet.events.size() / 3;
  const double at_s = quiet.events[third].time_s;
  Record wild = r;
  Record jump = r;
  for (std::size_t k = 0; k < r.time.size(); ++k) {
    if (r.time[k] == at_s) wild.truth[k] += 500.0;
    if (r.time[k] >= at_s) jump.truth[k] += 200.0;
  }
  const UpdateRun one = runWithUpdates(wild.time, wild.truth, wild.simulated, options);
  ASSERT_EQ(one.events.size(), quiet.events.size());
  for (std::size_t e = 0; e < one.events.size(); ++e) EXPECT_EQ(one.events[e].used, e != third) << e;
  // What it was off is not in the model: the next prediction is as uncertain as without this measurement.
  EXPECT_NEAR(one.events[third + 1].predicted_before, quiet.events[third + 1].predicted_before,
              5.0 * options.offset_sigma);
  const UpdateRun stays = runWithUpdates(jump.time, jump.truth, jump.simulated, options);
  EXPECT_FALSE(stays.events[third].used);
  for (std::size_t e = third + 1; e < stays.events.size(); ++e) EXPECT_TRUE(stays.events[e].used) << e;
  EXPECT_NEAR(stays.events[third + 1].offset, 200.0, 10.0);
}

TEST(MeasurementUpdate, WildMeasurementsOnBothSidesAreNeverBelieved) {
  UpdateOptions options;
  GainOffsetFilter filter(options);
  ASSERT_TRUE(filter.measure(1.0, 1.0));
  for (int k = 0; k < 4; ++k) {
    filter.advance(600.0);
    EXPECT_FALSE(filter.measure(k % 2 == 0 ? 1e6 : -1e6, 1.0)) << k;
  }
  EXPECT_NEAR(filter.value(1.0), 1.0, 1.0);
  filter.advance(600.0);
  EXPECT_TRUE(filter.measure(2.0, 1.0));
}

TEST(MeasurementUpdate, NothingIsPredictedWithItsOwnMeasurement) {
  Record r = updateRecord(3, 0.7);
  for (const UpdateKind kind : {UpdateKind::Gain, UpdateKind::Arx, UpdateKind::Kalman}) {
    UpdateOptions options;
    options.kind = kind;
    const auto before = runWithUpdates(r.time, r.truth, r.simulated, options);
    auto changed = r.truth;
    for (std::size_t k = 1000; k < changed.size(); ++k) changed[k] += 50.0;
    const auto after = runWithUpdates(r.time, changed, r.simulated, options);
    for (std::size_t k = 0; k <= 1000; ++k) EXPECT_EQ(before.predicted[k], after.predicted[k]);
  }
}

TEST(MeasurementUpdate, RefusesAnIntervalOfZero) {
  UpdateOptions options;
  options.interval_s = 0.0;
  EXPECT_THROW(options.validate(), InputError);
}

}  // namespace
}  // namespace spindrift
