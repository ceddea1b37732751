// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/thermal/response_fit.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/json_reader.h"
#include "core/base/random.h"
#include "core/thermal/baselines.h"
#include "core/thermal/response_dictionary.h"
#include "tests/support/response_run.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

using ::testing::HasSubstr;

/// A spindle whose housing and head warm up, read by three noisy sensors; room drifts. Truth has lags that are not on
/// the grid.
TimeSeries plant(std::uint64_t seed, double hours, double noise_um) {
  Random random(seed);
  TimeSeries s;
  s.file = "plant.csv";
  const double dt = 30.0;
  const auto n = static_cast<std::size_t>(hours * 3600.0 / dt);
  std::vector<double> rpm(n);
  std::vector<double> heat(n);
  std::vector<double> room(n);
  for (std::size_t i = 0; i < n; ++i) {
    s.time_s.push_back(static_cast<double>(i) * dt);
    const int plateau = static_cast<int>(s.time_s[i] / 7200.0);
    const double speeds[] = {0.0, 2000.0, 0.0, 4000.0, 1000.0, 0.0, 3000.0, 0.0, 3500.0, 500.0, 0.0, 2500.0};
    rpm[i] = speeds[plateau % 12];
    heat[i] = std::pow(rpm[i] / 4000.0, 1.4);
    room[i] = 22.0 + 1.5 * std::sin(2.0 * M_PI * s.time_s[i] / 86400.0);
  }
  const auto housing = lagFiltered(s.time_s, heat, 1100.0, true);
  const auto head = lagFiltered(s.time_s, heat, 6500.0, true);
  const auto frame = lagFiltered(s.time_s, room, 9000.0, false);
  std::vector<double> y(n);
  std::vector<double> t1(n);
  std::vector<double> t2(n);
  std::vector<double> t3(n);
  for (std::size_t i = 0; i < n; ++i) {
    y[i] = 14.0 * housing[i] + 25.0 * head[i] - 3.0 * (frame[i] - 22.0) + random.normal(0.0, noise_um);
    t1[i] = room[i] + 9.0 * housing[i] + random.normal(0.0, 0.02);
    t2[i] = frame[i] + 4.0 * head[i] + random.normal(0.0, 0.02);
    t3[i] = room[i] + random.normal(0.0, 0.02);
  }
  s.signals = {{"spindle_rpm", SignalKind::Speed, rpm},
               {"T_1_degC", SignalKind::Temperature, t1},
               {"T_2_degC", SignalKind::Temperature, t2},
               {"T_3_degC", SignalKind::Temperature, t3},
               {"ez_um", SignalKind::Displacement, y}};
  return s;
}

double rms(const std::vector<double>& a, const std::vector<double>& b, std::size_t from) {
  double sum = 0.0;
  for (std::size_t i = from; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size() - from));
}

TEST(ResponseFit, FreeRunBeatsThePlainModelsOnUnseenSpeeds) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const TimeSeries s = plant(seed, 24.0, 0.3);
    const double cut = 14.0 * 3600.0;
    const auto inputs = automaticInputs(s, "ez_um");
    EXPECT_EQ(inputs.size(), 4U);
    const ResponseFitResult fit = fitResponse(s, "ez_um", inputs, 0.0, cut, {}, {});
    ASSERT_EQ(fit.status, FitStatus::Converged) << fit.message;
    const auto from = static_cast<std::size_t>(cut / 30.0);
    const auto& y = s.at("ez_um").values;
    const double dynamic = rms(fit.model.predict(s, 0).value, y, from);
    EXPECT_LT(dynamic, 0.35 * rms(staticRegression(s, "ez_um", 0.0, cut).prediction, y, from));
    EXPECT_LT(dynamic, 0.1 * rms(noModel(s, "ez_um", 0.0, cut).prediction, y, from));
  }
}

TEST(ResponseFit, DoesNotLookAtTheOutputAfterTraining) {
  TimeSeries s = plant(4, 20.0, 0.3);
  const auto first =
      fitResponse(s, "ez_um", automaticInputs(s, "ez_um"), 0.0, 40000.0, {}, {}).model.predict(s, 0).value;
  for (Signal& signal : s.signals)
    if (signal.name == "ez_um")
      for (std::size_t i = 0; i < s.time_s.size(); ++i)
        if (s.time_s[i] >= 40000.0) signal.values[i] = 1e6;
  const auto second =
      fitResponse(s, "ez_um", automaticInputs(s, "ez_um"), 0.0, 40000.0, {}, {}).model.predict(s, 0).value;
  EXPECT_EQ(first, second);
}

