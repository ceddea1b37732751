// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/thermal/baselines.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"

namespace spindrift {
namespace {

/// Speed steps of 40 min, a temperature that follows with 30 min, another that only drifts with the room.
TimeSeries plainRecord(int rows, double period_s) {
  Random random(11);
  TimeSeries s;
  std::vector<double> rpm;
  std::vector<double> bearing;
  std::vector<double> room;
  double level = 0.0;
  double heat = 0.0;
  for (int k = 0; k < rows; ++k) {
    const double t = k * period_s;
    s.time_s.push_back(t);
    if (std::fmod(t, 2400.0) < period_s) level = level > 0.0 ? 0.0 : 1000.0 * (1.0 + 4.0 * random.uniform());
    rpm.push_back(level);
    heat += period_s / 1800.0 * (level / 300.0 - heat);
    room.push_back(21.0 + std::sin(t / 9000.0));
    bearing.push_back(room.back() + heat);
  }
  s.signals = {{"spindle_rpm", SignalKind::Speed, rpm},
               {"T_1_degC", SignalKind::Temperature, bearing},
               {"T_2_degC", SignalKind::Temperature, room}};
  return s;
}

double rms(const TimeSeries& s, const PlainModel& model, double from_s) {
  double sum = 0.0;
  int n = 0;
  const Signal& y = s.at("ez_um");
  for (std::size_t r = 0; r < s.time_s.size(); ++r) {
    if (s.time_s[r] < from_s || !std::isfinite(y.values[r])) continue;
    sum += std::pow(model.prediction[r] - y.values[r], 2);
    ++n;
  }
  return std::sqrt(sum / n);
}

TEST(Baselines, FirstOrderArxRecoversASystemOfItsOwnForm) {
  TimeSeries s = plainRecord(1500, 60.0);
  std::vector<double> y{3.0};
  for (std::size_t k = 1; k < s.time_s.size(); ++k)
    y.push_back(0.97 * y[k - 1] + 0.05 * s.at("T_1_degC").values[k] + 1e-5 * s.at("spindle_rpm").values[k] - 0.8);
  s.signals.push_back({"ez_um", SignalKind::Displacement, y});
  const PlainModel model = firstOrderArx(s, "ez_um", 0.0, 45000.0);
  EXPECT_LT(rms(s, model, 45000.0), 1e-6);
  EXPECT_GT(rms(s, noModel(s, "ez_um", 0.0, 45000.0), 45000.0), 1.0);
}

TEST(Baselines, LaggedRidgeFollowsALagThatStaticRegressionCannot) {
  TimeSeries s = plainRecord(3000, 30.0);
  const std::vector<double>& bearing = s.at("T_1_degC").values;
  Random random(3);
  std::vector<double> y;
  double lag = bearing.front();
  for (const double t : bearing) {
    lag += 30.0 / 5400.0 * (t - lag);
    y.push_back(2.0 * lag - 1.0 * t + 0.02 * random.normal());
  }
  s.signals.push_back({"ez_um", SignalKind::Displacement, y});
  const double ridge = rms(s, laggedRidge(s, "ez_um", 0.0, 60000.0), 60000.0);
  const double still = rms(s, staticRegression(s, "ez_um", 0.0, 60000.0), 60000.0);
  EXPECT_LT(ridge, 0.2);
  EXPECT_LT(ridge, 0.2 * still);
}

TEST(Baselines, UseNothingMeasuredAfterTraining) {
  TimeSeries s = plainRecord(2000, 60.0);
  std::vector<double> y;
  for (const double t : s.at("T_1_degC").values) y.push_back(1.5 * t);
  s.signals.push_back({"ez_um", SignalKind::Displacement, y});
  TimeSeries changed = s;
  for (std::size_t r = 0; r < s.time_s.size(); ++r)
    if (s.time_s[r] >= 60000.0) changed.signals.back().values[r] = r % 2 == 0 ? 1e6 : std::nan("");
  for (const auto model : {noModel, staticRegression, firstOrderArx, laggedRidge}) {
    const PlainModel a = model(s, "ez_um", 0.0, 60000.0);
    const PlainModel b = model(changed, "ez_um", 0.0, 60000.0);
    ASSERT_EQ(a.prediction.size(), s.time_s.size());
    EXPECT_EQ(a.prediction, b.prediction) << a.name;
  }
}

TEST(Baselines, FallBackToTheMeanWithTooFewSamples) {
  TimeSeries s = plainRecord(2000, 60.0);
  s.signals.push_back({"ez_um", SignalKind::Displacement, std::vector<double>(2000, 4.0)});
  for (const auto model : {firstOrderArx, laggedRidge}) {
    const PlainModel m = model(s, "ez_um", 0.0, 600.0);
    for (const double v : m.prediction) EXPECT_DOUBLE_EQ(v, 4.0) << m.name;
    EXPECT_FALSE(m.note.empty()) << m.name;
  }
}

}  // namespace
}  // namespace spindrift
