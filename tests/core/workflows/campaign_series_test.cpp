// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/workflows/campaign_series.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/base/text.h"
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
      c.observations->rows.push_back(o);
    }
    state += (1.0 - std::exp(-30.0 / series_tau_s)) * (rpm / 3000.0 - state);
  }
  c.log = OperatingLog(time);
  c.log->setSignal("spindle_rpm", speed);
  c.log->setSignal("compensation_on", on);
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

TEST(CampaignSeries, SaysWhatIsMissing) {
  testing::TempFolder folder;
  Campaign c = written(folder);
  JobContext job;
  c.observations->rows.resize(5);
  EXPECT_THROW(static_cast<void>(campaignSeries(c, nullptr, job)), InputError);
  c.log.reset();
  EXPECT_THROW(static_cast<void>(campaignSeries(c, nullptr, job)), InputError);
}

}  // namespace
}  // namespace spindrift
