// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/thermal/compensator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/thermal/compensator_c.h"
#include "core/thermal/thermal_model.h"
#include "tests/support/temp_folder.h"

extern "C" int compensate_one_minute(const char* model_file, double temperature_degC, double* compensation);

namespace spindrift {
namespace {

using ::testing::HasSubstr;

ThermalModel model() {
  ThermalModel m;
  m.inputs = {{"spindle_rpm", SignalKind::Speed, 1.5, 4000.0, 0.2, 0.0, 4000.0},
              {"T_1_degC", SignalKind::Temperature, 1.0, 1.0, 22.0, 20.0, 30.0}};
  ThermalOutput o;
  o.name = "ez_um";
  o.unit = "um";
  o.offset = 1.0;
  o.terms = {{0, 600.0, 10.0}, {1, 2000.0, -4.0}, {1, 0.0, 0.5}};
  m.outputs = {o};
  return m;
}

TEST(Compensator, EqualsMinusTheModelsPrediction) {
  TimeSeries s;
  std::vector<double> rpm;
  std::vector<double> t;
  for (int k = 0; k < 4000; ++k) {
    s.time_s.push_back(k);
    rpm.push_back(k < 1000 ? 0.0 : 3000.0);
    t.push_back(22.0 + 2.0 * std::sin(k / 700.0));
  }
  s.signals = {{"spindle_rpm", SignalKind::Speed, rpm}, {"T_1_degC", SignalKind::Temperature, t}};
  const ThermalPrediction expected = model().predict(s, 0);
  Compensator c;
  CompensatorLimits limits;
  limits.slew_per_s = 1e6;
  ASSERT_EQ(c.load(model(), 1.0, limits), "");
  ASSERT_STREQ(c.inputName(0), "spindle_rpm");
  for (int k = 0; k < 4000; ++k) {
    const double u[2] = {rpm[k], t[k]};
    double out = 0.0;
    EXPECT_EQ(c.step(u, nullptr, &out), CompensatorState::Running);
    EXPECT_NEAR(out, -expected.value[k], 1e-9);
  }
}

TEST(Compensator, BoundsOutputAndSlew) {
  Compensator c;
  CompensatorLimits limits;
  limits.limit = 3.0;
  limits.slew_per_s = 0.5;
  ASSERT_EQ(c.load(model(), 0.1, limits), "");
  double last = 0.0;
  double out = 0.0;
  for (int k = 0; k < 100000; ++k) {
    const double u[2] = {4000.0, 22.0};
    c.step(u, nullptr, &out);
    EXPECT_LE(std::abs(out - last), 0.05 + 1e-12);
    EXPECT_LE(std::abs(out), 3.0);
    last = out;
  }
  EXPECT_DOUBLE_EQ(out, -3.0);
}

TEST(Compensator, FallsBackSafelyAndComesBack) {
  Compensator c;
  CompensatorLimits limits;
  limits.slew_per_s = 0.5;
  limits.stale_after_s = 30.0;
  limits.recover_after_s = 20.0;
  ASSERT_EQ(c.load(model(), 1.0, limits), "");
  double out = 0.0;
  const double good[2] = {3000.0, 24.0};
  for (int k = 0; k < 3000; ++k) c.step(good, nullptr, &out);
  const double level = out;
  // -(1 + 10 (0.75^1.5 - 0.2) - 4 * 2 + 0.5 * 2)
  EXPECT_NEAR(level, 1.505, 0.05);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {nan, std::numeric_limits<double>::infinity(), 295.0, -300.0}) {
    const double u[2] = {3000.0, bad};
    EXPECT_EQ(c.step(u, nullptr, &out), CompensatorState::Holding);
    EXPECT_EQ(c.refusedInput(), 1);
    EXPECT_NEAR(out, level, 0.2);
  }
  const double u[2] = {3000.0, nan};
  for (int k = 0; k < 200; ++k) c.step(u, nullptr, &out);
  EXPECT_EQ(c.state(), CompensatorState::Fallback);
  EXPECT_DOUBLE_EQ(out, 0.0);
  for (int k = 0; k < 200; ++k) c.step(good, nullptr, &out);
  EXPECT_EQ(c.state(), CompensatorState::Running);
  EXPECT_NEAR(out, level, 1.5);
  // Stale: the value is plausible but old.
  const double age[2] = {0.0, 31.0};
  c.step(good, age, &out);
  EXPECT_EQ(c.state(), CompensatorState::Fallback);
}

TEST(Compensator, IsZeroUntilAllInputsWereGoodOnce) {
  Compensator c;
  double out = 7.0;
  const double bad[2] = {0.0, std::numeric_limits<double>::quiet_NaN()};
  c.step(bad, nullptr, &out);
  EXPECT_EQ(c.state(), CompensatorState::Empty);
  ASSERT_EQ(c.load(model(), 1.0), "");
  EXPECT_EQ(c.step(bad, nullptr, &out), CompensatorState::Fallback);
  EXPECT_EQ(out, 0.0);
  EXPECT_THAT(c.load(model(), 0.0), HasSubstr("cycle"));
  ThermalModel large = model();
  large.outputs.front().terms.assign(2000, {0, 1.0, 1.0});
  EXPECT_THAT(c.load(large, 1.0), HasSubstr("1024"));
}

TEST(Compensator, WorksFromC) {
  const testing::TempFolder folder;
  model().write(folder / "model.json");
  double value = 0.0;
  EXPECT_EQ(compensate_one_minute((folder / "model.json").c_str(), 24.0, &value), SPINDRIFT_COMPENSATOR_RUNNING);
  EXPECT_LT(value, 20.0);
  EXPECT_NE(value, 0.0);
  char message[200];
  EXPECT_EQ(spindrift_compensator_load((folder / "none.json").c_str(), 1.0, 0.0, 0.0, message, sizeof message),
            nullptr);
  EXPECT_THAT(message, HasSubstr("none.json"));
}

}  // namespace
}  // namespace spindrift
