// SPDX-License-Identifier: GPL-3.0-or-later
// The model that `thermal identify` chooses by itself, judged in free run over the last 40 % of made records.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/random.h"
#include "core/thermal/autocorrelation.h"
#include "core/thermal/compensator.h"
#include "core/thermal/method_choice.h"
#include "core/workflows/thermal_workflow.h"
#include "tests/support/frame_run.h"
#include "tests/support/temp_folder.h"

namespace spindrift::testing {
namespace {

constexpr double train_part = 0.6;

IdentifyRequest request(const TimeSeries& series, const std::string& method) {
  IdentifyRequest r;
  r.output = "z_um";
  const double cut = train_part * series.time_s.back();
  r.train = {0.0, cut};
  r.test = {cut, 1e300};
  r.method = method;
  r.peers = method.empty();
  return r;
}

TEST(ThermalChoice, IsAsGoodAsTheBestOfLineRidgeArxAndOutputError) {
  double log_ratio = 0.0;
  double inside = 0.0;
  constexpr int runs = 10;
  for (int seed = 0; seed < runs; ++seed) {
    const TimeSeries series = frameRun(static_cast<std::uint64_t>(seed));
    const IdentifyResult chosen = identifyThermalModel(series, request(series, ""), {});
    double best = std::numeric_limits<double>::infinity();
    for (const ModelComparison& plain : chosen.plain)
      if (plain.name.starts_with("static") || plain.name.starts_with("ridge")) best = std::min(best, plain.test.rmse);
    for (const char* method : {"arx", "oe"})
      best = std::min(best, identifyThermalModel(series, request(series, method), {}).test.rmse);
    EXPECT_LT(chosen.test.rmse, 2.0 * best) << "seed " << seed;
    log_ratio += std::log(chosen.test.rmse / best) / runs;
    double rows = 0.0;
    double within = 0.0;
    for (std::size_t r = 0; r < chosen.time_s.size(); ++r) {
      if (chosen.time_s[r] < train_part * series.time_s.back()) continue;
      rows += 1.0;
      within += std::abs(chosen.measured[r] - chosen.predicted[r]) <= 1.96 * chosen.sigma[r] ? 1.0 : 0.0;
    }
    inside += within / rows / runs;
  }
  EXPECT_LT(std::exp(log_ratio), 1.1) << "geometric mean of the ratio to the best of four";
  EXPECT_GT(inside, 0.8) << "free run within the 95 % interval";
}

TEST(ThermalChoice, TheAverageIsOneModelThatIsStoredAndRunAsJudged) {
  const TimeSeries series = frameRun(3);
  const IdentifyResult chosen = identifyThermalModel(series, request(series, ""), {});
  ASSERT_GE(chosen.methods.size(), 4U);
  double shares = 0.0;
  int sharing = 0;
  for (const MethodEvidence& m : chosen.methods) {
    EXPECT_GT(m.left_out_rms, 0.0) << m.method;
    shares += m.weight;
    sharing += m.weight > 0.01 ? 1 : 0;
  }
  EXPECT_NEAR(shares, 1.0, 1e-9);
  EXPECT_GE(sharing, 2) << "an average";
  const TempFolder folder;
  chosen.model.write(folder / "model.json");
  const ThermalModel read = ThermalModel::read(folder / "model.json");
  const std::vector<double> again = read.predict(series, 0).value;
  Compensator compensator;
  CompensatorLimits limits;
  limits.limit = 1e6;
  limits.slew_per_s = 1e6;
  limits.forced = true;
  ASSERT_EQ(compensator.load(read, series.time_s[1] - series.time_s[0], limits), "");
  std::vector<double> inputs(static_cast<std::size_t>(compensator.inputCount()));
  double largest = 0.0;
  for (std::size_t r = 0; r < series.time_s.size(); ++r) {
    for (int i = 0; i < compensator.inputCount(); ++i)
      inputs[static_cast<std::size_t>(i)] = series.at(compensator.inputName(i)).values[r];
    double out = 0.0;
    compensator.step(inputs.data(), nullptr, &out);
    largest = std::max(largest, std::abs(out + chosen.predicted[r]));
    EXPECT_NEAR(again[r], chosen.predicted[r], 1e-6);
  }
  EXPECT_LT(largest, 1e-6);
}

TEST(ThermalChoice, NothingMeasuredAfterTrainingIsUsed) {
  TimeSeries series = frameRun(1);
  const IdentifyResult before = identifyThermalModel(series, request(series, ""), {});
  for (Signal& s : series.signals) {
    if (s.name != "z_um") continue;
    for (std::size_t r = 0; r < s.values.size(); ++r)
      if (series.time_s[r] >= train_part * series.time_s.back()) s.values[r] = 1e5;
  }
  const IdentifyResult after = identifyThermalModel(series, request(series, ""), {});
  EXPECT_EQ(before.predicted, after.predicted);
}

TEST(ThermalChoice, SlipsOfTheProbeCostNothing) {
  TimeSeries series = frameRun(2);
  const double clean = identifyThermalModel(series, request(series, ""), {}).train.rmse;
  for (Signal& s : series.signals)
    if (s.name == "z_um") s.values[200] += 4000.0;
  const IdentifyResult slipped = identifyThermalModel(series, request(series, ""), {});
  double sum = 0.0;
  double rows = 0.0;
  for (std::size_t r = 0; r < series.time_s.size() && series.time_s[r] < train_part * series.time_s.back(); ++r) {
    if (r == 200) continue;
    sum += std::pow(slipped.measured[r] - slipped.predicted[r], 2);
    rows += 1.0;
  }
  EXPECT_LT(std::sqrt(sum / rows), 1.1 * clean + 0.5);
}

TEST(ThermalChoice, AnAverageOfModelsPredictsTheAverage) {
  const TimeSeries series = frameRun(0);
  const auto inputs = automaticInputs(series, "z_um");
  const double cut = train_part * series.time_s.back();
  const ThermalModel a = fitResponse(series, "z_um", inputs, 0.0, cut, {}, {}).model;
  const ThermalModel b = fitResponse(series, "z_um", {"bed_degC"}, 0.0, cut, {}, {}).model;
  const ThermalModel both = weightedAverage({a, b}, {0.3, 0.7});
  const ThermalPrediction pa = a.predict(series, 0);
  const ThermalPrediction pb = b.predict(series, 0);
  const ThermalPrediction p = both.predict(series, 0);
  ASSERT_EQ(p.sigma.size(), p.value.size());
  for (std::size_t r = 0; r < p.value.size(); r += 50)
    EXPECT_NEAR(p.value[r], 0.3 * pa.value[r] + 0.7 * pb.value[r], 1e-6);
}

TEST(ThermalChoice, AnArxModelWithComplexPolesIsNotShipped) {
  // A swinging system: poles 0.95 +- 0.2i.
  Random random(5);
  TimeSeries series;
  std::vector<double> u;
  std::vector<double> y;
  for (int k = 0; k < 900; ++k) {
    const auto i = static_cast<std::size_t>(k);
    series.time_s.push_back(30.0 * k);
    u.push_back(k % 60 == 0 || k == 0 ? random.uniform(20.0, 40.0) : u.back());
    y.push_back(k < 2 ? 0.0 : 1.9 * y[i - 1] - 0.9425 * y[i - 2] + 0.04 * u[i - 1] + random.normal(0.0, 0.01));
  }
  series.signals = {{"bed_degC", SignalKind::Temperature, u}, {"z_um", SignalKind::Displacement, y}};
  IdentifyRequest asked = request(series, "arx");
  asked.order = std::array<int, 3>{2, 1, 1};
  asked.inputs = {"bed_degC"};
  const IdentifyResult arx = identifyThermalModel(series, asked, {});
  ASSERT_TRUE(arx.model.outputs.front().terms.empty());
  EXPECT_FALSE(arx.good_enough);
  EXPECT_THAT(arx.model.outputs.front().verdict->reason, ::testing::HasSubstr("no equivalent in lags"));
  const TempFolder folder;
  EXPECT_THROW(arx.model.write(folder / "model.json"), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder / "model.json"));
  Compensator compensator;
  CompensatorLimits forced;
  forced.forced = true;
  EXPECT_THAT(compensator.load(arx.model, 30.0, forced), ::testing::HasSubstr("no equivalent in lags"));
}

TEST(ThermalChoice, AnArxModelWithRealPolesIsJudgedAsItIsShipped) {
  const TimeSeries series = frameRun(2);
  IdentifyRequest asked = request(series, "arx");
  asked.order = std::array<int, 3>{1, 1, 0};
  asked.inputs = {"frame_degC", "bed_degC"};
  const IdentifyResult arx = identifyThermalModel(series, asked, {});
  ASSERT_FALSE(arx.model.outputs.front().terms.empty());
  EXPECT_EQ(arx.predicted, arx.model.predict(series, 0).value);
}

TEST(ThermalChoice, OutputErrorThatTheDataDoNotDetermineEndsWithAModelOrASentence) {
  const TimeSeries series = frameRun(34);
  const IdentifyResult result = identifyThermalModel(series, request(series, "oe"), {});
  EXPECT_GE(result.model.outputs.front().degrees_of_freedom, 1.0);
  EXPECT_TRUE(std::isfinite(result.test.rmse));
}

TEST(Autocorrelation, EqualsTheSumOfProducts) {
  Random random(2);
  std::vector<double> v;
  for (int k = 0; k < 777; ++k) v.push_back(random.normal() + (k > 0 ? 0.8 * v.back() : 0.0));
  const std::vector<double> fast = autocorrelation(v, 100);
  ASSERT_EQ(fast.size(), 101U);
  for (std::size_t lag = 0; lag < fast.size(); ++lag) {
    double zero = 0.0;
    double sum = 0.0;
    for (std::size_t i = 0; i < v.size(); ++i) zero += v[i] * v[i];
    for (std::size_t i = lag; i < v.size(); ++i) sum += v[i] * v[i - lag];
    EXPECT_NEAR(fast[lag], sum / zero, 1e-12) << lag;
  }
  EXPECT_TRUE(autocorrelation({}, 5).empty());
  EXPECT_EQ(autocorrelation(std::vector<double>(4, 0.0), 9), std::vector<double>(4, 0.0));
}

}  // namespace
}  // namespace spindrift::testing
