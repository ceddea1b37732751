// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/workflows/campaign_series.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/base/text.h"
#include "core/thermal/compensator.h"
#include "core/workflows/thermal_workflow.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

constexpr double series_tau_s = 3000.0;
constexpr double series_gain = 12.0;  // um at 3000 rpm

/// 40 h: a fast log of the speed every 30 s, EZ of point F1 every 30 min with 0.2 um. The control compensates in the
/// last 5 h and leaves nothing.
Campaign sparse() {
  Random random(11);
  Campaign c;
  std::vector<double> time;
  std::vector<double> speed;
  std::vector<double> on;
  c.observations.emplace();
  double state = 0.0;
  double rpm = 0.0;
  for (int i = 0; i < 4800; ++i) {
    if (i % 240 == 0) rpm = 1000.0 * std::floor(random.uniform(0.0, 4.0));
    time.push_back(30.0 * i);
    speed.push_back(rpm);
    on.push_back(i >= 4200 ? 1.0 : 0.0);
    if (i % 60 == 0) {
      Observation o;
      o.time_s = time.back();
      o.state = "M" + std::to_string(i / 60);
      o.point = "F1";
      o.component = Component::EZ;
      o.value = (on.back() > 0.5 ? 0.0 : series_gain * state) + random.normal(0.0, 0.2);
      o.sigma = 0.2;
      c.observations.edit().rows.push_back(o);
    }
    state += (1.0 - std::exp(-30.0 / series_tau_s)) * (rpm / 3000.0 - state);
  }
  c.log = OperatingLog(time);
  c.log.edit().setSignal("spindle_rpm", speed);
  c.log.edit().setSignal("compensation_on", on);
  return c;
}

Campaign written(testing::TempFolder& folder) {
  Campaign c = sparse();
  std::string text = "time_s,spindle_rpm,compensation_on\n";
  for (std::size_t i = 0; i < c.log->time_s().size(); ++i)
    text += exactNumber(c.log->time_s()[i]) + "," + exactNumber((*c.log->signal("spindle_rpm"))[i]) + "," +
            exactNumber((*c.log->signal("compensation_on"))[i]) + "\n";
  folder.write("log.csv", text);
  c.folder = folder.path();
  return c;
}

TEST(CampaignSeries, SparseObservationsJoinTheFastLogAndGiveTheModel) {
  testing::TempFolder folder;
  const Campaign c = written(folder);
  JobContext job;
  const CampaignSeries found = campaignSeries(c, nullptr, job);
  ASSERT_EQ(outputSignals(found.series), (std::vector<std::string>{"F1_EZ_um"}));
  EXPECT_NEAR(found.sigma.at("F1_EZ_um"), 0.2, 1e-12);
  ASSERT_FALSE(found.series.notes.empty());
  EXPECT_NE(found.series.notes.back().find("10 of 80"), std::string::npos) << found.series.notes.back();
  IdentifyRequest request;
  request.output = "F1_EZ_um";
  request.train = {0.0, 90000.0};
  request.test = {90000.0, 126000.0};
  const IdentifyResult model = identifyThermalModel(found.series, request, job);
  EXPECT_LT(model.test.rmse, 0.6);
  EXPECT_LT(model.test.rmse, 0.2 * model.plain.front().test.rmse);
  ASSERT_EQ(model.step_responses.size(), 1U);
  EXPECT_NEAR(model.step_responses[0].final_value, series_gain * model.step_responses[0].step / 3000.0, 1.0);
  // What needs a value at every row says so.
  request.method = "oe";
  EXPECT_THROW(static_cast<void>(identifyThermalModel(found.series, request, job)), InputError);
  // Rows taken while compensating are no measured output at all.
  request.method.clear();
  request.test = {126000.0, 144000.0};
  EXPECT_THROW(static_cast<void>(identifyThermalModel(found.series, request, job)), InputError);
}

