// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of a log against the period of a model and the cycle of a control: what lies between them acts as it did.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/thermal/thermal_model.h"
#include "core/workflows/thermal_tracking.h"
#include "core/workflows/thermal_workflow.h"

namespace spindrift {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double tau_s = 1800.0;
constexpr double gain = 10.0;

/// A spindle of levels that change at any time, and what it makes of a lag of half an hour.
TimeSeries spindle(std::uint64_t seed, double row_s, double jitter_s, double hours, double noise_um) {
  Random random(seed);
  TimeSeries out;
  std::vector<double> rpm;
  std::vector<double> heat;
  double level = 0.0;
  double until_s = 0.0;
  for (double t = 0.0; t < 3600.0 * hours; t += row_s + jitter_s * random.uniform(-1.0, 1.0)) {
    if (t >= until_s) {
      level = t > 0.0 ? std::floor(random.uniform(0.0, 5.0)) * 1000.0 : 0.0;
      until_s += random.uniform(300.0, 3000.0);
    }
    out.time_s.push_back(t);
    rpm.push_back(level);
    heat.push_back(level / 4000.0);
  }
  std::vector<double> z = lagFiltered(out.time_s, heat, tau_s, true);
  for (double& v : z) v = gain * v + random.normal(0.0, noise_um);
  out.signals = {{"spindle_rpm", SignalKind::Speed, rpm}, {"z_um", SignalKind::Other, z}};
  return out;
}

IdentifyRequest request(const TimeSeries& series, const char* method, double period_s) {
  IdentifyRequest r;
  r.output = "z_um";
  r.inputs = {"spindle_rpm"};
  const double cut = 0.7 * series.time_s.back();
  r.train = {0.0, cut};
  r.test = {cut, 1e300};
  r.method = method;
  r.order = {{1, 1, 1}};
  r.period_s = period_s;
  return r;
}

TEST(ThermalRows, APeriodCoarserThanTheRowsDelaysNothing) {
  constexpr double noise_um = 0.05;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const TimeSeries series = spindle(seed, 15.0, 0.0, 24.0, noise_um);
    for (const double period_s : {0.0, 300.0}) {
      const IdentifyResult found = identifyThermalModel(series, request(series, "oe", period_s), {});
      const nlohmann::json lag = found.structure.at("lags").at(0);
      const double tau = found.model.outputs.front().terms.front().tau_s;
      EXPECT_NEAR(tau, tau_s, 0.006 * tau_s) << "seed " << seed << ", period " << period_s;
      EXPECT_LT(found.test.rmse, 1.15 * noise_um) << "seed " << seed << ", period " << period_s;
    }
    const IdentifyResult arx = identifyThermalModel(series, request(series, "arx", 300.0), {});
    EXPECT_LT(arx.test.rmse, 2.0 * noise_um) << "seed " << seed;
  }
}

TEST(ThermalRows, TrainingMayBeginWhileTheMachineIsWarm) {
  const TimeSeries series = spindle(4, 30.0, 0.0, 20.0, 0.05);
  for (const char* method : {"oe", "arx"}) {
    IdentifyRequest later = request(series, method, 0.0);
    later.train.from_s = 0.3 * series.time_s.back();
    const IdentifyResult found = identifyThermalModel(series, later, {});
    EXPECT_LT(found.train.rmse, 0.1) << method;
    EXPECT_LT(found.test.rmse, 0.1) << method;
    EXPECT_NEAR(found.predicted.front(), found.model.outputs.front().offset, 0.1)
        << method << ": at rest in the first row";
  }
}

TEST(ThermalRows, AnIrregularLogIsNoStaleInput) {
  for (const double row_s : {60.0, 120.0}) {
    const TimeSeries series = spindle(5, row_s, 0.15 * row_s, 16.0, 0.05);
    IdentifyRequest asked = request(series, "", 0.0);
    asked.order.reset();
    asked.method = "response";
    const IdentifyResult found = identifyThermalModel(series, asked, {});
    const CompensateResult replayed = compensateLog(series, found.model, {}, {});
    EXPECT_EQ(replayed.fallback, 0U) << row_s;
    EXPECT_GT(replayed.outputs.front().reduction_percent, 90.0) << row_s;
    EXPECT_THAT(replayed.warnings, Not(Contains(HasSubstr("faded"))));
    // A sensor that is silent for an hour is one, and it is said.
    TimeSeries silent = series;
    for (std::size_t r = silent.time_s.size() / 2;
         r < silent.time_s.size() && silent.time_s[r] < silent.time_s[silent.time_s.size() / 2] + 3600.0; ++r)
      silent.signals[0].values[r] = std::nan("");
    const CompensateResult with = compensateLog(silent, found.model, {}, {});
    EXPECT_GT(with.fallback * row_s, 3000.0) << row_s;
    EXPECT_THAT(with.warnings, Contains(HasSubstr("faded to zero")));
  }
}

}  // namespace
}  // namespace spindrift
