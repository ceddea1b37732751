// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/thermal/adaptive.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/thermal/thermal_model.h"

namespace spindrift {
namespace {

/// 60 h of random feed; after 30 h the heat finds another way (gain of the error changes by half).
TimeSeries campaign(std::uint64_t seed) {
  Random random(seed);
  TimeSeries s;
  std::vector<double> feed;
  std::vector<double> heat;
  double level = 0.0;
  for (int k = 0; k < 720; ++k) {
    s.time_s.push_back(300.0 * k);
    if (random.uniform() < 0.06) level = random.uniform() < 0.3 ? 0.0 : random.uniform(3000.0, 30000.0);
    feed.push_back(level);
    heat.push_back(std::pow(level / 30000.0, 1.3));
  }
  const auto screw = lagFiltered(s.time_s, heat, 4000.0, true);
  const auto nut = lagFiltered(s.time_s, heat, 1500.0, true);
  std::vector<double> y;
  std::vector<double> t1;
  std::vector<double> t2;
  for (std::size_t k = 0; k < s.time_s.size(); ++k) {
    y.push_back((k < 360 ? 60.0 : 90.0) * screw[k]);
    t1.push_back(22.0 + 10.0 * nut[k] + random.normal(0.0, 0.05));
    t2.push_back(22.0 + 6.0 * screw[k] + random.normal(0.0, 0.05));
  }
  s.signals = {{"feed_x_mm_min", SignalKind::Feed, feed},
               {"T_1_degC", SignalKind::Temperature, t1},
               {"T_2_degC", SignalKind::Temperature, t2},
               {"exx_um", SignalKind::Displacement, y}};
  return s;
}

TEST(Adaptive, StaysTrueWhereAStaticModelDoesNot) {
  const TimeSeries s = campaign(1);
  const std::vector<std::string> candidates = {"feed_x_mm_min", "T_1_degC", "T_2_degC"};
  AdaptiveOptions options;
  options.setup_s = 12.0 * 3600.0;
  const AdaptiveResult r = replayAdaptive(s, {{"exx_um", 0.3, 4.0, 2.0}}, candidates, options, {});
  EXPECT_GT(r.errors[0].adaptive_reduction_percent, 80.0);
  EXPECT_LT(r.errors[0].rms_adaptive, 0.7 * r.errors[0].rms_static);
  EXPECT_GT(r.reidentifications, 0U);
  EXPECT_LT(r.measurements, 90U);
  bool exceeded_after_change = false;
  for (const AdaptiveEvent& e : r.events)
    exceeded_after_change |= e.kind == AdaptiveEventKind::LimitExceeded && e.time_s > 108000.0;
  EXPECT_TRUE(exceeded_after_change);
}

TEST(Adaptive, SeesTheErrorsOnlyWhereItMeasures) {
  TimeSeries s = campaign(2);
  const std::vector<std::string> candidates = {"feed_x_mm_min", "T_1_degC", "T_2_degC"};
  AdaptiveOptions options;
  options.setup_s = 12.0 * 3600.0;
  const AdaptiveResult first = replayAdaptive(s, {{"exx_um", 0.3, 4.0, 2.0}}, candidates, options, {});
  // Errors that nobody measured may be anything.
  std::vector<char> measured(s.time_s.size(), 0);
  for (const AdaptiveEvent& e : first.events)
    if (e.kind == AdaptiveEventKind::Measurement)
      for (std::size_t k = 0; k < s.time_s.size(); ++k) measured[k] |= s.time_s[k] == e.time_s;
  for (std::size_t k = 0; k < s.time_s.size(); ++k)
    if (s.time_s[k] >= options.setup_s && measured[k] == 0) s.signals.back().values[k] = 1e5;
  const AdaptiveResult second = replayAdaptive(s, {{"exx_um", 0.3, 4.0, 2.0}}, candidates, options, {});
  EXPECT_EQ(first.errors[0].adaptive_prediction, second.errors[0].adaptive_prediction);
}

TEST(Adaptive, MeasuresOnlyWhereSomethingWasRecorded) {
  TimeSeries s = campaign(4);
  std::vector<double>& y = s.signals.back().values;
  for (std::size_t k = 0; k < y.size(); ++k) {
    if (k % 6 != 0) y[k] = std::nan("");
  }
  AdaptiveOptions options;
  options.setup_s = 16.0 * 3600.0;
  options.add_noise = false;
  const AdaptiveResult r =
      replayAdaptive(s, {{"exx_um", 0.3, 4.0, 2.0}}, {"feed_x_mm_min", "T_1_degC", "T_2_degC"}, options, {});
  EXPECT_EQ(r.setup_measurements, 32U);
  EXPECT_GT(r.measurements, 0U);
  for (const AdaptiveEvent& e : r.events) {
    if (e.kind != AdaptiveEventKind::Measurement) continue;
    EXPECT_EQ(std::fmod(e.time_s, 1800.0), 0.0) << e.time_s;
  }
  EXPECT_GT(r.errors[0].adaptive_reduction_percent, 75.0);
}

TEST(Adaptive, RefusesARecordShorterThanItsSetup) {
  AdaptiveOptions options;
  options.setup_s = 1e6;
  EXPECT_THROW(static_cast<void>(replayAdaptive(campaign(3), {{"exx_um", 0.3, 4.0, 2.0}}, {"T_1_degC"}, options, {})),
               InputError);
}

}  // namespace
}  // namespace spindrift