/// An output keeps the unit of its name, whatever finds its model, and a machine is compensated in no other.
TEST(CampaignSeries, AModelStatesTheUnitOfItsOutput) {
  Random random(3);
  TimeSeries series;
  std::vector<double> rpm, growth;
  double state = 0.0;
  for (int k = 0; k < 1200; ++k) {
    series.time_s.push_back(30.0 * k);
    rpm.push_back((k / 100) % 2 == 1 ? 1000.0 * static_cast<double>(1 + (k / 200) % 3) : 0.0);
    growth.push_back(20.0 * state + random.normal(0.0, 0.2));
    state += (1.0 - std::exp(-30.0 / 900.0)) * (rpm.back() / 3000.0 - state);
  }
  for (const auto& [name, unit, loads] : {std::tuple{"Z_um", "um", true},
                                          {"A_urad", "urad", true},
                                          {"Z_nm", "nm", false},
                                          {"A_mrad", "mrad", false},
                                          {"EXX_um_per_m", "um/m", false},
                                          {"growth", "", false}}) {
    series.signals = {{"spindle_rpm", SignalKind::Speed, rpm}, {name, signalKind(name, growth), growth}};
    for (const char* method : {"response", "arx", "oe"}) {
      IdentifyRequest request;
      request.output = name;
      request.inputs = {"spindle_rpm"};
      request.method = method;
      request.train = {0.0, 24000.0};
      request.test = {24000.0, 36000.0};
      JobContext job;
      const IdentifyResult found = identifyThermalModel(series, request, job);
      EXPECT_EQ(found.model.outputs.front().unit, unit) << name << " by " << method;
      if (found.model.outputs.front().terms.empty()) continue;
      Compensator compensator;
      CompensatorLimits forced;
      forced.forced = true;
      EXPECT_EQ(compensator.load(found.model, 1.0, forced).empty(), loads) << name << " by " << method;
    }
  }
}

/// Of a column in Fahrenheit: the model names the unit that its numbers have, and the log is still found by it.
TEST(CampaignSeries, AModelOfAConvertedTemperatureNamesItsUnit) {
  std::string text = "time_s,T_b_degF,Z_um\n";
  Random random(4);
  double state = 20.0;
  double room = 20.0;
  for (int k = 0; k < 1200; ++k) {
    if (k % 150 == 0) room = random.uniform(20.0, 40.0);
    state += (1.0 - std::exp(-30.0 / 900.0)) * (room - state);
    text += std::to_string(30 * k) + "," + exactNumber(32.0 + 1.8 * room) + "," +
            exactNumber(2.0 * state + random.normal(0.0, 0.1)) + "\n";
  }
  const TimeSeries series = parseTimeSeries(text, "log.csv");
  for (const char* asked : {"T_b_degF", "T_b_degC", ""}) {
    IdentifyRequest request;
    request.output = "Z_um";
    if (*asked != 0) request.inputs = {asked};
    request.train = {0.0, 24000.0};
    request.test = {24000.0, 36000.0};
    JobContext job;
    IdentifyResult found = identifyThermalModel(series, request, job);
    ASSERT_FALSE(found.model.inputs.empty());
    EXPECT_EQ(found.model.inputs.front().name, "T_b_degC") << asked;
    EXPECT_LT(found.model.inputs.front().train_max, 41.0);
    // A model that names its input as the file did predicts the same.
    const std::vector<double> expected = found.model.predict(series, 0).value;
    for (ThermalInput& input : found.model.inputs) input.name = "T_b_degF";
    EXPECT_EQ(found.model.predict(series, 0).value, expected);
  }
}

TEST(CampaignSeries, SaysWhatIsMissing) {
  testing::TempFolder folder;
  Campaign c = written(folder);
  JobContext job;
  c.observations.edit().rows.resize(5);
  EXPECT_THROW(static_cast<void>(campaignSeries(c, nullptr, job)), InputError);
  c.log.reset();
  EXPECT_THROW(static_cast<void>(campaignSeries(c, nullptr, job)), InputError);
}

}  // namespace
}  // namespace spindrift