TEST(ResponseFit, AnIsolatedStepOfTheProbeCostsLittle) {
  TimeSeries s = plant(5, 24.0, 0.2);
  const auto clean = s.at("ez_um").values;
  for (Signal& signal : s.signals)
    if (signal.name == "ez_um")
      for (std::size_t i = 500; i < s.time_s.size(); ++i) signal.values[i] += 0.8;
  const auto p = fitResponse(s, "ez_um", automaticInputs(s, "ez_um"), 0.0, 50400.0, {}, {}).model.predict(s, 0).value;
  EXPECT_LT(rms(p, s.at("ez_um").values, 1680), 1.5);
}

TEST(ResponseFit, UncertaintyGrowsOutsideTheTrainingRange) {
  TimeSeries s = plant(6, 24.0, 0.3);
  const ResponseFitResult fit = fitResponse(s, "ez_um", automaticInputs(s, "ez_um"), 0.0, 50400.0, {}, {});
  TimeSeries hot = s;
  for (Signal& signal : hot.signals)
    if (signal.name == "T_3_degC")
      for (double& v : signal.values) v += 25.0;
  const ThermalPrediction inside = fit.model.predict(s, 0);
  const ThermalPrediction outside = fit.model.predict(hot, 0);
  EXPECT_EQ(inside.outside[1000], 0);
  EXPECT_EQ(outside.outside[1000], 1);
  EXPECT_FALSE(outside.notes.empty());
  EXPECT_GT(outside.sigma[1000], 3.0 * inside.sigma[1000]);
}

/// Part of the 95 % intervals that hold what they are about, and how well so many records tell it.
struct Rate {
  double mean = 0.0;
  double sigma = 0.0;
};

Rate rateOf(const std::vector<double>& of_records) {
  Rate rate;
  for (const double part : of_records) rate.mean += part / static_cast<double>(of_records.size());
  for (const double part : of_records) rate.sigma += std::pow(part - rate.mean, 2);
  rate.sigma = std::sqrt(rate.sigma) / static_cast<double>(of_records.size());
  return rate;
}

TEST(ResponseFit, IntervalsHoldAsOftenAsStated) {
  for (const testing::ResponseRun& kind : {testing::ResponseRun{false, 0.3, 0.0}, testing::ResponseRun{true, 0.3, 0.0},
                                           testing::ResponseRun{true, 0.2, 0.6}}) {
    std::vector<double> measured;
    std::vector<double> step;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
      const testing::ResponseCoverage coverage = testing::responseCoverage(testing::responseRun(300 + seed, kind));
      const auto part = [](const std::vector<char>& inside) {
        return static_cast<double>(std::count(inside.begin(), inside.end(), char{1})) /
               static_cast<double>(inside.size());
      };
      if (!coverage.measured.empty()) measured.push_back(part(coverage.measured));
      if (!coverage.step.empty()) step.push_back(part(coverage.step));
    }
    const Rate of_measured = rateOf(measured);
    EXPECT_NEAR(of_measured.mean, 0.95, 0.015 + 2.0 * of_measured.sigma) << kind.sensors << kind.drift_um;
    EXPECT_LT(of_measured.sigma, 0.01);
    if (step.empty()) continue;
    const Rate of_step = rateOf(step);
    EXPECT_NEAR(of_step.mean, 0.95, 0.015 + 2.0 * of_step.sigma);
  }
}

TEST(ResponseFit, SaysWhyAnInputIsDropped) {
  TimeSeries s = plant(7, 16.0, 0.3);
  s.signals.push_back({"T_still_degC", SignalKind::Temperature, std::vector<double>(s.time_s.size(), 20.0)});
  s.signals.push_back({"T_twin_degC", SignalKind::Temperature, s.at("T_1_degC").values});
  const ResponseFitResult fit = fitResponse(s, "ez_um", automaticInputs(s, "ez_um"), 0.0, 50000.0, {}, {});
  int found = 0;
  for (const InputVerdict& v : fit.verdicts) {
    EXPECT_FALSE(v.reason.empty());
    if (v.name == "T_still_degC") found += !v.kept && v.reason.find("constant") == 0;
    if (v.name == "T_twin_degC") found += !v.kept && v.reason.find("identical to T_1_degC") == 0;
  }
  EXPECT_EQ(found, 2);
}

