// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/workflows/live_compensation.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/base/error.h"

namespace spindrift {
namespace {

constexpr double tau_s = 300.0, gain = 2.0, start_s = 1.7e9;

ThermalModel model() {
  ThermalModel m;
  m.inputs = {{"T_1_degC", SignalKind::Temperature, 1.0, 1.0, 20.0, 15.0, 35.0}};
  ThermalOutput o;
  o.name = "ez_um";
  o.unit = "um";
  o.offset = 1.0;
  o.terms = {{0, tau_s, gain}};
  m.outputs = {o};
  return m;
}

/// The temperature steps from 20 to 30 degC at start_s; before an hour of it nothing is known.
LiveCompensation::ValueAt stepOf(double lost_after_s = 1e300) {
  return [lost_after_s](const std::string& column, double t) -> std::optional<LiveCompensation::Held> {
    if (t < start_s - 1000.0) return std::nullopt;
    const double good = std::min(t, lost_after_s);
    if (column == "ez_um") return LiveCompensation::Held{7.0, good};
    return LiveCompensation::Held{t < start_s ? 20.0 : 30.0, good};
  };
}

TEST(LiveCompensation, ShowsThePredictionOfTheModelBesideTheMeasurement) {
  LiveCompensation live(model());
  EXPECT_EQ(live.output(), "ez_um");
  EXPECT_EQ(live.inputs(), std::vector<std::string>{"T_1_degC"});
  // In two looks, as a window takes them.
  live.advance(start_s + 10.0, stepOf());
  live.advance(start_s + 900.0, stepOf());
  ASSERT_FALSE(live.points().empty());
  // It begins where the input is known, at once with what a compensator that had been running would say.
  EXPECT_NEAR(live.points().front().time_s, start_s - 1000.0, 1.01);
  EXPECT_NEAR(live.points().back().time_s, start_s + 900.0, 1.01);
  for (const LiveCompensation::Point& point : live.points()) {
    const double since = point.time_s - start_s;
    const double expected = 1.0 + (since < 0.0 ? 0.0 : 10.0 * gain * (1.0 - std::exp(-since / tau_s)));
    // A step between two cycles is seen within one.
    EXPECT_NEAR(point.prediction, expected, 10.0 * gain / tau_s * 1.01 + 1e-6) << since;
    EXPECT_EQ(point.measured, 7.0);
    EXPECT_EQ(point.state, CompensatorState::Running);
  }
  EXPECT_GT(live.remainderRms(), 1.0);
}

TEST(LiveCompensation, ALostInputFadesOutAndIsNamed) {
  LiveCompensation live(model());
  live.advance(start_s + 1000.0, stepOf(start_s + 500.0));
  EXPECT_EQ(live.points().back().state, CompensatorState::Fallback);
  EXPECT_EQ(live.refusedInput(), "T_1_degC");
  EXPECT_NEAR(live.points().back().prediction, 0.0, 1e-9);
  // The last measurement of a source that is gone is none of now.
  EXPECT_TRUE(std::isnan(live.points().back().measured));
}

TEST(LiveCompensation, KeepsAnHourAndBeginsAnewAfterAPause) {
  LiveCompensation live(model());
  for (double t = 0.0; t <= 7200.0; t += 450.0) live.advance(start_s + t, stepOf());
  EXPECT_LE(live.points().size(), 3602U);
  EXPECT_NEAR(live.points().front().time_s, start_s + 3600.0, 1.01);
  // Nobody looked for a day: what was between is not known.
  live.advance(start_s + 86400.0, stepOf());
  EXPECT_NEAR(live.points().front().time_s, start_s + 82800.0, 1.01);
  EXPECT_NEAR(live.points().back().prediction, 21.0, 0.01);
}

TEST(LiveCompensation, AModelThatCannotRunIsRefusedWithItsReason) {
  ThermalModel none = model();
  none.outputs[0].terms.clear();
  try {
    const LiveCompensation live(none);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), ::testing::HasSubstr("has no terms"));
  }
}

}  // namespace
}  // namespace spindrift
