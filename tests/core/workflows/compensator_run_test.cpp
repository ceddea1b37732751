// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/workflows/compensator_run.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/base/error.h"

namespace spindrift {
namespace {

/// Without a lag to speak of: 2 um per K about 20 degC.
ThermalModel quickModel() {
  ThermalModel m;
  m.inputs = {{"T_1_degC", SignalKind::Temperature, 1.0, 1.0, 20.0, 15.0, 35.0}};
  ThermalOutput o;
  o.name = "ez_um";
  o.unit = "um";
  o.terms = {{0, 1.0, 2.0}};
  m.outputs = {o};
  return m;
}

/// Temperature steps by 4 K after half the time; the machine follows with 2 um per K, read 100 um too high.
TimeSeries stepLog(bool measured) {
  TimeSeries series;
  Signal temperature, error;
  temperature.name = "T_1_degC";
  error.name = "ez_um";
  for (int i = 0; i <= 200; ++i) {
    series.time_s.push_back(60.0 * i);
    temperature.values.push_back(i < 100 ? 20.0 : 24.0);
    error.values.push_back(i % 7 == 3 ? std::nan("") : 100.0 + (i < 100 ? 0.0 : 8.0));
  }
  series.signals = {temperature};
  if (measured) series.signals.push_back(error);
  return series;
}

TEST(CompensatorRun, IsJudgedInTheTestRangeAboutTheMean) {
  const CompensatorRun run = runCompensator(stepLog(true), quickModel(), {3000.0, 9000.0}, {});
  EXPECT_EQ(run.output, "ez_um");
  // A step of 8 um in the middle of the range: 4 um rms about its mean. The compensator takes it out.
  EXPECT_NEAR(run.before_rms, 4.0, 0.1);
  EXPECT_LT(run.after_rms, 0.6);
  EXPECT_TRUE(std::isnan(run.measured[3]));
  EXPECT_NEAR(run.measured[0], -4.0, 0.1);
  EXPECT_NEAR(run.left[0], 0.0, 0.2);
}

TEST(CompensatorRun, WithoutValuesInTheRangeNothingIsJudged) {
  EXPECT_TRUE(std::isnan(runCompensator(stepLog(true), quickModel(), {1e6, 2e6}, {}).before_rms));
}

TEST(CompensatorRun, ALogWithoutTheOutputIsSaid) {
  EXPECT_THROW((void)runCompensator(stepLog(false), quickModel(), {0.0, 1000.0}, {}), InputError);
}

TEST(CompensatorRun, TheRangeIsTheOneChosenOrTheSecondHalf) {
  const TimeSeries series = stepLog(true);
  EXPECT_EQ(judgedRange(TimeRange{600.0, 1200.0}, series).to_s, 1200.0);
  EXPECT_EQ(judgedRange({}, series).from_s, 6000.0);
  EXPECT_EQ(judgedRange({}, series).to_s, 12000.0);
}

}  // namespace
}  // namespace spindrift