TEST(ResponseFit, RefusesWhatCannotWork) {
  TimeSeries s = plant(8, 4.0, 0.3);
  s.signals.push_back({"copy", SignalKind::Other, s.at("ez_um").values});
  const auto refusal = [&](const std::vector<std::string>& inputs, double to) {
    try {
      static_cast<void>(fitResponse(s, "ez_um", inputs, 0.0, to, {}, {}));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_THAT(refusal({"copy"}, 1e5), HasSubstr("copy of the output"));
  EXPECT_THAT(refusal({"T_1_degC"}, 1500.0), HasSubstr("50 samples"));
  EXPECT_THAT(refusal({"nothing"}, 1e5), HasSubstr("\"nothing\" is missing"));
  EXPECT_THAT(refusal({"spindle_rpm"}, 7200.0), HasSubstr("constant"));
}

TEST(ThermalModel, SurvivesAFile) {
  const TimeSeries s = plant(9, 16.0, 0.3);
  const ThermalModel model = fitResponse(s, "ez_um", automaticInputs(s, "ez_um"), 0.0, 50000.0, {}, {}).model;
  const testing::TempFolder folder;
  model.write(folder / "model.json");
  const ThermalModel back = ThermalModel::read(folder / "model.json");
  const auto a = model.predict(s, 0);
  const auto b = back.predict(s, 0);
  for (std::size_t i = 0; i < a.value.size(); i += 100) {
    EXPECT_NEAR(a.value[i], b.value[i], 1e-9);
    EXPECT_NEAR(a.sigma[i], b.sigma[i], 1e-9 * a.sigma[i]);
  }
  const Eigen::MatrixXd before = model.outputs[0].covariance.triangularView<Eigen::Lower>();
  const Eigen::MatrixXd after = back.outputs[0].covariance.triangularView<Eigen::Lower>();
  EXPECT_EQ(before, after) << "to the last digit";
  folder.write("bad.json", R"({"format":"spindrift-thermal-model","version":2})");
  EXPECT_THROW(static_cast<void>(ThermalModel::read(folder / "bad.json")), InputError);
}

TEST(ThermalModel, LagsAreExactAtAnySpacing) {
  // Ramp input: x = t - tau (1 - exp(-t / tau)).
  const std::vector<double> time = {0.0, 0.001, 5.0, 5.5, 300.0, 90000.0};
  const std::vector<double> x = lagFiltered(time, time, 700.0, false);
  for (std::size_t i = 0; i < time.size(); ++i)
    EXPECT_NEAR(x[i], time[i] - 700.0 * -std::expm1(-time[i] / 700.0), 1e-8 * (1.0 + time[i]));
}

// The nodes of a finite-element model: hundreds of columns that tell the same few things.
TEST(ResponseFit, OfHundredsOfColumnsThoseAreLookedAtThatTellMost) {
  Random random(3);
  constexpr std::size_t rows = 600;
  constexpr std::size_t columns = 220;
  constexpr std::size_t causes = 5;
  TimeSeries series;
  std::vector<std::vector<double>> cause(causes, std::vector<double>(rows));
  for (std::vector<double>& c : cause) {
    double level = 0.0;
    for (double& v : c) v = level += random.normal(0.0, 0.1);
  }
  std::vector<std::string> names;
  for (std::size_t r = 0; r < rows; ++r) series.time_s.push_back(60.0 * static_cast<double>(r));
  for (std::size_t k = 0; k < columns; ++k) {
    Signal s{fmt::format("T_{}_degC", k), SignalKind::Temperature, std::vector<double>(rows, 20.0)};
    for (const std::vector<double>& c : cause) {
      const double weight = random.normal(0.0, 1.0);
      for (std::size_t r = 0; r < rows; ++r) s.values[r] += weight * c[r];
    }
    for (double& v : s.values) v += random.normal(0.0, 0.002);
    if (k == 40) s.values[100] = std::nan("");
    names.push_back(s.name);
    series.signals.push_back(std::move(s));
  }
  Signal z{"z_um", SignalKind::Displacement, cause[2]};
  series.signals.push_back(z);
  std::vector<InputVerdict> verdicts;
  const std::vector<std::string> kept = response::usableInputs(series, "z_um", names, 0.0, 60.0 * rows, verdicts);
  EXPECT_EQ(kept.size(), 64U);
  EXPECT_EQ(verdicts.size(), columns - 64U);
  for (const InputVerdict& v : verdicts) {
    EXPECT_FALSE(v.kept);
    EXPECT_EQ(v.reason, "the 64 columns that are looked at explain 100.0 % of its variance") << v.name;
    EXPECT_EQ(std::count(kept.begin(), kept.end(), v.name), 0);
  }
  std::vector<InputVerdict> none;
  EXPECT_EQ(response::usableInputs(series, "z_um", {names.begin(), names.begin() + 64}, 0.0, 60.0 * rows, none).size(),
            64U);
  EXPECT_TRUE(none.empty());
}

}  // namespace
}  // namespace spindrift
